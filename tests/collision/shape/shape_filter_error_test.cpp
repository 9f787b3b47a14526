#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "collision/filter/coordinate_changes.hpp"
#include "shape/shape_filter.hpp"
#include "support/hill_climb.hpp"
#include "support/moving_gap.hpp"
#include "support/nearest_points.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/shape_families.hpp"

namespace surehit::test::shape_filter_error_test {
namespace {

using detail::Core;
using detail::NearTriangles;
using detail::ShapeFilter;
using detail::ShapeList;
using oracle::operator-;

using Float = mpf_class;
using Gap = MovingGap<Float>;
using Point = oracle::Vec<Float>;

/// A moving shape of any kind, a triangle, and what comes after which t does not count.
template <typename Scalar>
struct Pair {
  Core core;
  bool is_still;  ///< The shape stays where it begins.
  /// The start, the end, the half extents or the half axis, and the corners.
  std::array<Vector3<Scalar>, 6> points;
  Scalar radius;
  Scalar limit;

  [[nodiscard]] const Vector3<Scalar>& start() const { return points[0]; }
  [[nodiscard]] const Vector3<Scalar>& end() const { return points[is_still ? 0 : 1]; }
  [[nodiscard]] Vector3<Scalar> half() const { return core == Core::point ? Vector3<Scalar>(0, 0, 0) : points[2]; }

  [[nodiscard]] ShapeFilter<Scalar> filter() const {
    if (core == Core::box) return ShapeFilter<Scalar>(SweptBox<Scalar>{start(), end(), half()});
    if (core == Core::point) return ShapeFilter<Scalar>(SweptSphere<Scalar>{start(), end(), radius});
    return ShapeFilter<Scalar>(SweptCapsule<Scalar>{start(), end(), half(), radius});
  }
  /// Returns the number that makes the shape larger or smaller.
  [[nodiscard]] Scalar& size() { return core == Core::box ? points[2][0] : radius; }
};

Float exact(double x) { return Float(x, 512); }

template <typename Scalar>
Point exact(const Vector3<Scalar>& x) {
  return {exact(x[0]), exact(x[1]), exact(x[2])};
}

Float largest_of(const Point& x) { return std::max({Float(abs(x[0])), Float(abs(x[1])), Float(abs(x[2]))}); }
Point negated(const Point& x) { return {Float(-x[0]), Float(-x[1]), Float(-x[2])}; }
Float length_of(const Point& x) { return sqrt(oracle::dot(x, x)); }

/// What the lemmas of the filter speak of, in long floats.
template <typename Scalar>
struct Exact {
  explicit Exact(const Pair<Scalar>& pair)
      : core(pair.core),
        w(exact(pair.start()) - exact(pair.points[3])),
        p(exact(pair.points[4]) - exact(pair.points[3])),
        q(exact(pair.points[5]) - exact(pair.points[3])),
        step(exact(pair.end()) - exact(pair.start())),
        half(exact(pair.half())),
        n(oracle::cross(p, q)),
        r(exact(core == Core::box ? Scalar{0} : pair.radius)),
        limit(exact(pair.limit)),
        of_edges(std::max(largest_of(p), largest_of(q))),
        of_step(largest_of(step)),
        of_start(largest_of(w)),
        far(of_start + of_edges + r + largest_of(half)) {}

  /// Returns how far the core comes along m.
  [[nodiscard]] Float reach_of_core(const Point& m) const {
    if (core == Core::segment) return abs(oracle::dot(m, half));
    Float sum = exact(0);
    for (std::size_t i = 0; i < 3; ++i) sum += abs(m[i]) * half[i];
    return sum;
  }
  /// Returns the height above the corners along an axis across the step, where they are at 0 or at `other`.
  [[nodiscard]] static Float above_corners(const Float& height, const Float& other) {
    return std::max(Float(std::min(other, exact(0)) - height), Float(height - std::max(other, exact(0))));
  }
  /// Returns how fast the centre comes to the plane of the triangle, times |n|.
  [[nodiscard]] Float rate_toward() const {
    const Float rate = oracle::dot(n, step);
    return oracle::dot(n, w) < 0 ? rate : Float(-rate);
  }

