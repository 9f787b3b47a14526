#include "game_physics/trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <utility>

#include "command_line/chunked_run.hpp"
#include "game_physics/wall_check.hpp"

namespace surehit::example {
namespace {

constexpr std::size_t max_trails = 24;
constexpr std::size_t max_positions = 24;

/// Draws starts. The standard's distributions differ between libraries, its engines do not.
class StartDraw {
 public:
  explicit StartDraw(std::uint64_t seed) : bits_(seed) {}

  /// A free position in the room and a velocity in any direction.
  MovingPoint draw(const Boxf& room, const WallCheck& check, float speed) {
    Vector3f position;
    do {
      for (int axis = 0; axis < 3; ++axis) {
        position[axis] = room.low[axis] + (room.high[axis] - room.low[axis]) * unit();
      }
    } while (check.is_breach(position, position));
    return {position, speed * direction()};
  }

 private:
  float unit() { return static_cast<float>(bits_() >> 40) * 0x1p-24f; }

  Vector3f direction() {
    for (;;) {
      const Vector3f v(2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1);
      const float square = v.squaredNorm();
      if (square > 0.01f && square <= 1) return v / std::sqrt(square);
    }
  }

  std::mt19937_64 bits_;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The positions around one of them.
Trail trail(const Course& course, std::size_t middle) {
  const std::size_t first = middle - std::min(middle, max_positions / 2);
  const std::size_t last = std::min(middle + max_positions, course.positions.size());
  const auto at = [&](std::size_t i) { return course.positions.begin() + static_cast<std::ptrdiff_t>(i); };
  return {{at(first), at(last)}, middle - first};
}

/// The report on one flight alone.
TrialReport report_on(const Course& course, const WallCheck& check, const Boxf& room, bool is_sample) {
  const auto start = std::chrono::steady_clock::now();
  const auto breach = check.first_breach(course.positions);
  TrialReport report;
  report.check_seconds = seconds_since(start);
  report.points = 1;
  report.steps = course.steps;
  report.bounces = course.bounces;
  report.escaped = breach ? 1 : 0;
  report.outside = room.contains(course.positions.back()) ? 0 : 1;
  report.stuck = course.is_stuck_at_start() ? 1 : 0;
  report.length_wanted = course.length_wanted;
  report.length_completed = course.length_completed;
  if (is_sample) report.trails.push_back(trail(course, 0));
  if (breach) report.escapes.push_back(trail(course, *breach));
  return report;
}

void append(std::vector<Trail>& all, std::vector<Trail>& more) {
  for (Trail& trail : more) {
    if (all.size() < max_trails) all.push_back(std::move(trail));
  }
}

void add(TrialReport& sum, TrialReport& report) {
  sum.points += report.points;
  sum.steps += report.steps;
  sum.bounces += report.bounces;
  sum.escaped += report.escaped;
  sum.outside += report.outside;
  sum.stuck += report.stuck;
  sum.length_wanted += report.length_wanted;
  sum.length_completed += report.length_completed;
  sum.flight_seconds += report.flight_seconds;
  sum.check_seconds += report.check_seconds;
  append(sum.trails, report.trails);
  append(sum.escapes, report.escapes);
}

}  // namespace

TrialReport run_trial(const std::string& title, const Arena& arena, const Sweep& sweep, const TrialOptions& options) {
  const WallCheck check(arena);
  const Flight flight(arena, sweep);
  StartDraw starts(options.seed);
  std::vector<MovingPoint> points;
  for (std::size_t i = 0; i < options.points; ++i) points.push_back(starts.draw(arena.room, check, options.speed));
  std::vector<TrialReport> reports(points.size());
  run_in_chunks(title, points.size(), 1, options.threads, [&](std::size_t i, std::size_t) {
    const auto start = std::chrono::steady_clock::now();
    const Course course = flight.fly(points[i], options.steps);
    const double flight_seconds = seconds_since(start);
    reports[i] = report_on(course, check, arena.room, i < max_trails);
    reports[i].flight_seconds = flight_seconds;
  });
  TrialReport sum;
  for (TrialReport& report : reports) add(sum, report);
  return sum;
}

}  // namespace surehit::example
