#pragma once

#include <optional>

#include "contact.hpp"
#include "exact/exact_scale.hpp"
#include "path_range.hpp"
#include "support/inlining.hpp"

namespace surehit::detail {

/// The rounded weights at the contact.
template <typename Scalar>
struct Weights {
  Scalar u = 0;  ///< The weight of corner b.
  Scalar v = 0;  ///< The weight of corner c.
};

/// Tests one path against one triangle in exact integers.
///
/// The path's whole line meets the triangle in a closed interval of parameters, if at all. A line that crosses the
/// triangle's plane has one such parameter. A line in the plane, or along a degenerate triangle, may have many.
/// The path meets the triangle where this interval and the range overlap. The first contact is at the larger one of the
/// two lower ends.
///
/// The steps are not inlined into each other, so each stack frame ends with its step. The integers are large enough for
/// all of double. One frame for all steps would exceed the 24 KiB of stack that a query may use.
///
/// `Size` is `AnySize`, or `PlacedSize` for placed triangles, or `CompactSize` if the scale is compact.
template <typename Scalar, typename Size>
class ExactPair {
 public:
  using B = Bits<Size>;
  template <int Bound>
  using Int = typename Size::template Int<Bound>;
  using Parameter = Ratio<Int<B::parameter>>;
  using PlaneParameter = Ratio<Int<B::cross + 3>>;  ///< Its largest part is n - (U + V), see `set_weight`.

  /// `AnyTriangle` is `Triangle` or `PlacedTriangle`.
  template <typename AnyTriangle>
  ExactPair(const Path<Scalar>& path, const AnyTriangle& triangle, const Scale<Scalar>& scale)
      : path_(path), corners_(local_corners(triangle)), t_exponent_(scale.t_exponent) {
    set_vectors(path, triangle, scale, s_, d_, e1_, e2_);
  }

  /// Returns the first contact, or nothing if there is none. Sets `t` to its exact parameter. Sets the weights unless
  /// `weights` is null.
  [[nodiscard]] std::optional<Contact> find(const PathRange<Scalar>& range, Parameter& t, Weights<Scalar>* weights) {
    if (is_zero(d_)) return standing_point(range, t, weights);
    if (std::optional<Contact> contact; crosses_plane(range, t, weights, contact)) return contact;
    if (std::optional<Contact> contact; is_parallel_to_plane(range, t, weights, contact)) return contact;
    return along_degenerate(range, t, weights);
  }

 private:
  /// The triangle's plane, projected along an axis on which the normal is not zero.
  struct Plane {
    bool is_degenerate = true;    ///< True if the corners are on one line, so that there is no plane.
    bool contains_start = false;  ///< True if the path's start is in the plane.
    std::size_t axis = 0;         ///< The axis of the projection.
    Int<B::cross> normal;         ///< The normal's component on that axis.
  };

  SUREHIT_NOINLINE Plane find_plane() const {
    Plane plane;
    IntVector<Int<B::cross>> normal;
    set_cross(normal, e1_, e2_);
    if (is_zero(normal)) return plane;
    Int<B::det> height;
    set_dot(height, s_, normal);
    plane.is_degenerate = false;
    plane.contains_start = height.is_zero();
    plane.axis = nonzero_axis(normal);
    plane.normal = normal[plane.axis];
    return plane;
  }

  /// Cuts the interval [first, last] to the range. Returns the contact, or nothing if they do not overlap. Sets `t` to
  /// the lower end of the overlap. `t` and `first` may be the same object.
  template <typename F, typename L, typename P>
  SUREHIT_NOINLINE std::optional<Contact> cut(const Ratio<F>& first, const Ratio<L>& last,
                                              const PathRange<Scalar>& range, Ratio<P>& t) {
    Contact contact = {};
    contact.at_start = path_.has_start() && first.num.sign() <= 0 && last.num.sign() >= 0;
    if (path_.has_end()) {
      const Limit<Scalar> end(1, t_exponent_);
      contact.at_end = end.compare(first) <= 0 && end.compare(last) >= 0;
    }
    if (range.last < PathRange<Scalar>::infinity && Limit<Scalar>(range.last, t_exponent_).compare(first) > 0) {
      return std::nullopt;
    }
    if (range.first == -PathRange<Scalar>::infinity) {
      t.set(first.num, first.den);
      return contact;
    }
    const Limit<Scalar> begin(range.first, t_exponent_);
    if (begin.compare(last) < 0) return std::nullopt;
    if (begin.compare(first) < 0) {
      begin.store(t);
    } else {
      t.set(first.num, first.den);
    }
    return contact;
  }