  /// Returns f, g and f - g.
  [[nodiscard]] std::array<Point, 3> axes_across() const {
    const Point f = oracle::cross(step, p);
    const Point g = oracle::cross(step, q);
    return {f, g, f - g};
  }
  /// Returns the heights above the corners along these.
  [[nodiscard]] std::array<Float, 3> heights_across() const {
    const auto [f, g, h] = axes_across();
    const Float other = oracle::dot(f, q);
    return {above_corners(oracle::dot(f, w), other), above_corners(Float(-oracle::dot(g, w)), other),
            above_corners(oracle::dot(h, w), other)};
  }

  /// Returns the way from corner a to the nearest point of the core, and what is left of it across the step.
  [[nodiscard]] std::array<Point, 2> ways_to_core() const {
    Point way = w;
    const Float squared_half = oracle::dot(half, half);
    if (core == Core::segment && squared_half > 0) {
      const Float place = std::clamp(Float(oracle::dot(w, half) / squared_half), exact(-1), exact(1));
      for (std::size_t i = 0; i < 3; ++i) way[i] -= place * half[i];
    } else {
      for (std::size_t i = 0; i < 3; ++i) {
        const Float beyond = std::max(Float(abs(w[i]) - half[i]), exact(0));
        way[i] = w[i] < 0 ? Float(-beyond) : beyond;
      }
    }
    Point across = way;
    const Float squared_step = oracle::dot(step, step);
    if (squared_step > 0) {
      const Float along = oracle::dot(way, step) / squared_step;
      for (std::size_t i = 0; i < 3; ++i) across[i] -= along * step[i];
    }
    return {way, across};
  }

  static constexpr double u = std::is_same_v<Scalar, float> ? 0x1p-24 : 0x1p-53;
  Core core;
  Point w, p, q, step, half, n;
  Float r;
  Float limit;
  Float of_edges;  ///< E
  Float of_step;   ///< S
  Float of_start;  ///< W
  Float far;       ///< F
};

/// Searches for shapes that the filter leaves out although they are as near as it can be wrong. Each share is that of a
/// bound which an exact gap falls short of, where the filter just leaves out the shape.
template <typename Scalar>
class ShapeFilterError : public testing::Test {
 protected:
  using Numbers = Pair<Scalar>;

  /// A list of one triangle. A vector load may read beyond it.
  using Corners = std::array<Scalar, 9 + 64>;
  static Corners corners_of(const Numbers& pair) {
    Corners corners = {};
    for (std::size_t i = 0; i < 9; ++i) corners[i] = pair.points[3 + i / 3][static_cast<Eigen::Index>(i % 3)];
    return corners;
  }

  /// Returns whether the first axes leave out a triangle: f, g, f - g, n, and the ways to the core.
  static bool is_apart_at_once(const Numbers& pair) {
    const Corners corners = corners_of(pair);
    const ShapeFilter<Scalar> filter = pair.filter();
    ShapeList<Scalar> list{&filter, corners.data(), 1, 0, 1, pair.limit};
    std::array<NearTriangles, 2> near;
    return ShapeFilter<Scalar>::find_near({&list, 1}, near) == 0;
  }
  /// Returns whether the other axes do. Sets the time at which the shape may come.
  static bool is_apart_at_all_times(const Numbers& pair, double& enters) {
    const Corners corners = corners_of(pair);
    const ShapeFilter<Scalar> filter = pair.filter();
    typename ShapeFilter<Scalar>::Times times;
    const std::uint64_t found =
        filter.find_times({&filter, corners.data(), 1, 0, 1, pair.limit}, {0, 0, 1}, pair.limit, times.data());
    enters = times[0];
    return (found & 1) == 0;
  }

  /// Whether the lanes ask any axis but those of coordinates, and compute with this scalar.
  static bool is_usable(const Numbers& pair) {
    const ShapeFilter<Scalar> filter = pair.filter();
    double smallest = filter.doubles.smallest;
    double largest = detail::largest_double;
    if constexpr (std::is_same_v<Scalar, float>) {
      if (!filter.fits_float) return false;
      smallest = filter.floats.smallest;
      largest = detail::largest_float;
    }
    const Exact<Scalar> exact(pair);
    return exact.of_edges > smallest && exact.far * (1 + 0x1p-20) < largest && exact.far * (1 - 0x1p-20) > smallest;
  }

