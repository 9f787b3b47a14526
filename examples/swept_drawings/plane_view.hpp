#pragma once

#include <string_view>
#include <surehit/swept_shape.hpp>
#include <vector>

#include "picture/canvas.hpp"

namespace surehit::example {

inline constexpr int drawing_width = 1280;

// The colours that all drawings of moving shapes have.
inline constexpr Colour night = Colour::hex(0x10141d);
inline constexpr Colour ink = Colour::hex(0xe8ebf2);
inline constexpr Colour dim = Colour::hex(0x8b93a5);
inline constexpr Colour free_colour = Colour::hex(0x43d9a3);
inline constexpr Colour touching_colour = Colour::hex(0xff5d5d);

/// A plane of the world on a canvas, x to the right and y up.
struct PlaneView {
  Spot origin;      ///< Where (0, 0) is, in pixels.
  float scale = 1;  ///< The pixels of a unit.

  [[nodiscard]] Spot spot(float x, float y) const { return {origin.x + scale * x, origin.y - scale * y}; }
};

/// A closed convex line in the plane.
using Outline = std::vector<Spot>;

/// Returns the outline of a shape with its centre at a place, as one sees it along y. Up is z.
[[nodiscard]] Outline outline_from_the_side(const SweptShapef& shape, const Vector3f& centre, const PlaneView& view);

/// Draws an outline, and fills it by a share of the colour.
void draw_outline(Canvas& canvas, const Outline& outline, const Colour& colour, float filled, float line_width);

/// Draws an arrow.
void draw_arrow(Canvas& canvas, const Spot& from, const Spot& to, const Colour& colour);

/// Draws a line of dashes.
void draw_dashes(Canvas& canvas, const Spot& from, const Spot& to, const Colour& colour);

/// Draws a line of text with its middle at a spot.
void draw_centred(Canvas& canvas, const Spot& middle, std::string_view text, float scale, const Colour& colour);

}  // namespace surehit::example