  /// Handles det ≠ 0. The contact is at T / det, and its weights are U / det and V / det. Returns false if det = 0,
  /// which decides nothing.
  SUREHIT_NOINLINE bool crosses_plane(const PathRange<Scalar>& range, Parameter& t, Weights<Scalar>* weights,
                                      std::optional<Contact>& contact) {
    const Crossing crossing = cross_plane(t);
    if (crossing == Crossing::none) return false;
    if (crossing == Crossing::beside) return true;
    contact = cut(t, t, range, t);
    if (!contact) return true;
    contact->side = crossing == Crossing::from_front ? Side::front : Side::back;
    if (weights != nullptr) *weights = crossing_weights();
    return true;
  }

  /// How the path's whole line meets the triangle's plane. `none` means det = 0. `beside` means a point outside the
  /// triangle.
  enum class Crossing { none, beside, from_front, from_back };

  SUREHIT_NOINLINE Crossing cross_plane(Parameter& t) const {
    Int<B::det> det;
    Int<B::det> u;
    Int<B::det> v;
    set_determinants(det, u, v, t);
    if (det.is_zero()) return Crossing::none;
    const int side = det.sign();
    if (u.sign() * side < 0 || v.sign() * side < 0) return Crossing::beside;
    Int<B::weight> w = det;
    w.add(u, true);
    w.add(v, true);
    if (w.sign() * side < 0) return Crossing::beside;
    return side > 0 ? Crossing::from_front : Crossing::from_back;
  }

  /// Computes the determinants a second time. If they were kept, they would use stack while `cut` runs.
  SUREHIT_NOINLINE Weights<Scalar> crossing_weights() const {
    Int<B::det> det;
    Int<B::det> u;
    Int<B::det> v;
    Parameter t;
    set_determinants(det, u, v, t);
    return {rounded_quotient<Scalar>(u, det), rounded_quotient<Scalar>(v, det)};
  }

  SUREHIT_NOINLINE void set_determinants(Int<B::det>& det, Int<B::det>& u, Int<B::det>& v, Parameter& t) const {
    IntVector<Int<B::cross>> cross;
    set_cross(cross, d_, e2_);
    set_dot(det, e1_, cross);
    set_dot(u, s_, cross);
    set_cross(cross, s_, e1_);
    set_dot(v, d_, cross);
    set_dot(t.num, e2_, cross);
    t.set(t.num, det);
  }

  /// Handles det = 0 and a triangle that spans a plane. Returns false if it spans none, which decides nothing.
  SUREHIT_NOINLINE bool is_parallel_to_plane(const PathRange<Scalar>& range, Parameter& t, Weights<Scalar>* weights,
                                             std::optional<Contact>& contact) {
    const Plane plane = find_plane();
    if (plane.is_degenerate) return false;
    if (plane.contains_start) contact = along_plane(plane, range, t, weights);
    return true;
  }

  /// Handles a path in the plane of a triangle. All is projected along an axis on which the normal is not zero. Each
  /// weight of the line's point at t is then linear: (s + t d) / n. No weight may be negative, so each one bounds t.
  SUREHIT_NOINLINE std::optional<Contact> along_plane(const Plane& plane, const PathRange<Scalar>& range, Parameter& t,
                                                      Weights<Scalar>* weights) {
    const std::size_t axis = plane.axis;
    const Int<B::cross>& n = plane.normal;
    PlaneParameter at;
    const std::optional<Contact> contact = cut_to_weights(axis, n, range, at);
    if (!contact) return std::nullopt;
    t.set(at.num, at.den);
    if (weights != nullptr) *weights = {weight_at(PlaneWeight::u, axis, n, at), weight_at(PlaneWeight::v, axis, n, at)};
    return contact;
  }

  enum class PlaneWeight { u, v, w };
  using PlaneTerm = Int<B::cross + 3>;