  /// Makes the shape as large as it may be where it is left out. Returns false if it is never left out, or always.
  template <typename IsApart>
  static bool grow(Numbers& pair, const IsApart& is_apart) {
    using Bits = std::conditional_t<std::is_same_v<Scalar, float>, std::uint32_t, std::uint64_t>;
    Scalar& size = pair.size();
    size = 0;
    if (!is_apart(pair)) return false;
    Bits low = 0;
    Bits high = std::bit_cast<Bits>(static_cast<Scalar>(std::is_same_v<Scalar, float> ? 0x1p19 : 0x1p159));
    size = std::bit_cast<Scalar>(high);
    if (is_apart(pair)) return false;
    while (high - low > 1) {
      const Bits middle = low + (high - low) / 2;
      size = std::bit_cast<Scalar>(middle);
      (is_apart(pair) ? low : high) = middle;
    }
    size = std::bit_cast<Scalar>(low);
    return is_usable(pair);
  }

  /// Draws a shape of some family and a triangle.
  static Numbers draw(Random& random) {
    const auto of = [&](Core core, const auto& shape, const Vector3<Scalar>& half, Scalar radius,
                        const Triangle<Scalar>& triangle) {
      return Numbers{core,
                     random.one_in(4),
                     {shape.start, shape.end, half, triangle.a, triangle.b, triangle.c},
                     radius,
                     random.one_in(3) ? Scalar{1} : random.unit<Scalar>()};
    };
    const auto any_of = [&](const auto& families) { return families[random.below(families.size())]; };
    const auto of_family = [&] {
      if (random.one_in(3)) {
        const auto [box, triangle] = draw_shape_pair<Scalar>(any_of(all_box_families), random);
        return of(Core::box, box, box.half_extents, 0, triangle);
      }
      if (random.one_in(2)) {
        const auto [capsule, triangle] = draw_shape_pair<Scalar>(any_of(all_capsule_families), random);
        return of(Core::segment, capsule, capsule.half_axis, capsule.radius, triangle);
      }
      const auto [ball, triangle] = draw_shape_pair<Scalar>(any_of(all_sphere_families), random);
      return of(Core::point, ball, {0, 0, 0}, ball.radius, triangle);
    };
    Numbers pair = of_family();
    if (random.one_in(3)) {
      // Errors are largest where all coordinates have one size.
      for (Vector3<Scalar>& point : pair.points) {
        for (Scalar& x : point) x = random.symmetric<Scalar>();
      }
      pair.radius = random.unit<Scalar>();
    }
    if (pair.core == Core::box) pair.points[2] = pair.points[2].cwiseAbs();
    return pair;
  }

  /// Changes one number, or moves a point near to another one.
  static Numbers changed(Random& random, Numbers pair) {
    Vector3<Scalar>& point = pair.points[random.below(6)];
    const auto axis = static_cast<Eigen::Index>(random.below(3));
    switch (random.below(8)) {
      case 0: {
        const Vector3<Scalar>& other = pair.points[random.below(6)];
        point = other + (point - other) * std::ldexp(Scalar{1}, static_cast<int>(random.between(-12, 6)));
        break;
      }
      case 1:
        pair.limit = random.unit<Scalar>();
        break;
      default:
        point[axis] = changed_coordinate(random, point[axis]);
    }
    if (pair.core == Core::box) pair.points[2] = pair.points[2].cwiseAbs();
    return pair;
  }

  /// Draws a ball and a triangle whose coordinates are whole numbers, so that heights have no roundings.
  static Numbers draw_whole(Random& random) {
    Numbers pair = {Core::point, random.one_in(2), {}, 0, 1};
    for (Vector3<Scalar>& point : pair.points) {
      for (Scalar& x : point) x = static_cast<Scalar>(random.between(-largest_whole, largest_whole));
    }
    return pair;
  }
  static Numbers changed_whole(Random& random, Numbers pair) {
    Scalar& x = pair.points[random.below(6)][static_cast<Eigen::Index>(random.below(3))];
    const auto step = static_cast<Scalar>(random.between(-3, 3));
    x = random.one_in(2) ? std::clamp(x + step, Scalar{-largest_whole}, Scalar{largest_whole})
                         : static_cast<Scalar>(random.between(-largest_whole, largest_whole));
    return pair;
  }
  static constexpr int largest_whole = std::is_same_v<Scalar, float> ? 60 : 40000;

