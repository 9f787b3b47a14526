// Walks a path through the tree of a scene's instances. Highway compiles this file for each instruction set.

#if defined(SUREHIT_TREE_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_TREE_WALK_INL
#undef SUREHIT_TREE_WALK_INL
#else
#define SUREHIT_TREE_WALK_INL
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "scene/instance_tree.hpp"
#include "scene/placed_path.hpp"
#include "support/lane_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A path in the frame of a tree, in float. Its start is moved near the middle of the tree. The parameter tau counts
/// from there: t = moved_t + tau unit.
///
/// I9. Let the path meet a box at some t of its range. Then no test of this path calls the box a miss.
/// Proof. See POSES.md.
struct TreePath {
  template <typename Scalar>
  TreePath(const InstanceTree& tree, const ScenePath<Scalar>& path);

  /// Returns tau at t, rounded up.
  [[nodiscard]] float beyond(double t) const { return tau_at(t, 1); }
  /// Returns tau at t, rounded down.
  [[nodiscard]] float before(double t) const { return tau_at(t, -1); }

  std::array<float, 3> start_of_low = {};   ///< The start plus the slack, which moves low planes outward.
  std::array<float, 3> start_of_high = {};  ///< The start less the slack, which moves high planes outward.
  std::array<float, 3> inverse = {};        ///< The inverse of the direction.
  std::array<bool, 3> falls = {};           ///< True if the path meets high planes first.
  float first = 0;                          ///< The tau at which the range begins.
  float last = 0;                           ///< The tau at which it ends.
  double moved_t = 0;                       ///< The t of tau 0.
  double inverse_unit = 1;                  ///< The tau of a unit of t.

 private:
  /// Returns tau at t, rounded toward the infinity of this sign.
  [[nodiscard]] float tau_at(double t, double sign) const {
    const double tau = (t - moved_t) * inverse_unit;
    const double rounding = (std::fabs(t) + std::fabs(moved_t)) * inverse_unit * 0x1p-50 + std::fabs(tau) * 0x1p-22;
    const double rounded = tau + sign * (rounding + 0x1p-120);
    return static_cast<float>(std::isnan(rounded) ? sign * std::numeric_limits<double>::infinity() : rounded);
  }
};

template <typename Scalar>
inline TreePath::TreePath(const InstanceTree& tree, const ScenePath<Scalar>& path) {
  double along = 0;
  double length = 0;
  Doubles from;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    from[axis] = (path.start[axis] - tree.origin()[axis]) * tree.scale();
    const double way = path.direction[axis][0] * tree.scale();
    along += (0.5 - from[axis]) * way;
    length += way * way;
  }
  double t = length > 0 ? along / length : 0;
  t = std::min(std::max(t, double{path.range.first}), double{path.range.last});
  if (!std::isfinite(t)) t = 0;
  double largest = 0;
  double error = 0;
  Doubles start;
  Doubles way;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    way[axis] = path.direction[axis][0] * tree.scale();
    const double step = t * way[axis];
    start[axis] = from[axis] + step;
    largest = std::max(largest, std::fabs(way[axis]));
    error = std::max(error, (std::fabs(path.start[axis]) + std::fabs(tree.origin()[axis])) * tree.scale() +
                                std::fabs(step) + std::fabs(start[axis]));
  }
  moved_t = t;
  const double power = inverse_power(largest);
  inverse_unit = 1 / power;
  double size = 0;
  for (const double x : start) size = std::max(size, std::fabs(x));
  const double slack = error * 0x1p-49 + (size + 2) * 0x1p-19;
  const bool is_known = slack < 0x1p60 && largest <= 0x1p900 && (largest == 0 || largest >= 0x1p-900);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto rate = static_cast<float>(way[axis] * power);
    falls[axis] = rate < 0;
    const bool is_still = std::fabs(rate) < 0x1p-60F;
    inverse[axis] = is_still ? 0x1p90F : 1 / rate;
    if (is_still) falls[axis] = false;
    start_of_low[axis] = is_known ? static_cast<float>(start[axis] + slack) : std::numeric_limits<float>::infinity();
    start_of_high[axis] = is_known ? static_cast<float>(start[axis] - slack) : -std::numeric_limits<float>::infinity();
    if (!is_known) {
      inverse[axis] = 1;
      falls[axis] = false;
    }
  }
  last = is_known ? beyond(path.range.last) : std::numeric_limits<float>::infinity();
  first = is_known ? before(path.range.first) : -std::numeric_limits<float>::infinity();
}

