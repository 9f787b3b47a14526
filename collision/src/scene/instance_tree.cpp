#include "scene/instance_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr InstanceBox no_box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

void extend(InstanceBox& box, const InstanceBox& by) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], by.low[axis]);
    box.high[axis] = std::max(box.high[axis], by.high[axis]);
  }
}

/// Returns half of the surface of a box. It is NaN or infinite for boxes without bounds.
double surface(const InstanceBox& box) {
  const double x = box.high[0] - box.low[0];
  const double y = box.high[1] - box.low[1];
  const double z = box.high[2] - box.low[2];
  return x < 0 ? 0 : x * y + y * z + z * x;
}

double middle(const InstanceBox& box, std::size_t axis) {
  const double sum = box.low[axis] + box.high[axis];
  return std::isfinite(sum) ? sum / 2 : 0;  // A box without bounds may be anywhere.
}

/// Some instances of the tree, and their box.
struct Group {
  std::uint32_t first;
  std::uint32_t last;
  InstanceBox box;
};

/// Splits groups of instances.
class Splitter {
 public:
  Splitter(std::vector<std::uint32_t>& order, std::span<const InstanceBox> boxes) : order_(order), boxes_(boxes) {}

  [[nodiscard]] Group group(std::uint32_t first, std::uint32_t last) const {
    Group group = {first, last, no_box};
    for (std::uint32_t i = first; i < last; ++i) extend(group.box, boxes_[order_[i]]);
    return group;
  }

  /// Splits a group of at least two instances, where the surfaces of both parts, each times its instances, are least.
  /// If `evenly`, or if nothing parts them, each part has half of the instances.
  [[nodiscard]] std::array<Group, 2> split(const Group& group, bool evenly) {
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

  /// Splits the first one of some groups until there are as many as there is room for, or until all are single
  /// instances. Returns the number of groups.
  std::size_t split_all(std::span<Group> groups, bool evenly) {
    std::size_t count = 1;
    while (count < groups.size()) {
      // The group with the largest surface is split next.
      std::size_t largest = groups.size();
      double largest_cost = -1;
      for (std::size_t i = 0; i < count; ++i) {
        if (groups[i].last - groups[i].first < 2) continue;
        double cost = surface(groups[i].box);
        if (!std::isfinite(cost)) cost = std::numeric_limits<double>::max();
        if (cost > largest_cost) {
          largest_cost = cost;
          largest = i;
        }
      }
      if (largest == groups.size()) break;
      const auto [left, right] = split(groups[largest], evenly);
      groups[largest] = left;
      groups[count++] = right;
    }
    return count;
  }

 private:
  static constexpr std::size_t bins = 16;

  /// Where an index of the order lies.
  [[nodiscard]] std::uint32_t* place(std::uint32_t i) const { return order_.data() + i; }

  /// Brings the instances of the better part to the front, and returns where the other part begins.
  std::uint32_t part_by_bins(const Group& group, std::size_t axis, double low, double size) {
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

/// Returns a float that is at most x, and hardly less. The result is never plus infinity.
float round_down(double x) {
  // A rounding is off by at most 2^-24 of the number, or by 2^-150. There is no branch on which side of x it is.
  const auto low = static_cast<float>(x - (std::fabs(x) * 0x1p-23 + 0x1p-148));
  return std::isnan(low) ? -std::numeric_limits<float>::infinity() : std::min(low, std::numeric_limits<float>::max());
}

/// Returns a node without children.
InstanceTree::Node empty_node() {
  constexpr float far = std::numeric_limits<float>::infinity();
  InstanceTree::Node node;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.low(axis).fill(far);
    node.high(axis).fill(-far);
  }
  node.child.fill(InstanceTree::no_child);
  return node;
}

/// The planes of a box, in the order of a node.
using Planes = std::array<float, 6>;

/// Returns the number of children of a node. They are in its first places.
std::size_t child_count(const InstanceTree::Node& node) {
  std::size_t count = 0;
  while (count < InstanceTree::width && node.child[count] != InstanceTree::no_child) ++count;
  return count;
}

Planes planes_of_child(const InstanceTree::Node& node, std::size_t lane) {
  Planes planes;
  for (std::size_t i = 0; i < planes.size(); ++i) planes[i] = node.planes[i][lane];
  return planes;
}

void set_child(InstanceTree::Node& node, std::size_t lane, const Planes& planes, std::uint32_t child) {
  for (std::size_t i = 0; i < planes.size(); ++i) node.planes[i][lane] = planes[i];
  node.child[lane] = child;
}

/// Returns the planes around two boxes.
Planes joined(const Planes& x, const Planes& y) {
  Planes planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes[axis] = std::min(x[axis], y[axis]);
    planes[3 + axis] = std::max(x[3 + axis], y[3 + axis]);
  }
  return planes;
}

/// Returns half of the surface of a box.
float surface(const Planes& planes) {
  const float x = planes[3] - planes[0];
  const float y = planes[4] - planes[1];
  const float z = planes[5] - planes[2];
  return x * y + y * z + z * x;
}

/// Returns the child whose box grows least if another box joins it. Among those that grow alike, the smallest one is
/// taken, and then the first one from `first` on.
std::size_t lane_that_grows_least(const InstanceTree::Node& node, const Planes& planes, std::size_t first) {
  std::size_t best = first;
  float best_growth = std::numeric_limits<float>::infinity();
  float best_surface = best_growth;
  for (std::size_t i = 0; i < InstanceTree::width; ++i) {
    const std::size_t lane = (first + i) % InstanceTree::width;
    const Planes before = planes_of_child(node, lane);
    const float before_surface = surface(before);
    const float growth = surface(joined(before, planes)) - before_surface;
    if (growth < best_growth || (growth == best_growth && before_surface < best_surface)) {
      best = lane;
      best_growth = growth;
      best_surface = before_surface;
    }
  }
  return best;
}

}  // namespace

