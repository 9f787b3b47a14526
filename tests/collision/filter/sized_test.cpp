// How close the errors of sums and products come to the bounds of `Sized`. The polynomials of moving shapes are
// computed in numbers that also know what is exact.

#include "filter/sized.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "collision/filter/coordinate_changes.hpp"
#include "placement.hpp"
#include "shape/bounded_approach.hpp"
#include "shape/bounded_terms.hpp"
#include "shape/box_terms.hpp"
#include "shape/capsule_touch.hpp"
#include "shape/exact_capsule.hpp"
#include "shape/sphere_touch.hpp"
#include "shape/touched_point.hpp"
#include "support/dyadic.hpp"
#include "support/hill_climb.hpp"
#include "support/random.hpp"
#include "support/shape_families.hpp"

namespace surehit::test::sized_test {
namespace {

using detail::Sized;
using detail::time_to_line;
using detail::time_to_plane;
using detail::time_to_point;
using detail::Vector;

/// A `Sized` number that knows what it would be without roundings. Whenever its sign or its error is asked for, it
/// notes which share of the bound its error takes up.
struct Judged {
  Judged() = default;
  Judged(const Sized& computed, Dyadic exact_value)
      : value(computed.value), size(computed.size), exact(std::move(exact_value)) {}

  [[nodiscard]] Sized sized() const { return {value, size}; }
  [[nodiscard]] double error() const {
    largest_share = std::max(largest_share, share());
    return sized().error();
  }
  [[nodiscard]] std::optional<int> sign() const {
    largest_share = std::max(largest_share, share());
    return sized().sign();
  }

  double value = 0;
  double size = 0;
  Dyadic exact;

  static inline double largest_share = 0;  ///< That of all numbers that were asked.

 private:
  [[nodiscard]] double share() const {
    constexpr double exceeded = std::numeric_limits<double>::infinity();
    if (!std::isfinite(size)) return exceeded;
    const Dyadic off = Dyadic(value) - exact;
    if (off.is_zero()) return 0;
    const double bound = sized().error();
    if (bound == 0) return exceeded;
    const mpz_class units = abs(off.in_units_of(off.exponent()));
    long exponent = 0;
    const double significand = mpz_get_d_2exp(&exponent, units.get_mpz_t());
    return std::ldexp(significand / bound, static_cast<int>(exponent + off.exponent()));
  }
};

Judged operator+(const Judged& a, const Judged& b) { return {a.sized() + b.sized(), a.exact + b.exact}; }
Judged operator-(const Judged& a, const Judged& b) { return {a.sized() - b.sized(), a.exact - b.exact}; }
Judged operator-(const Judged& a) { return {-a.sized(), Dyadic() - a.exact}; }
Judged operator*(const Judged& a, const Judged& b) { return {a.sized() * b.sized(), a.exact * b.exact}; }
Judged negated(const Judged& x) { return -x; }
Judged magnitude(const Judged& x) {
  return {detail::magnitude(x.sized()), x.exact.rational() < 0 ? Dyadic() - x.exact : x.exact};
}
double error_of(const Judged& x) { return x.error(); }

void set_difference(Judged& out, double x, double y) {
  Sized computed;
  detail::set_difference(computed, x, y);
  out = {computed, Dyadic(x) - Dyadic(y)};
}
void set_exact(Judged& out, double x) {
  Sized computed;
  detail::set_exact(computed, x);
  out = {computed, Dyadic(x)};
}
void set_one(Judged& out) { set_exact(out, 1); }

/// The numbers of a moving shape of any kind, of a triangle, and of an instance. Those of floats are among them.
struct Numbers {
  /// The start, the end, the half axis or the half extents, and the corners.
  std::array<Vector3<double>, 6> points;
  double radius;
  detail::Placement<double> placement = {};
  double share = 1;

