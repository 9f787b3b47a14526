#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "surehit/box.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

/// How finely a grid divides the mesh's box. No setting changes an answer, only time and memory.
struct GridOptions {
  /// Cells along x, y and z; 0 leaves that axis to the grid, which aims at `cells_per_triangle` cubic cells in all.
  /// Whatever is asked for is made coarser where it would break the grid's budget of memory or its bound on rounding.
  std::array<std::uint32_t, 3> resolution = {0, 0, 0};
  double cells_per_triangle = 2.0;
};

/// The cells' planes, and the scaled frame of doubles in which they are counted: the mesh's box becomes [0, 1] or less
/// on each axis, whatever its size. Its bounds are derived in grid_frame.cpp.
struct GridFrame {
  int exponent = 0;                                     ///< a coordinate x stands at x 2^exponent - origin
  std::array<double, 3> origin = {0, 0, 0};             ///< the box's low corner, scaled
  std::array<double, 3> low = {0, 0, 0};                ///< first plane on each axis
  std::array<double, 3> cell_size = {0, 0, 0};          ///< distance between planes
  std::array<std::uint32_t, 3> resolution = {0, 0, 0};  ///< cells on each axis; planes are one more

  /// By which a cell's box is grown on each side when triangles are listed, in the frame's unit: under 1/16 of a cell.
  static constexpr double padding = 0x1p-32;

  /// Around a box that is not empty, with as many cells on each axis as is wished and the padding allows.
  template <typename Scalar>
  static GridFrame around(const Box<Scalar>& box, const std::array<double, 3>& wished_resolution);

  /// x 2^exponent, exactly unless it underflows (by less than 2^-1074) or overflows.
  [[nodiscard]] double scaled(double x) const noexcept;
  /// Plane `index` of an axis. Monotone in the index: a product and a sum, each rounded to nearest.
  [[nodiscard]] double plane(std::size_t axis, std::uint32_t index) const noexcept;
  /// The cell of an axis with plane(i) <= x <= plane(i + 1); the first or the last cell for an x outside.
  [[nodiscard]] std::uint32_t cell_at(std::size_t axis, double x) const noexcept;
};

/// A uniform grid over a mesh's box. Each cell lists the triangles that meet the cell's box grown by
/// `GridFrame::padding`.
///
/// Listing is conservative and as tight as clipping each triangle to the cell: it never misses one that meets the grown
/// box, and is at most rounding wider.
class Grid {
 public:
  /// No cells.
  Grid() = default;

  /// Of a valid mesh (see `find_invalid`) and its box. Counting, prefix sum, scatter; time and memory linear in the
  /// triangles, for the resolution is lowered until the lists fit their budget. May throw std::bad_alloc.
  template <typename Scalar>
  Grid(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, const GridOptions& options);

  [[nodiscard]] const GridFrame& frame() const noexcept { return frame_; }
  [[nodiscard]] const std::array<std::uint32_t, 3>& resolution() const noexcept { return frame_.resolution; }
  [[nodiscard]] std::size_t cell_count() const noexcept { return offsets_.empty() ? 0 : offsets_.size() - 1; }
  /// Entries of all cells' lists together.
  [[nodiscard]] std::size_t entry_count() const noexcept { return entries_.size(); }
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return offsets_.capacity() * sizeof(std::uint32_t) + entries_.capacity() * sizeof(std::uint32_t);
  }

  /// x fastest, then y, then z.
  [[nodiscard]] std::size_t cell_index(const std::array<std::uint32_t, 3>& cell) const noexcept {
    return (std::size_t{cell[2]} * frame_.resolution[1] + cell[1]) * frame_.resolution[0] + cell[0];
  }
  /// Ids of the triangles that a cell lists, ascending.
  [[nodiscard]] std::span<const std::uint32_t> triangles(std::size_t cell) const noexcept {
    return {entries_.data() + offsets_[cell], entries_.data() + offsets_[cell + 1]};
  }

 private:
  template <typename Scalar>
  bool try_list(const TriangleMeshView<Scalar>& mesh, std::size_t entry_budget);

  GridFrame frame_;
  std::vector<std::uint32_t> offsets_;  ///< where each cell's list begins, and one more for the end
  std::vector<std::uint32_t> entries_;
};

}  // namespace surehit