  /// Draws a ball and a triangle that are hardly larger than the smallest ones.
  static Numbers draw_smallest(Random& random) {
    Numbers pair = {Core::point, random.one_in(2), {}, 0, 1};
    const double smallest = std::is_same_v<Scalar, float> ? detail::smallest_float : detail::smallest_double;
    for (Vector3<Scalar>& point : pair.points) {
      for (Scalar& x : point) x = 2 * static_cast<Scalar>(smallest) * random.symmetric<Scalar>();
    }
    return pair;
  }
  static Numbers changed_smallest(Random& random, Numbers pair) {
    Scalar& x = pair.points[random.below(6)][static_cast<Eigen::Index>(random.below(3))];
    x = random.one_in(2) ? x * (1 + random.symmetric<Scalar>() / 16)
                         : draw_smallest(random).points[random.below(6)][static_cast<Eigen::Index>(random.below(3))];
    return pair;
  }

  /// Climbs to the worst share. `share_of(pair)` may change the pair.
  template <typename ShareOf>
  static double worst(std::uint64_t seed, std::size_t steps, const ShareOf& share_of,
                      Numbers (*draw_pair)(Random&) = draw, Numbers (*change)(Random&, Numbers) = changed) {
    Random random(seed);
    return climb_to_worst(
        10, steps, [&] { return draw_pair(random); }, [&](const Numbers& pair) { return change(random, pair); },
        [&](Numbers pair) { return share_of(pair); });
  }

