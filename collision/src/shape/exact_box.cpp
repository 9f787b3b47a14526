#include "shape/exact_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "shape/exact_differences.hpp"
#include "shape/outline.hpp"
#include "shape/shape_contact.hpp"
#include "shape/touched_point.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// The numbers of bits of the exact terms. A sum of k terms adds k - 1 to the bits of its terms.
template <typename AnyTriangle>
struct BoxBits {
  static constexpr int difference = DifferenceBits<AnyTriangle>::value;
  static constexpr int cross = 2 * difference + 1;
  static constexpr int volume = cross + difference + 2;  ///< For n·w, D·n and the reach of a box.
  static constexpr int time = volume + 1;                ///< For both parts of a t.
  static constexpr int moved = time + difference + 1;    ///< For the centre at a t.
};

/// The integers that `TouchedPoint` computes with.
template <typename AnyTriangle>
struct ExactNumbers {
  using Bits = BoxBits<AnyTriangle>;
  static constexpr int square = 2 * Bits::difference + 2;
  static constexpr int slope = Bits::cross + Bits::difference + 2;
  using Difference = WideInt<Bits::difference>;
  using Time = WideInt<Bits::time>;
  using Moved = WideInt<Bits::moved>;
  using Constant = WideInt<Bits::moved + 1>;
  using Square = WideInt<square>;
  using MovedSquare = WideInt<Bits::moved + Bits::difference + 2>;
  using Direction = WideInt<Bits::cross>;
  using Slope = WideInt<slope>;
  using MovedSlope = WideInt<Bits::moved + Bits::cross + 2>;
  using Weight = WideInt<Bits::moved + Bits::cross + Bits::difference + 4>;
  using Divisor = WideInt<2 * square + 1>;
};

/// The centre is outside of one side of K at t if gap - t approach > 0 (B1).
template <typename AnyTriangle>
struct Side {
  WideInt<BoxBits<AnyTriangle>::time> gap;
  WideInt<BoxBits<AnyTriangle>::volume> approach;
  std::size_t axis;
  bool is_above;
};

/// A box and a triangle in integers. `AnyTriangle` is `Triangle` or `PlacedTriangle`.
template <typename Scalar, typename AnyTriangle>
class ExactBox {
  using Bits = BoxBits<AnyTriangle>;
  using Int = WideInt<Bits::time>;

 public:
  using Time = Ratio<Int>;

  ExactBox(const SweptBox<Scalar>& box, const AnyTriangle& triangle) : extremes_(local_corners(triangle)) {
    BinaryUnit unit;
    include(unit, box, triangle);
    unit.include(box.half_extents);
    if (unit.is_empty()) unit.exponent = 0;
    set_differences(terms_, box, triangle, unit);
    for (std::size_t i = 0; i < 3; ++i) {
      set_integer(terms_.half_extents[i], box.half_extents[static_cast<Eigen::Index>(i)], unit);
    }
    terms_.extremes = AxisExtremes::from_edges([&](std::size_t k, std::size_t i) { return terms_.edge[k][i].sign(); });
    normal_ = cross(terms_.edge[0], terms_.edge[1]);
  }

  [[nodiscard]] std::optional<BoxContact> find() const {
    std::array<Side<AnyTriangle>, 2 * axis_count> sides;
    std::size_t count = 0;
    const auto add = [&](std::size_t axis, bool is_above, const auto& gap, const auto& approach) {
      sides[count].gap = gap;
      sides[count].approach = approach;
      sides[count].axis = axis;
      sides[count++].is_above = is_above;
    };
    take_all(add);
    BoxContact contact;
    // The side that is passed last, if the centre begins outside of any (B4).
    const Side<AnyTriangle>* last = nullptr;
    for (std::size_t i = 0; i < count; ++i) {
      const Side<AnyTriangle>& side = sides[i];
      if (side.gap.sign() <= 0) continue;
      // The centre must pass this side, and not after the end.
      if (side.approach.sign() <= 0 || side.gap.compare_magnitude(side.approach) > 0) return std::nullopt;
      if (last == nullptr || compare(side.gap, side.approach, last->gap, last->approach) > 0) last = &side;
    }
    if (last == nullptr) {
      contact.at_start = true;
      return contact;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto passed = sides[i].approach * last->gap;
      if ((sides[i].gap * last->approach - passed).sign() > 0) return std::nullopt;
    }
    contact.timed_by = last->axis;
    contact.is_above = last->is_above;
    // The nearest double is at most half an ulp from the exact t, so its neighbours enclose it.
    const double nearest = rounded_quotient<double>(last->gap, last->approach);
    contact.t_lower = nearest > 0 ? std::nextafter(nearest, 0.0) : 0;
    contact.t_upper = std::min(std::nextafter(nearest, 2.0), 1.0);
    return contact;
  }

