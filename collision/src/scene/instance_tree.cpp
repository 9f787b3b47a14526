#include "scene/instance_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "scene/tree_collapse.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// Returns true if no coordinate is infinite, NaN or huge.
bool is_bounded(const InstanceBox& box) {
  bool is_bounded = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    is_bounded &= std::fabs(box.low[axis]) <= 0x1p1000 && std::fabs(box.high[axis]) <= 0x1p1000;
  }
  return is_bounded;
}

/// Returns the length of a box on its longest axis.
double largest_side(const InstanceBox& box) {
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) size = std::max(size, box.high[axis] - box.low[axis]);
  return size;
}

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

/// Returns the planes around all children of a node.
Planes planes_around(const InstanceTree::Node& node) {
  Planes planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes[axis] = *std::min_element(node.planes[axis].begin(), node.planes[axis].end());
    planes[3 + axis] = *std::max_element(node.planes[3 + axis].begin(), node.planes[3 + axis].end());
  }
  return planes;
}

/// Returns the place of a child in its node.
std::size_t lane_of(const InstanceTree::Node& node, std::uint32_t child) {
  std::size_t lane = 0;
  while (node.child[lane] != child) ++lane;
  return lane;
}

/// Returns what a box adds to the cost of a tree: half of its surface, if it has bounds.
double cost_of(const Planes& planes) {
  std::array<double, 3> sides;
  for (std::size_t axis = 0; axis < 3; ++axis) sides[axis] = double{planes[3 + axis]} - double{planes[axis]};
  const double cost = sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
  return std::isfinite(cost) ? cost : 0;
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

void InstanceTree::set_box(std::span<const InstanceBox> boxes) noexcept {
  box_ = no_box;
  for (const Node& node : nodes_) {
    for (const std::uint32_t child : node.child) {
      if (child != no_child && (child & instance_bit) != 0) extend(box_, boxes[child & ~instance_bit]);
    }
  }
}

void InstanceTree::set_frame(std::span<const InstanceBox> boxes) noexcept {
  // The boxes without bounds do not count.
  InstanceBox all = box_;
  if (!is_bounded(all)) {
    all = no_box;
    for (const Node& node : nodes_) {
      for (const std::uint32_t child : node.child) {
        if (child == no_child || (child & instance_bit) == 0) continue;
        const InstanceBox& box = boxes[child & ~instance_bit];
        if (is_bounded(box)) extend(all, box);
      }
    }
  }
  const double size = largest_side(all);
  // Around the instances there is room for those that move.
  constexpr double room = 0x1p-4;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    origin_[axis] = all.low[axis] <= all.high[axis] ? all.low[axis] - size * room : 0;
  }
  scale_ = size > 0x1p-1000 ? std::ldexp(1.0, -std::ilogb(size * (1 + 2 * room)) - 1) : 1;
}

bool InstanceTree::frame_holds() const noexcept {
  constexpr double min_share = 0x1p-3;  // A smaller box would be found more coarsely.
  if (!is_bounded(box_) || largest_side(box_) * scale_ < min_share) return false;
  bool holds = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    holds &= box_.low[axis] >= origin_[axis] && (box_.high[axis] - origin_[axis]) * scale_ < 1;
  }
  return holds;
}

Planes InstanceTree::planes_of(const InstanceBox& box) const noexcept {
  constexpr float far = std::numeric_limits<float>::infinity();
  // It may be beyond the frame, where the slack of a path is not enough.
  if (!is_bounded(box)) return {-far, -far, -far, far, far, far};
  Planes planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Two roundings, of the difference and of this margin.
    const auto margin = [&](double x) { return (std::fabs(x) + std::fabs(origin_[axis])) * scale_ * 0x1p-51; };
    planes[axis] = round_down((box.low[axis] - origin_[axis]) * scale_ - margin(box.low[axis]));
    planes[3 + axis] = -round_down(-((box.high[axis] - origin_[axis]) * scale_ + margin(box.high[axis])));
  }
  return planes;
}

void InstanceTree::refit(std::span<const InstanceBox> boxes) noexcept {
  set_box(boxes);
  set_frame(boxes);
  cost_ = 0;
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    for (std::size_t lane = 0; lane < width; ++lane) {
      const std::uint32_t child = node.child[lane];
      if (child == no_child) continue;
      const bool is_instance = (child & instance_bit) != 0;
      const Planes planes = is_instance ? planes_of(boxes[child & ~instance_bit]) : planes_around(nodes_[child]);
      set_child(node, lane, planes, child);
      cost_ += cost_of(planes);
    }
  }
}

