#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace surehit::detail {

/// Paths as instances see them, one pair of a path and an instance in each lane. The members have the meanings of those
/// of `PlacedPath`.
struct PlacedLanes {
  static constexpr std::size_t max_lanes = 8;  ///< The number of doubles in the widest vectors of today.
  using Lanes = std::array<double, max_lanes>;

  alignas(64) std::array<Lanes, 3> start;
  std::array<Lanes, 3> direction;
  std::array<Lanes, 3> position_error;
  Lanes moved_t;
  Lanes start_error;
  Lanes direction_error;
  Lanes direction_size;
  Lanes start_size;
  Lanes reach;
  std::uint32_t beside = 0;  ///< The lanes whose path does not come near the instance.
  std::uint32_t near = 0;    ///< The lanes whose path may meet the instance. All others must be placed one by one.
};

}  // namespace surehit::detail