  [[nodiscard]] bool are_finite() const {
    return std::all_of(points.begin(), points.end(), [](const Vector3<double>& point) { return point.allFinite(); });
  }
  [[nodiscard]] SweptSphere<double> ball() const { return {points[0], points[1], radius}; }
  [[nodiscard]] SweptCapsule<double> capsule() const { return {points[0], points[1], points[2], radius}; }
  [[nodiscard]] SweptBox<double> box() const { return {points[0], points[1], points[2].cwiseAbs()}; }
  [[nodiscard]] Triangle<double> triangle() const { return {points[3], points[4], points[5]}; }
  [[nodiscard]] detail::PlacedTriangle<double> placed() const { return {triangle(), placement, share}; }
};

/// Returns whether the premise of Z2 holds.
template <typename AnyTriangle>
bool has_usual_sizes(const SweptSphere<double>& ball, const AnyTriangle& triangle) {
  detail::SphereTerms<Sized, Sized> terms;
  set_terms(terms, ball, triangle);
  detail::SizeRange range;
  range.include(terms);
  return range.is_usual() && detail::has_usual_images(triangle);
}
bool has_usual_sizes(const SweptCapsule<double>& capsule, const Triangle<double>& triangle) {
  detail::CapsuleTerms<Sized, Sized> terms;
  set_terms(terms, capsule, triangle);
  detail::SizeRange range;
  range.include(static_cast<const detail::SphereTerms<Sized, Sized>&>(terms));
  range.include(terms.half_axis);
  return range.is_usual();
}
bool has_usual_sizes(const detail::BoxTerms<Judged, Judged>& terms) {
  detail::SizeRange range;
  const auto include = [&](const Vector<Judged>& vector) {
    for (const Judged& x : vector) range.include(x.sized());
  };
  for (std::size_t k = 0; k < 3; ++k) {
    include(terms.from_corner[k]);
    include(terms.edge[k]);
  }
  include(terms.step);
  include(terms.half_extents);
  return range.is_usual();
}

// Each `ask` function asks for all signs and errors that the library asks for, if the sizes are usual. Times of parts
// are asked for even if another part is touched first.

template <typename AnyTriangle>
void ask_ball(const SweptSphere<double>& ball, const AnyTriangle& triangle) {
  if (!has_usual_sizes(ball, triangle)) return;
  detail::SphereTerms<Judged, Judged> terms;
  set_terms(terms, ball, triangle);
  const Vector<Judged> n = normal_of(terms);
  for (const Judged& x : n) static_cast<void>(x.sign());
  detail::SphereFindings findings;
  const detail::Outline outline;
  static_cast<void>(detail::SphereTouch(terms, outline).find([](auto, auto) { return false; }, findings));
  static_cast<void>(time_to_plane(terms.from_corner[0], terms.step, n, terms.radius));
  for (std::size_t k = 0; k < 3; ++k) {
    static_cast<void>(time_to_point(terms.from_corner[k], terms.step, terms.radius));
    static_cast<void>(time_to_line(terms.from_corner[k], terms.step, terms.edge[k], terms.radius));
  }
}

void ask_capsule(const SweptCapsule<double>& capsule, const Triangle<double>& triangle) {
  if (!has_usual_sizes(capsule, triangle)) return;
  detail::CapsuleTerms<Judged, Judged> terms;
  set_terms(terms, capsule, triangle);
  const Vector<Judged> n = normal_of(terms);
  for (const Judged& x : n) static_cast<void>(x.sign());
  detail::Signs signs;
  static_cast<void>(tilt_of(terms, signs));
  const detail::CoreTilt tilt = detail::exact_tilt(capsule, triangle);
  detail::CapsuleFindings findings;
  const detail::Outline outline;
  static_cast<void>(detail::CapsuleTouch(terms, outline, tilt).find([](auto, auto) { return false; }, findings));
  const Vector<Judged>& axis = terms.half_axis;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector<Judged>& w = terms.from_corner[k];
    const Vector<Judged>& e = terms.edge[k];
    static_cast<void>(time_to_line(w, terms.step, axis, terms.radius));
    static_cast<void>(time_to_plane(w, terms.step, detail::cross(e, axis), terms.radius));
    for (const detail::CorePart end : {detail::CorePart::low_end, detail::CorePart::high_end}) {
      const Vector<Judged> from_end = moved_to(end, w, axis);
      static_cast<void>(time_to_point(from_end, terms.step, terms.radius));
      static_cast<void>(time_to_line(from_end, terms.step, e, terms.radius));
      static_cast<void>(time_to_plane(from_end, terms.step, n, terms.radius));
    }
  }
}

/// The numbers that `TouchedPoint` computes with.
struct JudgedNumbers {
  using Difference = Judged;
  using Time = Judged;
  using Moved = Judged;
  using Constant = Judged;
  using Square = Judged;
  using MovedSquare = Judged;
  using Direction = Judged;
  using Slope = Judged;
  using MovedSlope = Judged;
  using Weight = Judged;
  using Divisor = Judged;
};
using Search = detail::TouchedPoint<JudgedNumbers>;

/// Asks for the point that a box touches at t = moved / m, when it passes a side of this axis, or begins with a
/// contact.
void ask_point(const detail::BoxTerms<Judged, Judged>& terms, std::optional<std::size_t> axis, const Judged& moved,
               const Judged& m) {
  Vector<Judged> way;
  Vector<Judged> extents;
  Vector<Judged> ac;
  for (std::size_t i = 0; i < 3; ++i) {
    way[i] = terms.from_corner[0][i] * m + terms.step[i] * moved;
    extents[i] = terms.half_extents[i] * m;
    ac[i] = negated(terms.edge[2][i]);
  }
  detail::Signs signs;
  Search search(way, terms.edge[0], ac, extents, m, signs);
  const auto ask = [&](const Search::Point& point) {
    const Judged whole = m * point.z;
    for (const Judged& x : {whole, whole - point.u - point.v, point.u, point.v}) static_cast<void>(signs.of(x));
  };
  const auto sides_of_axis = [](std::size_t i) { return 1U << Search::lower_side(i) | 1U << Search::upper_side(i); };
  if (!axis) return ask(search.find());
  if (*axis < detail::normal_axis) return ask(search.find(Search::all_sides & ~sides_of_axis(*axis)));
  if (*axis == detail::normal_axis) {
    for (std::size_t i = 0; i < 3; ++i) ask(search.find_on(Search::upper_side(detail::next(i)), 7U | sides_of_axis(i)));
    return;
  }
  ask(search.crossing(detail::edge_of(*axis), Search::lower_side(detail::next(detail::coordinate_of(*axis)))));
}

void ask_box(const SweptBox<double>& box, const Triangle<double>& triangle) {
  detail::BoxTerms<Judged, Judged> terms;
  detail::set_differences<Judged>(terms, box, triangle);
  for (std::size_t i = 0; i < 3; ++i) set_exact(terms.half_extents[i], box.half_extents[static_cast<Eigen::Index>(i)]);
  terms.extremes = detail::AxisExtremes(triangle);
  if (!has_usual_sizes(terms)) return;
  Vector<Judged> n = normal_of(terms);
  for (Judged& x : n) {
    static_cast<void>(x.sign());
    if (x.exact.is_zero()) x = {};  // The library knows that most of these are zero.
  }
  std::optional<std::size_t> timed_by;
  Judged moved;
  Judged m;
  set_one(m);
  const auto take = [&](std::size_t axis, bool, const Judged& gap, const Judged& approach) {
    for (const Judged& x : {gap, approach, gap - approach}) static_cast<void>(x.error());
    // The box passes the last one of all sides that it comes to.
    if (gap.value <= 0 || approach.value <= 0 || gap.value / approach.value < moved.value / m.value) return;
    timed_by = axis;
    moved = gap;
    m = approach;
  };
  for (std::size_t i = 0; i < 3; ++i) take_coordinate(terms, i, take);
  take_normal(terms, n, take);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) take_edge(terms, k, i, 0, take);
  }
  ask_point(terms, timed_by, moved, m);
}

