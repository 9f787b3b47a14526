#include "shape/bounded_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "shape/bounded_terms.hpp"
#include "shape/touched_point.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

template <typename Number>
struct TermsOf : BoxTerms<Number, Number> {
  Vector<Number> normal;
};

/// Sets a component of the normal to a certain zero if exact differences and products show it. A wall has such
/// components, and `Sized` alone never knows.
template <typename Scalar>
void set_certain_zeros(Vector<Sized>& normal, const Triangle<Scalar>& triangle) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (certain_sign(normal[i])) continue;
    const Vector<Bounded> ab = difference<Bounded>(triangle.b, triangle.a);
    const Vector<Bounded> bc = difference<Bounded>(triangle.c, triangle.b);
    const std::size_t j = next(i);
    const std::size_t k = next(j);
    if (certain_sign(ab[j] * bc[k] - ab[k] * bc[j]) == 0) normal[i] = {};
  }
}
template <typename AnyTriangle>
void set_certain_zeros(Vector<Bounded>&, const AnyTriangle&) {}

/// Sets the extreme corners. Returns false if they are not certain.
template <typename Number, typename Scalar>
bool set_extremes(TermsOf<Number>& terms, const Triangle<Scalar>& triangle) {
  terms.extremes = AxisExtremes(triangle);
  return true;
}
template <typename Number, typename Scalar>
bool set_extremes(TermsOf<Number>& terms, const PlacedTriangle<Scalar>&) {
  Signs signs;
  terms.extremes = AxisExtremes::from_edges([&](std::size_t k, std::size_t i) { return signs.of(terms.edge[k][i]); });
  for (const Vector<Number>& edge : terms.edge) {
    for (const Number& x : edge) static_cast<void>(signs.of(x));
  }
  return signs.is_certain();
}

/// Sets the terms of a box and a triangle. Returns false if the extreme corners are not certain.
template <typename Number, typename Scalar, typename AnyTriangle>
bool set_terms(TermsOf<Number>& terms, const SweptBox<Scalar>& box, const AnyTriangle& triangle) {
  set_differences<Number>(terms, box, triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    set_exact(terms.half_extents[i], double{box.half_extents[static_cast<Eigen::Index>(i)]});
  }
  terms.normal = normal_of(terms);
  set_certain_zeros(terms.normal, triangle);
  return set_extremes(terms, triangle);
}

/// Returns whether the premise of Z2 holds.
bool has_usual_sizes(const TermsOf<Sized>& terms) {
  double low = max_sized;
  double high = 0;
  const auto include_all = [&](const Vector<Sized>& vector) {
    for (const Sized& x : vector) {
      low = std::min(low, x.size == 0 ? max_sized : x.size);
      high = std::max(high, x.size);
    }
  };
  std::for_each(terms.from_corner.begin(), terms.from_corner.end(), include_all);
  std::for_each(terms.edge.begin(), terms.edge.end(), include_all);
  include_all(terms.step);
  include_all(terms.half_extents);
  return low >= min_sized && high <= max_sized;
}
bool has_usual_sizes(const TermsOf<Bounded>&) { return true; }

/// Returns bounds of a number of any sign, which is off by `slack` more than it knows.
template <typename Number>
DoubleRange bounds_of(const Number& x, double slack) {
  const double error = (error_of(x) + slack) * up;
  const double low = x.value - error;
  const double high = x.value + error;
  return {low - std::fabs(low) * 0x1p-50, high + std::fabs(high) * 0x1p-50};
}

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Quotients below this may underflow.
constexpr double min_quotient = 0x1p-900;

double quotient_below(double x, double y) {
  const double quotient = x / y * down;
  return quotient >= min_quotient ? quotient : 0;
}
double quotient_above(double x, double y) {
  const double quotient = x / y * up;
  if (quotient >= min_quotient) return quotient;
  return quotient < min_quotient ? min_quotient : infinity;  // A NaN is no bound.
}

