#pragma once

#include <algorithm>
#include <vector>

#include "entrants.hpp"

namespace surehit::benchmark {

/// Returns one figure for each name of an entrant: the least by `is_less` among its variants. They keep their order.
template <typename Figure, typename IsLess>
[[nodiscard]] std::vector<Figure> one_a_name(const std::vector<Figure>& figures, const IsLess& is_less) {
  std::vector<Figure> chosen;
  for (const Figure& figure : figures) {
    const auto same = std::find_if(chosen.begin(), chosen.end(), [&](const Figure& other) {
      return other.entrant->name() == figure.entrant->name();
    });
    if (same == chosen.end()) {
      chosen.push_back(figure);
    } else if (is_less(figure, *same)) {
      *same = figure;
    }
  }
  return chosen;
}

}  // namespace surehit::benchmark