/// Draws a shape of one of these families and a triangle. What the shape does not have is drawn alone.
template <typename Families>
Numbers draw_of(const Families& families, Random& random) {
  const auto [shape, triangle] = draw_shape_pair<double>(families[random.below(families.size())], random);
  Numbers numbers = {{shape.start, shape.end, {}, triangle.a, triangle.b, triangle.c}, random.unit<double>()};
  for (double& x : numbers.points[2]) x = random.symmetric<double>();
  const auto take = [&](const auto& any) {
    if constexpr (requires { any.radius; }) numbers.radius = any.radius;
    if constexpr (requires { any.half_axis; }) numbers.points[2] = any.half_axis;
    if constexpr (requires { any.half_extents; }) numbers.points[2] = any.half_extents;
  };
  take(shape);
  return numbers;
}

/// Draws a shape of one of these families, or of none, and a triangle.
template <const auto& families>
Numbers draw(Random& random) {
  Numbers numbers = draw_of(families, random);
  if (!random.one_in(3)) return numbers;
  // Errors are largest where all coordinates have one size.
  for (Vector3<double>& point : numbers.points) {
    for (double& x : point) x = random.symmetric<double>();
  }
  numbers.radius = random.unit<double>();
  return numbers;
}

/// Returns the numbers times a power of two.
Numbers scaled(Numbers numbers, int exponent) {
  for (Vector3<double>& point : numbers.points) {
    for (double& x : point) x = std::ldexp(x, exponent);
  }
  numbers.radius = std::ldexp(numbers.radius, exponent);
  return numbers;
}
/// Returns the numbers as small or as large as the premise of Z2 allows.
Numbers scaled_to_limit(Numbers numbers, bool is_large) {
  for (int step = 0; step < 100; ++step) {
    const Numbers next = scaled(numbers, is_large ? 1 : -1);
    if (!has_usual_sizes(next.capsule(), next.triangle())) break;
    numbers = next;
  }
  return numbers;
}

