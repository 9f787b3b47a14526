#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "collision/filter/on_every_instruction_set.hpp"
#include "exact_path.hpp"
#include "support/case_count.hpp"
#include "support/neighbour.hpp"
#include "support/pair_text.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "tree_walk_on_targets.hpp"

namespace surehit::test::tree_walk_test {
namespace {

using detail::InstanceBox;
using detail::InstanceTree;
using detail::PathRange;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Some boxes, and a path that touches one of them.
template <typename Scalar>
struct Case {
  std::vector<InstanceBox> boxes = {};
  Path<Scalar> path = Line<Scalar>{Vector3<Scalar>::Zero(), Vector3<Scalar>::Zero()};
  PathRange<Scalar> range = {0, 1};

  /// What is true of the path and a box.
  enum class Truth : std::uint8_t { miss, touch, meet };
  [[nodiscard]] Truth truth_of(const InstanceBox& box) const {
    const auto met = exact_range_in(box, exact(path.start), exact_direction(path), range);
    if (!met) return Truth::miss;
    return met->first && met->last && *met->first == *met->last ? Truth::touch : Truth::meet;
  }
};

/// Draws boxes with corners on whole numbers or anywhere, near the origin or far away. Some have no bounds. The path
/// comes to a corner or to an edge of one of them, from near or far. On whole numbers, it touches it exactly, and its
/// range may begin or end there.
template <typename Scalar>
Case<Scalar> draw_case(Random& random) {
  Case<Scalar> drawn;
  const bool is_whole = random.one_in(2);
  const double unit = std::ldexp(1.0, static_cast<int>(random.between(-40, 40)));
  const auto any = [&](std::int64_t reach) {
    return is_whole ? static_cast<double>(random.between(-reach, reach))
                    : static_cast<double>(reach) * random.symmetric<double>();
  };
  const std::int64_t far = random.one_in(2) ? 0 : std::int64_t{1} << random.below(18);
  const std::array<double, 3> place = {any(far), any(far), any(far)};
  for (std::uint64_t i = 1 + random.below(40); i > 0; --i) {
    InstanceBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({place[axis] + any(8), place[axis] + any(8)});
      box.low[axis] = low * unit;
      box.high[axis] = high * unit;
    }
    drawn.boxes.push_back(box);
  }
  const InstanceBox aimed = drawn.boxes[random.below(drawn.boxes.size())];
  if (random.one_in(16)) drawn.boxes.push_back({{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}});
  if (random.one_in(16)) drawn.boxes.push_back({{-0x1p1010, 0, 0}, {0, 0x1p1010, 0x1p-1000}});

  Vector3<Scalar> target;
  Vector3<Scalar> way;
  const std::uint64_t edge = random.below(4);  // Or 3 for a corner.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double weight = axis == edge ? 0.5 : static_cast<double>(random.below(2));
    const auto k = static_cast<Eigen::Index>(axis);
    target[k] = static_cast<Scalar>(aimed.low[axis] * (1 - weight) + aimed.high[axis] * weight);
    way[k] = static_cast<Scalar>(random.one_in(4) ? 0 : unit * any(4));
  }
  const auto steps = static_cast<Scalar>(random.one_in(3) ? std::int64_t{1} << random.below(15) : random.between(0, 3));
  const Vector3<Scalar> start = target - steps * way;
  drawn.range = PathRange<Scalar>(PathKind::line, QueryOptions<Scalar>{});
  if (random.one_in(2)) {
    drawn.path = Segment<Scalar>{start, target + steps * way};
    drawn.range = {0, 1};
    if (random.one_in(3)) (random.one_in(2) ? drawn.range.first : drawn.range.last) = Scalar{0.5F};
  } else {
    drawn.path = Line<Scalar>{start, way};
    if (random.one_in(2)) drawn.range.first = 0;
    if (random.one_in(3)) (random.one_in(2) ? drawn.range.first : drawn.range.last) = steps;
  }
  return drawn;
}

template <typename Scalar>
class TreeWalk : public testing::Test {
 protected:
  /// The tree is that of two boxes at the corners of a cube. Its width is about 1 in its own frame.
  static InstanceTree cube(double low, double width) {
    const auto at = [](double x) { return InstanceBox{{x, x, x}, {x, x, x}}; };
    return tree_around({at(low), at(low + width)});
  }

  /// A path and a plane of the tree.
  struct Crossing {
    Vector3<Scalar> start, end;
    std::size_t axis;
    float plane;
  };

  /// Both times of a plane are moved outward by the slack. Returns the share of it that their errors take up: 0 if the
  /// exact path is as far from the plane at both, and 1 if it is on the plane at one of them.
  static double share_of_slack(const InstanceTree& tree, const Crossing& at) {
    const Path<Scalar> path = Segment<Scalar>{at.start, at.end};
    const PathRange<Scalar> range(path, QueryOptions<Scalar>{});
    const detail::ScenePath<Scalar> in_scene(path, range);
    const TreeCrossing crossing = tree_crossing(tree, in_scene, at.axis, at.plane);
    const mpq_class way = exact_direction(path)[at.axis];
    if (way == 0 || !std::isfinite(crossing.near) || !std::isfinite(crossing.far)) return 0;
    const auto place = [&](float tau) {
      const mpq_class t = mpq_class(crossing.moved_t) + mpq_class(double{tau}) / mpq_class(crossing.inverse_unit);
      const mpq_class x = exact(at.start)[at.axis] + t * way;
      return mpq_class((x - mpq_class(tree.origin()[at.axis])) * mpq_class(tree.scale()));
    };
    const int sign = crossing.falls ? -1 : 1;
    const mpq_class before = sign * (double{at.plane} - place(crossing.near));
    const mpq_class behind = sign * (place(crossing.far) - double{at.plane});
    EXPECT_GT(before + behind, 0) << hex_text(path);
    return mpq_class(abs(before - behind) / (before + behind)).get_d();
  }