void InstanceTree::refit(std::span<const std::uint32_t> moved, std::span<const InstanceBox> boxes) noexcept {
  if (is_empty()) return;
  if (2 * moved.size() > node_of_.size()) {
    refit(boxes);
    return;
  }
  update({}, {}, moved, boxes);
}

void InstanceTree::update(std::span<const std::uint32_t> removed, std::span<const std::uint32_t> added,
                          std::span<const std::uint32_t> moved, std::span<const InstanceBox> boxes) noexcept {
  const Planes all = planes_around(nodes_[0]);
  bool may_be_smaller = false;
  // They come first, because they have changed too, and have no box any more.
  for (const std::uint32_t instance : removed) {
    may_be_smaller |= reaches_a_side_of(all, instance);
    take_child_out(node_of_[instance], instance | instance_bit);
    node_of_[instance] = no_child;
  }
  for (const std::uint32_t instance : moved) {
    if (node_of(instance) == no_child) continue;
    may_be_smaller |= reaches_a_side_of(all, instance);
    extend(box_, boxes[instance]);
  }
  for (const std::uint32_t instance : added) {
    extend(box_, boxes[instance]);
    node_of_[instance] = put_and_link(instance, planes_of(boxes[instance]));
  }
  exchanged_ += removed.size() + added.size();
  if (may_be_smaller) set_box(boxes);
  if (!frame_holds()) {
    std::fill(changed_.begin(), changed_.end(), 0);
    refit(boxes);
    return;
  }
  for (const std::uint32_t instance : moved) {
    if (node_of(instance) == no_child) continue;
    const Planes planes = planes_of(boxes[instance]);
    if (has_left(instance, planes)) put_elsewhere(instance, planes);
    set_planes(node_of_[instance], instance | instance_bit, planes);
  }
  // A node comes before its children, so the last ones are done first.
  for (std::size_t word = changed_.size(); word-- > 0;) {
    while (changed_[word] != 0) {
      const auto bit = static_cast<std::uint32_t>(std::bit_width(changed_[word])) - 1;
      changed_[word] &= ~(std::uint64_t{1} << bit);
      const std::uint32_t node = static_cast<std::uint32_t>(word) * 64 + bit;
      if (parents_[node] != no_child) set_planes(parents_[node], node, planes_around(nodes_[node]));
    }
  }
}

bool InstanceTree::reaches_a_side_of(const Planes& all, std::uint32_t instance) const noexcept {
  // The same side of a box has the same plane. So only these instances may be the outermost ones.
  const Node& node = nodes_[node_of_[instance]];
  const Planes planes = planes_of_child(node, lane_of(node, instance | instance_bit));
  bool reaches = false;
  for (std::size_t i = 0; i < planes.size(); ++i) reaches |= planes[i] == all[i];
  return reaches;
}

bool InstanceTree::has_left(std::uint32_t instance, const Planes& planes) const noexcept {
  const std::uint32_t at = node_of_[instance];
  if (at == 0 || nodes_.size() >= std::min(nodes_.capacity(), parents_.size()) || !can_update(0, 1)) return false;
  const Planes all = planes_around(nodes_[at]);
  bool has_left = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // It may be as far away as it is long.
    const float length = planes[3 + axis] - planes[axis];
    has_left |= planes[axis] - length > all[3 + axis] || planes[3 + axis] + length < all[axis];
  }
  return has_left;
}

std::uint32_t InstanceTree::put_and_link(std::uint32_t instance, const Planes& planes) noexcept {
  const auto first_new = static_cast<std::uint32_t>(nodes_.size());
  const std::uint32_t to = put_in(instance, planes);
  if (to == no_child) return to;
  if (to == first_new) {
    // The parent comes before the new node, and has it among its children.
    const std::uint32_t other = nodes_[to].child[0] & ~instance_bit;
    parents_[to] = node_of_[other];
    node_of_[other] = to;
  }
  mark(to);
  return to;
}

void InstanceTree::put_elsewhere(std::uint32_t instance, const Planes& planes) noexcept {
  const std::uint32_t to = put_and_link(instance, planes);
  if (to == no_child) return;
  ++exchanged_;
  const std::uint32_t from = node_of_[instance];
  node_of_[instance] = to;
  take_child_out(from, instance | instance_bit);
}

void InstanceTree::take_child_out(std::uint32_t node, std::uint32_t child) noexcept {
  Node& of = nodes_[node];
  const std::size_t lane = lane_of(of, child);
  const std::size_t last = child_count(of) - 1;
  cost_ -= cost_of(planes_of_child(of, lane));
  set_child(of, lane, planes_of_child(of, last), of.child[last]);
  set_child(of, last, planes_of_child(empty_node(), 0), no_child);
  if (last > 0 || node == 0) {
    mark(node);
  } else {
    take_child_out(parents_[node], node);
    parents_[node] = no_child;
  }
}