/// The times at which the centre enters K and leaves it, in bounds (B7).
class Passage {
 public:
  /// Takes part of one side of K: the centre is outside if gap - t approach > 0. `last` is the gap at t = 1.
  void take(std::size_t axis, bool is_above, const DoubleRange& gap, const DoubleRange& approach,
            const DoubleRange& last) {
    if (gap.lower > 0) {
      if (last.lower > 0 || approach.upper <= 0) {
        misses_ = true;
        return;
      }
      const double low = quotient_below(gap.lower, approach.upper);
      enter(axis, approach.lower > 0 ? quotient_above(gap.upper, approach.lower) : infinity);
      if (low > enters_.lower) {
        enters_.lower = low;
        axis_ = axis;
        is_above_ = is_above;
      }
    } else if (gap.upper <= 0) {
      if (last.upper <= 0 || approach.lower >= 0) return;
      const bool leaves = approach.upper < 0;
      leave(quotient_below(-gap.upper, -approach.lower),
            leaves ? quotient_above(-gap.lower, -approach.upper) : infinity);
    } else {
      // Nothing is certain about the start. If the centre is certainly inside at the end, it comes in until then.
      const bool enters = approach.lower > 0;
      enter(axis, enters ? quotient_above(gap.upper, approach.lower) : last.upper <= 0 ? 1 : infinity);
      if (approach.upper < 0) leave(1, quotient_above(-gap.lower, -approach.upper));
    }
  }

  [[nodiscard]] bool misses() const { return misses_ || enters_.lower > leaves_.upper; }

  [[nodiscard]] Verdict verdict(BoxContact& found) const {
    if (misses()) return Verdict::miss;
    if (!(enters_.upper <= leaves_.lower)) return Verdict::undecided;
    found = {};
    found.at_start = enters_.upper == 0;
    if (found.at_start) return Verdict::hit;
    if (!(enters_.lower > 0)) return Verdict::undecided;
    found.t_lower = enters_.lower;
    found.t_upper = enters_.upper;
    bool is_alone = true;
    for (std::size_t axis = 0; axis < axis_count; ++axis) is_alone &= axis == axis_ || enters_at_[axis] < enters_.lower;
    if (is_alone) {
      found.timed_by = axis_;
      found.is_above = is_above_;
    }
    return Verdict::hit;
  }

 private:
  void enter(std::size_t axis, double at_most) {
    enters_.upper = std::max(enters_.upper, at_most);
    enters_at_[axis] = std::max(enters_at_[axis], at_most);
  }
  void leave(double at_least, double at_most) {
    leaves_.lower = std::min(leaves_.lower, at_least);
    leaves_.upper = std::min(leaves_.upper, at_most);
  }

  bool misses_ = false;
  DoubleRange enters_{0, 0};
  DoubleRange leaves_{1, 1};
  std::size_t axis_ = axis_count;                   ///< An axis that is entered at `enters_.lower` at least.
  bool is_above_ = false;                           ///< Its side.
  std::array<double, axis_count> enters_at_ = {0};  ///< The centre has entered between the sides of each axis by then.
};

template <typename Number, typename Scalar, typename AnyTriangle>
SUREHIT_NOINLINE Verdict find_contact(const SweptBox<Scalar>& box, const AnyTriangle& triangle, BoxContact& found) {
  TermsOf<Number> terms;
  if (!set_terms(terms, box, triangle) || !has_usual_sizes(terms)) return Verdict::undecided;
  Passage passage;
  double slack = 0;
  const auto take = [&](std::size_t axis, bool is_above, const Number& gap, const Number& approach) {
    passage.take(axis, is_above, bounds_of(gap, slack), bounds_of(approach, 0), bounds_of(gap - approach, slack));
  };
  for (std::size_t i = 0; i < 3; ++i) take_coordinate(terms, i, take);
  if (passage.misses()) return Verdict::miss;
  const Vector<Number>& n = terms.normal;
  int zeros = 0;
  bool has_area = false;
  for (const Number& x : n) {
    zeros += certain_sign(x) == 0;
    has_area |= certain_sign(x).value_or(0) != 0;
  }
  if (zeros < 2) take_normal(terms, n, take);  // B3
  if (passage.misses()) return Verdict::miss;
  for (std::size_t coordinate = 0; coordinate < 3; ++coordinate) {
    const std::optional<int> below = certain_sign(n[coordinate]);
    if (below == 0 && has_area) continue;  // B3
    // If it is not certain on which side of an edge the third corner is, both sides are moved by its distance.
    slack = below ? 0 : std::fabs(n[coordinate].value) + error_of(n[coordinate]);
    for (std::size_t k = 0; k < 3; ++k) take_edge(terms, k, coordinate, below.value_or(0), take);
    if (passage.misses()) return Verdict::miss;
  }
  return passage.verdict(found);
}

