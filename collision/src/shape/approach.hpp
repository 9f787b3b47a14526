#pragma once

#include <optional>
#include <utility>

#include "shape/sphere_terms.hpp"

namespace surehit::detail {

/// The t at which a point comes to another point: the lower root of a t² + 2 b t + c.
template <typename A, typename B, typename D>
struct PointTime {
  A a;             ///< It is positive.
  B b;             ///< It is negative.
  D discriminant;  ///< b² - a c. It is not negative.

  /// Returns the sign of x + t y.
  template <typename X, typename Y>
  [[nodiscard]] int sign_of(Signs& signs, const X& x, const Y& y) const {
    return signs.with_root(a * x - b * y, negated(y), discriminant);
  }
};

/// The t at which a point comes to a line: the lower root of a t² + 2 b t + c.
template <typename A, typename B, typename S, typename D>
struct LineTime {
  A a;        ///< It is positive.
  B b;        ///< It is negative.
  S square;   ///< The squared length of the line's direction.
  D reduced;  ///< (b² - a c) / square. It is not negative.

  [[nodiscard]] auto discriminant() const { return square * reduced; }
  /// Returns the sign of x + t y.
  template <typename X, typename Y>
  [[nodiscard]] int sign_of(Signs& signs, const X& x, const Y& y) const {
    return signs.with_root(a * x - b * y, negated(y), discriminant());
  }
};

/// The t at which a point comes to a plane: (height - radius √square) / rate.
template <typename H, typename R, typename Radius, typename S>
struct PlaneTime {
  int side;       ///< The side of the plane on which the point begins.
  H height;       ///< |n·w|
  R rate;         ///< |n·D|
  Radius radius;  ///< The radius.
  S square;       ///< n·n

  /// Returns the sign of x + t y.
  template <typename X, typename Y>
  [[nodiscard]] int sign_of(Signs& signs, const X& x, const Y& y) const {
    return signs.with_root(rate * x + height * y, negated(y * radius), square);
  }
};

/// A point that moves by a step, and comes within a radius of a point, a line or a plane (S3). In all functions, `w` is
/// its start less a point of these, and `last` is its end less the same point. They return the t at which it is as near
/// as the radius first, if it begins farther away and t is in (0, 1].
template <typename Step, typename Radius>
class Approach {
 public:
  Approach(const Vector<Step>& step, const Radius& radius) : step_(step), radius_(radius) {}

  /// The start must not be within the radius.
  template <typename W>
  [[nodiscard]] auto to_point(const Vector<W>& w, const Vector<W>& last, Signs& signs) const {
    using A = decltype(dot(step_, step_));
    using B = decltype(dot(step_, w));
    const B b = dot(step_, w);
    const auto minus_c = radius_squared() - dot(w, w);
    using D = decltype(b * b + std::declval<A>() * minus_c);
    std::optional<PointTime<A, B, D>> time;
    if (signs.of(b) >= 0 || signs.of(minus_c) >= 0) return time;
    const A a = dot(step_, step_);
    const D discriminant = b * b + a * minus_c;
    if (signs.of(discriminant) < 0) return time;
    if (signs.of(dot(step_, last)) <= 0 && signs.of(dot(last, last) - radius_squared()) > 0) return time;
    time = PointTime<A, B, D>{a, b, discriminant};
    return time;
  }

  /// The line has the direction `e`.
  template <typename W, typename E>
  [[nodiscard]] auto to_line(const Vector<W>& w, const Vector<W>& last, const Vector<E>& e, Signs& signs) const {
    const auto f = cross(step_, e);
    const auto moment = cross(w, e);
    using A = decltype(dot(f, f));
    using B = decltype(dot(f, moment));
    using S = decltype(dot(e, e));
    using D = decltype(radius_squared() * std::declval<A>() - dot(w, f) * dot(w, f));
    std::optional<LineTime<A, B, S, D>> time;
    const B b = dot(f, moment);
    if (signs.of(b) >= 0) return time;
    const A a = dot(f, f);
    const S ee = dot(e, e);
    const auto limit = radius_squared() * ee;
    if (signs.of(dot(moment, moment) - limit) <= 0) return time;
    const auto wf = dot(w, f);
    const D reduced = radius_squared() * a - wf * wf;
    if (signs.of(reduced) < 0) return time;
    const auto final = cross(last, e);
    if (signs.of(dot(f, final)) <= 0 && signs.of(dot(final, final) - limit) > 0) return time;
    time = LineTime<A, B, S, D>{a, b, ee, reduced};
    return time;
  }

  /// The plane has the normal `n`.
  template <typename W, typename N>
  [[nodiscard]] auto to_plane(const Vector<W>& w, const Vector<W>& last, const Vector<N>& n, Signs& signs) const {
    using H = decltype(dot(n, w));
    using R = decltype(dot(n, step_));
    using S = decltype(dot(n, n));
    std::optional<PlaneTime<H, R, Radius, S>> time;
    const R rate = dot(n, step_);
    const H height = dot(n, w);
    const int side = signs.of(height);
    if (side == 0 || side * signs.of(rate) >= 0) return time;
    const S nn = dot(n, n);
    const auto limit = radius_squared() * nn;
    if (signs.of(height * height - limit) <= 0) return time;
    // The height at the end, on the side of the start, must be at most the radius.
    const H height_at_end = dot(n, last);
    if (signs.of(height_at_end) == side && signs.of(height_at_end * height_at_end - limit) > 0) return time;
    time = PlaneTime<H, R, Radius, S>{side, side > 0 ? height : negated(height), side > 0 ? negated(rate) : rate,
                                      radius_, nn};
    return time;
  }

 private:
  [[nodiscard]] auto radius_squared() const { return radius_ * radius_; }

  const Vector<Step>& step_;
  const Radius& radius_;
};

}  // namespace surehit::detail
