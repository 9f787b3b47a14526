#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "surehit/path.hpp"
#include "surehit/shape_hit.hpp"

// What the judges of moving shapes compute with: vectors of rationals or of long floats, and the points of segments and
// triangles that are nearest to a point.

namespace surehit::test::oracle {

template <typename Number>
using Vec = std::array<Number, 3>;

template <typename Number>
Vec<Number> operator-(const Vec<Number>& x, const Vec<Number>& y) {
  return {Number(x[0] - y[0]), Number(x[1] - y[1]), Number(x[2] - y[2])};
}
template <typename Number>
Vec<Number> along(const Vec<Number>& x, const Number& t, const Vec<Number>& d) {
  return {Number(x[0] + t * d[0]), Number(x[1] + t * d[1]), Number(x[2] + t * d[2])};
}
template <typename Number>
Number dot(const Vec<Number>& x, const Vec<Number>& y) {
  return Number(x[0] * y[0] + x[1] * y[1] + x[2] * y[2]);
}
template <typename Number>
Vec<Number> cross(const Vec<Number>& x, const Vec<Number>& y) {
  return {Number(x[1] * y[2] - x[2] * y[1]), Number(x[2] * y[0] - x[0] * y[2]), Number(x[0] * y[1] - x[1] * y[0])};
}

template <typename Number, typename Scalar>
Vec<Number> vector_of(const Vector3<Scalar>& x) {
  return {Number(double{x[0]}), Number(double{x[1]}), Number(double{x[2]})};
}

/// The weights of the ends of a segment at its point nearest to x.
template <typename Number>
Number nearest_on_segment(const Vec<Number>& x, const Vec<Number>& a, const Vec<Number>& b) {
  const Vec<Number> e = b - a;
  const Number ee = dot(e, e);
  if (ee == 0) return Number(0);
  const Number s = Number(dot(x - a, e) / ee);
  return s < 0 ? Number(0) : s > 1 ? Number(1) : s;
}

/// The weights of b and c at the point of a triangle that is nearest to x, and the squared distance.
template <typename Number>
struct Nearest {
  Number u, v, distance;
};

/// Finds the point of the triangle with the corners a, b and c of `pair` that is nearest to x.
template <typename Number, typename Pair>
Nearest<Number> nearest_on_triangle(const Vec<Number>& x, const Pair& pair) {
  const Vec<Number> ab = pair.b - pair.a;
  const Vec<Number> ac = pair.c - pair.a;
  const Vec<Number> n = cross(ab, ac);
  const Number nn = dot(n, n);
  const Vec<Number> w = x - pair.a;
  if (nn != 0) {
    const Number u = Number(dot(n, cross(w, ac)) / nn);
    const Number v = Number(dot(n, cross(ab, w)) / nn);
    if (u >= 0 && v >= 0 && u + v <= 1) {
      const Number height = dot(n, w);
      return {u, v, Number(height * height / nn)};
    }
  }
  Nearest<Number> best{Number(0), Number(0), Number(-1)};
  const auto take = [&](const Vec<Number>& from, const Vec<Number>& to, auto weights) {
    const Number s = nearest_on_segment(x, from, to);
    const Vec<Number> gap = x - along(from, s, Vec<Number>(to - from));
    const Number distance = dot(gap, gap);
    if (best.distance >= 0 && distance >= best.distance) return;
    const auto [u, v] = weights(s);
    best = {u, v, distance};
  };
  using Weights = std::array<Number, 2>;
  const std::array<std::pair<const Vec<Number>*, Weights>, 3> corners = {
      std::pair{&pair.a, Weights{Number(0), Number(0)}}, std::pair{&pair.b, Weights{Number(1), Number(0)}},
      std::pair{&pair.c, Weights{Number(0), Number(1)}}};
  const auto by_place = [](const auto& x, const auto& y) { return *x.first < *y.first; };
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end(), by_place);
  // A triangle without area is the edge between its first and its last corner. The first of two equal corners counts.
  const auto first_high = std::max_element(corners.begin(), corners.end(), by_place);
  for (std::size_t i = 0; i < 3; ++i) {
    auto from = corners.begin() + static_cast<std::ptrdiff_t>(i);
    auto to = corners.begin() + static_cast<std::ptrdiff_t>((i + 1) % 3);
    if (nn == 0) {
      from = low;
      to = first_high;
    }
    take(*from->first, *to->first, [&](const Number& s) {
      const auto weigh = [&](std::size_t k) { return Number(from->second[k] + s * (to->second[k] - from->second[k])); };
      return Weights{weigh(0), weigh(1)};
    });
    if (nn == 0) break;
  }
  static_cast<void>(high);
  return best;
}

using Float = mpf_class;

/// The lower root of a t^2 + 2 b t + c, if there is one.
inline std::optional<Float> lower_root(const Float& a, const Float& b, const Float& c, const Float& tiny) {
  if (a <= 0) return std::nullopt;
  Float d = b * b - a * c;
  if (d < 0 && d > -tiny * b * b) d = 0;
  if (d < 0) return std::nullopt;
  return Float((-b - sqrt(d)) / a);
}

/// The part of a triangle that has the point with these weights.
inline Feature feature_at(const Float& u, const Float& v, const Float& tiny) {
  const bool no_u = u < tiny;
  const bool no_v = v < tiny;
  const bool no_w = 1 - u - v < tiny;
  if (no_u && no_v) return Feature::corner_a;
  if (no_v && no_w) return Feature::corner_b;
  if (no_u && no_w) return Feature::corner_c;
  return no_v ? Feature::edge_ab : no_w ? Feature::edge_bc : no_u ? Feature::edge_ca : Feature::face;
}

/// Whether a number rounds to x, but for exact ties, which floats cannot tell.
template <typename Scalar>
bool rounds_to(const Float& exact, Scalar x, const Float& tiny) {
  const Float value(double{x}, exact.get_prec());
  const Float above = (value + double{std::nextafter(x, Scalar{2})}) / 2;
  const Float below = (value + double{std::nextafter(x, Scalar{-1})}) / 2;
  return exact <= above + tiny * above && exact >= below - tiny;
}

/// Says what is wrong with a unit vector that leads from one point to another, or returns nothing. Each component may
/// be off by `allowed`. Nothing is known if the points are the same.
template <typename Scalar>
std::optional<std::string> find_error_of_unit(const Vec<Float>& from, const Vec<Float>& to, const Vector3<Scalar>& unit,
                                              double allowed, const Float& tiny) {
  const Vec<Float> gap = to - from;
  const Float square = dot(gap, gap);
  if (square <= tiny * Float(dot(from, from) + dot(to, to))) return std::nullopt;
  const Float length = sqrt(square);
  for (std::size_t i = 0; i < 3; ++i) {
    const Float error = gap[i] / length - double{unit[static_cast<Eigen::Index>(i)]};
    if (abs(error) > allowed) return "the normal is off by " + std::to_string(error.get_d() / allowed);
  }
  return std::nullopt;
}

}  // namespace surehit::test::oracle
