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
#include "support/double4.hpp"
#include "support/float4.hpp"
#include "support/lane_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A path in the frame of a tree, in float. A start that is far away is moved near the middle of the tree. The
/// parameter tau counts from there: t = moved_t + tau / inverse_unit.
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

  // The path crosses a plane at x at tau = x inverse + shift. The shifts include the slack, which moves planes outward.
  Float4 inverse;                          ///< The inverse of the direction.
  Float4 near_shift;                       ///< The shift of the planes that the path meets first.
  Float4 far_shift;                        ///< The shift of the planes that it meets last.
  std::array<std::size_t, 3> near_planes;  ///< The index of these planes in a node, for each axis.
  float first = 0;                         ///< The tau at which the range begins.
  float last = 0;                          ///< The tau at which it ends.
  double moved_t = 0;                      ///< The t of tau 0.
  double inverse_unit = 1;                 ///< The tau of a unit of t.

  /// Returns the index of the planes that the path meets last on an axis.
  [[nodiscard]] std::size_t far_planes(std::size_t axis) const { return near_planes[axis] < 3 ? axis + 3 : axis; }

 private:
  /// Returns tau at t, rounded toward the infinity of this sign.
  [[nodiscard]] float tau_at(double t, double sign) const {
    const double tau = (t - moved_t) * inverse_unit;
    const double rounding = (std::fabs(t) + std::fabs(moved_t)) * inverse_unit * 0x1p-50 + std::fabs(tau) * 0x1p-22;
    const double rounded = tau + sign * (rounding + 0x1p-120);
    return static_cast<float>(std::isnan(rounded) ? sign * std::numeric_limits<double>::infinity() : rounded);
  }
};

/// Returns the t in the range at which a path is near the middle of the tree.
template <typename Scalar>
HWY_NOINLINE double t_near_middle(const ScenePath<Scalar>& path, const Double4& from, const Double4& way) {
  const double along = sum_of_three((0.5 - from) * way);
  const double length = sum_of_three(way * way);
  double t = length > 0 ? along / length : 0;
  t = std::min(std::max(t, double{path.range.first}), double{path.range.last});
  return std::isfinite(t) ? t : 0;
}

template <typename Scalar>
HWY_INLINE TreePath::TreePath(const InstanceTree& tree, const ScenePath<Scalar>& path) {
  constexpr double max_distance = 8;  // In widths of the tree. A start up to there is not moved.
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Double4 start = (path.start - tree.origin()) * tree.scale();
  const Double4 way = path.direction * tree.scale();
  const double largest = path.size * tree.scale();
  double distance = max_lane(absolute(start));
  double error = (path.start_size + tree.origin_size()) * tree.scale() + distance;
  if (!(distance <= max_distance)) {
    moved_t = t_near_middle(path, start, way);
    const Double4 step = moved_t * way;
    start += step;
    distance = max_lane(absolute(start));
    error += max_lane(absolute(step)) + distance;
  }
  const double power = inverse_power(largest);
  inverse_unit = 1 / power;
  const double slack = error * 0x1p-49 + (distance + 2) * 0x1p-19;
  const Float4 rate = to_float(way * power);
  const Float4 at = to_float(start);
  const Int4 is_still = absolute(rate) < 0x1p-60F;
  inverse = choose(is_still, all_lanes(0x1p90F), 1 / rate);
  const Int4 falls = inverse < 0.0F;
  const Float4 outward = negated_where(all_lanes(static_cast<float>(slack)), falls);
  near_shift = -((at + outward) * inverse);
  far_shift = -((at - outward) * inverse);
  last = beyond(path.range.last);
  first = before(path.range.first);
  for (std::size_t axis = 0; axis < 3; ++axis) near_planes[axis] = falls[axis] != 0 ? axis + 3 : axis;
  // A larger slack could make a shift infinite, and infinite planes would have no time.
  if (slack < 0x1p16 && largest <= 0x1p900 && (largest == 0 || largest >= 0x1p-900)) [[likely]]
    return;
  // Nothing is known of it. It meets all boxes.
  inverse = all_lanes(1.0F);
  near_shift = all_lanes(-infinity);
  far_shift = all_lanes(infinity);
  near_planes = {0, 1, 2};
  last = infinity;
  first = -infinity;
}

/// The maximum number of children that a walk leaves for later. A node leaves at most seven of them.
inline constexpr std::size_t max_open_children = (InstanceTree::width - 1) * InstanceTree::max_depth + 1;
/// What a walk returns instead of an instance.
inline constexpr std::uint32_t no_instance = InstanceTree::no_child;

