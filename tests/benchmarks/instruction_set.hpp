#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace surehit::benchmark {

struct InstructionSet {
  std::string name;     ///< "avx2"
  std::int64_t target;  ///< as Highway numbers it
};

/// Those that both this machine and this build have, best first.
[[nodiscard]] std::vector<InstructionSet> all_instruction_sets();
/// The name of the one that the library would choose now.
[[nodiscard]] std::string instruction_set_in_effect();

}  // namespace surehit::benchmark
