#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "grid/grid.hpp"
#include "support/random.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

using ExactPoint = std::array<mpq_class, 3>;
using ExactPolygon = std::vector<ExactPoint>;

/// x 2^exponent
[[nodiscard]] mpq_class scaled_exactly(double x, int exponent);
/// The exact position of a point, or of a triangle's corners, counted in finest cells.
template <typename Scalar>
[[nodiscard]] ExactPoint in_frame(const GridFrame& frame, const Vector3<Scalar>& point);
template <typename Scalar>
[[nodiscard]] ExactPolygon in_frame(const GridFrame& frame, const Triangle<Scalar>& triangle);

/// The coordinate in mesh units of `place`, as near as a double comes.
[[nodiscard]] double out_of_frame(const GridFrame& frame, std::size_t axis, double place);

/// In the plane z = 0, from a corner of finest cells in the direction of whole numbers up to 4: where cells are
/// squares, through many more corners, as near as rounding comes.
template <typename Scalar>
[[nodiscard]] Line<Scalar> line_through_corners(const GridFrame& frame, Random& random);

/// By how many finest cells a box is grown on each side of an axis.
using Growth = std::array<double, 3>;
/// A share of the grid's width on each axis, and as many cells more on all of them.
[[nodiscard]] Growth growth_by(const GridFrame& frame, double share, double more_cells = 0);

/// A box, closed, in finest cells.
struct ExactBox {
  ExactPoint low;
  ExactPoint high;

  [[nodiscard]] ExactBox grown(const Growth& growth) const;
};

/// What lies between two parallel planes, closed: along the normal, counted in finest cells.
struct ExactSlab {
  ExactPoint normal;
  mpq_class low;
  mpq_class high;

  [[nodiscard]] mpq_class height_of(const ExactPoint& point) const;
  /// By as much as a box is that is grown on each axis.
  [[nodiscard]] ExactSlab grown(const Growth& growth) const;
};

/// A cell that is not divided.
struct LeafCell {
  std::array<std::uint32_t, 3> low;  ///< in finest cells
  std::uint32_t size;
  CellWord word;

  [[nodiscard]] ExactBox box() const;
  /// What its list, which is not empty, takes up of it.
  [[nodiscard]] ExactBox listed_box(const Grid& grid) const;
  /// Where such a slab is in this cell.
  [[nodiscard]] ExactSlab placed(CellSlab slab) const;
};

/// All cells of a grid's frame that are not divided: they fill it without overlap.
class LeafCells {
 public:
  /// Takes those of the outermost frame.
  explicit LeafCells(const Grid& grid) : LeafCells(grid, grid.frame()) {}
  LeafCells(const Grid& grid, const GridFrame& frame);

  [[nodiscard]] std::size_t size() const { return leaves_.size(); }
  [[nodiscard]] const LeafCell& operator[](std::size_t leaf) const { return leaves_[leaf]; }
  [[nodiscard]] auto begin() const { return leaves_.begin(); }
  [[nodiscard]] auto end() const { return leaves_.end(); }

  /// The leaf with this low corner.
  [[nodiscard]] std::optional<std::size_t> at(const std::array<std::uint32_t, 3>& low) const;
  /// Leaves, ascending, that the convex polygon meets when they are grown.
  [[nodiscard]] std::vector<std::size_t> met_by(const ExactPolygon& polygon, const Growth& growth) const;

 private:
  void add(const Grid& grid, CellWord word, const std::array<std::uint32_t, 3>& low, std::uint32_t size);

  std::vector<LeafCell> leaves_;
  std::map<std::array<std::uint32_t, 3>, std::size_t> by_low_;
};

/// The ids in a cell's list and in its inner grid, if it has one, ascending and each once. The cell is not empty.
[[nodiscard]] std::vector<std::uint32_t> triangles_in(const Grid& grid, CellWord word);

/// The part of a convex polygon that lies in the box.
[[nodiscard]] ExactPolygon part_in(const ExactBox& box, const ExactPolygon& polygon);
/// Whether a convex polygon meets the box.
[[nodiscard]] bool meets_box(const ExactPolygon& polygon, const ExactBox& box);

/// Whether the path, between two parameters, meets the box. The parameters may be infinite.
template <typename Scalar>
[[nodiscard]] bool meets_box(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t,
                             const ExactBox& box);
/// The same of the box's part in the slab.
template <typename Scalar>
[[nodiscard]] bool meets_part_in_slab(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t,
                                      const ExactBox& box, const ExactSlab& slab);

}  // namespace surehit::test