  /// Returns the t of a contact that is not at the start.
  [[nodiscard]] SUREHIT_NOINLINE Time time(const BoxContact& contact) const {
    Time t;
    const std::size_t axis = contact.timed_by != axis_count ? contact.timed_by : find()->timed_by;
    const auto take = [&](std::size_t, bool, const auto& gap, const auto& approach) {
      if (gap.sign() <= 0) return;
      t.num = gap;
      t.den = approach;
    };
    if (axis < normal_axis) {
      take_coordinate(terms_, axis, take);
    } else if (axis == normal_axis) {
      take_normal(terms_, normal_, take);
    } else {
      take_edge(terms_, edge_of(axis), coordinate_of(axis), normal_[coordinate_of(axis)].sign(), take);
    }
    return t;
  }

  /// Returns the sign of the step times the normal.
  [[nodiscard]] int sign_along() const { return dot(normal_, terms_.step).sign(); }

  /// Returns the direction of the side that the centre passes, or that of the side that it is nearest to at the start.
  [[nodiscard]] SUREHIT_NOINLINE Direction direction(const BoxContact& contact) const {
    std::size_t axis = contact.timed_by;
    bool is_above = contact.is_above;
    if (contact.at_start) {
      bool is_first = true;
      WideInt<2 * Bits::time> least_depth;  // The square of the depth, times the square of the axis.
      WideInt<2 * Bits::cross + 2> square_of_least;
      take_all([&](std::size_t any_axis, bool any_is_above, const auto& gap, const auto&) {
        const Int depth = gap;
        const auto square = depth * depth;
        const auto m = axis_vector(any_axis);
        const auto square_of_axis = dot(m, m);
        if (!is_first && (square * square_of_least - least_depth * square_of_axis).sign() >= 0) return;
        is_first = false;
        least_depth = square;
        square_of_least = square_of_axis;
        axis = any_axis;
        is_above = any_is_above;
      });
    }
    auto m = axis_vector(axis);
    if (!is_above) m = {negated(m[0]), negated(m[1]), negated(m[2])};
    return direction_of(m);
  }

  SUREHIT_NOINLINE void round(const BoxContact& contact, ShapeHit<Scalar>& hit) const {
    Time t;
    if (contact.at_start) {
      t.den = Int::power_of_two(0);
    } else {
      t = time(contact);
    }
    hit.t = rounded_quotient<Scalar>(t.num, t.den);
    if (is_zero(normal_)) {
      round_on_segment(t, hit);
    } else {
      round_on_triangle(t, hit);
    }
  }

 private:
  using Numbers = ExactNumbers<AnyTriangle>;
  using Point = typename TouchedPoint<Numbers>::Point;
  using Difference = typename Numbers::Difference;
  using Moved = typename Numbers::Moved;
  using Weight = typename Numbers::Weight;

  /// Calls `take` for all sides of K.
  template <typename Take>
  void take_all(const Take& take) const {
    for (std::size_t i = 0; i < 3; ++i) take_coordinate(terms_, i, take);
    const int zeros = normal_[0].is_zero() + normal_[1].is_zero() + normal_[2].is_zero();
    if (zeros < 2) take_normal(terms_, normal_, take);  // B3
    for (std::size_t coordinate = 0; coordinate < 3; ++coordinate) {
      const int below = normal_[coordinate].sign();
      if (below == 0 && zeros < 3) continue;  // B3
      for (std::size_t k = 0; k < 3; ++k) take_edge(terms_, k, coordinate, below, take);
    }
  }

  /// Returns the vector of an axis (B1).
  [[nodiscard]] Vector<WideInt<Bits::cross>> axis_vector(std::size_t axis) const {
    if (axis == normal_axis) return normal_;
    Vector<WideInt<Bits::cross>> m;
    if (axis < normal_axis) {
      m[axis] = WideInt<Bits::cross>::power_of_two(0);
      return m;
    }
    const std::size_t i = next(coordinate_of(axis));
    const std::size_t j = next(i);
    const auto& e = terms_.edge[edge_of(axis)];
    m[i] = e[j];
    m[j] = negated(e[i]);
    return m;
  }

  /// Returns the way from a corner to the centre at t, times the divisor of t.
  [[nodiscard]] Vector<Moved> to_centre(std::size_t corner, const Time& t) const {
    Vector<Moved> way;
    for (std::size_t i = 0; i < 3; ++i) way[i] = terms_.from_corner[corner][i] * t.den + terms_.step[i] * t.num;
    return way;
  }
  [[nodiscard]] auto extents(const Time& t) const {
    const auto& h = terms_.half_extents;
    return Vector<decltype(h[0] * t.den)>{h[0] * t.den, h[1] * t.den, h[2] * t.den};
  }

  void round_on_triangle(const Time& t, ShapeHit<Scalar>& hit) const {
    const Vector<Moved> way = to_centre(0, t);
    const auto& ca = terms_.edge[2];
    const Vector<Difference> ac = {negated(ca[0]), negated(ca[1]), negated(ca[2])};
    Signs signs;
    const Point point = TouchedPoint<Numbers>(way, terms_.edge[0], ac, extents(t), t.den, signs).find();
    const Weight whole = t.den * point.z;
    const auto rest = whole - point.u - point.v;
    hit.feature = feature_with(!rest.is_zero(), !point.u.is_zero(), !point.v.is_zero());
    hit.u = rounded_quotient<Scalar>(point.u, whole);
    hit.v = rounded_quotient<Scalar>(point.v, whole);
  }

