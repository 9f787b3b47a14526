#include "character/crowd_walk.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <random>

#include "character/mind.hpp"
#include "command_line/chunked_run.hpp"

namespace surehit::example {
namespace {

constexpr std::uint32_t rounds_to_be_stuck = 8;
constexpr double deep = 0.05;
/// The centre of a body on the gallery, and one on the floor of the house.
constexpr float gallery = 2.25f + Body::radius + Body::half_height;
constexpr float ground_floor = Body::radius + Body::half_height;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// FNV-1a over the bits of all characters.
std::uint64_t hash_of(std::span<const Character> characters) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto take = [&hash](std::uint32_t bits) { hash = (hash ^ bits) * 0x100000001b3u; };
  for (const Character& character : characters) {
    for (const float x : character.position) take(std::bit_cast<std::uint32_t>(x));
    take(std::bit_cast<std::uint32_t>(character.fall_speed));
    take(character.is_standing);
  }
  return hash;
}

/// What is known of one character besides where it is.
struct Life {
  explicit Life(std::uint32_t seed) : mind(seed) {}

  Mind mind;
  bool has_touched = false;
  bool was_deep = false;
  bool is_lost = false;
  bool was_stuck = false;
  bool was_low = false;
  bool has_climbed = false;
  WalkCounts counts;
};

bool is_lost(const Vector3f& position) { return !position.allFinite() || position.z() < -20; }

void note_state(Life& life, const Vector3f& position) {
  life.is_lost = is_lost(position);
  life.was_stuck = life.was_stuck || life.mind.failed_rounds() >= rounds_to_be_stuck;
  const bool is_in_hall = position.x() > 27 && position.x() < 46 && position.y() > 18 && position.y() < 38;
  life.was_low = life.was_low || (is_in_hall && std::abs(position.z() - ground_floor) < 0.125f);
  life.has_climbed = life.has_climbed || (life.was_low && is_in_hall && std::abs(position.z() - gallery) < 0.125f);
}

void check_ways(Life& life, const ClearanceCheck& check, Vector3f from, std::span<const Vector3f> positions) {
  for (const Vector3f& to : positions) {
    if (is_lost(to)) break;
    const Clearance clearance = check.check(from, to);
    life.counts.ways += 1;
    life.counts.touching_ways += clearance.is_touching;
    life.counts.unsure_ways += !clearance.is_certain;
    life.counts.metres += double{(to - from).head<2>().norm()};
    life.has_touched = life.has_touched || clearance.is_touching;
    life.was_deep = life.was_deep || clearance.depth > deep;
    from = to;
  }
}

/// Calls work(i) for each character, on many threads.
template <typename Work>
void for_each_character(std::size_t count, unsigned threads, const Work& work) {
  run_in_chunks("", count, 64, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(i);
  });
}

std::vector<Character> placed_at(const std::vector<Vector3f>& starts) {
  std::vector<Character> characters(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) characters[i].position = starts[i];
  return characters;
}

}  // namespace

WalkCounts& WalkCounts::operator+=(const WalkCounts& other) {
  steps += other.steps;
  ways += other.ways;
  queries += other.queries;
  touching_ways += other.touching_ways;
  unsure_ways += other.unsure_ways;
  touching += other.touching;
  deep += other.deep;
  lost += other.lost;
  stuck += other.stuck;
  climbed += other.climbed;
  metres += other.metres;
  walk_seconds += other.walk_seconds;
  check_seconds += other.check_seconds;
  return *this;
}

std::vector<Vector3f> draw_starts(const Colliderf& level, const Area& area, std::size_t count, std::uint32_t seed) {
  std::mt19937_64 bits(seed);
  const auto between = [&](float low, float high) {
    return low + (high - low) * (static_cast<float>(bits() >> 40) * 0x1p-24f);
  };
  std::vector<Vector3f> starts;
  while (starts.size() < count) {
    const float x = between(area.low_x, area.high_x);
    const float y = between(area.low_y, area.high_y);
    const bool is_in_house = x > 14 && x < 58 && y > 10 && y < 44;
    // Below the ceiling or the gallery in the house, and below the sky outside.
    const auto ground = level.first_hit(Rayf{{x, y, is_in_house ? 1.9f : 12.0f}, {0, 0, -1}});
    if (!ground || ground->side != Side::front || level.normal(ground->triangle).z() < 0.9f) continue;
    const float z = (is_in_house ? 1.9f : 12.0f) - ground->t;
    const Vector3f place(x, y, z + ground_floor + 0.0625f);
    if (!level.overlaps(SweptCapsulef{place, place, Body::half_axis(), Body::radius})) starts.push_back(place);
  }
  return starts;
}

WalkRecording record_walk(const std::vector<Vector3f>& starts, const CapsuleSweep& sweep, const ClearanceCheck& check,
                          const WalkOptions& options, const WalkWatch& watch) {
  const Walker walker(sweep);
  WalkRecording recording;
  recording.starts = starts;
  std::vector<Character> characters = placed_at(starts);
  std::vector<Life> lives;
  for (std::uint32_t i = 0; i < starts.size(); ++i) lives.emplace_back(options.seed + i);
  for (std::uint32_t step = 0; step < options.steps; ++step) {
    auto& velocities = recording.velocities.emplace_back(characters.size(), Vector3f::Zero());
    for_each_character(characters.size(), options.threads, [&](std::size_t i) {
      Life& life = lives[i];
      Character& character = characters[i];
      if (life.is_lost) return;
      const auto start = std::chrono::steady_clock::now();
      const Vector3f from = character.position;
      velocities[i] = life.mind.decide(character);
      std::vector<Vector3f> positions;
      walker.step(character, velocities[i], positions, life.counts.queries);
      ++life.counts.steps;
      life.counts.walk_seconds += seconds_since(start);
      const auto start_of_check = std::chrono::steady_clock::now();
      check_ways(life, check, from, positions);
      note_state(life, character.position);
      life.counts.check_seconds += seconds_since(start_of_check);
    });
    recording.hashes.push_back(hash_of(characters));
    if (watch) watch(step, characters);
  }
  for (Life& life : lives) {
    life.counts.touching = life.has_touched;
    life.counts.deep = life.was_deep;
    life.counts.lost = life.is_lost;
    life.counts.stuck = life.was_stuck;
    life.counts.climbed = life.has_climbed;
    recording.counts += life.counts;
  }
  return recording;
}

std::vector<std::uint64_t> replay_walk(const CapsuleSweep& sweep, const WalkRecording& recording, unsigned threads) {
  const Walker walker(sweep);
  std::vector<Character> characters = placed_at(recording.starts);
  std::vector<std::uint64_t> hashes;
  for (const std::vector<Vector3f>& velocities : recording.velocities) {
    for_each_character(characters.size(), threads, [&](std::size_t i) {
      std::vector<Vector3f> positions;
      std::size_t queries = 0;
      walker.step(characters[i], velocities[i], positions, queries);
    });
    hashes.push_back(hash_of(characters));
  }
  return hashes;
}

}  // namespace surehit::example
