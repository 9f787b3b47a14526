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

/// One of the bars of each path set.
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

/// What all meshes have in common: the minimum, the maximum and the geometric mean of their ratios.
struct Range {
  double min, max, mean;
};

Range range_of(const std::vector<double>& ratios) {
  double logarithms = 0;
  for (const double ratio : ratios) logarithms += std::log2(ratio);
  const auto [min, max] = std::minmax_element(ratios.begin(), ratios.end());
  return {*min, *max, std::exp2(logarithms / static_cast<double>(ratios.size()))};
}

/// A panel for each question (down), a group of bars for each path set, ratios on a logarithmic scale. A bar goes from
/// the worst mesh to the best one, with a tick at the mean.
class RatioChart {
 public:
  RatioChart(std::vector<Bar> bars, std::string machine)
      : bars_(std::move(bars)),
        machine_(std::move(machine)),
        sets_(values_of(bars_, &Place::paths)),
        questions_(values_of(bars_, &Place::question)),
        meshes_(values_of(bars_, &Place::mesh).size()),
        panel_width_(static_cast<double>(sets_.size()) * group_width),
        drawing_(left + panel_width_ + gap, top + static_cast<double>(questions_.size()) * (panel_height + gap)) {
    const auto [min, max] = std::minmax_element(bars_.begin(), bars_.end(), [](const Bar& x, const Bar& y) {
      return x.record->figure.median < y.record->figure.median;
    });
    low_ = std::min(-1.0, std::floor(std::log2(min->record->figure.median)));
    high_ = std::max(1.0, std::ceil(std::log2(max->record->figure.median)));
  }

  [[nodiscard]] std::string draw() {
    draw_legend();
    for (std::size_t question = 0; question < questions_.size(); ++question) {
      draw_panel(question);
      for (std::size_t set = 0; set < sets_.size(); ++set) {
        for (std::size_t kind = 0; kind < bar_kinds.size(); ++kind) draw_bar(question, set, kind);
      }
    }
    return drawing_.text();
  }

 private:
  static constexpr double left = 60;
  static constexpr double top = 140;
  static constexpr double gap = 48;
  static constexpr double panel_height = 300;
  static constexpr double bar_width = 28;
  static constexpr double group_width = bar_width * (bar_kinds.size() + 0.6);

  [[nodiscard]] static double panel_y(std::size_t question) {
    return top + static_cast<double>(question) * (panel_height + gap);
  }
  /// How far a ratio is below the top of its panel.
  [[nodiscard]] double depth(double ratio) const { return panel_height * (high_ - std::log2(ratio)) / (high_ - low_); }

  void draw_legend() {
    drawing_.add_text(left, 26,
                      "How many times as long Embree takes (above 1 surehit is faster), from the worst of " +
                          std::to_string(meshes_) + " meshes to the best, with the mean",
                      16, Anchor::start, ink);
    if (!machine_.empty()) drawing_.add_text(left, 46, machine_, 12, Anchor::start, ink);
    for (std::size_t kind = 0; kind < bar_kinds.size(); ++kind) {
      const double y = 66 + 18 * static_cast<double>(kind);
      drawing_.add_rectangle(left, y - 10, 12, 12, bar_kinds[kind].colour);
      drawing_.add_text(left + 20, y, bar_kinds[kind].label, 12, Anchor::start, ink);
    }
  }

  void draw_panel(std::size_t question) {
    const double y = panel_y(question);
    drawing_.add_text(left, y - 8, questions_[question], 13, Anchor::start, ink);
    for (double tick = low_; tick <= high_; ++tick) {
      const double line = y + depth(std::exp2(tick));
      drawing_.add_line(left, line, left + panel_width_, line, tick == 0 ? ink : faint, tick == 0 ? 1.5 : 1);
      const std::string label = tick < 0 ? "1/" + short_whole(std::exp2(-tick)) : short_whole(std::exp2(tick));
      drawing_.add_text(left - 6, line + 4, label, 11, Anchor::end, ink);
    }
    for (std::size_t set = 0; set < sets_.size(); ++set) {
      const double middle = left + (static_cast<double>(set) + 0.5) * group_width;
      drawing_.add_text(middle, y + panel_height + 14, sets_[set], 11, Anchor::middle, ink);
    }
  }

  void draw_bar(std::size_t question, std::size_t set, std::size_t kind) {
    std::vector<double> ratios;
    for (const Bar& bar : bars_) {
      const Place& place = bar.record->place;
      if (bar.kind == kind && place.question == questions_[question] && place.paths == sets_[set]) {
        ratios.push_back(bar.record->figure.median);
      }
    }
    if (ratios.empty()) return;
    const Range range = range_of(ratios);
    const double x = left + static_cast<double>(set) * group_width + (0.3 + static_cast<double>(kind)) * bar_width;
    const double y = panel_y(question);
    const double tip = y + depth(range.max);
    const double foot = y + depth(range.min);
    const double mean = y + depth(range.mean);
    drawing_.add_rectangle(x + 1, tip, bar_width - 2, std::max(foot - tip, 1.0), bar_kinds[kind].colour);
    drawing_.add_line(x + 1, mean, x + bar_width - 1, mean, ink, 2);
    drawing_.add_text(x + bar_width / 2, tip - 3, short_number(range.max), 10, Anchor::middle, ink);
    drawing_.add_text(x + bar_width / 2, foot + 11, short_number(range.min), 10, Anchor::middle, ink);
  }

  static std::string short_whole(double number) { return std::to_string(static_cast<long>(number)); }

  std::vector<Bar> bars_;
  std::string machine_;
  std::vector<std::string> sets_;
  std::vector<std::string> questions_;
  std::size_t meshes_;
  double panel_width_;
  SvgDrawing drawing_;
  double low_;  ///< powers of two at the panels' ends
  double high_;
};

}  // namespace

std::string ratio_chart(std::span<const Record> records, const std::string& machine) {
  std::vector<Bar> bars = bars_of(records);
  if (bars.empty()) throw std::runtime_error("the chart shows ratios over Embree in table queries: none was measured");
  return RatioChart(std::move(bars), machine).draw();
}

}  // namespace surehit::benchmark
