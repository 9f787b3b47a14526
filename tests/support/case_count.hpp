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

}  // namespace surehit::test