  static Crossing draw(Random& random, double low, double width) {
    Crossing at;
    const double reach = random.one_in(3) ? std::exp2(random.between(0, 14)) : 8;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      at.start[axis] = static_cast<Scalar>(low + width * reach * random.symmetric<double>());
      at.end[axis] = static_cast<Scalar>(low + width * (random.one_in(2) ? 1 : reach) * random.symmetric<double>());
    }
    at.axis = random.below(3);
    at.plane = random.unit<float>();
    return at;
  }

  static Crossing changed(Crossing at, Random& random) {
    Vector3<Scalar>& point = random.one_in(2) ? at.start : at.end;
    Scalar& x = point[static_cast<Eigen::Index>(random.below(3))];
    switch (random.below(3)) {
      case 0:
        x = neighbour(x, random.one_in(2) ? 1 : -1);
        break;
      case 1:
        x += x * std::ldexp(random.symmetric<Scalar>(), -static_cast<int>(random.between(0, 24)));
        break;
      default:
        at.plane =
            std::min(1.0F, at.plane + std::ldexp(random.unit<float>(), -static_cast<int>(random.between(0, 24))));
    }
    return at;
  }
};
TYPED_TEST_SUITE(TreeWalk, Scalars, ScalarNames);

/// I9: no test calls a box a miss that the path meets in its range.
TYPED_TEST(TreeWalk, comes_to_every_box_that_the_path_meets) {
  using Truth = typename Case<TypeParam>::Truth;
  on_every_instruction_set([] {
    Random random(20261127);
    std::size_t touched = 0;
    std::size_t in_vain = 0;
    std::size_t boxes = 0;
    const std::size_t cases = case_count(4000);
    for (std::size_t i = 0; i < cases; ++i) {
      const Case<TypeParam> drawn = draw_case<TypeParam>(random);
      const InstanceTree tree = tree_around(drawn.boxes);
      const detail::ScenePath<TypeParam> path(drawn.path, drawn.range);
      std::vector<std::uint32_t> found = instances_on_way(tree, path, random.one_in(2));
      std::sort(found.begin(), found.end());
      EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
      for (std::uint32_t box = 0; box < drawn.boxes.size(); ++box) {
        const Truth truth = drawn.truth_of(drawn.boxes[box]);
        const bool is_found = std::binary_search(found.begin(), found.end(), box);
        EXPECT_TRUE(truth == Truth::miss || is_found) << hex_text(drawn.path) << ", box " << box;
        touched += truth == Truth::touch ? 1 : 0;
        in_vain += truth == Truth::miss && is_found ? 1 : 0;
      }
      boxes += drawn.boxes.size();
    }
    EXPECT_GE(touched, cases / 4);
    EXPECT_LE(in_vain, boxes / 5);  // A walk to all boxes would miss none.
  });
}

TYPED_TEST(TreeWalk, begins_before_the_range_and_ends_after_it) {
  on_every_instruction_set([] {
    Random random(5);
    for (std::size_t i = case_count(2000); i > 0; --i) {
      Case<TypeParam> drawn = draw_case<TypeParam>(random);
      const InstanceTree tree = tree_around(drawn.boxes);
      const auto end = [&] {
        return std::ldexp(random.symmetric<TypeParam>(), static_cast<int>(random.between(-40, 40)));
      };
      const auto [first, last] = std::minmax({end(), end()});
      drawn.range = {first, last};
      const TreeCrossing crossing = tree_crossing(tree, detail::ScenePath<TypeParam>(drawn.path, drawn.range), 0, 0.5F);
      const auto tau = [&](TypeParam t) {
        return mpq_class((mpq_class(double{t}) - mpq_class(crossing.moved_t)) * mpq_class(crossing.inverse_unit));
      };
      EXPECT_TRUE(crossing.first == -infinity || mpq_class(double{crossing.first}) <= tau(first));
      EXPECT_TRUE(crossing.last == infinity || mpq_class(double{crossing.last}) >= tau(last));
      EXPECT_LT(crossing.first, crossing.last);
    }
  });
}

TYPED_TEST(TreeWalk, stays_within_its_slack_where_hill_climbing_makes_it_worst) {
  double worst = 0;
  on_every_instruction_set([&] {
    Random random(7);
    for (std::size_t start = case_count(60); start > 0; --start) {
      const double width = std::ldexp(1 + random.unit<double>(), static_cast<int>(random.between(-20, 20)));
      const double low = random.one_in(2) ? 0 : width * 100 * random.symmetric<double>();
      const InstanceTree tree = this->cube(low, width);
      auto at = this->draw(random, low, width);
      double share = this->share_of_slack(tree, at);
      for (int step = 0; step < 60; ++step) {
        const auto next = step < 20 ? this->draw(random, low, width) : this->changed(at, random);
        const double next_share = this->share_of_slack(tree, next);
        if (next_share < share) continue;
        share = next_share;
        at = next;
      }
      worst = std::max(worst, share);
    }
  });
  EXPECT_LT(worst, 1);
  this->RecordProperty("worst_share", std::to_string(worst));
}

}  // namespace
}  // namespace surehit::test::tree_walk_test