  void round_on_segment(const Time& t, ShapeHit<Scalar>& hit) const {
    const auto [first, last] = extremes_;
    hit.feature = corner_feature(first);
    std::array<Scalar, 3> weights = {0, 0, 0};
    weights[first] = 1;
    if (first != last) {
      const bool is_forward = next(first) == last;
      const std::size_t edge = is_forward ? first : last;
      Vector<Difference> along = terms_.edge[edge];
      if (!is_forward) along = {negated(along[0]), negated(along[1]), negated(along[2])};
      const Vector<Moved> way = to_centre(first, t);
      Signs signs;
      const Point point = TouchedPoint<Numbers>(way, along, {}, extents(t), t.den, signs).find_on(0);
      const Weight whole = t.den * point.z;
      const auto rest = whole - point.u;
      weights[first] = rounded_quotient<Scalar>(rest, whole);
      weights[last] = rounded_quotient<Scalar>(point.u, whole);
      if (!point.u.is_zero()) hit.feature = rest.is_zero() ? corner_feature(last) : edge_feature(edge);
    }
    hit.u = weights[1];
    hit.v = weights[2];
  }

  BoxTerms<Difference, WideInt<Bits::difference>> terms_;
  IntVector<WideInt<Bits::cross>> normal_;
  /// For a placed triangle, these are the corners in the mesh. Their images have the same order or the opposite one,
  /// and the same extremes.
  ExtremeCorners extremes_;
};

}  // namespace

template <typename Scalar, typename AnyTriangle>
std::optional<BoxContact> exact_contact(const SweptBox<Scalar>& box, const AnyTriangle& triangle, NoFindings) {
  return ExactBox<Scalar, AnyTriangle>(box, triangle).find();
}

template <typename Scalar, typename AnyTriangle>
int compare_times(const SweptBox<Scalar>& box, const AnyTriangle& x_triangle, const BoxContact& x,
                  const AnyTriangle& y_triangle, const BoxContact& y) {
  if (x.at_start || y.at_start) return static_cast<int>(y.at_start) - static_cast<int>(x.at_start);
  const auto x_time = ExactBox<Scalar, AnyTriangle>(box, x_triangle).time(x);
  return compare(x_time, ExactBox<Scalar, AnyTriangle>(box, y_triangle).time(y));
}

template <typename Scalar, typename AnyTriangle>
int compare_time(const SweptBox<Scalar>& box, const AnyTriangle& triangle, const BoxContact& contact, Scalar limit) {
  if (contact.at_start) return limit > 0 ? -1 : 0;
  return Limit<Scalar>(limit, 0).compare(ExactBox<Scalar, AnyTriangle>(box, triangle).time(contact));
}

template <typename Scalar, typename AnyTriangle>
int sign_along(const SweptBox<Scalar>& box, const AnyTriangle& triangle) {
  return ExactBox<Scalar, AnyTriangle>(box, triangle).sign_along();
}

template <typename Scalar, typename AnyTriangle>
void round_exactly(const SweptBox<Scalar>& box, const AnyTriangle& triangle, const BoxContact& contact,
                   ShapeHit<Scalar>& hit) {
  ExactBox<Scalar, AnyTriangle>(box, triangle).round(contact, hit);
}

template <typename Scalar, typename AnyTriangle>
Direction exact_direction(const SweptBox<Scalar>& box, const AnyTriangle& triangle, const BoxContact& contact) {
  return ExactBox<Scalar, AnyTriangle>(box, triangle).direction(contact);
}

#define SUREHIT_INSTANTIATE(Scalar, AnyTriangle)                                                                  \
  template std::optional<BoxContact> exact_contact(const SweptBox<Scalar>&, const AnyTriangle&, NoFindings);      \
  template int compare_times(const SweptBox<Scalar>&, const AnyTriangle&, const BoxContact&, const AnyTriangle&,  \
                             const BoxContact&);                                                                  \
  template int compare_time(const SweptBox<Scalar>&, const AnyTriangle&, const BoxContact&, Scalar);              \
  template int sign_along(const SweptBox<Scalar>&, const AnyTriangle&);                                           \
  template void round_exactly(const SweptBox<Scalar>&, const AnyTriangle&, const BoxContact&, ShapeHit<Scalar>&); \
  template Direction exact_direction(const SweptBox<Scalar>&, const AnyTriangle&, const BoxContact&);
SUREHIT_INSTANTIATE(float, Triangle<float>)
SUREHIT_INSTANTIATE(double, Triangle<double>)
SUREHIT_INSTANTIATE(float, PlacedTriangle<float>)
SUREHIT_INSTANTIATE(double, PlacedTriangle<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
