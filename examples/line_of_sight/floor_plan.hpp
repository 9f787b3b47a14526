#pragma once

#include <cstddef>
#include <surehit/collider.hpp>
#include <vector>

namespace surehit::example {

/// The floor under the points of a regular grid in the plan of a mesh, as an architect draws it: what lies below the
/// height of the cut.
class FloorPlan {
 public:
  /// A grid over the mesh's box that is just fine enough for `wanted` of its points to have a floor. A point has one if
  /// a ray down from the cut's height first meets a triangle from its front: what is met from behind encloses the
  /// point. Throws std::runtime_error if there is no floor, or so little of it that the grid would grow beyond all
  /// measure.
  FloorPlan(const Colliderf& collider, float cut_height, std::size_t wanted, unsigned threads);

  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] const Boxf& box() const { return box_; }

  /// Grid points, along x first.
  [[nodiscard]] std::size_t size() const { return heights_.size(); }
  [[nodiscard]] float x(std::size_t index) const;
  [[nodiscard]] float y(std::size_t index) const;
  [[nodiscard]] bool has_floor(std::size_t index) const;
  [[nodiscard]] float floor_height(std::size_t index) const { return heights_[index]; }
  /// How many grid points have a floor.
  [[nodiscard]] std::size_t floor_count() const;

 private:
  void divide(std::size_t points);

  Boxf box_;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<float> heights_;  ///< NaN where there is no floor
};

}  // namespace surehit::example
