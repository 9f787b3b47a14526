#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "surehit/scalar.hpp"

namespace surehit {

/// A point or a vector, in the mesh's own unit of length. Twelve or twenty-four bytes, no over-alignment.
template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

/// The points start + t (end - start) with t in [0, 1], both ends included.
/// A point swept through one physics step is the same thing: t is then the time of impact as a fraction of the step.
template <FloatOrDouble Scalar>
struct Segment {
  Vector3<Scalar> start;
  Vector3<Scalar> end;
};

/// The points origin + t direction with t in [0, inf). The direction is taken as given, of any length: t counts in it.
template <FloatOrDouble Scalar>
struct Ray {
  Vector3<Scalar> origin;
  Vector3<Scalar> direction;
};

/// The points origin + t direction with t in (-inf, inf).
template <FloatOrDouble Scalar>
struct Line {
  Vector3<Scalar> origin;
  Vector3<Scalar> direction;
};

enum class PathKind : std::uint8_t { segment, ray, line };

/// Any of the three, so that every query is written once. Segments, rays and lines convert to it by themselves.
template <FloatOrDouble Scalar>
struct Path {
  Path(PathKind kind_given, const Vector3<Scalar>& start_given, const Vector3<Scalar>& toward_given)
      : kind(kind_given), start(start_given), toward(toward_given) {}
  Path(const Segment<Scalar>& segment) : kind(PathKind::segment), start(segment.start), toward(segment.end) {}
  Path(const Ray<Scalar>& ray) : kind(PathKind::ray), start(ray.origin), toward(ray.direction) {}
  Path(const Line<Scalar>& line) : kind(PathKind::line), start(line.origin), toward(line.direction) {}

  /// A segment and a ray begin at `start`; a line runs through it.
  [[nodiscard]] bool has_start() const { return kind != PathKind::line; }
  /// Only a segment ends, at `toward`.
  [[nodiscard]] bool has_end() const { return kind == PathKind::segment; }

  PathKind kind;
  Vector3<Scalar> start;   ///< the start or the origin
  Vector3<Scalar> toward;  ///< the end of a segment, the direction of a ray or a line
};

using Vector3f = Vector3<float>;
using Vector3d = Vector3<double>;
using Segmentf = Segment<float>;
using Segmentd = Segment<double>;
using Rayf = Ray<float>;
using Rayd = Ray<double>;
using Linef = Line<float>;
using Lined = Line<double>;
using Pathf = Path<float>;
using Pathd = Path<double>;

}  // namespace surehit
