// How close the errors of the walk of a moving shape through the tree of instances come to their bound (I14 in
// POSES.md). Shapes of floats are among those of doubles.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "exact_matrix.hpp"
#include "placement.hpp"
#include "scene/instance_frame.hpp"
#include "scene/instance_tree.hpp"
#include "scene/swept_tree_walk.hpp"
#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/shape_filter.hpp"
#include "shape/sphere_contact.hpp"
#include "support/hill_climb.hpp"
#include "support/moving_gap.hpp"
#include "support/neighbour.hpp"
#include "support/random.hpp"
#include "surehit/box.hpp"

namespace surehit::test::swept_tree_walk_error_test {
namespace {

using detail::Core;
using detail::InstanceBox;
using detail::InstanceFrame;
using detail::InstanceTree;

using Gap = MovingGap<mpq_class>;
using Vector = Vector3<double>;

/// A moving shape of any kind, and the boxes of some instances.
struct Case {
  Core core;
  Vector start, end;
  Vector half;  ///< The half extents or the half axis.
  double radius;
  std::vector<InstanceBox> boxes;
  std::size_t sought;  ///< One of the boxes.
  std::size_t axis;    ///< One of the three.

  [[nodiscard]] SweptExtents extents() const {
    if (core == Core::point) return detail::swept_extents(SweptSphere<double>{start, end, radius});
    if (core == Core::box) return detail::swept_extents(SweptBox<double>{start, end, half});
    return detail::swept_extents(SweptCapsule<double>{start, end, half, radius});
  }
  /// Returns how far the exact shape reaches from its centre on an axis.
  [[nodiscard]] mpq_class reach(std::size_t i) const {
    mpq_class reach(core == Core::box ? 0 : radius);
    if (core != Core::point) reach += mpq_class(half[static_cast<Eigen::Index>(i)]);
    return reach;
  }
  /// Returns the number that makes the shape larger or smaller.
  [[nodiscard]] double& size() { return core == Core::box ? half[static_cast<Eigen::Index>(axis)] : radius; }

  [[nodiscard]] InstanceTree tree() const {
    std::vector<std::uint32_t> all(boxes.size());
    std::iota(all.begin(), all.end(), 0U);
    InstanceTree tree;
    tree.build(all, boxes);
    return tree;
  }
};

/// Looks for one instance.
class InstanceSeeker {
 public:
  InstanceSeeker(std::size_t sought, double limit) : sought_(sought), limit_(limit) {}

  void visit(std::uint32_t index) { is_found_ |= index == sought_; }
  [[nodiscard]] bool is_done() const { return is_found_; }
  [[nodiscard]] double limit() const { return limit_; }

 private:
  std::size_t sought_;
  double limit_;
  bool is_found_ = false;
};

bool comes_to_instance(const InstanceTree& tree, const Case& at, double limit) {
  const SweptExtents swept = at.extents();
  InstanceSeeker seeker(at.sought, limit);
  detail::SweptTreeWalk(tree, swept, seeker).walk();
  return seeker.is_done();
}

/// Returns the planes of an instance in the tree's frame.
std::array<double, 6> planes_of(const InstanceTree& tree, std::size_t instance) {
  for (const InstanceTree::Node& node : tree.nodes()) {
    for (std::size_t lane = 0; lane < InstanceTree::width; ++lane) {
      if (node.child[lane] != (instance | InstanceTree::instance_bit)) continue;
      std::array<double, 6> planes;
      for (std::size_t i = 0; i < planes.size(); ++i) planes[i] = double{node.planes[i][lane]};
      return planes;
    }
  }
  ADD_FAILURE() << "has no instance " << instance;
  return {};
}

/// Returns how many times 2^-46 of its sizes must be added to a box so that it comes to its instance until some t. It
/// is about 1 where the walk just comes there or just does not.
mpq_class growth_to_instance(const InstanceTree& tree, const Case& at, double limit) {
  const mpq_class scale(tree.scale());
  const ExactVector origin = exact(tree.origin());
  const ExactVector start = scale * (exact(at.start) - origin);
  const ExactVector way = scale * (exact(at.end) - exact(at.start));
  const std::array<double, 6> planes = planes_of(tree, at.sought);
  std::vector<Gap> gaps;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class low(planes[i]);
    const mpq_class high(planes[3 + i]);
    const mpq_class reach = scale * at.reach(i);
    const mpq_class ends = abs(exact(at.start)[i]) + abs(exact(at.end)[i]) + abs(origin[i]);
    const mpq_class sizes = scale * ends + reach + 1;
    const mpq_class share(0x1p-46);
    gaps.push_back({low - start[i] - reach, -way[i], share * (sizes + abs(low))});
    gaps.push_back({start[i] - high - reach, way[i], share * (sizes + abs(high))});
  }
  return growth_to_meet(gaps, mpq_class(limit));
}

/// Returns the last number up to `high` at which something is not reached yet. Nothing if it is reached at 0, or not at
/// `high`.
template <typename IsReached>
std::optional<double> last_before(double high, const IsReached& is_reached) {
  if (is_reached(0) || !is_reached(high)) return std::nullopt;
  std::uint64_t from = 0;
  auto to = std::bit_cast<std::uint64_t>(high);
  while (to - from > 1) {
    const std::uint64_t middle = from + (to - from) / 2;
    (is_reached(std::bit_cast<double>(middle)) ? to : from) = middle;
  }
  return std::bit_cast<double>(from);
}

class SweptTreeWalkError : public testing::Test {
 protected:
  Vector vector(double size) {
    const double x = size * random_.symmetric<double>();
    const double y = size * random_.symmetric<double>();
    return {x, y, size * random_.symmetric<double>()};
  }
  double power(int low, int high) { return std::ldexp(1.0, static_cast<int>(random_.between(low, high))); }
  /// Draws a number of at most this size, which may be far smaller.
  double number(double size, int smallest) {
    const double most = size * power(smallest, 0);
    return most * random_.symmetric<double>();
  }

