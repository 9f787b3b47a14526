#include "mesh/octet_places.hpp"

namespace surehit::detail {

void OctetPlaces::reset(std::size_t octets) { groups_.assign((octets + group_size - 1) / group_size, Group{}); }

void OctetPlaces::add(std::size_t first, std::size_t count) noexcept {
  for (std::size_t octet = first; octet < first + count; ++octet) {
    groups_[octet / group_size].has_box |= std::uint64_t{1} << octet % group_size;
  }
}

std::size_t OctetPlaces::number() noexcept {
  std::size_t boxes = 0;
  for (Group& group : groups_) {
    group.first_place = static_cast<std::uint32_t>(boxes);
    boxes += static_cast<std::size_t>(std::popcount(group.has_box));
  }
  return boxes;
}

}  // namespace surehit::detail
