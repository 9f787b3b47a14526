#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace surehit::test {

/// Ends the program as a fuzzer expects it of a wrong answer, where there is one to tell of.
inline void stop_at(const std::string& finding) {
  if (finding.empty()) return;
  std::fprintf(stderr, "\n%s\n", finding.c_str());
  std::abort();
}

}  // namespace surehit::test