void InstanceTree::set_planes(std::uint32_t node, std::uint32_t child, const Planes& planes) noexcept {
  const std::size_t lane = lane_of(nodes_[node], child);
  const Planes before = planes_of_child(nodes_[node], lane);
  if (before == planes) return;
  cost_ += cost_of(planes) - cost_of(before);
  set_child(nodes_[node], lane, planes, child);
  mark(node);
}

InstanceTree InstanceTree::with_room() const {
  InstanceTree copy = *this;
  copy.make_room(0, node_of_.size());
  return copy;
}

void InstanceTree::make_room(std::size_t added, std::size_t instances) {
  if (node_of_.size() < instances) node_of_.resize(instances, no_child);
  const std::size_t needed = nodes_.size() + added + 1;
  const std::size_t capacity = nodes_.capacity() < needed ? needed + nodes_.size() / 8 : nodes_.capacity();
  // The nodes come last. If memory runs out before, they have no room that the others lack.
  parents_.resize(std::max(parents_.size(), capacity), no_child);
  changed_.resize((parents_.size() + 63) / 64, 0);
  nodes_.reserve(capacity);
}

void InstanceTree::link(std::size_t instances) {
  make_room(0, instances);
  node_of_.assign(instances, no_child);
  parents_.assign(parents_.size(), no_child);
  deepest_ = 0;
  std::vector<std::uint32_t> depths(nodes_.size(), 0);
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    for (const std::uint32_t child : nodes_[i].child) {
      if (child == no_child) continue;
      if ((child & instance_bit) != 0) {
        node_of_[child & ~instance_bit] = i;
      } else {
        parents_[child] = i;
        depths[child] = depths[i] + 1;
        deepest_ = std::max<std::size_t>(deepest_, depths[child]);
      }
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
  node_of_.clear();
  if (instances.empty()) return;
  const TreeCollapse collapse(instances, boxes);
  struct Task {
    std::uint32_t part;
    std::uint32_t node;
  };
  std::vector<Task> tasks = {{TreeCollapse::root, 0}};
  nodes_.push_back(empty_node());
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const TreeCollapse::Children children = collapse.children_of(task.part);
    for (std::size_t lane = 0; lane < children.count; ++lane) {
      const std::uint32_t part = children.part[lane];
      if (collapse.is_instance(part)) {
        nodes_[task.node].child[lane] = collapse.instance(part) | instance_bit;
        continue;
      }
      const auto child = static_cast<std::uint32_t>(nodes_.size());
      nodes_[task.node].child[lane] = child;
      nodes_.push_back(empty_node());
      tasks.push_back({part, child});
    }
  }
  refit(boxes);
  link(boxes.size());
  built_cost_ = cost_;
  built_scale_ = scale_;
  built_count_ = instances.size();
  exchanged_ = 0;
}

bool InstanceTree::exchange(std::span<const std::uint8_t> is_there, std::span<const std::uint32_t> added,
                            std::span<const InstanceBox> boxes) {
  exchanged_ += take_out(is_there) + added.size();
  for (const std::uint32_t instance : added) {
    if (put_in(instance, planes_of(boxes[instance])) == no_child) return false;
  }
  refit(boxes);
  link(boxes.size());
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

std::uint32_t InstanceTree::put_in(std::uint32_t instance, const Planes& planes) {
  std::uint32_t at = 0;
  std::uint32_t turn = instance;  // Where nothing tells children apart, each gets as many instances.
  for (std::size_t depth = 0; depth + 1 < max_depth; ++depth, turn /= std::uint32_t{width}) {
    const std::size_t count = child_count(nodes_[at]);
    if (count < width) {
      set_child(nodes_[at], count, planes, instance | instance_bit);
      cost_ += cost_of(planes);
      return at;
    }
    const std::size_t lane = lane_that_grows_least(nodes_[at], planes, turn % width);
    const std::uint32_t child = nodes_[at].child[lane];
    const Planes before = planes_of_child(nodes_[at], lane);
    const Planes grown = joined(before, planes);
    cost_ += cost_of(grown) - cost_of(before);
    if ((child & instance_bit) != 0) {
      // Both instances get a node of their own.
      const auto pair = static_cast<std::uint32_t>(nodes_.size());
      nodes_.push_back(empty_node());
      set_child(nodes_[pair], 0, before, child);
      set_child(nodes_[pair], 1, planes, instance | instance_bit);
      set_child(nodes_[at], lane, grown, pair);
      cost_ += cost_of(before) + cost_of(planes);
      deepest_ = std::max(deepest_, depth + 1);
      return pair;
    }
    set_child(nodes_[at], lane, grown, child);
    at = child;
  }
  return no_child;
}

}  // namespace surehit::detail
