#include "visibility_bake/bake_picture.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <string>
#include <surehit/box.hpp>
#include <vector>

namespace surehit::example {
namespace {

constexpr Colour paper = Colour::hex(0x12161f);
constexpr Colour ink = Colour::hex(0xe8ebf2);
constexpr Colour seen = Colour::hex(0xffd98a);
constexpr Colour hidden = Colour::hex(0x3b4763);
constexpr Colour out_of_range = Colour::hex(0x1f2635);
constexpr Colour eye = Colour::hex(0xe5383b);
constexpr float margin = 20;
constexpr float legend_height = 44;
constexpr float plan_width = 760;

/// From nothing to all: dark blue, blue, green and light yellow.
Colour colour_of_share(float share) {
  constexpr std::array<Colour, 4> stops = {Colour::hex(0x232050), Colour::hex(0x28688c), Colour::hex(0x35b277),
                                           Colour::hex(0xf6ec62)};
  const float place = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(stops.size() - 1);
  const std::size_t stop = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  return mix(stops[stop], stops[stop + 1], place - static_cast<float>(stop));
}

/// Where the cells are on the canvas.
class CellView {
 public:
  explicit CellView(const PairPlan& plan) : plan_(plan) {
    for (const Vector3f& floor : plan.floors()) box_.extend(floor);
    const float cell = plan.options().cell_width;
    box_.low -= Vector3f::Constant(cell / 2);
    box_.high += Vector3f::Constant(cell / 2);
    // Far from the origin, half of a cell may be nothing.
    const Vector3f size = (box_.high - box_.low).cwiseMax(cell);
    scale_ = std::min(plan_width / size.x(), 900 / size.y());
    half_cell_ = std::max(0.75f, scale_ * cell / 2 - 0.5f);
    order_.resize(plan.cell_count());
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::stable_sort(order_, {}, [&](std::uint32_t cell_id) { return plan.floors()[cell_id].z(); });
  }

  [[nodiscard]] float width() const { return scale_ * (box_.high - box_.low).x(); }
  [[nodiscard]] float height() const { return scale_ * (box_.high - box_.low).y(); }
  [[nodiscard]] Spot spot(std::uint32_t cell, float left) const {
    const Vector3f& floor = plan_.floors()[cell];
    return {left + scale_ * (floor.x() - box_.low.x()), margin + scale_ * (box_.high.y() - floor.y())};
  }
  /// Draws the cells from the lowest to the highest, each in a colour.
  template <typename ColourOf>
  void draw(Canvas& canvas, float left, ColourOf colour_of) const {
    for (const std::uint32_t cell : order_) {
      const Spot middle = spot(cell, left);
      canvas.draw_rectangle({middle.x - half_cell_, middle.y - half_cell_},
                            {middle.x + half_cell_, middle.y + half_cell_}, colour_of(cell));
    }
  }

 private:
  const PairPlan& plan_;
  Boxf box_;
  float scale_ = 1;
  float half_cell_ = 1;
  std::vector<std::uint32_t> order_;
};

void draw_legend_of_shares(Canvas& canvas, float left, float top) {
  constexpr int ramp = 140;
  for (int x = 0; x < ramp; ++x) {
    const float from = left + static_cast<float>(x);
    canvas.draw_rectangle({from, top}, {from + 1, top + 14}, colour_of_share(static_cast<float>(x) / (ramp - 1)));
  }
  canvas.draw_text({left + ramp + 12, top + 3}, "share of the cells in range that a cell sees, 0 to 1", 1.5f, ink);
}

void draw_legend_of_cell(Canvas& canvas, float left, float top, const std::string& caption) {
  const auto entry = [&](const Colour& colour, const char* name) {
    canvas.draw_rectangle({left, top}, {left + 14, top + 14}, colour);
    left = canvas.draw_text({left + 20, top + 3}, name, 1.5f, ink) + 24;
  };
  entry(seen, "seen");
  entry(hidden, "not seen");
  entry(out_of_range, "out of range");
  canvas.draw_text({left, top + 3}, caption, 1.5f, ink);
}

}  // namespace

Canvas draw_bake(const PairPlan& plan, const Visibility& visibility, std::uint32_t shown) {
  const CellView view(plan);
  const float width = std::max(view.width(), 620.0f);
  const float right = 2 * margin + width;
  Canvas canvas(static_cast<int>(right + width + margin), static_cast<int>(view.height() + margin + legend_height),
                paper);
  view.draw(canvas, margin, [&](std::uint32_t cell) {
    const Visibility::Figures& figures = visibility.figures(cell);
    const auto in_range = static_cast<float>(std::max(figures.cells_in_range, std::uint64_t{1}));
    return colour_of_share(static_cast<float>(figures.cells_seen) / in_range);
  });
  const float range = plan.options().range;
  view.draw(canvas, right, [&](std::uint32_t cell) {
    if (visibility.sees(shown, cell)) return seen;
    const bool is_in_range = (plan.floors()[cell] - plan.floors()[shown]).squaredNorm() <= range * range;
    return is_in_range ? hidden : out_of_range;
  });
  canvas.draw_disc(view.spot(shown, right), 7, ink);
  canvas.draw_disc(view.spot(shown, right), 5, eye);

  const float top = static_cast<float>(canvas.height()) - legend_height + 16;
  draw_legend_of_shares(canvas, margin, top);
  char caption[64];
  std::snprintf(caption, sizeof caption, "cell %u sees %zu cells", shown,
                static_cast<std::size_t>(visibility.figures(shown).cells_seen));
  draw_legend_of_cell(canvas, right, top, caption);
  return canvas;
}

}  // namespace surehit::example
