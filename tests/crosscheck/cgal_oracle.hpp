#pragma once

#include "surehit/path.hpp"
#include "surehit/pose.hpp"
#include "surehit/query_options.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Whether a finite path meets a finite triangle under the options: the verdict of CGAL's kernel of exact predicates
/// and exact constructions.
template <typename Scalar>
[[nodiscard]] bool cgal_meets(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                              const QueryOptions<Scalar>& options = {});

/// Whether a finite path meets the exact image of a finite triangle, while this moves as `Scene::set_motion` says.
template <typename Scalar>
[[nodiscard]] bool cgal_meets_placed(const Path<Scalar>& path, const Triangle<double>& triangle,
                                     const Pose<Scalar>& pose, const Vector3<Scalar>& motion,
                                     const QueryOptions<Scalar>& options = {});

}  // namespace surehit::test
