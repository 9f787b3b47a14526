#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "surehit/scalar.hpp"

namespace surehit {

/// A point or a vector, in the mesh's unit of length. It has 12 bytes in float and 24 bytes in double, and no alignment
/// beyond that of its Scalar.
template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

/// The points start + t (end - start) with t in [0, 1], both ends included. A segment of length zero is a point, at t =
/// 0.
///
/// A segment is also the way of a point in one physics step. The t of a hit is then the time of impact, as a fraction
/// of the step. Any finite coordinates are allowed. A segment with a NaN or an infinity hits nothing.
template <FloatOrDouble Scalar>
struct Segment {
  Vector3<Scalar> start;  ///< The point at t = 0.
  Vector3<Scalar> end;    ///< The point at t = 1.
};

/// The points origin + t direction with t in [0, inf).
///
/// The direction may have any length, and is the unit of t. A ray with a zero direction is a point, at t = 0. A ray
/// with a NaN or an infinity hits nothing.
template <FloatOrDouble Scalar>
struct Ray {
  Vector3<Scalar> origin;     ///< The point at t = 0.
  Vector3<Scalar> direction;  ///< The way from t = 0 to t = 1.
};

/// The points origin + t direction with t in (-inf, inf).
///
/// The direction may have any length, and is the unit of t. A line with a zero direction is a point, at t = 0. A line
/// with a NaN or an infinity hits nothing.
template <FloatOrDouble Scalar>
struct Line {
  Vector3<Scalar> origin;     ///< The point at t = 0.
  Vector3<Scalar> direction;  ///< The way from t = 0 to t = 1.
};

/// The kind of a path.
enum class PathKind : std::uint8_t {
  segment,  ///< A `Segment`.
  ray,      ///< A `Ray`.
  line      ///< A `Line`.
};

/// A segment, a ray or a line. All of them convert to it, so each query takes all of them.
template <FloatOrDouble Scalar>
struct Path {
  /// Makes a path of any kind. `toward_given` is the end of a segment, or the direction of a ray or a line.
  Path(PathKind kind_given, const Vector3<Scalar>& start_given, const Vector3<Scalar>& toward_given)
      : kind(kind_given), start(start_given), toward(toward_given) {}
  /// Makes a path of a segment.
  Path(const Segment<Scalar>& segment) : kind(PathKind::segment), start(segment.start), toward(segment.end) {}
  /// Makes a path of a ray.
  Path(const Ray<Scalar>& ray) : kind(PathKind::ray), start(ray.origin), toward(ray.direction) {}
  /// Makes a path of a line.
  Path(const Line<Scalar>& line) : kind(PathKind::line), start(line.origin), toward(line.direction) {}

  /// Returns true if the path begins at `start`. Segments and rays do. A line runs through it.
  [[nodiscard]] bool has_start() const { return kind != PathKind::line; }
  /// Returns true if the path ends at `toward`. Only a segment does.
  [[nodiscard]] bool has_end() const { return kind == PathKind::segment; }

  PathKind kind;           ///< What the path is.
  Vector3<Scalar> start;   ///< The start of a segment, or the origin of a ray or a line.
  Vector3<Scalar> toward;  ///< The end of a segment, or the direction of a ray or a line.
};

using Vector3f = Vector3<float>;   ///< A point or a vector in float.
using Vector3d = Vector3<double>;  ///< A point or a vector in double.
using Segmentf = Segment<float>;   ///< A segment in float.
using Segmentd = Segment<double>;  ///< A segment in double.
using Rayf = Ray<float>;           ///< A ray in float.
using Rayd = Ray<double>;          ///< A ray in double.
using Linef = Line<float>;         ///< A line in float.
using Lined = Line<double>;        ///< A line in double.
using Pathf = Path<float>;         ///< A path in float.
using Pathd = Path<double>;        ///< A path in double.

}  // namespace surehit
