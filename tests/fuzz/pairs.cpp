// Draws pairs of the families in any number, and holds every answer against an exact oracle in integers; where asked
// to, against rationals and CGAL too.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "command_line/program.hpp"
#include "crosscheck/pair_judge.hpp"
#include "narrowphase.hpp"
#include "support/case_count.hpp"
#include "support/integer_oracle.hpp"
#include "support/neighbour.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"

namespace surehit::test {
namespace {

struct Request {
  std::uint64_t pairs = 0;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  bool in_double = false;
  bool confirm = false;
};

struct Counts {
  std::uint64_t pairs = 0;
  std::uint64_t hits = 0;
  std::uint64_t exact = 0;  ///< took the library's exact stage, to decide or to round
  std::uint64_t findings = 0;

  Counts& operator+=(const Counts& more) {
    pairs += more.pairs;
    hits += more.hits;
    exact += more.exact;
    findings += more.findings;
    return *this;
  }
};

using CountsOfFamilies = std::array<Counts, all_pair_families.size()>;

/// What `intersect` does, which keeps the statistics to itself.
template <typename Scalar>
std::optional<Hit<Scalar>> answer_of(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                     QueryStatistics& statistics) {
  const QueryOptions<Scalar> options;
  const detail::PathRange<Scalar> range(path, options);
  const detail::Narrowphase<Scalar> narrowphase(path, options, range, statistics);
  detail::Candidate<Scalar> candidate{0, triangle, {}};
  if (!narrowphase.find_contact(triangle, candidate.contact)) return std::nullopt;
  return narrowphase.hit(candidate);
}

/// Whether an answer that is wrong in one field, by as little as can be, passes for right.
template <typename Scalar>
bool passes_wrong(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const std::optional<Hit<Scalar>>& right) {
  const auto accepts = [&](const std::optional<Hit<Scalar>>& wrong) { return is_right(path, triangle, wrong); };
  if (!right) return accepts(Hit<Scalar>{.triangle = 0});
  if (accepts(std::nullopt)) return true;
  for (Scalar Hit<Scalar>::*field : {&Hit<Scalar>::t, &Hit<Scalar>::u, &Hit<Scalar>::v}) {
    for (const int steps : {-1, 1}) {
      Hit<Scalar> wrong = *right;
      wrong.*field = neighbour(wrong.*field, steps);
      if (accepts(wrong)) return true;
    }
  }
  Hit<Scalar> wrong = *right;
  wrong.side = wrong.side == Side::front ? Side::back : Side::front;
  return accepts(wrong);
}

/// The finding's text, if there is one.
template <typename Scalar>
std::string check(const Path<Scalar>& path, const Triangle<Scalar>& triangle, bool confirm, Counts& counts) {
  QueryStatistics statistics;
  const std::optional<Hit<Scalar>> answer = answer_of(path, triangle, statistics);
  ++counts.pairs;
  counts.hits += answer.has_value();
  counts.exact += statistics.exact_decisions + statistics.exact_roundings > 0;

  std::string finding;
  if (!is_right(path, triangle, answer)) finding = "\nanswered: " + (answer ? hex_text(*answer) : "a miss");
  if (confirm) {
    if (passes_wrong(path, triangle, answer)) finding += "\nthe integers let a wrong answer pass";
    finding += judge_pair(path, triangle, {}).difference;
  }
  if (finding.empty()) return finding;
  ++counts.findings;
  return hex_text(path) + '\n' + hex_text(triangle) + finding + '\n';
}

/// Each thread takes the next chunk, which has a seed of its own: what is drawn does not depend on the threads.
template <typename Scalar>
class PairRun {
 public:
  explicit PairRun(const Request& request) : request_(request) {}

  CountsOfFamilies run() {
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < request_.threads; ++i) threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    return counts_;
  }

 private:
  static constexpr std::uint64_t chunk = 15 * 1024;

  void work() {
    CountsOfFamilies counts;
    for (;;) {
      const std::uint64_t first = next_.fetch_add(chunk);
      if (first >= request_.pairs) break;
      Random random(Random(request_.seed).bits() + first);
      for (std::uint64_t i = first; i < std::min(first + chunk, request_.pairs); ++i) {
        const std::size_t family = i % all_pair_families.size();
        const auto [segment, triangle] = draw_pair<Scalar>(all_pair_families[family], random);
        const Path<Scalar> path = path_along(segment, static_cast<PathKind>(random.below(3)));
        tell(check(path, triangle, request_.confirm, counts[family]));
      }
    }
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < counts.size(); ++i) counts_[i] += counts[i];
  }

  void tell(const std::string& finding) {
    if (finding.empty()) return;
    const std::lock_guard lock(mutex_);
    std::fprintf(stderr, "%s\n", finding.c_str());
  }

  const Request& request_;
  std::atomic<std::uint64_t> next_ = 0;
  std::mutex mutex_;
  CountsOfFamilies counts_;
};

void print_row(const char* name, const Counts& counts) {
  const auto print = [](std::uint64_t count) { std::printf(" %13llu", static_cast<unsigned long long>(count)); };
  std::printf("%-22s", name);
  for (const std::uint64_t count : {counts.pairs, counts.hits, counts.exact, counts.findings}) {
    print(count);
  }
  std::printf("\n");
}

example::ExitStatus run(const Request& request) {
  const auto start = std::chrono::steady_clock::now();
  const CountsOfFamilies counts = request.in_double ? PairRun<double>(request).run() : PairRun<float>(request).run();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;

  std::printf("%-22s %13s %13s %13s %13s\n", "family", "pairs", "hits", "exact stage", "findings");
  Counts all;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    print_row(name_of(all_pair_families[i]).c_str(), counts[i]);
    all += counts[i];
  }
  print_row("all", all);
  std::printf("%.1f s, %.0f pairs a second\n", seconds.count(), static_cast<double>(all.pairs) / seconds.count());
  return all.findings == 0 ? example::success : example::failure;
}

example::Work describe(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  app.add_option("--pairs", request->pairs, "How many; SUREHIT_TEST_PERCENT asks for a share of them")->required();
  app.add_option("--seed", request->seed, "Each draws other pairs")->capture_default_str();
  app.add_option("--threads", request->threads, "Threads that share them; they change nothing that is drawn")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--double", request->in_double, "In double instead of float");
  app.add_flag("--confirm", request->confirm,
               "Ask the rationals and CGAL about every pair as well, and the integers about wrong answers");
  return [request] {
    request->pairs = case_count(request->pairs);
    return run(*request);
  };
}

}  // namespace
}  // namespace surehit::test

int main(int argc, char** argv) {
  return surehit::example::run_program("fuzz_pairs", "Holds answers about drawn pairs against exact oracles.", argc,
                                       argv, surehit::test::describe);
}