void InstanceTree::set_frame(std::span<const InstanceBox> boxes) noexcept {
  // The boxes without bounds do not count.
  InstanceBox all = no_box;
  box_ = no_box;
  for (const Node& node : nodes_) {
    for (const std::uint32_t child : node.child) {
      if (child == no_child || (child & instance_bit) == 0) continue;
      const InstanceBox& box = boxes[child & ~instance_bit];
      extend(box_, box);
      bool is_bounded = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        is_bounded &= std::fabs(box.low[axis]) <= 0x1p1000 && std::fabs(box.high[axis]) <= 0x1p1000;
      }
      if (is_bounded) extend(all, box);
    }
  }
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    origin_[axis] = all.low[axis] <= all.high[axis] ? all.low[axis] : 0;
    if (all.low[axis] <= all.high[axis]) size = std::max(size, all.high[axis] - all.low[axis]);
  }
  scale_ = size > 0x1p-1000 ? std::ldexp(1.0, -std::ilogb(size) - 1) : 1;
}

void InstanceTree::refit(std::span<const InstanceBox> boxes) noexcept {
  set_frame(boxes);
  cost_ = 0;
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    for (std::size_t lane = 0; lane < width; ++lane) {
      const std::uint32_t child = node.child[lane];
      if (child == no_child) continue;
      std::array<double, 3> sides;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        float& low = node.low(axis)[lane];
        float& high = node.high(axis)[lane];
        if ((child & instance_bit) != 0) {
          const InstanceBox& box = boxes[child & ~instance_bit];
          // Two roundings, of the difference and of this margin.
          const auto margin = [&](double x) { return (std::fabs(x) + std::fabs(origin_[axis])) * scale_ * 0x1p-51; };
          low = round_down((box.low[axis] - origin_[axis]) * scale_ - margin(box.low[axis]));
          high = -round_down(-((box.high[axis] - origin_[axis]) * scale_ + margin(box.high[axis])));
        } else {
          Node& below = nodes_[child];
          low = *std::min_element(below.low(axis).begin(), below.low(axis).end());
          high = *std::max_element(below.high(axis).begin(), below.high(axis).end());
        }
        sides[axis] = double{high} - double{low};
      }
      const double cost = sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
      if (std::isfinite(cost)) cost_ += cost;
    }
  }
}

std::uint32_t InstanceTree::only_instance() const noexcept {
  // The first child of a node is always there.
  const bool is_one = nodes_.size() == 1 && nodes_[0].child[1] == no_child;
  return is_one ? nodes_[0].child[0] & ~instance_bit : no_child;
}

