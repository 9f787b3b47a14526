#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "scene/instance_tree.hpp"

namespace surehit::detail {

/// The box of no instances.
inline constexpr InstanceBox no_box = [] {
  constexpr double far = std::numeric_limits<double>::infinity();
  return InstanceBox{{far, far, far}, {-far, -far, -far}};
}();

/// Makes a box hold another one too.
inline void extend(InstanceBox& box, const InstanceBox& by) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], by.low[axis]);
    box.high[axis] = std::max(box.high[axis], by.high[axis]);
  }
}

/// Returns half of the surface of a box. It is NaN or infinite for boxes without bounds.
inline double surface(const InstanceBox& box) {
  const double x = box.high[0] - box.low[0];
  const double y = box.high[1] - box.low[1];
  const double z = box.high[2] - box.low[2];
  return x < 0 ? 0 : x * y + y * z + z * x;
}

/// Returns the middle of a box on an axis.
inline double middle(const InstanceBox& box, std::size_t axis) {
  const double sum = box.low[axis] + box.high[axis];
  return std::isfinite(sum) ? sum / 2 : 0;  // A box without bounds may be anywhere.
}

/// Some instances of the tree, and their box.
struct InstanceGroup {
  std::uint32_t first;  ///< Where the first one is in the order.
  std::uint32_t last;   ///< The place behind the last one.
  InstanceBox box;      ///< The box around them.
};

/// Splits groups of instances for a tree, by binned surfaces (Wald, On fast Construction of SAH-based Bounding Volume
/// Hierarchies, 2007). It reorders their indices.
class InstanceSplitter {
 public:
  InstanceSplitter(std::vector<std::uint32_t>& order, std::span<const InstanceBox> boxes)
      : order_(order), boxes_(boxes) {}

  /// Returns the group of a part of the order.
  [[nodiscard]] InstanceGroup group(std::uint32_t first, std::uint32_t last) const {
    InstanceGroup group = {first, last, no_box};
    for (std::uint32_t i = first; i < last; ++i) extend(group.box, boxes_[order_[i]]);
    return group;
  }

  /// Splits a group of at least two instances, where the surfaces of both parts, each times its instances, are least.
  /// If `evenly`, or if nothing parts them, each part has half of the instances.
  [[nodiscard]] std::array<InstanceGroup, 2> split(const InstanceGroup& group, bool evenly) {
    Doubles low = {infinity, infinity, infinity};
    Doubles high = {-infinity, -infinity, -infinity};
    for (std::uint32_t i = group.first; i < group.last; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = middle(boxes_[order_[i]], axis);
        low[axis] = std::min(low[axis], at);
        high[axis] = std::max(high[axis], at);
      }
    }
    std::size_t axis = 0;
    for (std::size_t other = 1; other < 3; ++other) {
      if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
    }
    std::uint32_t middle_at = group.first;
    const double size = high[axis] - low[axis];
    if (!evenly && size > 0 && std::isfinite(size)) middle_at = part_by_bins(group, axis, low[axis], size);
    if (middle_at == group.first || middle_at == group.last) {
      middle_at = group.first + (group.last - group.first) / 2;
      std::nth_element(place(group.first), place(middle_at), place(group.last), [&](std::uint32_t x, std::uint32_t y) {
        return middle(boxes_[x], axis) < middle(boxes_[y], axis);
      });
    }
    return {this->group(group.first, middle_at), this->group(middle_at, group.last)};
  }

 private:
  static constexpr std::size_t bins = 16;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Where an index of the order lies.
  [[nodiscard]] std::uint32_t* place(std::uint32_t i) const { return order_.data() + i; }

  /// Brings the instances of the better part to the front, and returns where the other part begins.
  std::uint32_t part_by_bins(const InstanceGroup& group, std::size_t axis, double low, double size) {
    struct Bin {
      InstanceBox box = no_box;
      std::uint32_t count = 0;
    };
    std::array<Bin, bins> bin;
    const auto bin_of = [&](std::uint32_t index) {
      const double share = (middle(boxes_[index], axis) - low) / size;
      return std::min(static_cast<std::size_t>(share * bins), bins - 1);
    };
    for (std::uint32_t i = group.first; i < group.last; ++i) {
      Bin& of = bin[bin_of(order_[i])];
      extend(of.box, boxes_[order_[i]]);
      ++of.count;
    }
    std::array<double, bins> after = {};  // The cost of the bins from one on.
    Bin sum;
    for (std::size_t i = bins - 1; i > 0; --i) {
      extend(sum.box, bin[i].box);
      sum.count += bin[i].count;
      after[i] = surface(sum.box) * sum.count;
    }
    sum = Bin();
    double best = infinity;
    std::size_t best_bin = 0;
    for (std::size_t i = 1; i < bins; ++i) {
      extend(sum.box, bin[i - 1].box);
      sum.count += bin[i - 1].count;
      const double cost = surface(sum.box) * sum.count + after[i];
      if (cost < best) {
        best = cost;
        best_bin = i;
      }
    }
    if (best_bin == 0) return group.first;
    const std::uint32_t* const other = std::partition(place(group.first), place(group.last),
                                                      [&](std::uint32_t index) { return bin_of(index) < best_bin; });
    return static_cast<std::uint32_t>(other - order_.data());
  }

  std::vector<std::uint32_t>& order_;
  std::span<const InstanceBox> boxes_;
};

}  // namespace surehit::detail
