#include "svg_drawing.hpp"

#include <array>
#include <cstdio>
#include <initializer_list>
#include <utility>

namespace surehit::benchmark {
namespace {

using Attribute = std::pair<std::string_view, double>;

std::string element(std::string_view name, std::initializer_list<Attribute> attributes) {
  std::string text("<");
  text += name;
  for (const auto& [key, value] : attributes) {
    std::array<char, 32> number;
    std::snprintf(number.data(), number.size(), "%.1f", value);
    text.append(" ").append(key).append("=\"").append(number.data()).append("\"");
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char letter : text) {
    if (letter == '&') {
      safe += "&amp;";
    } else if (letter == '<') {
      safe += "&lt;";
    } else {
      safe += letter;
    }
  }
  return safe;
}

}  // namespace

SvgDrawing::SvgDrawing(double width, double height)
    : text_(element("svg xmlns=\"http://www.w3.org/2000/svg\" font-family=\"sans-serif\"",
                    {{"width", width}, {"height", height}}) +
            ">\n") {
  add_rectangle(0, 0, width, height, "#ffffff");
}

void SvgDrawing::add_rectangle(double x, double y, double width, double height, std::string_view colour) {
  text_ += element("rect", {{"x", x}, {"y", y}, {"width", width}, {"height", height}});
  text_.append(" fill=\"").append(colour).append("\"/>\n");
}

void SvgDrawing::add_line(double from_x, double from_y, double to_x, double to_y, std::string_view colour,
                          double line_width) {
  text_ += element("line", {{"x1", from_x}, {"y1", from_y}, {"x2", to_x}, {"y2", to_y}, {"stroke-width", line_width}});
  text_.append(" stroke=\"").append(colour).append("\"/>\n");
}

void SvgDrawing::add_text(double x, double y, std::string_view text, double size, Anchor anchor,
                          std::string_view colour) {
  constexpr std::array anchors = {"start", "middle", "end"};
  text_ += element("text", {{"x", x}, {"y", y}, {"font-size", size}});
  text_.append(" text-anchor=\"").append(anchors[static_cast<std::size_t>(anchor)]);
  text_.append("\" fill=\"").append(colour).append("\">").append(escaped(text)).append("</text>\n");
}

}  // namespace surehit::benchmark
