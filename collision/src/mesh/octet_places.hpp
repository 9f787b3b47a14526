#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "support/default_init_allocator.hpp"

namespace surehit::detail {

/// Which octets of a grid's lists have a box, and where it is. The boxes lie in the order of the octets, without gaps.
class OctetPlaces {
 public:
  /// Makes this one for so many octets without a box. May throw std::bad_alloc.
  void reset(std::size_t octets);
  /// Gives boxes to `count` octets from `first` on. `number` must follow.
  void add(std::size_t first, std::size_t count) noexcept;
  /// Numbers the boxes and returns how many there are.
  std::size_t number() noexcept;

  /// Returns the number of boxes before that of an octet.
  [[nodiscard]] std::size_t place(std::size_t octet) const noexcept {
    const Group& group = groups_[octet / group_size];
    const std::uint64_t before = (std::uint64_t{1} << octet % group_size) - 1;
    return group.first_place + static_cast<std::size_t>(std::popcount(group.has_box & before));
  }
  [[nodiscard]] std::size_t memory_bytes() const noexcept { return groups_.capacity() * sizeof(Group); }

 private:
  static constexpr std::size_t group_size = 64;
  /// As many octets as a mask has bits.
  struct Group {
    std::uint64_t has_box;      ///< A bit for each octet.
    std::uint32_t first_place;  ///< The number of boxes in all groups before.
  };

  UnsetVector<Group> groups_;
};

}  // namespace surehit::detail