  /// Sets s and d of one weight. The line's point at t has the weight (s + t d) / n, where n is the normal's component
  /// on the axis.
  SUREHIT_NOINLINE void set_weight(PlaneWeight which, std::size_t axis, const Int<B::cross>& n, PlaneTerm& s,
                                   PlaneTerm& d) const {
    switch (which) {
      case PlaneWeight::u:
        s = cross_component(s_, e2_, axis);
        d = cross_component(d_, e2_, axis);
        break;
      case PlaneWeight::v:
        s = cross_component(e1_, s_, axis);
        d = cross_component(e1_, d_, axis);
        break;
      case PlaneWeight::w:
        s = n;
        s.add(cross_component(s_, e2_, axis), true);
        s.add(cross_component(e1_, s_, axis), true);
        d = PlaneTerm();
        d.add(cross_component(d_, e2_, axis), true);
        d.add(cross_component(e1_, d_, axis), true);
        break;
    }
  }

  SUREHIT_NOINLINE Scalar weight_at(PlaneWeight which, std::size_t axis, const Int<B::cross>& n,
                                    const PlaneParameter& t) const {
    WideInt<2 * B::cross + 7> num;
    {
      PlaneTerm s;
      PlaneTerm d;
      set_weight(which, axis, n, s, d);
      num.set_product(wide(s), wide(t.den));
      num.add(wide(t.num) * wide(d));
    }
    return rounded_quotient<Scalar>(num, wide(t.den) * wide(n));
  }

  SUREHIT_NOINLINE std::optional<Contact> cut_to_weights(std::size_t axis, const Int<B::cross>& n,
                                                         const PathRange<Scalar>& range, PlaneParameter& t) {
    Interval interval;
    for (const PlaneWeight which : {PlaneWeight::u, PlaneWeight::v, PlaneWeight::w}) {
      if (!bound_by(which, axis, n, interval)) return std::nullopt;
    }
    if (compare(interval.first, interval.last) > 0) return std::nullopt;
    return cut(interval.first, interval.last, range, t);
  }

  /// The parameters t at which all s + t d so far are at least zero.
  struct Interval {
    PlaneParameter first;
    PlaneParameter last;
    bool has_first = false;
    bool has_last = false;

    /// Adds the condition s + t d >= 0. Returns false if no t satisfies it. All three weights together set both ends:
    /// their d sum to zero, and they are not all zero, so one is positive and one is negative.
    bool bound(PlaneTerm& s, PlaneTerm& d) {
      if (d.is_zero()) return s.sign() >= 0;
      const bool enters = d.sign() > 0;
      (enters ? s : d).negate();  // s + t d is zero at t = -s / d.
      PlaneParameter& end = enters ? first : last;
      bool& has_end = enters ? has_first : has_last;
      if (!has_end || (compare(s, d, end.num, end.den) > 0) == enters) end.set(s, d);
      has_end = true;
      return true;
    }
  };

  SUREHIT_NOINLINE bool bound_by(PlaneWeight which, std::size_t axis, const Int<B::cross>& n,
                                 Interval& interval) const {
    PlaneTerm s;
    PlaneTerm d;
    set_weight(which, axis, n, s, d);
    if (n.sign() < 0) {
      s.negate();
      d.negate();
    }
    return interval.bound(s, d);
  }

  static Int<B::cross> cross_component(const Differences<Size>& x, const Differences<Size>& y, std::size_t axis) {
    const std::size_t j = (axis + 1) % 3;
    const std::size_t k = (axis + 2) % 3;
    Int<B::cross> result;
    set_minor(result, x[j], y[k], x[k], y[j]);
    return result;
  }

  /// The two extreme corners of a degenerate triangle, in lexicographic order. They are indices into a, b, c. A pose
  /// may exchange the two, but no other corner becomes extreme. So those of the mesh's triangle are as good.
  struct Span {
    int min = 0;  ///< The first corner in that order.
    int max = 0;  ///< The last corner in that order.
  };

  Span span() const {
    const Vector3<Scalar>* corners[] = {&corners_.a, &corners_.b, &corners_.c};
    const auto before = [](const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
      return x[0] != y[0] ? x[0] < y[0] : x[1] != y[1] ? x[1] < y[1] : x[2] < y[2];
    };
    Span span;
    for (int i = 1; i < 3; ++i) {
      if (before(*corners[i], *corners[span.min])) span.min = i;
      if (before(*corners[span.max], *corners[i])) span.max = i;
    }
    return span;
  }

