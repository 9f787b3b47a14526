#pragma once

#include <sstream>
#include <string>

#include "support/pair_text.hpp"
#include "surehit/shape_hit.hpp"
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
std::string hex_text(const ShapeHit<Scalar>& hit) {
  std::ostringstream out;
  out << std::hexfloat << "{.t = " << hit.t << ", .u = " << hit.u << ", .v = " << hit.v
      << ", .triangle = " << hit.triangle << ", .feature = Feature(" << static_cast<int>(hit.feature)
      << "), .started_touching = " << hit.started_touching << '}';
  return out.str();
}

}  // namespace surehit::test
