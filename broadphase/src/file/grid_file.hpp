#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "file/file_reader.hpp"
#include "file/file_writer.hpp"
#include "grid/grid.hpp"
#include "surehit/invalid_file.hpp"
#include "surehit/scalar.hpp"

namespace surehit::detail {

/// How many elements each part of a saved grid has. FORMAT.md describes the parts.
struct GridCounts {
  std::uint32_t frames = 0;  ///< The grids: the outermost one and all inner ones.
  std::size_t cells = 0;     ///< The top cells of all grids, and the cells of all bricks.
  std::uint32_t lists = 0;   ///< The cells that have a list.
  std::size_t entries = 0;   ///< The entries of all lists.

  /// Returns the counts of a grid.
  [[nodiscard]] static GridCounts of(const Grid& grid);
};

/// The size of a record of a frame: its box and its number of top cells on each axis.
template <typename Scalar>
inline constexpr std::size_t frame_bytes = 6 * sizeof(Scalar) + 3 * sizeof(std::uint32_t);
/// The size of a record of a list: its box and its number of entries.
inline constexpr std::size_t list_bytes = 2 * sizeof(std::uint32_t);

/// Saves and loads grids. What a file does not hold follows from it: the numbers of lists and bricks, the distances
/// through empty cells, the frames, and the cover.
class GridFile {
 public:
  /// Writes the frames, the cells, the lists and the entries.
  template <typename Scalar>
  static void write(const Grid& grid, FileWriter& writer);

  /// Where the parts of a grid are in a file. `find_incomplete_list` says with it where a list is wrong.
  struct Offsets {
    std::size_t frames, cells, lists, entries;
  };
  /// Reads a grid for a mesh of so many triangles, and not none. There are as many bytes as the counts need. Returns
  /// what is wrong, or nothing. The lists may then have any entries.
  template <typename Scalar>
  [[nodiscard]] static std::optional<InvalidFile> read(FileReader& reader, const GridCounts& counts,
                                                       std::uint32_t triangles, Grid& grid, Offsets& offsets);
  /// Returns the first entry that is not a triangle's id, or not above the one before it in the list, or nothing.
  [[nodiscard]] static std::optional<InvalidFile> find_disorder(const Grid& grid, std::uint32_t triangles,
                                                                const Offsets& offsets);
};

}  // namespace surehit::detail
