#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace surehit::example {

/// A colour as sRGB shows it, each part in [0, 1].
struct Colour {
  float red = 0;
  float green = 0;
  float blue = 0;

  /// As style sheets write it: 0xRRGGBB.
  [[nodiscard]] static constexpr Colour hex(std::uint32_t rgb) {
    return {static_cast<float>(rgb >> 16 & 255) / 255, static_cast<float>(rgb >> 8 & 255) / 255,
            static_cast<float>(rgb & 255) / 255};
  }
};

[[nodiscard]] Colour mix(const Colour& a, const Colour& b, float share_of_b);

/// A position on the canvas in pixels, x to the right and y down. Pixel centres lie at halves.
struct Spot {
  float x = 0;
  float y = 0;
};

/// A picture to draw on. Edges are smoothed by the share of the pixel that a shape covers; what lies outside is cut
/// off.
class Canvas {
 public:
  Canvas(int width, int height, const Colour& background);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// The pixel at column x and row y, both in range.
  [[nodiscard]] Colour& at(int x, int y) {
    return pixels_[static_cast<std::size_t>(y) * width_size() + static_cast<std::size_t>(x)];
  }
  [[nodiscard]] const Colour& at(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * width_size() + static_cast<std::size_t>(x)];
  }

  void draw_line(const Spot& from, const Spot& to, float line_width, const Colour& colour, float opacity = 1);
  void draw_disc(const Spot& centre, float radius, const Colour& colour, float opacity = 1);
  void draw_rectangle(const Spot& low, const Spot& high, const Colour& colour, float opacity = 1);
  /// A convex polygon, its corners in either order around it.
  void draw_convex(std::span<const Spot> corners, const Colour& colour, float opacity = 1);
  /// One line of ASCII text with the top left corner of its first letter at a spot; letters are 7 `scale` pixels high.
  /// Returns the x at which it ends.
  float draw_text(const Spot& top_left, std::string_view text, float scale, const Colour& colour);

 private:
  /// The pixels whose centres lie within a box, cut to the canvas.
  struct Range {
    int low_x, high_x, low_y, high_y;
  };

  [[nodiscard]] std::size_t width_size() const { return static_cast<std::size_t>(width_); }
  [[nodiscard]] Range range(float low_x, float high_x, float low_y, float high_y) const;
  void blend(int x, int y, const Colour& colour, float coverage);

  int width_;
  int height_;
  std::vector<Colour> pixels_;
};

}  // namespace surehit::example
