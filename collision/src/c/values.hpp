#pragma once

#include "c/arguments.hpp"
#include "surehit/box.hpp"
#include "surehit/c/values_d.h"
#include "surehit/c/values_f.h"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/path_span.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/triangle.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::c {

/// The structs of the C interface for a Scalar.
template <typename Scalar>
struct Structs;

#define SUREHIT_STRUCTS(Scalar, s)                 \
  template <>                                      \
  struct Structs<Scalar> {                         \
    using Vector3 = surehit_vector3##s;            \
    using Box = surehit_box##s;                    \
    using Triangle = surehit_triangle##s;          \
    using Path = surehit_path##s;                  \
    using Paths = surehit_paths##s;                \
    using Hit = surehit_hit##s;                    \
    using Mesh = surehit_mesh##s;                  \
    using QueryOptions = surehit_query_options##s; \
    using BatchOptions = surehit_batch_options##s; \
    using Filter = surehit_filter##s;              \
  };
SUREHIT_STRUCTS(float, f)
SUREHIT_STRUCTS(double, d)
#undef SUREHIT_STRUCTS

inline Vector3<float> from_c(const surehit_vector3f& vector) { return {vector.x, vector.y, vector.z}; }
inline Vector3<double> from_c(const surehit_vector3d& vector) { return {vector.x, vector.y, vector.z}; }
inline surehit_vector3f to_c(const Vector3<float>& vector) { return {vector[0], vector[1], vector[2]}; }
inline surehit_vector3d to_c(const Vector3<double>& vector) { return {vector[0], vector[1], vector[2]}; }

template <typename Scalar>
[[nodiscard]] typename Structs<Scalar>::Box to_c(const Box<Scalar>& box) {
  return {to_c(box.low), to_c(box.high)};
}
template <typename Scalar>
[[nodiscard]] typename Structs<Scalar>::Triangle to_c(const Triangle<Scalar>& triangle) {
  return {to_c(triangle.a), to_c(triangle.b), to_c(triangle.c)};
}
inline Triangle<float> from_c(const surehit_trianglef& t) { return {from_c(t.a), from_c(t.b), from_c(t.c)}; }
inline Triangle<double> from_c(const surehit_triangled& t) { return {from_c(t.a), from_c(t.b), from_c(t.c)}; }

/// The path must have been checked.
inline Path<float> from_c(const surehit_pathf& path) {
  return {static_cast<PathKind>(path.kind), from_c(path.start), from_c(path.toward)};
}
inline Path<double> from_c(const surehit_pathd& path) {
  return {static_cast<PathKind>(path.kind), from_c(path.start), from_c(path.toward)};
}

/// Fails unless the path can be read.
template <typename CPath>
void check_path(Arguments& arguments, const CPath* path, const char* name) {
  arguments.check_pointer(path, name);
  if (arguments.are_valid()) arguments.check_value(path->kind, 3, 0, "the kind of the path");
}

/// Fails if a corner of the triangle is not finite.
template <typename Scalar>
void check_corners(Arguments& arguments, const typename Structs<Scalar>::Triangle* triangle) {
  if (!arguments.are_valid()) return;
  const Triangle<Scalar> corners = from_c(*triangle);
  if (!corners.a.allFinite() || !corners.b.allFinite() || !corners.c.allFinite()) {
    arguments.refuse(SUREHIT_INVALID_VALUE, 0, "a corner of the triangle is not finite");
  }
}

/// Adds the work of a call to what the caller has. `statistics` may be null.
inline void add_work(const QueryStatistics& work, surehit_statistics* statistics) {
  if (statistics == nullptr) return;
  statistics->paths += work.paths;
  statistics->cells += work.cells;
  statistics->candidates += work.candidates;
  statistics->undecided += work.undecided;
  statistics->exact_decisions += work.exact_decisions;
  statistics->exact_orders += work.exact_orders;
  statistics->exact_roundings += work.exact_roundings;
  statistics->instances += work.instances;
  statistics->unclipped += work.unclipped;
}

}  // namespace surehit::c
