#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <string>
#include <vector>

namespace surehit::test {

/// The instruction sets that both this machine and this build have, best first: bits as Highway numbers them. Asked for
/// once, for a virtual machine is slow to tell.
[[nodiscard]] inline const std::vector<std::int64_t>& instruction_sets() {
  static const std::vector<std::int64_t> all = hwy::SupportedAndGeneratedTargets();
  return all;
}

/// For as long as it lives, the library runs on one instruction set.
class ForcedInstructionSet {
 public:
  explicit ForcedInstructionSet(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
  }
  ~ForcedInstructionSet() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(all_);
  }
  ForcedInstructionSet(const ForcedInstructionSet&) = delete;
  ForcedInstructionSet& operator=(const ForcedInstructionSet&) = delete;

 private:
  static inline const std::int64_t all_ = hwy::SupportedTargets();
};

[[nodiscard]] inline std::string name_of_instruction_set(std::int64_t target) { return hwy::TargetName(target); }

}  // namespace surehit::test
