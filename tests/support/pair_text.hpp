#pragma once

#include <ios>
#include <ostream>
#include <sstream>
#include <string>

#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/scene_hit.hpp"
#include "surehit/scene_query_options.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

template <typename Scalar>
void write(std::ostream& out, const Vector3<Scalar>& x) {
  out << '{' << x[0] << ", " << x[1] << ", " << x[2] << '}';
}

template <typename Scalar>
void write(std::ostream& out, const Path<Scalar>& path) {
  out << (path.kind == PathKind::segment ? "Segment" : path.kind == PathKind::ray ? "Ray" : "Line");
  out << (sizeof(Scalar) == sizeof(float) ? "f{" : "d{");
  write(out, path.start);
  out << ", ";
  write(out, path.toward);
  out << '}';
}

template <typename Scalar>
void write(std::ostream& out, const Triangle<Scalar>& triangle) {
  out << "Triangle" << (sizeof(Scalar) == sizeof(float) ? "f{" : "d{");
  write(out, triangle.a);
  out << ", ";
  write(out, triangle.b);
  out << ", ";
  write(out, triangle.c);
  out << '}';
}

template <typename Scalar>
void write(std::ostream& out, const QueryOptions<Scalar>& options) {
  out << "{.min_t = " << options.min_t << ", .max_t = " << options.max_t << ", .culling = Culling("
      << static_cast<int>(options.culling) << "), .mask = " << options.mask
      << ", .ignored_triangle = " << options.ignored_triangle
      << ", .ignore_start_contact = " << options.ignore_start_contact
      << ", .ignore_end_contact = " << options.ignore_end_contact << '}';
}

template <typename Scalar>
void write(std::ostream& out, const Hit<Scalar>& hit) {
  out << "{.t = " << hit.t << ", .u = " << hit.u << ", .v = " << hit.v << ", .triangle = " << hit.triangle
      << ", .side = Side(" << static_cast<int>(hit.side) << ")}";
}

inline void write(std::ostream& out, InstanceId id) { out << '{' << id.index << ", " << id.generation << '}'; }

template <typename Scalar>
void write(std::ostream& out, const SceneHit<Scalar>& hit) {
  write<Scalar>(out, static_cast<const Hit<Scalar>&>(hit));
  out << " of instance ";
  write(out, hit.instance);
}

template <typename Scalar>
void write(std::ostream& out, const SceneQueryOptions<Scalar>& options) {
  out << "{.min_t = " << options.min_t << ", .max_t = " << options.max_t << ", .culling = Culling("
      << static_cast<int>(options.culling) << "), .mask = " << options.mask
      << ", .instance_mask = " << options.instance_mask << ", .ignored_instance = ";
  write(out, options.ignored_instance);
  out << ", .ignored_triangle = " << options.ignored_triangle
      << ", .ignore_start_contact = " << options.ignore_start_contact
      << ", .ignore_end_contact = " << options.ignore_end_contact << '}';
}

/// With hex floats, so that a failure can be pasted into a test of its own without losing a bit.
template <typename Object>
std::string hex_text(const Object& object) {
  std::ostringstream out;
  out << std::hexfloat;
  write(out, object);
  return out.str();
}

}  // namespace surehit::test
