#pragma once

#include <surehit/box.hpp>

#include "picture/canvas.hpp"

namespace surehit::example {

/// Oblique projection of a room: x to the right, z up, and y away to the upper right.
class ObliqueView {
 public:
  /// A view as wide as this, in pixels, with its upper edge at `top`.
  ObliqueView(const Boxf& room, float width, float top);

  [[nodiscard]] Spot spot(const Vector3f& point) const;
  /// A corner of the room: each number is 0 or 1.
  [[nodiscard]] Spot corner(int right, int back, int up) const;
  [[nodiscard]] float height() const { return height_; }

 private:
  static constexpr float right_per_depth = 0.3f;
  static constexpr float up_per_depth = 0.22f;
  static constexpr float border = 1;  ///< of the room, in its own unit

  Boxf room_;
  float top_;
  float scale_;
  float height_;
};

/// Draws the walls behind all that is in the room.
void draw_back_of_room(Canvas& canvas, const ObliqueView& view);
/// Draws the edges in front of it.
void draw_front_of_room(Canvas& canvas, const ObliqueView& view);

}  // namespace surehit::example
