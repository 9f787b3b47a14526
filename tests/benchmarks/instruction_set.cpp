#include "instruction_set.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "support/instruction_sets.hpp"

namespace surehit::benchmark {
namespace {

/// In lower case, and AVX-512 by the name that it has outside of Highway.
std::string usual_name(std::string name) {
  constexpr std::string_view avx512 = "AVX3";
  if (name.starts_with(avx512)) name.replace(0, avx512.size(), "avx512");
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return name;
}

}  // namespace

std::vector<InstructionSet> all_instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const std::int64_t target : test::instruction_sets()) {
    sets.push_back({usual_name(test::name_of_instruction_set(target)), target});
  }
  return sets;
}

std::string instruction_set_in_effect() {
  return usual_name(test::name_of_instruction_set(hwy::SupportedAndGeneratedTargets().front()));
}

}  // namespace surehit::benchmark
