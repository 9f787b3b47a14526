#pragma once

#include <string>
#include <string_view>

namespace surehit::benchmark {

/// A picture in SVG on a white ground; x goes to the right and y down.
class SvgDrawing {
 public:
  enum class Anchor { start, middle, end };

  SvgDrawing(double width, double height);

  void add_rectangle(double x, double y, double width, double height, std::string_view colour);
  void add_line(double from_x, double from_y, double to_x, double to_y, std::string_view colour, double line_width);
  /// With its base line at y.
  void add_text(double x, double y, std::string_view text, double size, Anchor anchor, std::string_view colour);

  [[nodiscard]] std::string text() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

}  // namespace surehit::benchmark
