#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/instance_frame.hpp"

namespace surehit::detail {

/// A box of doubles.
struct InstanceBox {
  Doubles low;   ///< The low corner.
  Doubles high;  ///< The high corner.
};

/// A tree of boxes around the instances of a scene. Each node has up to eight children. Coordinates are floats in a
/// frame of the tree: (x - origin) scale. Boxes are rounded outward.
class InstanceTree {
 public:
  static constexpr std::size_t width = 8;  ///< The maximum number of children of a node.
  /// The maximum number of nodes on a way down.
  static constexpr std::size_t max_depth = 48;

  /// A child is a node, or an instance if this bit is set.
  static constexpr std::uint32_t instance_bit = std::uint32_t{1} << 31;
  /// A child that is not there. Its box is empty.
  static constexpr std::uint32_t no_child = ~std::uint32_t{0};

  struct alignas(32) Node {
    /// The planes of the children's boxes: the low ones of each axis, and then the high ones.
    std::array<std::array<float, width>, 6> planes;
    std::array<std::uint32_t, width> child;  ///< The children.

    [[nodiscard]] std::array<float, width>& low(std::size_t axis) { return planes[axis]; }
    [[nodiscard]] std::array<float, width>& high(std::size_t axis) { return planes[3 + axis]; }
  };

  /// Sorts these instances into a tree. `boxes` has the box of each index, here and below. May throw std::bad_alloc.
  void build(std::span<const std::uint32_t> instances, std::span<const InstanceBox> boxes);
  /// Returns true if as many more instances may come and go before a new tree would be faster.
  [[nodiscard]] bool has_room_for(std::size_t exchanged) const {
    return !is_worn() && 2 * (exchanged_ + exchanged) <= built_count_;
  }
  /// Takes out the instances whose `is_there` is 0, and puts others in. Returns false if a way down becomes too long.
  /// Then the tree is of no use. May throw std::bad_alloc.
  [[nodiscard]] bool exchange(std::span<const std::uint8_t> is_there, std::span<const std::uint32_t> added,
                              std::span<const InstanceBox> boxes);
  /// Returns true if `update` can take out and put in as many instances.
  [[nodiscard]] bool can_update(std::size_t removed, std::size_t added) const {
    constexpr std::size_t min_count = 2 * width;  // Half of them stay, so the tree does not become empty.
    return built_count_ >= min_count && has_room_for(removed + added) && deepest_ + added + 2 <= max_depth;
  }
  /// Makes room for instances that `update` adds, and for as many in all. May throw std::bad_alloc.
  void make_room(std::size_t added, std::size_t instances);
  /// Takes instances out, puts others in, and fits the boxes of others that have moved, as `refit` does. `can_update`
  /// must hold, and there must be room.
  void update(std::span<const std::uint32_t> removed, std::span<const std::uint32_t> added,
              std::span<const std::uint32_t> moved, std::span<const InstanceBox> boxes) noexcept;
  /// Returns a copy in which `refit` can put instances elsewhere. May throw std::bad_alloc.
  [[nodiscard]] InstanceTree with_room() const;
  /// Fits the boxes of the tree to new boxes of the same instances.
  void refit(std::span<const InstanceBox> boxes) noexcept;
  /// Does the same if no other instances than these may have moved. Those that are not in the tree do not matter. It
  /// takes the time of these instances and of the nodes above them, if the tree can keep its frame. Instances that have
  /// left the place of their node get another one.
  void refit(std::span<const std::uint32_t> moved, std::span<const InstanceBox> boxes) noexcept;