/// Calls `visit(index)` for each instance whose box the path may meet, roughly in the order of the path, until `keep`
/// is done. Instances that lie beyond `keep.limit()` are left out. Calls `prefetch(index)` some time before.
template <typename Scalar, typename Keep, typename Fetch, typename Visit>
HWY_INLINE void walk_tree(const InstanceTree& tree, const ScenePath<Scalar>& scene_path, const Keep& keep,
                          const Fetch& prefetch, const Visit& visit) {
  using Node = InstanceTree::Node;
  const hn::CappedTag<float, InstanceTree::width> d;
  const std::size_t lanes = hn::Lanes(d);
  const TreePath path(tree, scene_path);
  struct Open {
    std::uint32_t child;
    float enters;
  };
  // A node leaves at most seven children for later.
  std::array<Open, (InstanceTree::width - 1) * InstanceTree::max_depth + 1> open;
  std::size_t count = 0;
  open[count++] = {0, path.first};
  float last = path.last;
  while (count > 0) {
    const Open next = open[--count];
    if (next.enters > last) continue;
    if ((next.child & InstanceTree::instance_bit) != 0) {
      visit(next.child & ~InstanceTree::instance_bit);
      if (keep.is_done()) return;
      if constexpr (Keep::shortens) last = std::min(last, path.beyond(keep.limit()));
      continue;
    }
    const Node& node = tree.nodes()[next.child];
    const std::size_t before = count;
    for (std::size_t from = 0; from < InstanceTree::width; from += lanes) {
      auto enters = hn::Set(d, path.first);
      auto leaves = hn::Set(d, last);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto low = hn::Load(d, &node.low[axis][from]);
        const auto high = hn::Load(d, &node.high[axis][from]);
        const auto inverse = hn::Set(d, path.inverse[axis]);
        const auto to_low = hn::Mul(hn::Sub(low, hn::Set(d, path.start_of_low[axis])), inverse);
        const auto to_high = hn::Mul(hn::Sub(high, hn::Set(d, path.start_of_high[axis])), inverse);
        enters = hn::Max(enters, path.falls[axis] ? to_high : to_low);
        leaves = hn::Min(leaves, path.falls[axis] ? to_low : to_high);
      }
      alignas(sizeof(float) * InstanceTree::width) std::array<float, InstanceTree::width> at;
      hn::Store(enters, d, at.data());
      std::uint64_t met = bits_of(d, hn::Le(enters, leaves));
      for (; met != 0; met &= met - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(met));
        const std::uint32_t child = node.child[from + lane];
        if (child == InstanceTree::no_child) continue;
        if ((child & InstanceTree::instance_bit) != 0) {
          prefetch(child & ~InstanceTree::instance_bit);
        } else {
          const Node* const below = &tree.nodes()[child];
          hwy::Prefetch(below->low.data());
          hwy::Prefetch(below->low.data() + 2);
          hwy::Prefetch(below->high.data() + 1);
          hwy::Prefetch(below->child.data());
        }
        // The nearest child comes last, and is taken first.
        std::size_t place = count++;
        if constexpr (Keep::shortens) {
          for (; place > before && open[place - 1].enters < at[lane]; --place) open[place] = open[place - 1];
        }
        open[place] = {child, at[lane]};
      }
    }
  }
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
