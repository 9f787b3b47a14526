#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh_io/axis_view.hpp"

namespace surehit::example {

/// Cuts ears off an outline, one at a time, until a triangle is left.
///
/// Corners are indices into the outline, which passes one vertex more than once where it touches itself. An *ear* is a
/// corner c between its neighbours p and n that can go. So the triangle p c n belongs to the polygon, and holds nothing
/// of the rest of the outline. `turn` says how the outline winds as it is seen: 1 is to the left.
template <typename Scalar>
class EarClipper {
 public:
  using Point = std::array<Scalar, 3>;
  using Corners = std::array<std::uint32_t, 3>;

  EarClipper(const AxisView<Scalar>& view, const std::vector<Point>& outline, int turn);

  /// The triangles, or nothing where the outline runs out of ears.
  [[nodiscard]] std::optional<std::vector<Corners>> clip();

 private:
  /// What may go, the better kinds first.
  ///
  /// A corner that coincides with a neighbour, or at which the outline folds back over itself, can always go. The
  /// triangle has no area there, and what the outline winds round is the same without it. While there are such corners,
  /// no other is looked at: so none of their edges hides which side of it is inside.
  ///
  /// A free ear has nothing on its edges either. A touched ear has: the outline comes that far, but not into it. Last
  /// is a corner on the line between its neighbours.
  enum class Kind : std::uint8_t { fold, free_ear, touched_ear, straight, none };

  [[nodiscard]] int turn_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  [[nodiscard]] bool is_between(std::uint32_t p, std::uint32_t c, std::uint32_t n) const;
  [[nodiscard]] Kind kind_of(std::uint32_t c) const;
  [[nodiscard]] Kind kind_of_ear(std::uint32_t p, std::uint32_t c, std::uint32_t n) const;
  [[nodiscard]] std::uint32_t first_left(std::uint32_t c) const;
  [[nodiscard]] bool is_ahead(std::uint32_t from, std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool is_lined_inside(std::uint32_t p, std::uint32_t c, std::uint32_t n, std::uint32_t w) const;
  [[nodiscard]] bool is_left_of(std::uint32_t x, std::uint32_t from, std::uint32_t at, std::uint32_t to) const;
  [[nodiscard]] bool goes_the_same_way_again() const;
  void cut(std::uint32_t c);
  void cut_folds_at(std::uint32_t c);

  const AxisView<Scalar>& view_;
  const std::vector<Point>& outline_;
  int turn_;
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> by_x_;  ///< the corners that are left, and some that are not, in the order of x
  std::vector<bool> is_left_;
  std::size_t left_;
  std::vector<Corners> triangles_;
};

}  // namespace surehit::example
