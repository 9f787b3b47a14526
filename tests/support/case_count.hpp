#pragma once

#include <cstddef>
#include <cstdlib>

namespace surehit::test {

/// `full`, or the share of it that SUREHIT_TEST_PERCENT asks for (at least 1): sanitized builds run a twentieth of the
/// cases.
inline std::size_t case_count(std::size_t full) {
  const char* percent = std::getenv("SUREHIT_TEST_PERCENT");
  if (percent == nullptr) return full;
  const std::size_t share = full * static_cast<std::size_t>(std::strtoul(percent, nullptr, 10)) / 100;
  return share == 0 ? 1 : share;
}

/// Whether nothing is left out: only then does a search come as close to a bound as it is said to.
inline bool runs_all_cases() { return case_count(100) >= 100; }

/// Whether so few are asked for, as with sanitizers, that fixed cases are too many.
inline bool runs_few_cases() { return case_count(100) < 10; }

/// The step from one fixed case to the next, such as the bytes of a file: 1, or 5 where few are asked for.
inline std::size_t case_step() { return runs_few_cases() ? 5 : 1; }

}  // namespace surehit::test