/// Walks a path through a tree. It goes from node to node, roughly in the order of the path. It has room for `capacity`
/// children that are left for later. A tree may need up to `max_open_children`.
template <std::size_t capacity>
class TreeWalk {
 public:
  template <typename Scalar>
  HWY_INLINE TreeWalk(const InstanceTree& tree, const ScenePath<Scalar>& path) : path_(tree, path), last_(path_.last) {
    open_[count_++] = entry(0, path_.first);
  }

  [[nodiscard]] bool at_end() const { return count_ == 0; }
  /// Returns true if there are more children than the walk can keep. Then the walk is of no use.
  [[nodiscard]] bool has_overflown() const { return has_overflown_; }
  /// Ends the walk at parameter t, because nothing beyond it counts.
  void shorten(double t) { last_ = std::min(last_, path_.beyond(t)); }

  /// Goes to the next node or instance. The walk must not be at its end. Returns the index of the instance, or
  /// `no_instance` for a node. If `sorts`, the nearest child of a node is the next one. Calls `prefetch(index)` for
  /// instances that are left for later.
  template <bool sorts, typename Fetch>
  HWY_INLINE std::uint32_t advance(const InstanceTree& tree, const Fetch& prefetch) {
    const std::uint64_t next = open_[--count_];
    if (enters_of(next) > last_) return no_instance;
    const std::uint32_t child = child_of(next);
    if ((child & InstanceTree::instance_bit) != 0) return child & ~InstanceTree::instance_bit;
    if (capacity < max_open_children && count_ + InstanceTree::width > capacity) [[unlikely]] {
      has_overflown_ = true;
      count_ = 0;
      return no_instance;
    }
    visit_node<sorts>(tree, tree.nodes()[child], prefetch);
    return no_instance;
  }

 private:
  // An entry is a child, and the tau at which the path enters its box. Both are stored and loaded together.
  static std::uint64_t entry(std::uint32_t child, float enters) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(enters)} << 32 | child;
  }
  static std::uint32_t child_of(std::uint64_t entry) { return static_cast<std::uint32_t>(entry); }
  static float enters_of(std::uint64_t entry) { return std::bit_cast<float>(static_cast<std::uint32_t>(entry >> 32)); }

  /// Leaves the children for later whose boxes the path may meet.
  template <bool sorts, typename Fetch>
  HWY_INLINE void visit_node(const InstanceTree& tree, const InstanceTree::Node& node, const Fetch& prefetch) {
    const hn::CappedTag<float, InstanceTree::width> d;
    const std::size_t lanes = hn::Lanes(d);
    const std::size_t before = count_;
    for (std::size_t from = 0; from < InstanceTree::width; from += lanes) {
      auto enters = hn::Set(d, path_.first);
      auto leaves = hn::Set(d, last_);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto plane = [&](std::size_t planes) { return hn::Load(d, &node.planes[planes][from]); };
        const auto inverse = hn::Set(d, path_.inverse[axis]);
        const auto near = hn::MulAdd(plane(path_.near_planes[axis]), inverse, hn::Set(d, path_.near_shift[axis]));
        const auto far = hn::MulAdd(plane(path_.far_planes(axis)), inverse, hn::Set(d, path_.far_shift[axis]));
        enters = hn::Max(enters, near);
        leaves = hn::Min(leaves, far);
      }
      alignas(sizeof(float) * InstanceTree::width) std::array<float, InstanceTree::width> at;
      hn::Store(enters, d, at.data());
      std::uint64_t met = bits_of(d, hn::Le(enters, leaves));
      for (; met != 0; met &= met - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(met));
        const std::uint32_t child = node.child[from + lane];
        if (child == InstanceTree::no_child) continue;
        fetch(tree, child, prefetch);
        std::size_t place = count_++;
        if constexpr (sorts) {  // The nearest child comes last, and is taken first.
          for (; place > before && enters_of(open_[place - 1]) < at[lane]; --place) open_[place] = open_[place - 1];
        }
        open_[place] = entry(child, at[lane]);
      }
    }
  }

  /// Fetches a child into the cache.
  template <typename Fetch>
  static HWY_INLINE void fetch(const InstanceTree& tree, std::uint32_t child, const Fetch& prefetch) {
    if ((child & InstanceTree::instance_bit) != 0) {
      prefetch(child & ~InstanceTree::instance_bit);
      return;
    }
    const InstanceTree::Node& below = tree.nodes()[child];
    for (std::size_t planes = 0; planes < 6; planes += 2) hwy::Prefetch(below.planes[planes].data());
    hwy::Prefetch(below.child.data());
  }

  TreePath path_;
  float last_;                  ///< Beyond this tau nothing counts.
  bool has_overflown_ = false;  ///< True if a child was lost.
  std::size_t count_ = 0;       ///< The number of entries in `open_`.
  std::array<std::uint64_t, capacity> open_;
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