/// Draws a capsule and a triangle all of whose differences are between 0.75 and 4.25.
Numbers draw_even(Random& random) {
  Numbers numbers;
  const auto draw_near = [&](double x) { return x + random.symmetric<double>() / 8; };
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::array<double, 5> places = {-2, -1, 0, 1, 2};
    for (std::size_t k = 4; k > 0; --k) std::swap(places[k], places[random.below(k + 1)]);
    for (std::size_t k = 0; k < 5; ++k) numbers.points[k < 2 ? k : k + 1][axis] = draw_near(places[k]);
    numbers.points[2][axis] = draw_near(random.one_in(2) ? 1 : -1);
  }
  numbers.radius = draw_near(1);
  return numbers;
}

/// Draws an instance and a ball. What the instance makes of its triangle is nearly the triangle of a family.
Numbers draw_placed(Random& random) {
  Numbers numbers = draw<all_sphere_families>(random);
  auto& [pose, motion, moves] = numbers.placement;
  const auto draw_vector = [&] {
    const double x = random.symmetric<double>();
    const double y = random.symmetric<double>();
    return Vector3<double>(x, y, random.symmetric<double>());
  };
  pose.linear << draw_vector(), draw_vector(), draw_vector();
  pose.translation = draw_vector();
  moves = random.one_in(2);
  if (moves) motion = draw_vector();
  numbers.share = random.one_in(2) ? 1 : random.unit<double>() / 2 + 0.5;
  for (std::size_t k = 3; k < 6; ++k) {
    numbers.points[k] = pose.linear.inverse() * (numbers.points[k] - pose.translation);
  }
  return numbers;
}

/// Draws an instance whose triangle has tiny coordinates along one axis of the mesh. In half of all cases, nothing is
/// added to their products with the matrix, which may underflow.
Numbers draw_tiny(Random& random) {
  Numbers numbers = draw_placed(random);
  auto& [pose, motion, moves] = numbers.placement;
  const auto axis = static_cast<Eigen::Index>(random.below(3));
  const auto exponent = static_cast<int>(random.one_in(2) ? random.between(-1074, -1000) : random.between(-540, -400));
  for (std::size_t k = 3; k < 6; ++k) numbers.points[k][axis] = std::ldexp(random.symmetric<double>(), exponent);
  if (random.one_in(2)) return numbers;
  const int exponent_of_entry = random.one_in(2) ? -64 : 0;
  pose.linear.row(axis).setZero();
  pose.linear.col(axis).setZero();
  pose.linear(axis, axis) = std::ldexp(random.unit<double>() + 1, exponent_of_entry);
  if (random.one_in(2)) numbers.points[0][axis] = pose.translation[axis];
  return numbers;
}

/// Changes one number, or moves a point near to another one.
Numbers changed(Random& random, Numbers numbers) {
  Vector3<double>& point = numbers.points[random.below(6)];
  const auto axis = static_cast<Eigen::Index>(random.below(3));
  switch (random.below(8)) {
    case 0: {
      const Vector3<double>& other = numbers.points[random.below(6)];
      point = other + (point - other) * std::ldexp(1.0, static_cast<int>(random.between(-12, 6)));
      break;
    }
    case 1:
      numbers.radius = std::fabs(changed_coordinate(random, numbers.radius));
      break;
    default:
      point[axis] = changed_coordinate(random, point[axis]);
  }
  return numbers;
}

