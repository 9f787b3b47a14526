#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "support/instruction_sets.hpp"

namespace surehit::test {

template <typename Check>
void on_every_instruction_set(const Check& check) {
  ASSERT_FALSE(instruction_sets().empty());
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    SCOPED_TRACE(name_of_instruction_set(target));
    check();
  }
}

}  // namespace surehit::test
