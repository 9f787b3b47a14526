#include "command_line/replays_alike.hpp"

#include <chrono>
#include <cstdio>

namespace surehit::example {

bool replays_alike(const std::vector<std::uint64_t>& hashes,
                   const std::function<std::vector<std::uint64_t>(unsigned threads)>& replay) {
  std::printf("replayed\n");
  bool are_alike = true;
  for (const unsigned threads : {1u, 2u, 8u}) {
    const auto start = std::chrono::steady_clock::now();
    const std::vector<std::uint64_t> replayed = replay(threads);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const bool is_alike = replayed == hashes;
    std::printf("  on %u thread%s %016llx, %s (%.1f s)\n", threads,
                threads == 1 ? ": " : "s:", static_cast<unsigned long long>(replayed.back()),
                is_alike ? "the same in each step" : "DIFFERENT", seconds.count());
    are_alike = are_alike && is_alike;
  }
  return are_alike;
}

}  // namespace surehit::example
