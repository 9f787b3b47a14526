#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "contender.hpp"

namespace surehit::benchmark {

enum class Question { closest_hit, any_hit };

inline constexpr std::array all_questions = {Question::closest_hit, Question::any_hit};

[[nodiscard]] inline std::string name_of(Question question) {
  return question == Question::closest_hit ? "closest hit" : "any hit";
}

/// Room for what contenders answer.
struct Answers {
  explicit Answers(std::size_t paths) : hits(paths), blocked(paths) {}

  std::vector<Hitf> hits;
  std::vector<std::uint8_t> blocked;
};

inline void ask(const Contender& contender, Question question, const PathBatch& paths, Answers& answers) {
  if (question == Question::closest_hit) {
    contender.first(paths, answers.hits);
  } else {
    contender.any(paths, answers.blocked);
  }
}

}  // namespace surehit::benchmark