  /// Draws the box of an instance during a step. Half of them move.
  InstanceBox draw_box(const Vector& place, double unit) {
    detail::Placement<double> placement;
    placement.pose.translation = place + vector(4 * unit);
    placement.moves = random_.one_in(2);
    if (placement.moves) placement.motion = vector(unit);
    const Vector half = vector(unit * power(-10, 0)).cwiseAbs();
    const InstanceFrame frame = InstanceFrame::of(placement, {-half, half});
    return {frame.low, frame.high};
  }

  /// Draws instances near the origin or far away, and a shape that comes near to one of them.
  Case draw(Core core) {
    Case drawn;
    drawn.core = core;
    drawn.axis = random_.below(3);
    const double unit = power(-30, 30);
    const Vector place = vector(random_.one_in(2) ? 0 : unit * power(0, 20));
    for (std::uint64_t i = 1 + random_.below(12); i > 0; --i) drawn.boxes.push_back(draw_box(place, unit));
    drawn.sought = random_.below(drawn.boxes.size());
    drawn.half = vector(unit * power(-12, 8)).cwiseAbs();
    drawn.radius = std::fabs(number(0x1p8 * unit, -20));
    const InstanceBox& box = drawn.boxes[drawn.sought];
    const double t = random_.one_in(6) ? 0 : 1 - std::fabs(number(1, -8));
    const bool is_along_axis = random_.one_in(2);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      drawn.start[k] = drawn.end[k] = (box.low[i] + box.high[i]) / 2;
      if (is_along_axis ? i != drawn.axis : random_.one_in(3)) continue;
      const double reach = drawn.extents().half_extents[i];
      const double centre = random_.one_in(2) ? box.low[i] - reach : box.high[i] + reach;
      const double way = random_.one_in(5) ? 0 : number(0x1p20 * unit, -30);
      drawn.start[k] = centre - t * way;
      drawn.end[k] = centre + (1 - t) * way;
    }
    return drawn;
  }

  /// Changes a number of a case.
  Case changed(Case at) {
    const auto i = static_cast<Eigen::Index>(random_.below(3));
    InstanceBox& box = at.boxes[random_.one_in(2) ? at.sought : random_.below(at.boxes.size())];
    double& low = box.low[static_cast<std::size_t>(i)];
    double& high = box.high[static_cast<std::size_t>(i)];
    const std::array<double*, 8> numbers = {&at.start[i], &at.start[i], &at.end[i], &at.end[i],
                                            &at.half[i],  &at.radius,   &low,       &high};
    double& x = *numbers[random_.below(numbers.size())];
    switch (random_.below(6)) {
      case 0:
        x *= 2 * random_.unit<double>();
        break;
      case 1:
        at.end[i] = at.start[i] + 2 * random_.unit<double>() * (at.end[i] - at.start[i]);
        break;
      case 2:
      case 3:
        x = neighbour(x, static_cast<int>(random_.between(-40, 40)));
        break;
      default:
        x *= 1 + number(1, -49);
    }
    at.half = at.half.cwiseAbs();
    at.radius = std::fabs(at.radius);
    if (low > high) std::swap(low, high);
    return at;
  }

  /// Climbs with each kind of shape.
  template <typename ShareOf>
  void climb(const std::string& name, std::size_t starts, std::size_t steps, const ShareOf& share_of) {
    for (const auto& [core, shape] : {std::pair(Core::point, "ball"), {Core::box, "box"}, {Core::segment, "capsule"}}) {
      const double worst = climb_to_worst(
          starts, steps, [&, core = core] { return draw(core); }, [&](const Case& at) { return changed(at); },
          share_of);
      expect_within_bound(name + "_of_a_" + shape, worst);
    }
  }

  Random random_{20261129};
};

/// The walk comes to an instance from some size of the shape on.
TEST_F(SweptTreeWalkError, of_sizes_stays_below_its_bound_where_hill_climbing_makes_it_worst) {
  climb("size", 10, 400, [](Case at) {
    const InstanceTree tree = at.tree();
    const auto comes_with = [&](double size) {
      at.size() = size;
      return comes_to_instance(tree, at, 1);
    };
    const auto size = last_before(0x1p100, comes_with);
    if (!size) return 0.0;
    at.size() = *size;
    return mpq_class(1 - growth_to_instance(tree, at, 1)).get_d();
  });
}

/// The time at which the shape enters the box of the instance is the first limit with which the walk comes there.
TEST_F(SweptTreeWalkError, of_times_stays_below_its_bound_where_hill_climbing_makes_it_worst) {
  climb("time", 10, 400, [](const Case& at) {
    const InstanceTree tree = at.tree();
    const auto before = last_before(1, [&](double t) { return comes_to_instance(tree, at, t); });
    return before ? mpq_class(1 - growth_to_instance(tree, at, neighbour(*before, 1))).get_d() : 0;
  });
}

}  // namespace
}  // namespace surehit::test::swept_tree_walk_error_test
