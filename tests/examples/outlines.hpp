#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "place.hpp"
#include "support/random.hpp"

namespace surehit::test {

/// The corners of a polygon in the plane, in whole numbers. Those drawn here wind to the left.
using Outline = std::vector<Place>;

/// Returns the corners as text, for messages.
[[nodiscard]] std::string text_of(const Outline& outline);

/// No corner is on another edge, nor where another corner is. Corners between their neighbours on a line are possible.
[[nodiscard]] Outline draw_star(std::size_t corner_count, std::int64_t radius, Random& random);
[[nodiscard]] Outline draw_comb(std::size_t tooth_count, Random& random);
[[nodiscard]] Outline draw_spiral(std::size_t turn_count);
[[nodiscard]] Outline draw_untangled(std::size_t corner_count, std::int64_t size, Random& random);
[[nodiscard]] Outline draw_letter(Random& random);
[[nodiscard]] Outline draw_convex(std::size_t point_count, std::int64_t size, Random& random);
/// Any of the above.
[[nodiscard]] Outline draw_simple(Random& random);

/// The outer rim of squares that share edges. It may touch itself where corners coincide.
[[nodiscard]] Outline draw_rim_of_squares(std::size_t square_count, Random& random);

/// A wall with windows. Each window is joined to the wall, or to another window, by a bridge that is walked both ways.
/// A bridge may bend, and several may share a corner. Where they may touch, windows touch each other and the wall with
/// corners.
[[nodiscard]] Outline draw_wall(std::size_t window_count, bool may_touch, Random& random);

/// Polygons outside of each other, joined by bridges as well: these are walked both ways where there is no polygon.
[[nodiscard]] Outline draw_islands(std::size_t island_count, Random& random);

/// Touches itself in any way that does not cross: corners on corners and on edges, edges on edges, some of them many
/// times. It is a simple polygon whose corners crowd round few places, each of them moved to its place.
[[nodiscard]] Outline draw_crowded(std::size_t corner_count, std::int64_t size, Random& random);

/// Places on edges become corners. All coordinates grow by the factor.
[[nodiscard]] Outline with_corners_on_edges(const Outline& outline, std::int64_t factor, Random& random);
/// Some corners are there twice or three times in a row.
[[nodiscard]] Outline with_repeated_corners(const Outline& outline, Random& random);
/// Some edges are walked back a part of the way, and on again. All coordinates grow by four.
[[nodiscard]] Outline with_folded_edges(const Outline& outline, Random& random);
/// Slits into the polygon and antennas out of it, a point far and back, which may branch. All coordinates grow by four.
[[nodiscard]] Outline with_spikes(const Outline& outline, std::size_t count, Random& random);

}  // namespace surehit::test
