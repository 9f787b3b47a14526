#pragma once

/// The whole public surface: paths, meshes, `intersect` for one triangle and `Collider` for a mesh.

#include "surehit/collider.hpp"
#include "surehit/hit.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/intersect.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/triangle.hpp"
#include "surehit/triangle_mesh_view.hpp"
