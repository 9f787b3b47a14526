#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "line_of_sight/sight.hpp"

namespace surehit::example {

/// What one look around came to.
struct Figures {
  std::size_t triangles = 0;
  std::size_t points = 0;  ///< with a floor under them: one segment to each
  std::size_t visible = 0;
  std::size_t hidden = 0;
  std::size_t without_floor = 0;
  unsigned threads = 1;
  double build_seconds = 0;
  double floor_seconds = 0;
  double sight_seconds = 0;

  void count(const std::vector<Sight>& sights);
  [[nodiscard]] double segments_per_second() const { return static_cast<double>(points) / sight_seconds; }
  /// A header and a row.
  [[nodiscard]] std::string csv() const;
};

}  // namespace surehit::example
