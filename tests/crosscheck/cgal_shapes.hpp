#pragma once

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Sqrt_extension.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include "surehit/shape_hit.hpp"
#include "surehit/triangle.hpp"

// What the judges of moving balls, boxes and capsules share, in CGAL's numbers.

namespace surehit::test::cgal {

using Rational = CGAL::Exact_rational;
using Kernel = CGAL::Simple_cartesian<Rational>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using OneRoot = CGAL::Sqrt_extension<Rational, Rational, CGAL::Tag_true>;
using Corners = std::array<Point, 3>;

template <typename Scalar>
Point to_point(const Vector3<Scalar>& x) {
  return {Rational(double{x[0]}), Rational(double{x[1]}), Rational(double{x[2]})};
}

template <typename Scalar>
Corners to_corners(const Triangle<Scalar>& triangle) {
  return {to_point(triangle.a), to_point(triangle.b), to_point(triangle.c)};
}

template <typename Scalar>
Rational middle(Scalar x, Scalar y) {
  return (Rational(double{x}) + Rational(double{y})) / 2;
}

/// Returns true if a number rounds to x, which must be in [0, 1]. `middle_of` gives the number between two others.
template <typename Number, typename Scalar, typename Middle>
bool rounds_to(const Number& exact, Scalar x, const Middle& middle_of) {
  if (!(x >= 0 && x <= 1) || std::signbit(x)) return false;
  using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
  const bool is_even = (std::bit_cast<Bits>(x) & 1) == 0;
  const auto over = CGAL::compare(exact, Number(middle_of(x, std::nextafter(x, Scalar{2}))));
  if (over == CGAL::LARGER || (over == CGAL::EQUAL && !is_even)) return false;
  if (x == 0) return CGAL::sign(exact) != CGAL::NEGATIVE;
  const auto under = CGAL::compare(exact, Number(middle_of(x, std::nextafter(x, Scalar{0}))));
  return under == CGAL::LARGER || (under == CGAL::EQUAL && is_even);
}

template <typename Scalar>
bool rounds_to(const OneRoot& exact, Scalar x) {
  return rounds_to(exact, x, middle<Scalar>);
}

/// Each corner of the part has a weight above 0, and no other corner has one.
template <typename Number>
bool is_inside(const std::array<Number, 3>& weights, Feature feature) {
  constexpr std::array<std::array<bool, 3>, 7> has = {{{true, true, true},
                                                       {true, true, false},
                                                       {false, true, true},
                                                       {true, false, true},
                                                       {true, false, false},
                                                       {false, true, false},
                                                       {false, false, true}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_positive = CGAL::sign(weights[i]) == CGAL::POSITIVE;
    if (is_positive != has[static_cast<std::size_t>(feature)][i]) return false;
  }
  return true;
}

/// Says what is wrong with an answered t, or returns nothing: `touches_until` becomes true within what rounds to it.
template <typename Scalar, typename TouchesUntil>
std::optional<std::string> error_of_t(Scalar t, const TouchesUntil& touches_until) {
  if (!(t >= 0 && t <= 1)) return "CGAL: t is not in [0, 1]";
  if (t < 1 && !touches_until(middle(t, std::nextafter(t, Scalar{2})))) return "CGAL: t is too low";
  if (t == 0) return std::nullopt;
  // A little less than the middle, for the contact may be at the middle itself.
  const Rational below = middle(t, std::nextafter(t, Scalar{0}));
  if (touches_until(below - below / Rational(std::ldexp(1.0, 200)))) return "CGAL: t is too high";
  return std::nullopt;
}

/// A quantity that is linear in t.
struct Linear {
  Rational constant = 0;
  Rational rate = 0;

  template <typename Number>
  [[nodiscard]] Number at(const Number& t) const {
    return Number(constant) + Number(rate) * t;
  }
};

/// A part of a triangle, and what comes near to it. At t they are apart by the radius if a t² + 2 b t + c = 0.
struct MeetingParts {
  Rational a, b, c;
  std::array<Linear, 3> weights;  ///< Those of the corners, at the nearest point of the part.

  /// Returns the lower t, or nothing if there is none.
  [[nodiscard]] std::optional<OneRoot> time() const {
    const Rational discriminant = b * b - a * c;
    if (a == 0 || discriminant < 0) return std::nullopt;
    // `Sqrt_extension` takes a root of zero for a positive one.
    if (discriminant == 0) return OneRoot(-b / a);
    return OneRoot(-b / a, -1 / a, discriminant);
  }
};

/// A point that moves from `start` by `step`, and a corner.
inline MeetingParts meet_corner(const Point& start, const Vector& step, const Rational& rr, const Corners& corners,
                                std::size_t corner) {
  const Vector w = start - corners[corner];
  MeetingParts parts{step * step, step * w, w * w - rr, {}};
  parts.weights[corner].constant = 1;
  return parts;
}

/// The same, and an edge that is no point.
inline MeetingParts meet_edge(const Point& start, const Vector& whole_step, const Rational& rr, const Corners& corners,
                              std::size_t from, std::size_t to) {
  const Vector e = corners[to] - corners[from];
  const Vector w = start - corners[from];
  // The parts of both across the edge.
  const Vector step = whole_step - (whole_step * e) / (e * e) * e;
  const Vector across = w - (w * e) / (e * e) * e;
  MeetingParts parts{step * step, step * across, across * across - rr, {}};
  parts.weights[to] = {(w * e) / (e * e), (whole_step * e) / (e * e)};
  parts.weights[from] = {1 - parts.weights[to].constant, -parts.weights[to].rate};
  return parts;
}

/// The same, and a face with an area.
inline MeetingParts meet_face(const Point& start, const Vector& step, const Rational& rr, const Corners& corners) {
  const Vector to_b = corners[1] - corners[0];
  const Vector to_c = corners[2] - corners[0];
  const Vector n = CGAL::cross_product(to_b, to_c);
  const Rational nn = n * n;
  const Vector w = start - corners[0];
  const Rational rate = n * step;
  const Rational height = n * w;
  MeetingParts parts{rate * rate / nn, rate * height / nn, height * height / nn - rr, {}};
  parts.weights[1] = {n * CGAL::cross_product(w, to_c) / nn, n * CGAL::cross_product(step, to_c) / nn};
  parts.weights[2] = {n * CGAL::cross_product(to_b, w) / nn, n * CGAL::cross_product(to_b, step) / nn};
  parts.weights[0] = {1 - parts.weights[1].constant - parts.weights[2].constant,
                      -parts.weights[1].rate - parts.weights[2].rate};
  return parts;
}

inline bool has_area(const Corners& corners) { return !CGAL::collinear(corners[0], corners[1], corners[2]); }

/// The corners of an edge, or the corner twice.
inline std::array<std::size_t, 2> ends_of(Feature feature) {
  const auto number = static_cast<std::size_t>(feature);
  if (feature < Feature::corner_a) return {number - 1, number % 3};
  return {number - 4, number - 4};
}

/// A moving point and any part of a triangle, or nothing for a part that is not there.
inline std::optional<MeetingParts> meet(const Point& start, const Vector& step, const Rational& rr,
                                        const Corners& corners, Feature feature) {
  if (feature == Feature::face) {
    if (!has_area(corners)) return std::nullopt;
    return meet_face(start, step, rr, corners);
  }
  const auto [from, to] = ends_of(feature);
  if (from == to) return meet_corner(start, step, rr, corners, from);
  if (corners[from] == corners[to]) return std::nullopt;
  return meet_edge(start, step, rr, corners, from, to);
}

}  // namespace surehit::test::cgal