  const Differences<Size>& e(int corner) const { return corner == 1 ? e1_ : e2_; }

  /// Sets r = start - min and g = max - min, where min and max are the extreme corners of a degenerate triangle.
  void set_span_differences(const Span& span, Differences<Size>& r, Differences<Size>& g) const {
    for (std::size_t i = 0; i < 3; ++i) {
      r[i] = s_[i];
      if (span.max != 0) g[i] = e(span.max)[i];
      if (span.min == 0) continue;
      r[i].add(e(span.min)[i], true);
      g[i].add(e(span.min)[i], true);
    }
  }

  /// Returns the weights of b and c at the point min + (num / den) (max - min).
  template <typename N, typename D>
  SUREHIT_NOINLINE static Weights<Scalar> span_weights(const Span& span, const N& num, const D& den) {
    return span_weights(span, rounded_quotient<Scalar>(num, den), rounded_quotient<Scalar>(den - num, den));
  }

  static Weights<Scalar> span_weights(const Span& span, Scalar at_max, Scalar at_min) {
    const auto of = [&](int corner) { return corner == span.max ? at_max : corner == span.min ? at_min : Scalar{0}; };
    return {of(1), of(2)};
  }

  /// Handles a path with a length against a degenerate triangle, which is a segment or a point.
  SUREHIT_NOINLINE std::optional<Contact> along_degenerate(const PathRange<Scalar>& range, Parameter& t,
                                                           Weights<Scalar>* weights) {
    const Span ends = span();
    Differences<Size> r;
    Differences<Size> g;
    set_span_differences(ends, r, g);
    if (!are_parallel(d_, g)) {
      const std::optional<std::size_t> axis = crossing_axis(r, g);
      return axis ? across_span(*axis, ends, r, g, range, t, weights) : std::nullopt;
    }
    // They are parallel, or the triangle is a point. So they can only meet on the path's own line.
    return are_parallel(d_, r) ? along_span(ends, r, g, range, t, weights) : std::nullopt;
  }

  SUREHIT_NOINLINE static bool are_parallel(const Differences<Size>& x, const Differences<Size>& y) {
    IntVector<Int<B::cross>> cross;
    set_cross(cross, x, y);
    return is_zero(cross);
  }

  /// Handles a path on the line of the corners, by its coordinates on an axis on which it moves.
  SUREHIT_NOINLINE std::optional<Contact> along_span(const Span& ends, const Differences<Size>& r,
                                                     const Differences<Size>& g, const PathRange<Scalar>& range,
                                                     Parameter& t, Weights<Scalar>* weights) {
    const std::size_t axis = nonzero_axis(d_);
    PlaneParameter at;
    const std::optional<Contact> contact = cut_to_span(r[axis], g[axis], d_[axis], range, at);
    if (!contact) return std::nullopt;
    t.set(at.num, at.den);
    if (weights != nullptr && !is_zero(g)) *weights = weights_along_span(ends, r[axis], g[axis], d_[axis], at);
    return contact;
  }

  SUREHIT_NOINLINE std::optional<Contact> cut_to_span(const Int<B::difference>& r, const Int<B::difference>& g,
                                                      const Int<B::difference>& d, const PathRange<Scalar>& range,
                                                      PlaneParameter& t) {
    Ratio<Int<B::difference>> first;
    Ratio<Int<B::difference>> last;
    Int<B::difference> ahead = r;  // This becomes min - start, and then max - start.
    ahead.negate();
    first.set(ahead, d);
    ahead.add(g);
    last.set(ahead, d);
    return compare(first, last) <= 0 ? cut(first, last, range, t) : cut(last, first, range, t);
  }

  /// Returns the weights at the point min + w (max - min), where w = (r + t d) / g.
  SUREHIT_NOINLINE static Weights<Scalar> weights_along_span(const Span& ends, const Int<B::difference>& r,
                                                             const Int<B::difference>& g, const Int<B::difference>& d,
                                                             const PlaneParameter& t) {
    WideInt<B::difference + B::cross + 5> w = wide(r) * wide(t.den);
    w.add(wide(d) * wide(t.num));
    const auto den = wide(g) * wide(t.den);
    const Scalar at_max = rounded_quotient<Scalar>(w, den);
    w.negate();  // The same memory then holds den - w, since stack is scarce here.
    w.add(den);
    return span_weights(ends, at_max, rounded_quotient<Scalar>(w, den));
  }

