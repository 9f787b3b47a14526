#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <surehit/path.hpp>
#include <vector>

#include "visibility_bake/pair_plan.hpp"
#include "visibility_bake/visibility.hpp"

namespace surehit::example {

/// The potentially visible sets of all cells, as a file has them. README.md has the format.
struct VisibleSets {
  std::vector<Vector3f> floors;  ///< The middle of each cell's floor.
  float range = 0;               ///< Cells that are farther apart were not asked about.
  std::uint32_t samples = 0;     ///< The number of segments for each pair of cells.
  std::string bits;              ///< The matrix, as `Visibility::matrix` has it.

  [[nodiscard]] bool sees(std::uint32_t a, std::uint32_t b) const {
    const std::size_t byte = a * ((floors.size() + 7) / 8) + b / 8;
    return (static_cast<unsigned char>(bits[byte]) >> (b % 8) & 1) != 0;
  }
};

/// The bytes of the file.
[[nodiscard]] std::string encode_visible_sets(const PairPlan& plan, const Visibility& visibility);

/// Reads the bytes of a file. Throws InputError if they are damaged.
[[nodiscard]] VisibleSets decode_visible_sets(std::string_view file);

/// The figures of each cell, in a table with a header.
[[nodiscard]] std::string figures_csv(const PairPlan& plan, const Visibility& visibility);

}  // namespace surehit::example