/// The numbers that `TouchedPoint` computes with.
template <typename Number>
struct BoundedNumbers {
  using Difference = Number;
  using Time = Number;
  using Moved = Number;
  using Constant = Number;
  using Square = Number;
  using MovedSquare = Number;
  using Direction = Number;
  using Slope = Number;
  using MovedSlope = Number;
  using Weight = Number;
  using Divisor = Number;
};

/// Finds the touched point, if all signs are certain.
template <typename Number>
class BoundedPoint {
  using Search = TouchedPoint<BoundedNumbers<Number>>;
  using Point = typename Search::Point;

 public:
  BoundedPoint(const TermsOf<Number>& terms, const BoxContact& contact) : terms_(terms), contact_(contact) {}

  template <typename Scalar>
  [[nodiscard]] bool try_round(ShapeHit<Scalar>& hit) {
    bool has_area = false;
    for (const Number& x : terms_.normal) has_area |= certain_sign(x).value_or(0) != 0;
    if (!has_area) return false;
    Number m;
    Number moved;
    if (contact_.at_start) {
      set_one(m);
    } else {
      set_time(moved, m);
    }
    Vector<Number> way;
    Vector<Number> extents;
    Vector<Number> ac;
    for (std::size_t i = 0; i < 3; ++i) {
      way[i] = terms_.from_corner[0][i] * m + terms_.step[i] * moved;
      extents[i] = terms_.half_extents[i] * m;
      ac[i] = negated(terms_.edge[2][i]);
    }
    Search search(way, terms_.edge[0], ac, extents, m, signs_);
    const std::optional<Point> point = find(search);
    return point && signs_.is_certain() && try_round(*point, m * point->z, hit);
  }

 private:
  /// Sets t = gap / approach.
  void set_time(Number& gap, Number& approach) const {
    const auto take = [&](std::size_t, bool is_above, const Number& any_gap, const Number& any_approach) {
      if (is_above != contact_.is_above) return;
      gap = any_gap;
      approach = any_approach;
    };
    const std::size_t axis = contact_.timed_by;
    if (axis < normal_axis) {
      take_coordinate(terms_, axis, take);
    } else if (axis == normal_axis) {
      take_normal(terms_, terms_.normal, take);
    } else {
      take_edge(terms_, edge_of(axis), coordinate_of(axis), 0, take);
    }
  }

  /// Returns the point on the part of the triangle and of the box that meet (B8).
  [[nodiscard]] std::optional<Point> find(Search& search) {
    const std::size_t axis = contact_.timed_by;
    if (contact_.at_start) return search.find();
    if (axis < normal_axis) return find_in_face(search, axis);
    if (axis == normal_axis) return find_on_edge_of_box(search);
    const std::size_t k = edge_of(axis);
    const std::size_t i = next(coordinate_of(axis));
    const std::size_t j = next(i);
    return search.crossing(k, facing_side(i, signs_.of(terms_.edge[k][j])));
  }

  /// Returns the face of the box that comes first, if it moves against the direction of an axis with this sign.
  [[nodiscard]] std::size_t facing_side(std::size_t i, int sign) const {
    return (sign > 0) == contact_.is_above ? Search::lower_side(i) : Search::upper_side(i);
  }
  static unsigned sides_of_axis(std::size_t i) { return 1U << Search::lower_side(i) | 1U << Search::upper_side(i); }