  /// Handles two lines in one plane that are not parallel. They cross where r + t d = w g. The product with g gives
  /// t = (r × g)·axis / (g × d)·axis. The product with d gives w = (d × r)·axis / (d × g)·axis.
  SUREHIT_NOINLINE std::optional<Contact> across_span(std::size_t axis, const Span& ends, const Differences<Size>& r,
                                                      const Differences<Size>& g, const PathRange<Scalar>& range,
                                                      Parameter& t, Weights<Scalar>* weights) {
    const auto across = cross_component(d_, g, axis);
    const auto w = cross_component(d_, r, axis);
    const auto from_end = across - w;
    const int side = across.sign();
    if (w.sign() * side < 0 || from_end.sign() * side < 0) return std::nullopt;
    t.set(cross_component(g, r, axis), across);
    const std::optional<Contact> contact = cut(t, t, range, t);
    if (contact && weights != nullptr) *weights = span_weights(ends, w, across);
    return contact;
  }

  /// Returns an axis on which d × g is not zero. Returns nothing if the two lines are not in one plane.
  SUREHIT_NOINLINE std::optional<std::size_t> crossing_axis(const Differences<Size>& r,
                                                            const Differences<Size>& g) const {
    IntVector<Int<B::cross>> cross;
    set_cross(cross, d_, g);
    Int<B::det> height;
    set_dot(height, r, cross);
    return height.is_zero() ? std::optional(nonzero_axis(cross)) : std::nullopt;
  }

  /// Handles a path of length zero. It is a point at t = 0, and it meets a triangle that contains this point.
  SUREHIT_NOINLINE std::optional<Contact> standing_point(const PathRange<Scalar>& range, Parameter& t,
                                                         Weights<Scalar>* weights) {
    if (!(range.first <= 0 && range.last >= 0)) return std::nullopt;
    t.set(Int<1>(), Int<1>::power_of_two(0));
    Contact contact = {};
    contact.at_start = path_.has_start();
    contact.at_end = path_.has_end();
    return contains_start(weights) ? std::optional(contact) : std::nullopt;
  }

  bool contains_start(Weights<Scalar>* weights) const {
    const Plane plane = find_plane();
    if (plane.is_degenerate) return on_span(weights);
    return plane.contains_start && on_plane(plane, weights);
  }

  /// Returns whether the triangle contains the start, which must be in its plane.
  SUREHIT_NOINLINE bool on_plane(const Plane& plane, Weights<Scalar>* weights) const {
    const Int<B::cross>& n = plane.normal;
    const auto u = cross_component(s_, e2_, plane.axis);
    const auto v = cross_component(e1_, s_, plane.axis);
    const auto w = n - (u + v);
    const int side = n.sign();
    if (u.sign() * side < 0 || v.sign() * side < 0 || w.sign() * side < 0) return false;
    if (weights != nullptr) *weights = {rounded_quotient<Scalar>(u, n), rounded_quotient<Scalar>(v, n)};
    return true;
  }

  /// Returns whether a degenerate triangle, which is a segment or a point, contains the start.
  SUREHIT_NOINLINE bool on_span(Weights<Scalar>* weights) const {
    const Span ends = span();
    Differences<Size> r;
    Differences<Size> g;
    set_span_differences(ends, r, g);
    if (is_zero(g)) return is_zero(r);
    if (!are_parallel(r, g)) return false;
    const std::size_t axis = nonzero_axis(g);
    const auto from_end = g[axis] - r[axis];
    if (r[axis].sign() * g[axis].sign() < 0 || from_end.sign() * g[axis].sign() < 0) return false;
    if (weights != nullptr) *weights = span_weights(ends, r[axis], g[axis]);
    return true;
  }

  const Path<Scalar>& path_;
  const Triangle<Scalar>& corners_;
  const int t_exponent_;
  Differences<Size> d_;
  Differences<Size> e1_;
  Differences<Size> e2_;
  Differences<Size> s_;
};

}  // namespace surehit::detail
