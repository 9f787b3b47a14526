#pragma once

/// @file
/// Includes all public headers but three: `tbb_executor.hpp` needs oneTBB, and `gpu.hpp` and `gpu_scene.hpp` belong to
/// `surehit::gpu`. `intersect` is for one triangle, `Collider` is for a mesh, and `Scene` is for many placed meshes.

#include "surehit/scalar.hpp"

#if defined(__cpp_concepts)  // else scalar.hpp has said that C++20 is needed
#include "surehit/collider.hpp"
#include "surehit/explain.hpp"
#include "surehit/hit.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/intersect.hpp"
#include "surehit/path.hpp"
#include "surehit/path_span.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/scene.hpp"
#include "surehit/scene_shape_hit.hpp"
#include "surehit/scene_shape_options.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/shape_options.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/swept_shape.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"
#include "surehit/triangle_mesh_view.hpp"
#include "surehit/version.hpp"
#endif
