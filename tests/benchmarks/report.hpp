#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "markdown_table.hpp"
#include "round_series.hpp"

namespace surehit::benchmark {

/// What a figure was measured on. A part that says nothing is empty.
struct Place {
  std::string table;
  std::string mesh;
  std::size_t triangles = 0;
  std::string paths = "";
  std::string question = "";
};

struct Record {
  Place place;
  std::string contender;
  std::string measure;
  Summary figure;
};

/// Shows tables as they come, and keeps every figure for files.
class Report {
 public:
  /// The instruction set is that which surehit runs on.
  explicit Report(std::string instruction_set) : instruction_set_(std::move(instruction_set)) {}

  void show(const std::string& title, const MarkdownTable& table) const;
  void keep(const Place& place, const std::string& contender, const std::string& measure, const Summary& figure) {
    records_.push_back({place, contender, measure, figure});
  }

  [[nodiscard]] std::span<const Record> records() const { return records_; }
  [[nodiscard]] std::string csv() const;

 private:
  std::string instruction_set_;
  std::vector<Record> records_;
};

}  // namespace surehit::benchmark
