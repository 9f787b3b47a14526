#include <algorithm>
#include <cmath>

#include "build_race.hpp"
#include "command_line/progress_bar.hpp"
#include "contest.hpp"
#include "size_series.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

/// What grows with the triangles.
struct Column {
  std::string contender;
  std::string paths;
  std::string measure;
  std::vector<double> figures;  ///< one a size

  [[nodiscard]] std::string header() const { return contender + ' ' + (paths.empty() ? measure : paths); }
};

/// The p for which the figures come nearest to growing as triangles^p: the slope of a straight line, fitted by least
/// squares to the logarithms.
double growth_exponent(const std::vector<double>& triangles, const std::vector<double>& figures) {
  const auto count = static_cast<double>(triangles.size());
  double x_sum = 0;
  double y_sum = 0;
  double xx_sum = 0;
  double xy_sum = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const double x = std::log(triangles[i]);
    const double y = std::log(figures[i]);
    x_sum += x;
    y_sum += y;
    xx_sum += x * x;
    xy_sum += x * y;
  }
  return (count * xy_sum - x_sum * y_sum) / (count * xx_sum - x_sum * x_sum);
}

class SizeTable {
 public:
  SizeTable(const Request& request, std::string name, Report& report)
      : request_(request), name_(std::move(name)), report_(report) {
    for (const Entrant& entrant : request.entrants) {
      const bool is_asked = entrant.name() == "surehit batch" || entrant.name() == "Embree fast medium x1";
      if (is_asked) asked_.push_back(entrant);
      if (is_asked || entrant.name() == "Embree fast low x1") built_.push_back(entrant);
    }
  }

  void measure(const NamedMesh& named) {
    const std::size_t triangles = named.mesh.triangles.size();
    triangles_.push_back(static_cast<double>(triangles));
    const std::size_t rounds = std::clamp<std::size_t>(request_.rounds * 300'000 / triangles, 1, request_.rounds);
    next_column_ = 0;
    for (const BuildResult& result : race_builds(built_, named.mesh.view(), rounds)) {
      const auto bytes = static_cast<double>(result.memory_bytes);
      add(result.entrant->library, "", "build ms", 1e6, summary_of(result.nanoseconds));
      add(result.entrant->library, "", "MB", 1e6, summary_of(bytes));
    }
    constexpr std::array sets = {PathSet::long_paths, PathSet::short_paths, PathSet::near_paths};
    std::vector<PathSample> samples;
    for (const PathSet set : sets) samples.emplace_back(set, named, request_.paths);
    std::vector<Heat> heats;
    for (const PathSample& sample : samples) heats.push_back({Question::closest_hit, &sample});
    const auto results = run_contest(asked_, named.mesh.view(), heats, rounds, [] {});
    for (std::size_t i = 0; i < sets.size(); ++i) {
      for (const Result& result : results[i]) {
        add(result.entrant->name(), name_of(sets[i]), "ns", 1, summary_of(result.nanoseconds));
      }
    }
  }

  void show() {
    std::vector<std::string> header = {"triangles"};
    for (const Column& column : columns_) header.push_back(column.header());
    MarkdownTable table(header, 1);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      std::vector<std::string> cells = {std::to_string(static_cast<std::size_t>(triangles_[i]))};
      for (const Column& column : columns_) cells.push_back(short_number(column.figures[i]));
      table.add_row(std::move(cells));
    }
    if (triangles_.size() > 1) add_exponents(table);
    report_.show("size: " + name_ + ", ns per path, closest hit", table);
  }

 private:
  /// Columns come in the same order for every size.
  void add(const std::string& contender, const std::string& paths, const std::string& measure, double unit,
           const Summary& figure) {
    if (next_column_ == columns_.size()) columns_.push_back({contender, paths, measure, {}});
    columns_[next_column_++].figures.push_back(figure.median / unit);
    report_.keep({"size", name_, static_cast<std::size_t>(triangles_.back()), paths}, contender, measure,
                 {figure.median / unit, figure.least / unit, figure.greatest / unit});
  }

  void add_exponents(MarkdownTable& table) {
    std::vector<std::string> cells = {"growth exponent"};
    for (const Column& column : columns_) {
      const double exponent = growth_exponent(triangles_, column.figures);
      cells.push_back(short_number(exponent));
      report_.keep({"size", name_, 0, column.paths}, column.contender, "growth exponent of " + column.measure,
                   summary_of(exponent));
    }
    table.add_row(std::move(cells));
  }

  const Request& request_;
  std::string name_;
  Report& report_;
  std::vector<Entrant> built_;
  std::vector<Entrant> asked_;
  std::vector<double> triangles_;
  std::vector<Column> columns_;
  std::size_t next_column_ = 0;
};

}  // namespace

void measure_sizes(const Request& request, Report& report) {
  const auto fewest = std::min_element(
      request.meshes.begin(), request.meshes.end(),
      [](const NamedMesh& x, const NamedMesh& y) { return x.mesh.triangles.size() < y.mesh.triangles.size(); });
  for (const SizeSeries& series : {level_series(request.largest), subdivision_series(*fewest, request.largest)}) {
    SizeTable table(request, series.name, report);
    example::ProgressBar bar("size, " + series.name, series.sizes.size());
    for (std::size_t i = 0; i < series.sizes.size(); ++i) {
      table.measure(series.sizes[i]());
      bar.show(i + 1);
    }
    bar.hide();
    table.show();
  }
}

}  // namespace surehit::benchmark
