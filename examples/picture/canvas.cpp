#include "picture/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "picture/text_shape.hpp"

namespace surehit::example {
namespace {

/// How much of a pixel lies within an edge that passes its centre at this distance, positive inside.
float covered(float distance) { return std::clamp(distance + 0.5f, 0.0f, 1.0f); }

}  // namespace

Colour mix(const Colour& a, const Colour& b, float share_of_b) {
  return {a.red + share_of_b * (b.red - a.red), a.green + share_of_b * (b.green - a.green),
          a.blue + share_of_b * (b.blue - a.blue)};
}

Canvas::Canvas(int width, int height, const Colour& background)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

Canvas::Range Canvas::range(float low_x, float high_x, float low_y, float high_y) const {
  // Clamped before the conversion: a shape may lie anywhere.
  const auto cut = [](float x, int size) { return static_cast<int>(std::clamp(x, 0.0f, static_cast<float>(size))); };
  return {cut(std::floor(low_x), width_), cut(std::ceil(high_x), width_), cut(std::floor(low_y), height_),
          cut(std::ceil(high_y), height_)};
}

void Canvas::blend(int x, int y, const Colour& colour, float coverage) {
  Colour& pixel = at(x, y);
  pixel = mix(pixel, colour, coverage);
}

void Canvas::draw_line(const Spot& from, const Spot& to, float line_width, const Colour& colour, float opacity) {
  const float radius = line_width / 2;
  const float reach = radius + 1;
  const float dx = to.x - from.x;
  const float dy = to.y - from.y;
  const float length_squared = dx * dx + dy * dy;
  const Range rows = range(0, 0, std::min(from.y, to.y) - reach, std::max(from.y, to.y) + reach);
  for (int y = rows.low_y; y < rows.high_y; ++y) {
    const float centre_y = static_cast<float>(y) + 0.5f;
    // Only where the line passes this row, or a long slanting line would cost the whole box around it.
    const auto share_at = [&](float row) { return std::clamp((row - from.y) / dy, 0.0f, 1.0f); };
    const float first = dy == 0 ? 0 : share_at(centre_y - 2 * reach);
    const float last = dy == 0 ? 1 : share_at(centre_y + 2 * reach);
    const auto [low, high] = std::minmax({from.x + first * dx, from.x + last * dx});
    const Range columns = range(low - reach, high + reach, 0, 0);
    for (int x = columns.low_x; x < columns.high_x; ++x) {
      const float px = static_cast<float>(x) + 0.5f - from.x;
      const float py = centre_y - from.y;
      const float share = length_squared == 0 ? 0 : std::clamp((px * dx + py * dy) / length_squared, 0.0f, 1.0f);
      const float distance = std::hypot(px - share * dx, py - share * dy);
      blend(x, y, colour, opacity * std::min(covered(radius - distance), line_width));
    }
  }
}

void Canvas::draw_disc(const Spot& centre, float radius, const Colour& colour, float opacity) {
  const float reach = radius + 1;
  const Range box = range(centre.x - reach, centre.x + reach, centre.y - reach, centre.y + reach);
  for (int y = box.low_y; y < box.high_y; ++y) {
    for (int x = box.low_x; x < box.high_x; ++x) {
      const float distance =
          std::hypot(static_cast<float>(x) + 0.5f - centre.x, static_cast<float>(y) + 0.5f - centre.y);
      blend(x, y, colour, opacity * covered(radius - distance));
    }
  }
}

void Canvas::draw_rectangle(const Spot& low, const Spot& high, const Colour& colour, float opacity) {
  const std::array<Spot, 4> corners = {low, {high.x, low.y}, high, {low.x, high.y}};
  draw_convex(corners, colour, opacity);
}

void Canvas::draw_convex(std::span<const Spot> corners, const Colour& colour, float opacity) {
  float twice_area = 0;
  Spot low = corners.front();
  Spot high = corners.front();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Spot& here = corners[i];
    const Spot& next = corners[(i + 1) % corners.size()];
    twice_area += here.x * next.y - next.x * here.y;
    low = {std::min(low.x, here.x), std::min(low.y, here.y)};
    high = {std::max(high.x, here.x), std::max(high.y, here.y)};
  }
  const float turn = twice_area < 0 ? -1.0f : 1.0f;
  const Range box = range(low.x - 1, high.x + 1, low.y - 1, high.y + 1);
  for (int y = box.low_y; y < box.high_y; ++y) {
    for (int x = box.low_x; x < box.high_x; ++x) {
      float coverage = 1;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Spot& here = corners[i];
        const Spot& next = corners[(i + 1) % corners.size()];
        const float dx = next.x - here.x;
        const float dy = next.y - here.y;
        const float cross = dx * (static_cast<float>(y) + 0.5f - here.y) - dy * (static_cast<float>(x) + 0.5f - here.x);
        const float length = std::hypot(dx, dy);
        if (length > 0) coverage = std::min(coverage, covered(turn * cross / length));
      }
      if (coverage > 0) blend(x, y, colour, opacity * coverage);
    }
  }
}

float Canvas::draw_text(const Spot& top_left, std::string_view text, float scale, const Colour& colour) {
  float end = top_left.x;
  for (const TextStroke& stroke : text_shape(text)) {
    const Spot high = {top_left.x + scale * stroke.high_x, top_left.y + scale * stroke.high_y};
    draw_rectangle({top_left.x + scale * stroke.low_x, top_left.y + scale * stroke.low_y}, high, colour);
    end = std::max(end, high.x);
  }
  return end;
}

}  // namespace surehit::example
