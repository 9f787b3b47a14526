#include "moving_platforms/game.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace surehit::example {
namespace {

constexpr float gravity = 9.81f;
constexpr float max_speed = 160;
/// Batches in a step. A piece that has no free way by then is squeezed.
constexpr int max_rounds = 12;
constexpr std::uint16_t max_bounces_of_bullets = 24;
constexpr std::uint16_t max_steps_of_debris = 512;
/// The gap between two neighbouring floats in [32, 64].
constexpr float gap = 0x1p-18f;

/// A velocity after a bounce off a surface that moves.
Vector3f bounced(const Piece& piece, const Vector3f& surface_velocity, const Vector3f& normal) {
  const Vector3f relative = piece.velocity - surface_velocity;
  const float approach = normal.dot(relative);
  if (approach >= 0) return piece.velocity;
  const Vector3f along = relative - approach * normal;
  if (piece.kind == Piece::Kind::bullet) return surface_velocity + along - approach * normal;
  constexpr float friction = 0.08f;
  constexpr float restitution = 0.45f;
  const bool comes_to_rest = approach > -0.75f;
  const float rebound = comes_to_rest ? 0 : -restitution * approach;
  return surface_velocity + (1 - friction) * along + rebound * normal;
}

/// FNV-1a.
class Hash {
 public:
  void take(std::uint64_t bits) { value_ = (value_ ^ bits) * 0x100000001b3u; }
  void take(const Vector3f& v) {
    for (const float x : v) take(std::bit_cast<std::uint32_t>(x));
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace

Game::Game(const Hall& hall, Stepping stepping, std::size_t pieces) : hall_scene_(hall, stepping), pieces_(pieces) {}

void Game::step(std::span<const Shot> shots, const std::optional<Executor>& executor) {
  for (const Shot& shot : shots) pieces_[shot.slot] = shot.piece;
  hall_scene_.next_step(executor);
  ways_.clear();
  std::vector<Attempt> attempts = begin_step();
  for (int round = 0; round < max_rounds && !attempts.empty(); ++round) attempts = try_ways(attempts, round, executor);
  for (const Attempt& attempt : attempts) remove(attempt.slot);
  counts_.squeezed += attempts.size();
}

std::vector<Game::Attempt> Game::begin_step() {
  std::vector<Attempt> attempts;
  for (std::size_t slot = 0; slot < pieces_.size(); ++slot) {
    Piece& piece = pieces_[slot];
    if (!piece.is_there) continue;
    piece.velocity.z() -= gravity * time_step;
    const float speed = piece.velocity.norm();
    if (speed > max_speed) piece.velocity *= max_speed / speed;
    attempts.push_back({slot, piece.position + time_step * piece.velocity});
  }
  return attempts;
}

std::vector<Game::Attempt> Game::try_ways(const std::vector<Attempt>& attempts, int round,
                                          const std::optional<Executor>& executor) {
  std::vector<Segmentf> segments;
  segments.reserve(attempts.size());
  for (const Attempt& attempt : attempts) segments.push_back({pieces_[attempt.slot].position, attempt.end});
  std::vector<SceneHitf> hits(segments.size());
  hall_scene_.scene().first_hits(segments, hits, {.executor = executor});
  counts_.asked += segments.size();

  std::vector<Attempt> again;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    if (hits[i].triangle == no_triangle) {
      finish_way(attempts[i]);
    } else {
      again.push_back({attempts[i].slot, respond(pieces_[attempts[i].slot], segments[i], hits[i], round)});
    }
  }
  if (round == 0) counts_.contacts += again.size();
  return again;
}

void Game::finish_way(const Attempt& attempt) {
  Piece& piece = pieces_[attempt.slot];
  ways_.push_back({attempt.slot, piece.position, attempt.end});
  ++counts_.ways;
  piece.position = attempt.end;
  ++piece.steps;
  const bool is_bullet = piece.kind == Piece::Kind::bullet;
  if (is_bullet ? piece.bounces >= max_bounces_of_bullets : piece.steps >= max_steps_of_debris) remove(attempt.slot);
}

Vector3f Game::respond(Piece& piece, const Segmentf& way, const SceneHitf& hit, int round) const {
  const Scenef& scene = hall_scene_.scene();
  const Vector3f stop = scene.last_free_point(way, hit);
  const Vector3f surface_motion = hall_scene_.motion_at(hit.instance, stop);
  Vector3f normal = scene.normal(hit.instance, hit.triangle);
  if (hit.side == Side::back) normal = -normal;
  if (hit.side == Side::edge_on) normal = -piece.velocity.normalized();
  piece.velocity = bounced(piece, surface_motion / time_step, normal);
  if (round == 0) ++piece.bounces;
  // The sum is rounded, and the next batch decides whether it is still in front. If not, the piece goes back further.
  const float back = std::ldexp(gap, round);
  return stop + (1 - hit.t) * scene.motion(hit.instance) + back * normal;
}

std::uint64_t Game::hash() const {
  Hash hash;
  for (const Piece& piece : pieces_) {
    hash.take(std::uint64_t{piece.is_there} | std::uint64_t{piece.steps} << 8 | std::uint64_t{piece.bounces} << 32);
    hash.take(piece.position);
    hash.take(piece.velocity);
  }
  return hash.value();
}

}  // namespace surehit::example
