#include "ratio_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "svg_drawing.hpp"

namespace surehit::benchmark {
namespace {

using Anchor = SvgDrawing::Anchor;

constexpr std::string_view ink = "#222222";
constexpr std::string_view faint = "#dddddd";

/// One of the bars of each mesh.
struct BarKind {
  const char* contender;
  const char* measure;
  const char* label;
  const char* colour;
};

constexpr std::array bar_kinds = {
    BarKind{"Embree fast medium x1", "over surehit batch", "surehit's batches against Embree's single rays", "#1b6ca8"},
    BarKind{"Embree fast medium x8", "over surehit batch", "surehit's batches against Embree's packets of 8",
            "#7fb7de"},
    BarKind{"Embree fast medium x1", "over surehit single", "surehit's single paths against Embree's single rays",
            "#e08e2b"},
};

struct Bar {
  const Record* record;
  std::size_t kind;
};

std::vector<Bar> bars_of(std::span<const Record> records) {
  std::vector<Bar> bars;
  for (const Record& record : records) {
    for (std::size_t kind = 0; kind < bar_kinds.size(); ++kind) {
      if (record.place.table == "queries" && record.contender == bar_kinds[kind].contender &&
          record.measure == bar_kinds[kind].measure) {
        bars.push_back({&record, kind});
      }
    }
  }
  return bars;
}

/// The values of one part of the places, each once, in their order.
std::vector<std::string> values_of(const std::vector<Bar>& bars, std::string Place::*part) {
  std::vector<std::string> values;
  for (const Bar& bar : bars) {
    const std::string& value = bar.record->place.*part;
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

std::size_t index_in(const std::vector<std::string>& values, const std::string& value) {
  return static_cast<std::size_t>(std::find(values.begin(), values.end(), value) - values.begin());
}

/// A panel for each path set (down) and question (across), a group of bars for each mesh, ratios on a logarithmic
/// scale.
class RatioChart {
 public:
  explicit RatioChart(std::vector<Bar> bars)
      : bars_(std::move(bars)),
        meshes_(values_of(bars_, &Place::mesh)),
        sets_(values_of(bars_, &Place::paths)),
        questions_(values_of(bars_, &Place::question)),
        panel_width_(static_cast<double>(meshes_.size()) * group_width),
        drawing_(left + static_cast<double>(questions_.size()) * (panel_width_ + gap),
                 top + static_cast<double>(sets_.size()) * (panel_height + gap)) {
    const auto [least, greatest] = std::minmax_element(bars_.begin(), bars_.end(), [](const Bar& x, const Bar& y) {
      return x.record->figure.median < y.record->figure.median;
    });
    low_ = std::min(-1.0, std::floor(std::log2(least->record->figure.median)));
    high_ = std::max(1.0, std::ceil(std::log2(greatest->record->figure.median)));
  }

  [[nodiscard]] std::string draw() {
    draw_legend();
    for (std::size_t set = 0; set < sets_.size(); ++set) {
      for (std::size_t question = 0; question < questions_.size(); ++question) draw_panel(set, question);
    }
    for (const Bar& bar : bars_) draw_bar(bar);
    return drawing_.text();
  }

 private:
  static constexpr double left = 60;
  static constexpr double top = 120;
  static constexpr double gap = 48;
  static constexpr double panel_height = 150;
  static constexpr double bar_width = 28;
  static constexpr double group_width = bar_width * (bar_kinds.size() + 0.6);

  [[nodiscard]] double panel_x(std::size_t question) const {
    return left + static_cast<double>(question) * (panel_width_ + gap);
  }
  [[nodiscard]] static double panel_y(std::size_t set) { return top + static_cast<double>(set) * (panel_height + gap); }
  /// How far a ratio is below the top of its panel.
  [[nodiscard]] double depth(double ratio) const { return panel_height * (high_ - std::log2(ratio)) / (high_ - low_); }

  void draw_legend() {
    drawing_.add_text(left, 26, "How many times as long Embree takes (above 1 surehit is faster)", 16, Anchor::start,
                      ink);
    for (std::size_t kind = 0; kind < bar_kinds.size(); ++kind) {
      const double y = 46 + 18 * static_cast<double>(kind);
      drawing_.add_rectangle(left, y - 10, 12, 12, bar_kinds[kind].colour);
      drawing_.add_text(left + 20, y, bar_kinds[kind].label, 12, Anchor::start, ink);
    }
  }

  void draw_panel(std::size_t set, std::size_t question) {
    const double x = panel_x(question);
    const double y = panel_y(set);
    drawing_.add_text(x, y - 8, sets_[set] + " paths, " + questions_[question], 13, Anchor::start, ink);
    for (double tick = low_; tick <= high_; ++tick) {
      const double line = y + depth(std::exp2(tick));
      drawing_.add_line(x, line, x + panel_width_, line, tick == 0 ? ink : faint, tick == 0 ? 1.5 : 1);
      const std::string label = tick < 0 ? "1/" + short_whole(std::exp2(-tick)) : short_whole(std::exp2(tick));
      drawing_.add_text(x - 6, line + 4, label, 11, Anchor::end, ink);
    }
    for (std::size_t mesh = 0; mesh < meshes_.size(); ++mesh) {
      const double middle = x + (static_cast<double>(mesh) + 0.5) * group_width;
      drawing_.add_text(middle, y + panel_height + 14, meshes_[mesh], 11, Anchor::middle, ink);
    }
  }

  void draw_bar(const Bar& bar) {
    const Place& place = bar.record->place;
    const double ratio = bar.record->figure.median;
    const double x = panel_x(index_in(questions_, place.question)) +
                     static_cast<double>(index_in(meshes_, place.mesh)) * group_width +
                     (0.3 + static_cast<double>(bar.kind)) * bar_width;
    const double y = panel_y(index_in(sets_, place.paths));
    const double tip = y + depth(ratio);
    const double one = y + depth(1);
    drawing_.add_rectangle(x + 1, std::min(tip, one), bar_width - 2, std::abs(tip - one), bar_kinds[bar.kind].colour);
    drawing_.add_text(x + bar_width / 2, ratio < 1 ? one - 4 : tip - 3, short_number(ratio), 10, Anchor::middle, ink);
  }

  static std::string short_whole(double number) { return std::to_string(static_cast<long>(number)); }

  std::vector<Bar> bars_;
  std::vector<std::string> meshes_;
  std::vector<std::string> sets_;
  std::vector<std::string> questions_;
  double panel_width_;
  SvgDrawing drawing_;
  double low_;  ///< powers of two at the panels' ends
  double high_;
};

}  // namespace

std::string ratio_chart(std::span<const Record> records) {
  std::vector<Bar> bars = bars_of(records);
  if (bars.empty()) throw std::runtime_error("the chart shows ratios over Embree in table queries: none was measured");
  return RatioChart(std::move(bars)).draw();
}

}  // namespace surehit::benchmark
