#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace surehit::example {

/// Replays a run on 1, 2 and 8 threads, and prints a line for each. `hashes` are those of the run, one for each step,
/// and `replay` returns those of a replay. Returns true if all of them are the same.
[[nodiscard]] bool replays_alike(const std::vector<std::uint64_t>& hashes,
                                 const std::function<std::vector<std::uint64_t>(unsigned threads)>& replay);

}  // namespace surehit::example
