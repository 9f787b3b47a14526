#pragma once

#include <sstream>
#include <string>

#include "support/pair_text.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/swept_sphere.hpp"

namespace surehit::test {

/// With hex floats, so that a failure can be pasted into a test of its own without losing a bit.
template <typename Scalar>
std::string hex_text(const SweptSphere<Scalar>& sphere) {
  std::ostringstream out;
  out << std::hexfloat << "SweptSphere" << (sizeof(Scalar) == sizeof(float) ? "f{" : "d{");
  write(out, sphere.start);
  out << ", ";
  write(out, sphere.end);
  out << ", " << sphere.radius << '}';
  return out.str();
}

template <typename Scalar>
std::string hex_text(const SweptBox<Scalar>& box) {
  std::ostringstream out;
  out << std::hexfloat << "SweptBox" << (sizeof(Scalar) == sizeof(float) ? "f{" : "d{");
  write(out, box.start);
  out << ", ";
  write(out, box.end);
  out << ", ";
  write(out, box.half_extents);
  out << '}';
  return out.str();
}

template <typename Scalar>
std::string hex_text(const SweptCapsule<Scalar>& capsule) {
  std::ostringstream out;
  out << std::hexfloat << "SweptCapsule" << (sizeof(Scalar) == sizeof(float) ? "f{" : "d{");
  write(out, capsule.start);
  out << ", ";
  write(out, capsule.end);
  out << ", ";
  write(out, capsule.half_axis);
  out << ", " << capsule.radius << '}';
  return out.str();
}

template <typename Scalar>
std::string hex_text(const ShapeHit<Scalar>& hit) {
  std::ostringstream out;
  out << std::hexfloat << "{.t = " << hit.t << ", .u = " << hit.u << ", .v = " << hit.v
      << ", .triangle = " << hit.triangle << ", .feature = Feature(" << static_cast<int>(hit.feature)
      << "), .started_touching = " << hit.started_touching << '}';
  return out.str();
}

}  // namespace surehit::test