void InstanceTree::build(std::span<const std::uint32_t> instances, std::span<const InstanceBox> boxes) {
  nodes_.clear();
  if (instances.empty()) return;
  std::vector<std::uint32_t> order(instances.begin(), instances.end());
  Splitter splitter(order, boxes);
  struct Task {
    Group group;
    std::uint32_t node;
    std::uint32_t depth;
  };
  std::vector<Task> tasks;
  nodes_.push_back(empty_node());
  tasks.push_back({splitter.group(0, static_cast<std::uint32_t>(order.size())), 0, 0});
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    // Halves of n instances have at most (n + 1) / 2, so bit_width(n - 1) more nodes hold all of them.
    const std::uint32_t size = task.group.last - task.group.first;
    const bool evenly = task.depth + static_cast<std::uint32_t>(std::bit_width(size - 1)) >= max_depth;
    std::array<Group, width> groups = {task.group};
    const std::size_t count = splitter.split_all(groups, evenly);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Group& group = groups[lane];
      if (group.last - group.first == 1) {
        nodes_[task.node].child[lane] = order[group.first] | instance_bit;
        continue;
      }
      const auto child = static_cast<std::uint32_t>(nodes_.size());
      nodes_[task.node].child[lane] = child;
      nodes_.push_back(empty_node());
      tasks.push_back({group, child, task.depth + 1});
    }
  }
  refit(boxes);
  built_cost_ = cost_;
  built_scale_ = scale_;
  built_count_ = instances.size();
  exchanged_ = 0;
}

bool InstanceTree::exchange(std::span<const std::uint8_t> is_there, std::span<const std::uint32_t> added,
                            std::span<const InstanceBox> boxes) {
  exchanged_ += take_out(is_there) + added.size();
  for (const std::uint32_t instance : added) {
    if (!put_in(instance, boxes[instance])) return false;
  }
  refit(boxes);
  return true;
}

std::size_t InstanceTree::take_out(std::span<const std::uint8_t> is_there) noexcept {
  std::size_t taken = 0;
  const auto is_gone = [&](std::uint32_t child) {
    if ((child & instance_bit) == 0) return nodes_[child].child[0] == no_child;
    const bool leaves = is_there[child & ~instance_bit] == 0;
    taken += leaves ? 1 : 0;
    return leaves;
  };
  const Planes no_planes = planes_of_child(empty_node(), 0);
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // A node without children is known before its parent.
    Node& node = nodes_[i];
    std::size_t count = child_count(node);
    for (std::size_t lane = count; lane-- > 0;) {
      if (!is_gone(node.child[lane])) continue;
      --count;
      set_child(node, lane, planes_of_child(node, count), node.child[count]);
      set_child(node, count, no_planes, no_child);
    }
  }
  return taken;
}

bool InstanceTree::put_in(std::uint32_t instance, const InstanceBox& box) {
  Planes planes;  // `refit` rounds them outward.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes[axis] = static_cast<float>((box.low[axis] - origin_[axis]) * scale_);
    planes[3 + axis] = static_cast<float>((box.high[axis] - origin_[axis]) * scale_);
  }
  std::uint32_t at = 0;
  std::uint32_t turn = instance;  // Where nothing tells children apart, each gets as many instances.
  for (std::size_t depth = 0; depth + 1 < max_depth; ++depth, turn /= std::uint32_t{width}) {
    Node& node = nodes_[at];
    const std::size_t count = child_count(node);
    if (count < width) {
      set_child(node, count, planes, instance | instance_bit);
      return true;
    }
    const std::size_t lane = lane_that_grows_least(node, planes, turn % width);
    const std::uint32_t child = node.child[lane];
    const Planes grown = joined(planes_of_child(node, lane), planes);
    if ((child & instance_bit) != 0) {
      // Both instances get a node of their own.
      Node pair = empty_node();
      set_child(pair, 0, planes_of_child(node, lane), child);
      set_child(pair, 1, planes, instance | instance_bit);
      set_child(node, lane, grown, static_cast<std::uint32_t>(nodes_.size()));
      nodes_.push_back(pair);
      return true;
    }
    set_child(node, lane, grown, child);
    at = child;
  }
  return false;
}

}  // namespace surehit::detail
