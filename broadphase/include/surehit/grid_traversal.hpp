#pragma once

#include <array>
#include <cstdint>

#include "surehit/grid.hpp"
#include "surehit/path.hpp"

namespace surehit {

/// The cells that a path goes through, in the path's order.
///
/// Contract: for every triangle that the path exactly meets at some t in the range, and that `shorten` has not put out
/// of reach, a cell that lists the triangle is visited before the walk ends. The argument stands in grid_traversal.cpp;
/// it presupposes that the caller holds a FloatingPointEnvironment for as long as it walks.
class GridTraversal {
 public:
  /// Stands at the first cell, or at the end where the path misses the grid. The path is finite; [first_t, last_t] is
  /// the part of it that counts, either end possibly infinite.
  template <typename Scalar>
  GridTraversal(const Grid& grid, const Path<Scalar>& path, double first_t, double last_t) noexcept;

  /// The path is so far from the grid that it cannot be placed within the padding: it must meet all triangles, and
  /// there is no walk. From some 2^60 times the size of the mesh on.
  [[nodiscard]] bool is_unclipped() const noexcept { return unclipped_; }

  [[nodiscard]] bool at_end() const noexcept { return at_end_; }
  /// The cell where the walk stands, see `Grid::cell_index`.
  [[nodiscard]] std::size_t cell() const noexcept { return cell_; }
  /// Steps to the next cell or to the end.
  void advance() noexcept;
  /// What the path meets beyond parameter t is of no interest any more.
  void shorten(double t) noexcept;

 private:
  /// One axis of the path, base + tau rate, and of the walk.
  struct Axis {
    double base = 0;
    double rate = 0;
    double exit = 0;          ///< tau at which the cell is left on this axis
    std::uint32_t index = 0;  ///< of the cell
    std::uint32_t last = 0;   ///< cell behind which the grid ends, in the path's direction
    std::int32_t step = 0;
  };

  /// tau of the plane behind (1) or before (0) a cell, in the path's direction.
  [[nodiscard]] double crossing(std::size_t axis, std::uint32_t cell, bool behind) const noexcept;
  [[nodiscard]] bool place(std::array<std::array<double, 2>, 3> start,
                           const std::array<std::array<double, 2>, 3>& rate) noexcept;
  void enter() noexcept;
  [[nodiscard]] double tau(double t, double outward) const noexcept;

  const Grid* grid_;
  std::array<Axis, 3> axes_;
  double entry_ = 0;                         ///< tau at which the cell is entered
  double end_ = 0;                           ///< tau beyond which nothing counts
  std::array<double, 2> base_tau_ = {0, 0};  ///< tau = t 2^t_exponent - base_tau[0] - base_tau[1]
  int t_exponent_ = 0;
  std::size_t cell_ = 0;
  bool unclipped_ = false;
  bool at_end_ = true;
};

}  // namespace surehit
