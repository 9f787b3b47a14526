#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace surehit::benchmark {

struct InstructionSet {
  std::string name;     ///< "avx2"
  std::int64_t target;  ///< as Highway numbers it
};

/// Those that both this machine and this build have, best first, or the one that is forced: surehit runs on the first.
[[nodiscard]] std::vector<InstructionSet> all_instruction_sets();

}  // namespace surehit::benchmark
