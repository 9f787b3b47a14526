#include "unit_times.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <surehit/collider.hpp>
#include <vector>

#include "round_series.hpp"
#include "support/random.hpp"

namespace surehit::benchmark {
namespace {

constexpr std::size_t path_count = 4096;

/// A mesh without a hit, its grid, and paths that do the same work.
struct Course {
  std::vector<Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  GridOptions grid;
  std::vector<Segmentf> paths;

  void add(const Vector3f& at, float size) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (int axis = 0; axis < 3; ++axis) vertices.push_back(at + size * Vector3f::Unit(axis));
    triangles.push_back({first, first + 1, first + 2});
  }
};

/// As many cells in a row, a speck in the corner of each, and paths along the other edge of the row.
Course row_of(std::uint32_t cells) {
  Course course;
  course.grid = {.resolution = {cells, 1, 1}, .crowded = 0};
  const auto length = static_cast<float>(cells);
  for (std::uint32_t cell = 0; cell < cells; ++cell) course.add({static_cast<float>(cell) + 0.5F, 0, 0}, 1e-3F);
  course.add({0, 1, 1}, 0);
  course.add({length, 1, 1}, 0);
  test::Random random(3);
  while (course.paths.size() < path_count) {
    const auto at = [&] { return 0.4F + 0.4F * random.unit<float>(); };
    course.paths.push_back({{1.5F, at(), at()}, {length - 1.5F, at(), at()}});
  }
  return course;
}

/// As many specks all over the only cell, and paths from side to side.
Course cell_of(std::size_t triangles) {
  Course course;
  course.grid = {.resolution = {1, 1, 1}, .crowded = 0};
  test::Random random(5);
  const auto anywhere = [&] { return Vector3f(random.unit<float>(), random.unit<float>(), random.unit<float>()); };
  while (course.triangles.size() < triangles) course.add(anywhere(), 1e-6F);
  while (course.paths.size() < path_count) {
    Vector3f start = anywhere();
    Vector3f end = anywhere();
    start[0] = 0.1F;
    end[0] = 0.9F;
    course.paths.push_back({start, end});
  }
  return course;
}

struct Work {
  double nanoseconds = 0;
  QueryStatistics counts;
};

Work work_of(const Course& course, std::size_t rounds) {
  const Colliderf collider(TriangleMeshViewf(course.vertices, course.triangles), {.grid = course.grid});
  const std::span<const Segmentf> paths(course.paths);
  std::vector<std::uint8_t> blocked(paths.size());
  Work work;
  collider.any_hits(paths, blocked, {.statistics = &work.counts});
  RoundSeries times;
  for (std::size_t round = 0; round < rounds; ++round) {
    times.push_back(nanoseconds_of<ThreadClock>([&] { collider.any_hits(paths, blocked); }));
  }
  work.nanoseconds = summary_of(times).median;
  return work;
}

/// Returns the time of a unit that one course has more of than the other, while all else is the same.
double cost_of_each(const Work& some, const Work& more, std::uint64_t QueryStatistics::*unit,
                    std::uint64_t QueryStatistics::*other) {
  if (some.counts.*other != more.counts.*other || more.counts.undecided != 0) {
    throw std::logic_error("the courses differ in more than what they measure");
  }
  return (more.nanoseconds - some.nanoseconds) / static_cast<double>(more.counts.*unit - some.counts.*unit);
}

/// Additions that wait for each other take a cycle each; one alone in a loop would wait for the branch.
double cycle_time(std::size_t rounds) {
  constexpr std::size_t additions = 1'000'000;
  RoundSeries times;
  for (std::size_t round = 0; round < rounds; ++round) {
    std::size_t sum = round;
    times.push_back(nanoseconds_of<ThreadClock>([&] {
      for (std::size_t i = 0; i < additions; i += 8) {
        for (int unrolled = 0; unrolled < 8; ++unrolled) {
          sum += i;
          asm volatile("" : "+r"(sum));  // else they would be one multiplication
        }
      }
    }));
  }
  return summary_of(times).median / static_cast<double>(additions);
}

}  // namespace

UnitTimes unit_times(std::size_t rounds) {
  const auto cells = &QueryStatistics::cells;
  const auto candidates = &QueryStatistics::candidates;
  return {cycle_time(rounds), cost_of_each(work_of(row_of(32), rounds), work_of(row_of(64), rounds), cells, candidates),
          cost_of_each(work_of(cell_of(256), rounds), work_of(cell_of(512), rounds), candidates, cells)};
}

}  // namespace surehit::benchmark
