// Walks a path through the tree of a scene's instances. Highway compiles this file for each instruction set.

#if defined(SUREHIT_TREE_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_TREE_WALK_INL
#undef SUREHIT_TREE_WALK_INL
#else
#define SUREHIT_TREE_WALK_INL
#endif

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
/// Let the path meet a box at some t of its range. Then no test of this path calls the box a miss (I9 in POSES.md).
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
  double distance = max_size(start);
  double error = (path.start_size + tree.origin_size()) * tree.scale() + distance;
  if (!(distance <= max_distance)) {
    moved_t = t_near_middle(path, start, way);
    const Double4 step = moved_t * way;
    start += step;
    distance = max_size(start);
    error += max_size(step) + distance;
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

/// Walks a path through a tree. It goes from node to node, roughly in the order of the path. It has room for `capacity`
/// children that are left for later. A tree may need up to `max_open_children`.
template <std::size_t capacity>
class TreeWalk {
 public:
  template <typename Scalar>
  HWY_INLINE TreeWalk(const InstanceTree& tree, const ScenePath<Scalar>& path) : path_(tree, path), last_(path_.last) {
    open_[0] = {0, std::bit_cast<std::uint32_t>(path_.first)};
    count_ = 1;
  }

  /// Ends the walk.
  void end() { count_ = 0; }
  /// Returns true if there are more children than the walk can keep. Then the walk is of no use.
  [[nodiscard]] bool has_overflown() const { return has_overflown_; }
  /// Ends the walk at parameter t, because nothing beyond it counts.
  void shorten(double t) { last_ = std::min(last_, path_.beyond(t)); }

  /// Returns the next node or instance, or `InstanceTree::no_child` if there is none.
  HWY_INLINE std::uint32_t next() {
    while (count_ != 0) {
      const Child child = open_[--count_];
      if (child.enters() <= last_) return child.index;
    }
    return InstanceTree::no_child;
  }
  /// Goes on to the children of the node that `next` has returned. If `sorts`, the nearest one is the next one.
  template <bool sorts>
  HWY_INLINE void visit(const InstanceTree::Node& node) {
    if (capacity < max_open_children && count_ + InstanceTree::width > capacity) [[unlikely]] {
      has_overflown_ = true;
      count_ = 0;
      return;
    }
    visit_node<sorts>(node);
  }

 private:
  /// A child that is left for later.
  struct Child {
    std::uint32_t index;        ///< Its index, as nodes have it.
    std::uint32_t enters_bits;  ///< The bits of the tau at which the path enters its box.

    [[nodiscard]] float enters() const { return std::bit_cast<float>(enters_bits); }
  };

  /// True if the instruction set has an instruction that compresses a vector. Highway's tables are slower than a loop.
  static constexpr bool compresses = HWY_TARGET <= HWY_AVX3;

  /// Leaves the children for later whose boxes the path may meet. Where vectors are compressed, there is no branch for
  /// each child, because a processor cannot predict which ones are met.
  template <bool sorts>
  HWY_INLINE void visit_node(const InstanceTree::Node& node) {
    const hn::CappedTag<float, InstanceTree::width> d;
    const hn::RebindToUnsigned<decltype(d)> du;
    const std::size_t before = count_;
    for (std::size_t from = 0; from < InstanceTree::width; from += hn::Lanes(d)) {
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
      const auto child = hn::Load(du, &node.child[from]);
      const auto is_there = hn::Ne(child, hn::Set(du, InstanceTree::no_child));
      const auto is_met = hn::And(is_there, hn::RebindMask(du, hn::Le(enters, leaves)));
      if constexpr (compresses) {
        static_assert(sizeof(Child) == 2 * sizeof(std::uint32_t));
        hn::StoreInterleaved2(hn::Compress(child, is_met), hn::Compress(hn::BitCast(du, enters), is_met), du,
                              reinterpret_cast<std::uint32_t*>(&open_[count_]));
        count_ += hn::CountTrue(du, is_met);
      } else {
        alignas(sizeof(float) * InstanceTree::width) std::array<std::uint32_t, InstanceTree::width> enters_bits;
        hn::Store(hn::BitCast(du, enters), du, enters_bits.data());
        for (std::uint64_t met = bits_of(du, is_met); met != 0; met &= met - 1) {
          const auto lane = static_cast<std::size_t>(std::countr_zero(met));
          open_[count_++] = {node.child[from + lane], enters_bits[lane]};
        }
      }
    }
    if constexpr (sorts) sort_from(before);
  }

  /// Exchanges two children if the first one is nearer.
  static HWY_INLINE void put_nearer_last(Child& x, Child& y) {
    const auto x_bits = std::bit_cast<std::uint64_t>(x);
    const auto y_bits = std::bit_cast<std::uint64_t>(y);
    const std::uint64_t changes = (x_bits ^ y_bits) & -std::uint64_t{x.enters() < y.enters()};
    x = std::bit_cast<Child>(x_bits ^ changes);
    y = std::bit_cast<Child>(y_bits ^ changes);
  }

  /// Sorts the children from place `first` on. The nearest one comes last, and is taken first. Up to four children are
  /// sorted without a branch.
  HWY_INLINE void sort_from(std::size_t first) {
    Child* const children = &open_[first];
    const std::size_t count = count_ - first;
    if (count < 2) return;
    put_nearer_last(children[0], children[1]);
    if (count == 2) return;
    put_nearer_last(children[1], children[2]);
    put_nearer_last(children[0], children[1]);
    if (count == 3) return;
    put_nearer_last(children[2], children[3]);
    put_nearer_last(children[1], children[2]);
    put_nearer_last(children[0], children[1]);
    for (std::size_t next = 4; next < count; ++next) {
      const Child child = children[next];
      std::size_t place = next;
      for (; place > 0 && children[place - 1].enters() < child.enters(); --place) children[place] = children[place - 1];
      children[place] = child;
    }
  }

  TreePath path_;
  float last_;                                              ///< Beyond this tau nothing counts.
  bool has_overflown_ = false;                              ///< True if a child was lost.
  std::size_t count_ = 0;                                   ///< The number of children that are left for later.
  std::array<Child, capacity + InstanceTree::width> open_;  ///< These children. All of a node are stored at once.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
