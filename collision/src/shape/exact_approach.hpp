#pragma once

#include <cstddef>

#include "exact/exact_terms.hpp"
#include "exact/quadratic_root.hpp"
#include "exact/root_rounding.hpp"
#include "shape/sphere_terms.hpp"
#include "support/inlining.hpp"
#include "surehit/shape_hit.hpp"

namespace surehit::detail {

// The equations of the t at which a point comes within a radius (S3), in integers. `w` is its start less a point of
// what it comes to, `step` is its way, and `rr` is the square of the radius.

/// Returns the equation of a point.
template <int B, typename W, typename D, typename R>
[[nodiscard]] SUREHIT_NOINLINE QuadraticRoot<B> root_of_point(const Vector<W>& w, const Vector<D>& step, const R& rr) {
  QuadraticRoot<B> root;
  root.a = dot(step, step);
  root.b = dot(step, w);
  root.c = dot(w, w) - rr;
  return root;
}

/// Returns the equation of a line with the direction `e`.
template <int B, typename W, typename D, typename R, typename E>
[[nodiscard]] SUREHIT_NOINLINE QuadraticRoot<B> root_of_line(const Vector<W>& w, const Vector<D>& step, const R& rr,
                                                             const Vector<E>& e) {
  QuadraticRoot<B> root;
  const auto f = cross(step, e);
  const auto moment = cross(w, e);
  root.a = dot(f, f);
  root.b = dot(f, moment);
  root.c = dot(moment, moment) - rr * dot(e, e);
  return root;
}

/// Returns the equation of a plane with the normal `n`.
template <int B, typename W, typename D, typename R, typename N>
[[nodiscard]] SUREHIT_NOINLINE QuadraticRoot<B> root_of_plane(const Vector<W>& w, const Vector<D>& step, const R& rr,
                                                              const Vector<N>& n) {
  QuadraticRoot<B> root;
  const auto height = dot(n, w);
  const auto rate = dot(n, step);
  root.a = rate * rate;
  root.b = height * rate;
  root.c = height * height - rr * dot(n, n);
  return root;
}

/// Returns (x + t y) / z, rounded once (S7). t is a root, or 0 if `root` is null. The result is in [0, 1], and z is
/// positive.
template <typename Scalar, int B, int V>
[[nodiscard]] SUREHIT_NOINLINE Scalar rounded_weight(const QuadraticRoot<B>* root, const WideInt<V>& x,
                                                     const WideInt<V>& y, const WideInt<V>& z) {
  if (root == nullptr || y.is_zero()) return rounded_quotient<Scalar>(x, z);
  // t is (-b - √d) / a, so this is (a x - b y - y √d) / (a z).
  constexpr int bits = B + V + 1;
  RootNumber<bits, V, 2 * B + 1, bits> weight;
  weight.p = root->a * x;
  {
    const auto product = root->b * y;
    weight.p.add(product, true);
  }
  weight.q = negated(y);
  weight.d = root->discriminant();
  weight.r = root->a * z;
  return weight.template rounded<Scalar>();
}

/// Rounds the weights of b and c at a point of an edge, each by itself. The corner where the edge ends has the weight
/// (x + t y) / z. The numbers are those of `rounded_weight`.
template <typename Scalar, int B, int V>
void round_edge_weights(std::size_t edge, const QuadraticRoot<B>* root, const WideInt<V>& x, const WideInt<V>& y,
                        const WideInt<V>& z, ShapeHit<Scalar>& hit) {
  const auto of_end = [&] { return rounded_weight<Scalar>(root, x, y, z); };
  const auto of_begin = [&] {
    WideInt<V> rest = z;
    rest.add(x, true);
    return rounded_weight<Scalar>(root, rest, negated(y), z);
  };
  if (edge == 0) hit.u = of_end();
  if (edge == 1) hit.u = of_begin();
  if (edge == 1) hit.v = of_end();
  if (edge == 2) hit.v = of_begin();
}

}  // namespace surehit::detail