  /// What the first axes fall short of.
  struct FirstShares {
    double across;  ///< f, g or f - g, whichever is best (V2).
    double normal;  ///< n (V3).
    double way;     ///< A way to the core, whichever is better (V7). It is not rounded as that in the lanes is.
  };
  static FirstShares first_shares(const Exact<Scalar>& pair) {
    const auto share_of = [](const Float& gap, const Float& margin) {
      return margin <= 0 ? 1e9 : Float(1 - gap / margin).get_d();
    };
    FirstShares shares = {1e9, 1e9, 1e9};
    const auto axes = pair.axes_across();
    const auto heights = pair.heights_across();
    for (std::size_t i = 0; i < 3; ++i) {
      const Float gap = heights[i] - pair.reach_of_core(axes[i]) - pair.r * length_of(axes[i]);
      const Float margin = 256 * pair.u * pair.of_step * pair.of_edges * pair.far;
      shares.across = std::min(shares.across, share_of(gap, margin));
    }
    const Float unit = 256 * pair.u * pair.of_edges * pair.of_edges;
    const Float toward = pair.rate_toward();
    const Float comes = std::max(Float(pair.limit * toward), exact(0));
    const Float may_come = std::max(Float(pair.limit * (toward + unit * pair.of_step)), exact(0));
    const Float gap = abs(oracle::dot(pair.n, pair.w)) - pair.reach_of_core(pair.n) - pair.r * length_of(pair.n);
    shares.normal = share_of(gap - comes, unit * pair.far + may_come - comes);
    for (const Point& m : pair.ways_to_core()) {
      const Float highest = std::max({exact(0), oracle::dot(m, pair.p), oracle::dot(m, pair.q)});
      const Float back = std::max(Float(-pair.limit * oracle::dot(m, pair.step)), exact(0));
      const Float above = oracle::dot(m, pair.w) - highest - back - pair.reach_of_core(m) - pair.r * length_of(m);
      const Float margin = 64 * pair.u * (pair.far + largest_of(m)) * (pair.far + pair.of_step);
      shares.way = std::min(shares.way, share_of(above, margin));
    }
    return shares;
  }
  /// Returns whether a way to the core may have left out the shape.
  static bool may_be_apart_by_way(const Exact<Scalar>& pair) { return first_shares(pair).way <= 2; }
  /// Returns the gaps along the axes of coordinates and along n. Each has an interval of t.
  static std::vector<Gap> gaps_without_edges(const Exact<Scalar>& pair) {
    std::vector<Gap> gaps;
    const Float margin = 16 * pair.u * (pair.far + pair.of_step);
    for (std::size_t i = 0; i < 3; ++i) {
      const Float low = std::min({exact(0), pair.p[i], pair.q[i]});
      const Float high = std::max({exact(0), pair.p[i], pair.q[i]});
      const Float reach = pair.r + abs(pair.half[i]);
      gaps.push_back({pair.w[i] - high - reach, pair.step[i], margin});
      gaps.push_back({low - pair.w[i] - reach, -pair.step[i], margin});
    }
    const Float along = oracle::dot(pair.n, pair.w);
    const Float rate = oracle::dot(pair.n, pair.step);
    const Float reach = pair.reach_of_core(pair.n) + pair.r * length_of(pair.n);
    const Float of_normal = 256 * pair.u * pair.of_edges * pair.of_edges * (pair.far + pair.of_step);
    if (of_normal > 0) {
      gaps.push_back({along - reach, rate, of_normal});
      gaps.push_back({-along - reach, -rate, of_normal});
    }
    return gaps;
  }
  /// What the ball reaches beside the plane, times |n|. `error` is that of a height, and `of_square` that of n·n (V6).
  static Float reach_beside(const Exact<Scalar>& pair, double error, double of_square) {
    const Float size_2 = pair.of_edges * pair.of_edges;
    const Float height = abs(oracle::dot(pair.n, pair.w)) - pair.reach_of_core(pair.n) -
                         error * pair.u * size_2 * (pair.far + pair.of_step);
    const Float above = std::max(height, exact(0));
    const Float square = pair.r * pair.r * (oracle::dot(pair.n, pair.n) + of_square * pair.u * size_2 * size_2);
    return sqrt(std::max(Float(square - above * above), exact(0)));
  }
  /// Adds the gaps along e × n. Where the radius is not 0, the height along n must not change.
  static void add_gaps_of_edges(const Exact<Scalar>& pair, std::vector<Gap>& gaps) {
    const Point of_p = oracle::cross(pair.p, pair.n);
    const Point of_q = oracle::cross(pair.q, pair.n);
    const Float bound = 1024 * pair.u * pair.of_edges * pair.of_edges * pair.of_edges * (pair.far + pair.of_step);
    if (bound <= 0) return;
    const Float least = reach_beside(pair, 0, 0);
    const Float most = reach_beside(pair, 256, 256);
    const auto add = [&](const Point& edge, const Point& outward, const Point& from) {
      const Float length = length_of(edge);
      const Float reach = pair.reach_of_core(outward) + length * least;
      gaps.push_back(
          {oracle::dot(outward, from) - reach, oracle::dot(outward, pair.step), bound + length * Float(most - least)});
    };
    add(pair.p, of_p, pair.w);
    add(pair.q, negated(of_q), pair.w);
    add(pair.q - pair.p, of_q - of_p, pair.w - pair.p);
  }

  /// What intervals of t fall short of.
  struct IntervalShares {
    double edges;   ///< With e × n (V4, V6).
    double others;  ///< Without.
  };
  /// Returns the shares until t.
  static IntervalShares interval_shares(const Exact<Scalar>& pair, const Float& until) {
    std::vector<Gap> gaps = gaps_without_edges(pair);
    const double others = Float(1 - growth_to_meet(gaps, until)).get_d();
    add_gaps_of_edges(pair, gaps);
    return {Float(1 - growth_to_meet(gaps, until)).get_d(), others};
  }
  static bool keeps_height(const Exact<Scalar>& pair) { return pair.r == 0 || oracle::dot(pair.n, pair.step) == 0; }

