#pragma once

#include <cstddef>

namespace surehit::test {

/// The most bytes that operator new had out at a time since `begin_peak_memory`, beyond those of then. Of one thread.
void begin_peak_memory();
[[nodiscard]] std::size_t peak_memory();

}  // namespace surehit::test
