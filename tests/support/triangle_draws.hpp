#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "support/random.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Draws triangles and what is about them. The families of moving shapes share it.
template <typename Scalar>
class TriangleDraws {
 public:
  explicit TriangleDraws(Random& random) : random_(random) {}

  /// Each coordinate is in [-1, 1).
  Vector3<Scalar> vector() {
    const Scalar x = random_.symmetric<Scalar>();
    const Scalar y = random_.symmetric<Scalar>();
    return {x, y, random_.symmetric<Scalar>()};
  }
  Triangle<Scalar> triangle() {
    const Vector3<Scalar> a = vector();
    const Vector3<Scalar> b = vector();
    return {a, b, vector()};
  }
  Vector3<Scalar> inside(const Triangle<Scalar>& triangle) {
    const Scalar v = random_.unit<Scalar>();
    const Scalar u = random_.unit<Scalar>() * (1 - v);
    return triangle.a + u * (triangle.b - triangle.a) + v * (triangle.c - triangle.a);
  }
  Vector3<Scalar> on_edge(const Triangle<Scalar>& triangle) {
    return triangle.a + random_.unit<Scalar>() * (triangle.b - triangle.a);
  }

  /// A number below 2^high, mostly above 2^low.
  Scalar size(std::int64_t low, std::int64_t high) {
    const Scalar factor = random_.unit<Scalar>();
    return std::ldexp(factor, static_cast<int>(random_.between(low, high)));
  }
  /// An offset of up to 2^19.
  Vector3<Scalar> far() {
    const Vector3<Scalar> way = vector();
    return way * static_cast<Scalar>(1 << random_.below(20));
  }
  /// Moves the number by an ulp.
  void nudge(Scalar& x) {
    x = std::nextafter(x,
                       random_.one_in(2) ? std::numeric_limits<Scalar>::max() : std::numeric_limits<Scalar>::lowest());
  }

  /// Moves the third corner close to the edge of the other two.
  void make_sliver(Triangle<Scalar>& triangle) {
    const Scalar share = random_.unit<Scalar>();
    triangle.c = triangle.a + share * (triangle.b - triangle.a);
    const Vector3<Scalar> offset = vector();
    triangle.c += offset / static_cast<Scalar>(std::int64_t{1} << random_.below(30));
  }
  /// Moves corners so that a point or a segment is left, up to rounding.
  void make_degenerate(Triangle<Scalar>& triangle) {
    auto& [a, b, c] = triangle;
    const std::uint64_t kind = random_.below(4);
    if (kind == 0) c = a;
    if (kind == 1) c = b;
    if (kind == 2) b = c = a;
    if (kind == 3) c = b + (b - a);
  }
  void maybe_swap_corners(Triangle<Scalar>& triangle) {
    if (random_.one_in(2)) std::swap(triangle.a, random_.one_in(2) ? triangle.b : triangle.c);
  }

 private:
  Random& random_;
};

}  // namespace surehit::test