  /// Returns the first share if nothing but these axes can have left out the shape. If all bounds are exceeded, that
  /// counts.
  static double share_alone(double share, double others) {
    if (share >= 1 && others >= 1) return std::min(share, others);
    return others > 2 ? share : 0;
  }
};
TYPED_TEST_SUITE(ShapeFilterError, Scalars, ScalarNames);

// A small ball is just left out. So its height is that of the bound, but for the error of the height.
TYPED_TEST(ShapeFilterError, of_heights_stays_within_its_bound) {
  const auto grow_small = [](Pair<TypeParam>& pair) {
    pair.core = Core::point;
    return TestFixture::grow(pair, TestFixture::is_apart_at_once);
  };
  const auto error_of = [](const Exact<TypeParam>& pair, const Point& axis, const Float& height, const Float& sizes) {
    const Float of_ball = pair.r * (1 + 8 * pair.u) * length_of(axis);
    return Float(abs(height - of_ball - 256 * pair.u * sizes * pair.far));
  };
  const auto share_of_normal = [&](Pair<TypeParam>& pair) {
    pair.is_still = true;
    if (!grow_small(pair)) return 0.0;
    const Exact<TypeParam> exact(pair);
    if (exact.r * 16 > exact.of_start || TestFixture::may_be_apart_by_way(exact)) return 0.0;
    const Float size_2 = exact.of_edges * exact.of_edges;
    const Float error = error_of(exact, exact.n, Float(abs(oracle::dot(exact.n, exact.w))), size_2);
    return Float(error / (54 * exact.u * size_2 * exact.of_start)).get_d();
  };
  const auto share_across = [&](Pair<TypeParam>& pair) {
    pair.is_still = false;
    pair.limit = std::ldexp(TypeParam{1}, 100);  // So n leaves out nothing that comes nearer.
    if (!grow_small(pair)) return 0.0;
    const Exact<TypeParam> exact(pair);
    if (exact.r * 16 > exact.of_start || exact.rate_toward() <= 0) return 0.0;
    if (TestFixture::may_be_apart_by_way(exact)) return 0.0;
    const auto axes = exact.axes_across();
    const auto heights = exact.heights_across();
    const Float sizes = exact.of_step * exact.of_edges;
    double share = 1e9;
    for (std::size_t i = 0; i < 3; ++i) {
      const Float of_height = (i < 2 ? 54 : 120) * exact.u * sizes * exact.of_start;
      const Float bound = of_height + 54 * exact.u * sizes * exact.of_edges;
      share = std::min(share, Float(error_of(exact, axes[i], heights[i], sizes) / bound).get_d());
    }
    return share;
  };
  expect_within_bound("V1_along_the_normal", this->worst(113, 1000, share_of_normal));
  expect_within_bound("V1_across_the_step", this->worst(127, 1000, share_across));
}

// What the square of the radius is larger by is all that covers the roundings of squares.
TYPED_TEST(ShapeFilterError, of_squares_stays_within_its_bound) {
  const auto share_of = [](Pair<TypeParam>& pair) {
    pair.limit = std::ldexp(TypeParam{1}, 100);  // So n leaves out nothing that comes nearer.
    if (!TestFixture::grow(pair, TestFixture::is_apart_at_once)) return 0.0;
    const Exact<TypeParam> exact(pair);
    if (TestFixture::may_be_apart_by_way(exact)) return 0.0;
    const auto axes = exact.axes_across();
    const auto heights = exact.heights_across();
    double share = 1e9;
    const auto take = [&](const Point& axis, const Float& height, const Float& sizes) {
      const Float gap = height - 256 * exact.u * sizes * exact.far;
      if (gap < height / 2) return;  // The bound of the height has roundings, too.
      const Float ratio = exact.r * exact.r * oracle::dot(axis, axis) / (gap * gap);
      share = std::min(share, Float(1 - (1 - ratio) / (16 * exact.u)).get_d());
    };
    const Float of_edges = exact.of_edges * exact.of_edges;
    if (pair.is_still) {
      take(exact.n, Float(abs(oracle::dot(exact.n, exact.w))), of_edges);
    } else {
      if (exact.rate_toward() <= 0) return 0.0;
      for (std::size_t i = 0; i < 3; ++i) take(axes[i], heights[i], Float(exact.of_step * exact.of_edges));
    }
    return share < 1e9 ? share : 0;
  };
  expect_within_bound("V5", this->worst(157, 1500, share_of, TestFixture::draw_whole, TestFixture::changed_whole));
}

// Squares may underflow here.
TYPED_TEST(ShapeFilterError, of_the_smallest_sizes_stays_within_its_bound) {
  const auto share_of = [](Pair<TypeParam>& pair) {
    if (!TestFixture::grow(pair, TestFixture::is_apart_at_once)) return 0.0;
    const auto shares = TestFixture::first_shares(Exact<TypeParam>(pair));
    return std::min({shares.across, shares.normal, shares.way});
  };
  const double worst = this->worst(163, 1500, share_of, TestFixture::draw_smallest, TestFixture::changed_smallest);
  expect_within_bound("V5_of_the_smallest_sizes", worst);
}

TYPED_TEST(ShapeFilterError, across_the_step_stays_within_its_bound) {
  const auto share_of = [](Pair<TypeParam>& pair) {
    pair.limit = std::ldexp(TypeParam{1}, 100);  // So n leaves out nothing that comes nearer.
    if (!TestFixture::grow(pair, TestFixture::is_apart_at_once)) return 0.0;
    const auto shares = TestFixture::first_shares(Exact<TypeParam>(pair));
    return TestFixture::share_alone(shares.across, std::min(shares.normal, shares.way));
  };
  expect_within_bound("V2", this->worst(131, 2000, share_of));
}

TYPED_TEST(ShapeFilterError, along_the_normal_stays_within_its_bound) {
  const auto share_of = [](Pair<TypeParam>& pair) {
    if (!TestFixture::grow(pair, TestFixture::is_apart_at_once)) return 0.0;
    const auto shares = TestFixture::first_shares(Exact<TypeParam>(pair));
    return TestFixture::share_alone(shares.normal, std::min(shares.across, shares.way));
  };
  expect_within_bound("V3", this->worst(137, 2000, share_of));
}

TYPED_TEST(ShapeFilterError, along_a_way_to_the_core_stays_within_its_bound) {
  const auto share_of = [](Pair<TypeParam>& pair) {
    if (!TestFixture::grow(pair, TestFixture::is_apart_at_once)) return 0.0;
    const auto shares = TestFixture::first_shares(Exact<TypeParam>(pair));
    return TestFixture::share_alone(shares.way, std::min(shares.across, shares.normal));
  };
  expect_within_bound("V7", this->worst(167, 2000, share_of));
}

// The shape is so large that it is just left out. The edges leave it out where it is level with the triangle, or has no
// radius.
TYPED_TEST(ShapeFilterError, beside_an_edge_stays_within_its_bound) {
  const auto share_of = [](Pair<TypeParam>& pair) {
    double enters = 0;
    const auto is_apart = [&](const auto& any) { return TestFixture::is_apart_at_all_times(any, enters); };
    if (!TestFixture::grow(pair, is_apart)) return 0.0;
    const Exact<TypeParam> exact(pair);
    if (!TestFixture::keeps_height(exact)) return 0.0;
    if (TestFixture::reach_beside(exact, 256, 0) < exact.r * length_of(exact.n)) return 0.0;
    const auto shares = TestFixture::interval_shares(exact, exact.limit);
    return TestFixture::share_alone(shares.edges, shares.others);
  };
  expect_within_bound("V4", this->worst(139, 1000, share_of));
}

TYPED_TEST(ShapeFilterError, of_the_time_beside_an_edge_stays_within_its_bound) {
  const auto share_of = [](Pair<TypeParam>& pair) {
    if (pair.core != Core::box) pair.radius = 0;
    double enters = 0;
    if (!TestFixture::is_usable(pair) || TestFixture::is_apart_at_all_times(pair, enters) || enters == 0) return 0.0;
    const auto shares = TestFixture::interval_shares(Exact<TypeParam>(pair), exact(enters));
    return TestFixture::share_alone(shares.edges, shares.others);
  };
  expect_within_bound("V4_time", this->worst(149, 2000, share_of));
}

TYPED_TEST(ShapeFilterError, above_a_plane_and_beside_an_edge_stays_within_its_bound) {
  const auto share_of = [](Pair<TypeParam>& pair) {
    double enters = 0;
    const auto is_apart = [&](const auto& any) { return TestFixture::is_apart_at_all_times(any, enters); };
    if (pair.core == Core::box || !TestFixture::grow(pair, is_apart)) return 0.0;
    const Exact<TypeParam> exact(pair);
    if (!TestFixture::keeps_height(exact)) return 0.0;
    if (TestFixture::reach_beside(exact, 256, 0) >= exact.r * length_of(exact.n)) return 0.0;
    const auto shares = TestFixture::interval_shares(exact, exact.limit);
    return TestFixture::share_alone(shares.edges, shares.others);
  };
  expect_within_bound("V6", this->worst(151, 1500, share_of));
}

}  // namespace
}  // namespace surehit::test::shape_filter_error_test
