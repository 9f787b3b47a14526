// Draws moving shapes and triangles of the families in any number, and holds every answer against `swept_truth`: exact
// roots in integers, and rationals about boxes. Where asked to, it holds them against CGAL too, and those about balls
// and capsules against rationals and long floats.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "command_line/program.hpp"
#include "crosscheck/cgal_box_oracle.hpp"
#include "crosscheck/cgal_capsule_oracle.hpp"
#include "crosscheck/cgal_sphere_oracle.hpp"
#include "support/capsule_oracle.hpp"
#include "support/case_count.hpp"
#include "support/shape_families.hpp"
#include "support/shape_text.hpp"
#include "support/sphere_oracle.hpp"
#include "support/swept_truth.hpp"
#include "support/wrong_answers.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test {
namespace {

struct Request {
  std::uint64_t pairs = 0;
  std::string shape = "sphere";
  std::vector<std::string> families;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  bool in_double = false;
  bool confirm = false;
};

struct Counts {
  std::uint64_t pairs = 0;
  std::uint64_t hits = 0;
  std::uint64_t starts = 0;  ///< hits at the start
  std::uint64_t findings = 0;

  Counts& operator+=(const Counts& more) {
    pairs += more.pairs;
    hits += more.hits;
    starts += more.starts;
    findings += more.findings;
    return *this;
  }
};

/// The finding's text, if there is one.
template <typename Shape, typename Scalar>
std::string check(const Shape& shape, const Triangle<Scalar>& triangle, bool confirm, Counts& counts) {
  const SweptTruth truth = truth_of(shape, triangle);
  const std::optional<ShapeHit<Scalar>> answer = intersect(shape, triangle);
  ++counts.pairs;
  counts.hits += truth.touches;
  counts.starts += truth.starts_touching;

  std::string finding;
  const auto tell = [&](const std::optional<std::string>& error) {
    if (error) finding += '\n' + *error;
  };
  tell(find_error(truth, answer));
  if (confirm) {
    constexpr bool is_box = std::is_same_v<Shape, SweptBox<Scalar>>;
    tell(cgal_error(shape, triangle, answer));
    // About a box, this would be the truth's own oracle.
    if constexpr (!is_box) tell(find_error(shape, triangle, answer));
    for (const auto& wrong : wrong_answers(answer)) {
      if (!find_error(truth, wrong)) tell("the first oracle lets a wrong answer pass");
      // CGAL finds the touched point of a box. It is told the part that a ball or a capsule touches, and two contacts
      // may have the same rounded t.
      if (is_box && !cgal_error(shape, triangle, wrong)) tell("CGAL lets a wrong answer pass");
    }
  }
  if (finding.empty()) return finding;
  ++counts.findings;
  return hex_text(shape) + '\n' + hex_text(triangle) + finding +
         "\nanswered: " + (answer ? hex_text(*answer) : "a miss") + '\n';
}

/// Returns the families that are asked for, or all of them.
template <typename Family>
std::vector<Family> chosen_families(const Request& request) {
  std::vector<std::string> names;
  for (const Family family : all_families<Family>) names.push_back(name_of(family));
  for (const std::string& chosen : request.families) {
    if (std::find(names.begin(), names.end(), chosen) == names.end()) {
      throw CLI::ValidationError("--family", chosen + " not in {" + CLI::detail::join(names) + "}");
    }
  }
  std::vector<Family> families;
  for (const Family family : all_families<Family>) {
    const auto& chosen = request.families;
    if (chosen.empty() || std::find(chosen.begin(), chosen.end(), name_of(family)) != chosen.end())
      families.push_back(family);
  }
  return families;
}

/// Each thread takes the next chunk, which has a seed of its own: what is drawn does not depend on the threads.
template <typename Family, typename Scalar>
class ShapeRun {
 public:
  explicit ShapeRun(const Request& request) : request_(request) {}

  [[nodiscard]] const std::vector<Family>& families() const { return families_; }

  /// Returns the counts of each family.
  std::vector<Counts> run() {
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < request_.threads; ++i) threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    return counts_;
  }

 private:
  void work() {
    const std::uint64_t chunk = families_.size() * 256;
    std::vector<Counts> counts(families_.size());
    for (;;) {
      const std::uint64_t first = next_.fetch_add(chunk);
      if (first >= request_.pairs) break;
      Random random(Random(request_.seed).bits() + first);
      for (std::uint64_t i = first; i < std::min(first + chunk, request_.pairs); ++i) {
        const std::size_t family = i % families_.size();
        const auto [shape, triangle] = draw_shape_pair<Scalar>(families_[family], random);
        tell(check(shape, triangle, request_.confirm, counts[family]));
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
  const std::vector<Family> families_ = chosen_families<Family>(request_);
  std::atomic<std::uint64_t> next_ = 0;
  std::mutex mutex_;
  std::vector<Counts> counts_ = std::vector<Counts>(families_.size());
};

void print_row(const char* name, const Counts& counts) {
  std::printf("%-22s", name);
  for (const std::uint64_t count : {counts.pairs, counts.hits, counts.starts, counts.findings}) {
    std::printf(" %13llu", static_cast<unsigned long long>(count));
  }
  std::printf("\n");
}

template <typename Run>
example::ExitStatus run(const Request& request) {
  const auto start = std::chrono::steady_clock::now();
  Run all_pairs(request);
  const std::vector<Counts> counts = all_pairs.run();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;

  std::printf("%-22s %13s %13s %13s %13s\n", "family", "pairs", "hits", "at the start", "findings");
  Counts all;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    print_row(name_of(all_pairs.families()[i]).c_str(), counts[i]);
    all += counts[i];
  }
  print_row("all", all);
  std::printf("%.1f s, %.0f pairs a second\n", seconds.count(), static_cast<double>(all.pairs) / seconds.count());
  return all.findings == 0 ? example::success : example::failure;
}

template <typename Family>
example::ExitStatus run_in(const Request& request) {
  return request.in_double ? run<ShapeRun<Family, double>>(request) : run<ShapeRun<Family, float>>(request);
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
               "Ask CGAL and rationals about every pair as well, and the oracles about wrong answers");
  app.add_option("--shape", request->shape, "What moves")
      ->check(CLI::IsMember({"sphere", "box", "capsule"}))
      ->capture_default_str();
  app.add_option("--family", request->families, "Only these families of the shape");
  return [request] {
    request->pairs = case_count(request->pairs);
    if (request->shape == "box") return run_in<BoxFamily>(*request);
    if (request->shape == "capsule") return run_in<CapsuleFamily>(*request);
    return run_in<SphereFamily>(*request);
  };
}

}  // namespace
}  // namespace surehit::test

int main(int argc, char** argv) {
  return surehit::example::run_program("fuzz_shapes", "Holds answers about drawn shapes against exact oracles.", argc,
                                       argv, surehit::test::describe);
}