  [[nodiscard]] bool is_empty() const { return nodes_.empty(); }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// Returns the only instance, or `no_child` if there is none or more than one.
  [[nodiscard]] std::uint32_t only_instance() const noexcept;
  [[nodiscard]] const Double4& origin() const { return origin_; }
  /// Returns the largest component of the origin.
  [[nodiscard]] double origin_size() const { return max_size(origin_); }
  [[nodiscard]] double scale() const { return scale_; }
  /// Returns the box of all instances, in the scene's unit of length.
  [[nodiscard]] const InstanceBox& box() const { return box_; }
  /// Returns true if the boxes have grown so much that a new tree would be faster.
  [[nodiscard]] bool is_worn() const {
    const double unit = built_scale_ / scale_;  // Costs are surfaces in the frame of their time.
    return cost_ * unit * unit > 1.5 * built_cost_;
  }
  [[nodiscard]] std::size_t memory_bytes() const {
    return nodes_.capacity() * sizeof(Node) + (node_of_.capacity() + parents_.capacity()) * sizeof(std::uint32_t) +
           changed_.capacity() * sizeof(std::uint64_t);
  }

 private:
  /// Takes out the instances whose `is_there` is 0, and the nodes that have no child then. Returns how many it took.
  std::size_t take_out(std::span<const std::uint8_t> is_there) noexcept;
  /// Puts an instance where the boxes grow least. Returns its node, or `no_child` if the way down would become too
  /// long. Does not throw if there is room for a node.
  [[nodiscard]] std::uint32_t put_in(std::uint32_t instance, const std::array<float, 6>& planes);
  /// Sets the box of all instances.
  void set_box(std::span<const InstanceBox> boxes) noexcept;
  /// Sets the frame from the boxes of all instances.
  void set_frame(std::span<const InstanceBox> boxes) noexcept;
  /// Returns true if the frame is still right for the box of all instances (I9).
  [[nodiscard]] bool frame_holds() const noexcept;
  /// Returns a box in the frame, rounded outward.
  [[nodiscard]] std::array<float, 6> planes_of(const InstanceBox& box) const noexcept;
  /// Notes where each node and each instance is.
  void link(std::size_t instances);
  /// Returns the node that has an instance, or `no_child`.
  [[nodiscard]] std::uint32_t node_of(std::uint32_t instance) const noexcept {
    return instance < node_of_.size() ? node_of_[instance] : no_child;
  }
  /// Returns true if an instance belongs elsewhere in the tree now, and if there is room for this.
  [[nodiscard]] bool has_left(std::uint32_t instance, const std::array<float, 6>& planes) const noexcept;
  /// Returns true if an instance may be the outermost one of all on a side.
  [[nodiscard]] bool reaches_a_side_of(const std::array<float, 6>& all, std::uint32_t instance) const noexcept;
  /// Puts an instance in, and notes where the nodes are then. Returns the node of the instance.
  std::uint32_t put_and_link(std::uint32_t instance, const std::array<float, 6>& planes) noexcept;
  /// Puts an instance of the tree where it belongs now.
  void put_elsewhere(std::uint32_t instance, const std::array<float, 6>& planes) noexcept;
  /// Takes a child out of its node, and the node out of the tree if it has no other one.
  void take_child_out(std::uint32_t node, std::uint32_t child) noexcept;
  /// Notes that the boxes above a node must be set.
  void mark(std::uint32_t node) noexcept { changed_[node / 64] |= std::uint64_t{1} << node % 64; }
  /// Sets the box of a child, and marks its node.
  void set_planes(std::uint32_t node, std::uint32_t child, const std::array<float, 6>& planes) noexcept;

  std::vector<Node> nodes_;  ///< Each node comes before its children.
  Double4 origin_ = {};
  double scale_ = 1;
  InstanceBox box_ = {};
  double cost_ = 0;                     ///< The sum of the surfaces of all boxes.
  double built_cost_ = 0;               ///< The same when the tree was built.
  double built_scale_ = 1;              ///< The scale when the tree was built.
  std::size_t built_count_ = 0;         ///< The number of instances when the tree was built.
  std::size_t exchanged_ = 0;           ///< The number of instances that came or went since then.
  std::size_t deepest_ = 0;             ///< No node has more nodes above it.
  std::vector<std::uint32_t> node_of_;  ///< The node of each instance, or `no_child`.
  std::vector<std::uint32_t> parents_;  ///< The node above each node, or `no_child`.
  std::vector<std::uint64_t> changed_;  ///< A bit for each node. It is set while the box of a child has changed.
};

}  // namespace surehit::detail
