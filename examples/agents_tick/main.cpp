#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "agents_tick/ticks.hpp"
#include "command_line/program.hpp"

namespace surehit::example {
namespace {

struct Request {
  TickOptions ticks{.threads = std::clamp(std::thread::hardware_concurrency(), 1u, 1024u)};
  std::vector<std::size_t> segments = {10'000, 100'000};
};

void describe(CLI::App& app, Request& request) {
  app.add_option("--agents", request.ticks.agents, "Agents that look and walk")
      ->check(CLI::Range(std::size_t{2}, std::size_t{100'000}).description(""))
      ->capture_default_str();
  app.add_option("--segments", request.segments, "Lines of sight in a tick, for each run")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}).description(""))
      ->capture_default_str();
  app.add_option("--ticks", request.ticks.ticks, "Ticks of a run, 16 a second")
      ->check(CLI::Range(1u, 1'000'000u).description(""))
      ->capture_default_str();
  app.add_option("--seed", request.ticks.seed, "Of the town and the agents")->capture_default_str();
  app.add_option("--threads", request.ticks.threads,
                 "Threads that share a batch; the answers are the same for any number")
      ->check(CLI::Range(1u, 1024u).description(""))
      ->capture_default_str();
  app.footer("Exit status: 0, 2 for bad usage, 1 for other failures.");
}

void print(const TickOptions& options, const TickReport& report) {
  const auto a_tick = [&](double sum) { return sum / options.ticks; };
  const auto milliseconds = [&](double seconds) { return 1000 * a_tick(seconds); };
  std::printf("%zu agents, %u ticks, %.0f lines of sight a tick against %zu instances with %zu triangles\n",
              options.agents, options.ticks, a_tick(static_cast<double>(report.looks)), report.instances,
              report.triangles);
  std::printf("  visible          %zu of %zu, %zu of them through glass or a railing\n", report.visible, report.looks,
              report.through_glass);
  std::printf("  stopped by these %zu times\n", report.stopped_by_glass);
  std::printf("  hash             %016llx\n", static_cast<unsigned long long>(report.hash));
  std::printf("  a tick, in ms    %.3f for sight, %.3f for steps, %.3f for doors and commit, %.3f to choose targets\n",
              milliseconds(report.sight_seconds), milliseconds(report.walk_seconds),
              milliseconds(report.commit_seconds), milliseconds(report.choice_seconds));
}

Work describe_program(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  describe(app, *request);
  return [request] {
    for (const std::size_t segments : request->segments) {
      request->ticks.segments = segments;
      print(request->ticks, run_ticks(request->ticks));
    }
    return success;
  };
}

}  // namespace
}  // namespace surehit::example

int main(int argc, char** argv) {
  return surehit::example::run_program("agents_tick", "Lets agents look around and walk in a town.", argc, argv,
                                       surehit::example::describe_program);
}
