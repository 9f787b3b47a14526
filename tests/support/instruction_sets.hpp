#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <string>
#include <vector>

namespace surehit::test {

/// The instruction sets that both this machine and this build have, best first: bits as Highway numbers them.
[[nodiscard]] inline std::vector<std::int64_t> instruction_sets() { return hwy::SupportedAndGeneratedTargets(); }

/// For as long as it lives, the library runs on one instruction set.
class ForcedInstructionSet {
 public:
  explicit ForcedInstructionSet(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~ForcedInstructionSet() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ForcedInstructionSet(const ForcedInstructionSet&) = delete;
  ForcedInstructionSet& operator=(const ForcedInstructionSet&) = delete;
};

[[nodiscard]] inline std::string name_of_instruction_set(std::int64_t target) { return hwy::TargetName(target); }

}  // namespace surehit::test