/// Does the same with the numbers of an instance too. Those of its matrix and its share stay between 2^-64 and 1.
Numbers changed_placed(Random& random, Numbers numbers) {
  auto& [pose, motion, moves] = numbers.placement;
  const auto axis = static_cast<Eigen::Index>(random.below(3));
  const auto is_entry = [](double x) { return std::fabs(x) >= 0x1p-64 && std::fabs(x) <= 1; };
  const auto change_entry = [&](double& x) {
    const double next = changed_coordinate(random, x);
    if (is_entry(next)) x = next;
  };
  switch (random.below(6)) {
    case 0:
    case 1:
      change_entry(pose.linear(axis, static_cast<Eigen::Index>(random.below(3))));
      return numbers;
    case 2:
      pose.translation[axis] = changed_coordinate(random, pose.translation[axis]);
      return numbers;
    case 3:
      if (moves) motion[axis] = changed_coordinate(random, motion[axis]);
      change_entry(numbers.share);
      numbers.share = std::fabs(numbers.share);
      return numbers;
    default:
      return changed(random, numbers);
  }
}

/// Climbs to the worst share of all numbers that are asked for.
template <typename Ask>
void climb(const std::string& name, std::uint64_t seed, std::size_t starts, std::size_t steps, const Ask& ask,
           Numbers (*draw_next)(Random&), Numbers (*change)(Random&, Numbers) = changed) {
  Random random(seed);
  const double worst = climb_to_worst(
      starts, steps, [&] { return draw_next(random); }, [&](const Numbers& numbers) { return change(random, numbers); },
      [&](const Numbers& numbers) {
        Judged::largest_share = 0;
        if (numbers.are_finite()) ask(numbers);
        return Judged::largest_share;
      });
  expect_within_bound(name, worst);
}

void ask_plain_ball(const Numbers& numbers) { ask_ball(numbers.ball(), numbers.triangle()); }
void ask_placed_ball(const Numbers& numbers) { ask_ball(numbers.ball(), numbers.placed()); }
void ask_any_capsule(const Numbers& numbers) { ask_capsule(numbers.capsule(), numbers.triangle()); }
void ask_any_box(const Numbers& numbers) { ask_box(numbers.box(), numbers.triangle()); }

/// Z1.
TEST(Sized, of_balls_stays_within_its_bound) {
  climb("Z1_of_balls", 181, 3, 800, ask_plain_ball, draw<all_sphere_families>);
}

TEST(Sized, of_capsules_stays_within_its_bound) {
  climb("Z1_of_capsules", 191, 3, 400, ask_any_capsule, draw<all_capsule_families>);
}

TEST(Sized, of_boxes_stays_within_its_bound) { climb("Z1_of_boxes", 193, 3, 500, ask_any_box, draw<all_box_families>); }

/// Z2.
TEST(Sized, of_the_smallest_and_the_largest_sizes_stays_within_its_bound) {
  const auto ask_at_limit = [](bool is_large) {
    return [is_large](const Numbers& numbers) {
      const Numbers extreme = scaled_to_limit(numbers, is_large);
      ask_plain_ball(extreme);
      ask_any_capsule(extreme);
    };
  };
  climb("Z2_of_the_smallest_sizes", 197, 10, 50, ask_at_limit(false), draw_even);
  climb("Z2_of_the_largest_sizes", 199, 10, 20, ask_at_limit(true), draw_even);
}

/// Z3.
TEST(Sized, of_balls_in_instances_stays_within_its_bound) {
  climb("Z3", 211, 3, 800, ask_placed_ball, draw_placed, changed_placed);
}

/// Z3, where products would underflow if these triangles were not left to numbers with bounds.
TEST(Sized, of_tiny_triangles_in_instances_stays_within_its_bound) {
  climb("Z3_of_tiny_triangles", 223, 10, 100, ask_placed_ball, draw_tiny, changed_placed);
}

}  // namespace
}  // namespace surehit::test::sized_test
