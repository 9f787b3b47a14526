#include "exact_world_answers.hpp"

namespace surehit::benchmark {

std::vector<std::uint8_t> exact_world_answers(const World&, std::span<const Segmentf>) { return {}; }

}  // namespace surehit::benchmark
