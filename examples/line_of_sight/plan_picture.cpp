#include "line_of_sight/plan_picture.hpp"

#include <algorithm>
#include <cmath>

namespace surehit::example {
namespace {

constexpr Colour paper = Colour::hex(0x12161f);
constexpr Colour near_light = Colour::hex(0xfff1c9);
constexpr Colour far_light = Colour::hex(0xf2b661);
constexpr Colour shadow = Colour::hex(0x3b4763);
constexpr Colour solid = Colour::hex(0x1a2030);
constexpr Colour outline = Colour::hex(0x0b0e15);
constexpr Colour eye_colour = Colour::hex(0xe5383b);
constexpr Colour ink = Colour::hex(0xe8ebf2);

constexpr int margin = 24;
constexpr int legend_width = 1440;
constexpr int legend_height = 56;

/// Where the plan lies on the canvas.
class PlanView {
 public:
  explicit PlanView(const Boxf& box) : box_(box) {
    const Vector3f size = box.high - box.low;
    scale_ = std::min(1552 / size.x(), 1200 / size.y());
    width_ = std::max(1, static_cast<int>(std::lround(scale_ * size.x())));
    height_ = std::max(1, static_cast<int>(std::lround(scale_ * size.y())));
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Spot spot(float x, float y) const {
    return {margin + scale_ * (x - box_.low.x()), margin + scale_ * (box_.high.y() - y)};
  }

 private:
  Boxf box_;
  float scale_;
  int width_;
  int height_;
};

/// Light from the upper left: slopes that face it are brighter.
float relief(const FloorPlan& plan, std::size_t index) {
  const std::size_t column = index % plan.columns();
  if (column == 0 || index < plan.columns()) return 1;
  const float here = plan.floor_height(index);
  const float step_x = plan.x(index) - plan.x(index - 1);
  const float step_y = plan.y(index) - plan.y(index - plan.columns());
  const float rise = (here - plan.floor_height(index - 1)) / step_x;
  const float climb = (here - plan.floor_height(index - plan.columns())) / step_y;
  const float light = 0.25f * (rise - climb);
  return std::isnan(light) ? 1 : 1 + std::clamp(light, -0.2f, 0.2f);
}

Colour colour_of(const FloorPlan& plan, std::size_t index, Sight sight, const Vector3f& eye) {
  if (sight == Sight::no_floor) return solid;
  const float reach = (plan.box().high - plan.box().low).head<2>().norm() / 2;
  const float distance = std::hypot(plan.x(index) - eye.x(), plan.y(index) - eye.y());
  const Colour base = sight == Sight::visible ? mix(near_light, far_light, std::min(1.0f, distance / reach)) : shadow;
  const float light = relief(plan, index);
  return {light * base.red, light * base.green, light * base.blue};
}

void draw_sights(Canvas& canvas, const PlanView& view, const FloorPlan& plan, const std::vector<Sight>& sights,
                 const Vector3f& eye) {
  std::vector<Colour> colours(plan.size());
  for (std::size_t i = 0; i < plan.size(); ++i) colours[i] = colour_of(plan, i, sights[i], eye);
  /// The grid point before a pixel's centre and how far the next one is away, where neither lies outside.
  struct Blend {
    std::size_t first, second;
    float share;
  };
  const auto blend_at = [](int pixel, int pixels, std::size_t count) {
    const float at = (static_cast<float>(pixel) + 0.5f) / static_cast<float>(pixels) * static_cast<float>(count) - 0.5f;
    const float inside = std::clamp(at, 0.0f, static_cast<float>(count - 1));
    const auto first = static_cast<std::size_t>(inside);
    return Blend{first, std::min(first + 1, count - 1), inside - static_cast<float>(first)};
  };
  for (int y = 0; y < view.height(); ++y) {
    const Blend row = blend_at(view.height() - 1 - y, view.height(), plan.rows());
    for (int x = 0; x < view.width(); ++x) {
      const Blend column = blend_at(x, view.width(), plan.columns());
      const auto along = [&](std::size_t r) {
        return mix(colours[r * plan.columns() + column.first], colours[r * plan.columns() + column.second],
                   column.share);
      };
      canvas.at(margin + x, margin + y) = mix(along(row.first), along(row.second), row.share);
    }
  }
}

/// Draws the lines in which a level plane cuts the triangles.
void draw_cut(Canvas& canvas, const PlanView& view, const Mesh<float>& mesh, float height) {
  for (const auto& triangle : mesh.triangles) {
    std::array<Spot, 2> ends;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& p = mesh.vertices[triangle[i]];
      const auto& q = mesh.vertices[triangle[(i + 1) % 3]];
      if ((p[2] < height) == (q[2] < height)) continue;
      const float s = (height - p[2]) / (q[2] - p[2]);
      ends[count++] = view.spot(p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]));
    }
    if (count == 2) canvas.draw_line(ends[0], ends[1], 1.75f, outline);
  }
}

void draw_eye(Canvas& canvas, const Spot& eye) {
  canvas.draw_disc(eye, 13, outline, 0.35f);
  canvas.draw_disc(eye, 11, ink);
  canvas.draw_disc(eye, 8.5f, eye_colour);
  canvas.draw_disc(eye, 3, ink);
}

void draw_legend(Canvas& canvas, const std::string& caption) {
  const auto top = static_cast<float>(canvas.height() - legend_height);
  float x = margin;
  const auto entry = [&](const Colour& swatch, std::string_view name) {
    canvas.draw_rectangle({x, top + 10}, {x + 20, top + 30}, ink, 0.5f);
    canvas.draw_rectangle({x + 1, top + 11}, {x + 19, top + 29}, swatch);
    x = canvas.draw_text({x + 30, top + 13}, name, 2, ink) + 40;
  };
  entry(mix(near_light, far_light, 0.3f), "visible");
  entry(shadow, "hidden");
  entry(solid, "wall or rock, cut at eye height");
  canvas.draw_disc({x + 10, top + 20}, 10, ink);
  canvas.draw_disc({x + 10, top + 20}, 8, eye_colour);
  x = canvas.draw_text({x + 30, top + 13}, "eye", 2, ink) + 40;
  canvas.draw_text({x, top + 13}, caption, 2, ink);
}

}  // namespace

Canvas draw_plan(const Mesh<float>& mesh, const FloorPlan& plan, const std::vector<Sight>& sights, const Vector3f& eye,
                 const std::string& caption) {
  const PlanView view(plan.box());
  Canvas canvas(std::max(view.width() + 2 * margin, legend_width), view.height() + margin + legend_height, paper);
  draw_sights(canvas, view, plan, sights, eye);
  draw_cut(canvas, view, mesh, eye.z());
  draw_eye(canvas, view.spot(eye.x(), eye.y()));
  draw_legend(canvas, caption);
  return canvas;
}

}  // namespace surehit::example
