#pragma once

#include <array>
#include <string>
#include <vector>

#include "contest.hpp"
#include "judgement.hpp"
#include "report.hpp"
#include "request.hpp"

namespace surehit::benchmark {

/// What was measured on one mesh and path set.
struct ContestRow {
  Place place;
  std::array<std::vector<Result>, all_questions.size()> results;
  Judgement judgement;

  [[nodiscard]] const std::vector<Result>& results_of(Question question) const {
    return results[static_cast<std::size_t>(question)];
  }
};

/// For each mesh and path set that is requested. The entrants must live as long as the rows, which point to them.
[[nodiscard]] std::vector<ContestRow> measure_rows(const std::string& table, const std::vector<Entrant>& entrants,
                                                   const Request& request);

}  // namespace surehit::benchmark
