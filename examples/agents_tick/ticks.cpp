#include "agents_tick/ticks.hpp"

#include <bit>
#include <chrono>

#include "agents_tick/crowd.hpp"
#include "agents_tick/town.hpp"
#include "command_line/thread_executor.hpp"

namespace surehit::example {
namespace {

/// Does some work, and adds its time.
template <typename Work>
auto timed(double& seconds, Work work) {
  const auto start = std::chrono::steady_clock::now();
  auto result = work();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace

TickReport run_ticks(const TickOptions& options) {
  const ThreadExecutor executor(options.threads);
  Town town(options.seed);
  Crowd crowd(options.agents, options.seed);
  TickReport report;
  report.instances = town.scene().instance_count();
  report.triangles = town.triangle_count();
  report.hash = 0xcbf29ce484222325u;
  const auto take = [&](std::uint64_t bits) { report.hash = (report.hash ^ bits) * 0x100000001b3u; };
  for (std::uint32_t tick = 0; tick < options.ticks; ++tick) {
    timed(report.commit_seconds, [&] {
      town.set_doors(tick, executor);
      return true;
    });
    const auto looks = timed(report.choice_seconds, [&] { return crowd.looks(options.segments); });
    const auto hidden_by = [&](std::uint32_t mask, const std::vector<Segmentf>& segments) {
      std::vector<std::uint8_t> hidden(segments.size());
      town.scene().any_hits(segments, hidden, {.options = {.instance_mask = mask}, .executor = executor});
      return hidden;
    };
    const std::vector<Segmentf> segments = crowd.segments(looks);
    const auto hidden = timed(report.sight_seconds, [&] { return hidden_by(blocks_sight, segments); });
    const auto blocked = hidden_by(blocks_movement, segments);
    report.looks += looks.size();
    for (std::size_t i = 0; i < looks.size(); ++i) {
      report.visible += hidden[i] == 0;
      report.through_glass += hidden[i] == 0 && blocked[i] != 0;
      take(hidden[i]);
    }
    report.stopped_by_glass += timed(report.walk_seconds, [&] { return crowd.walk(town, executor); });
    for (const Agent& agent : crowd.agents()) {
      for (const float x : agent.foot) take(std::bit_cast<std::uint32_t>(x));
    }
  }
  return report;
}

}  // namespace surehit::example