  /// A face of the box meets a corner, an edge, or the whole triangle.
  [[nodiscard]] std::optional<Point> find_in_face(Search& search, std::size_t axis) {
    const auto& extremes = contact_.is_above ? terms_.extremes.highest : terms_.extremes.lowest;
    const std::size_t corner = extremes[axis];
    // The first of the extreme corners begins its edge. The last one may be before it.
    const bool goes_on = certain_sign(terms_.edge[corner][axis]) == 0;
    const bool comes_on = certain_sign(terms_.edge[before(corner)][axis]) == 0;
    const unsigned others = Search::all_sides & ~sides_of_axis(axis);
    if (goes_on && comes_on) return search.find(others);
    if (goes_on) return search.find_on(corner, others);
    if (comes_on) return search.find_on(before(corner), others);
    return search.crossing(before(corner), corner);
  }
  /// A corner of the box meets the plane, or an edge that is parallel to the plane.
  [[nodiscard]] std::optional<Point> find_on_edge_of_box(Search& search) {
    std::array<int, 3> sign;
    for (std::size_t i = 0; i < 3; ++i) sign[i] = signs_.of(terms_.normal[i]);
    if (!signs_.is_certain()) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i) {
      if (sign[i] != 0) continue;
      const std::size_t j = next(i);
      return search.find_on(facing_side(j, sign[j]), 7U | sides_of_axis(i));
    }
    // The lines of two faces meet at the steepest angle without the largest component.
    std::size_t largest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (std::fabs(terms_.normal[i].value) > std::fabs(terms_.normal[largest].value)) largest = i;
    }
    const std::size_t i = next(largest);
    const std::size_t j = next(i);
    return search.crossing(facing_side(i, sign[i]), facing_side(j, sign[j]));
  }

  static std::size_t before(std::size_t corner) { return corner == 0 ? 2 : corner - 1; }

  template <typename Scalar>
  [[nodiscard]] bool try_round(const Point& point, const Number& whole, ShapeHit<Scalar>& hit) {
    const Number rest = whole - point.u - point.v;
    const bool no_c = (point.sides & 1U) != 0;
    const bool no_a = (point.sides & 2U) != 0;
    const bool no_b = (point.sides & 4U) != 0;
    // A point on other sides alone may be on an edge too.
    if (!(no_a || signs_.of(rest) > 0) || !(no_b || signs_.of(point.u) > 0) || !(no_c || signs_.of(point.v) > 0)) {
      return false;
    }
    hit.feature = feature_with(!no_a, !no_b, !no_c);
    const auto try_weight = [&](const Number& weight, Scalar& rounded) {
      return detail::try_round({lower(weight) / upper(whole) * down, upper(weight) / lower(whole) * up}, rounded);
    };
    hit.u = hit.feature == Feature::corner_b ? Scalar{1} : Scalar{0};
    hit.v = hit.feature == Feature::corner_c ? Scalar{1} : Scalar{0};
    if (is_corner(hit.feature)) return true;
    return (no_b || try_weight(point.u, hit.u)) && (no_c || try_weight(point.v, hit.v));
  }

  const TermsOf<Number>& terms_;
  const BoxContact& contact_;
  Signs signs_;
};

template <typename Number, typename Scalar, typename AnyTriangle>
SUREHIT_NOINLINE bool try_round_point(const SweptBox<Scalar>& box, const AnyTriangle& triangle,
                                      const BoxContact& contact, ShapeHit<Scalar>& hit) {
  TermsOf<Number> terms;
  return set_terms(terms, box, triangle) && has_usual_sizes(terms) &&
         BoundedPoint<Number>(terms, contact).try_round(hit);
}

}  // namespace

template <typename Scalar, typename AnyTriangle>
Verdict bounded_contact(const SweptBox<Scalar>& box, const AnyTriangle& triangle, BoxContact& found, NoFindings) {
  if constexpr (has_short_sums<AnyTriangle>) {
    const Verdict verdict = find_contact<Sized>(box, triangle, found);
    if (verdict != Verdict::undecided) return verdict;
  }
  return find_contact<Bounded>(box, triangle, found);
}

template <typename Scalar, typename AnyTriangle>
bool try_round(const SweptBox<Scalar>& box, const AnyTriangle& triangle, const BoxContact& contact,
               ShapeHit<Scalar>& hit) {
  if (!contact.at_start && contact.timed_by == axis_count) return false;
  hit.t = static_cast<Scalar>(contact.t_lower);
  if (hit.t != static_cast<Scalar>(contact.t_upper)) return false;
  if constexpr (has_short_sums<AnyTriangle>) {
    if (try_round_point<Sized>(box, triangle, contact, hit)) return true;
  }
  return try_round_point<Bounded>(box, triangle, contact, hit);
}

#define SUREHIT_INSTANTIATE(Scalar, AnyTriangle)                                                          \
  template Verdict bounded_contact(const SweptBox<Scalar>&, const AnyTriangle&, BoxContact&, NoFindings); \
  template bool try_round(const SweptBox<Scalar>&, const AnyTriangle&, const BoxContact&, ShapeHit<Scalar>&);
SUREHIT_INSTANTIATE(float, Triangle<float>)
SUREHIT_INSTANTIATE(double, Triangle<double>)
SUREHIT_INSTANTIATE(float, PlacedTriangle<float>)
SUREHIT_INSTANTIATE(double, PlacedTriangle<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
