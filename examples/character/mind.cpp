#include "character/mind.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace surehit::example {
namespace {

constexpr std::uint32_t steps_of_a_round = 16;
constexpr float hand = 0.125f;

/// The level from its outer edge inwards, so that nobody walks off it.
constexpr float margin = 2;
constexpr float width = 72;
constexpr float depth = 52;

/// Places of the level where much happens: the terrace, both doors, the hall, the stairs, the gallery and rooms.
constexpr std::array<std::array<float, 2>, 12> sights = {{{36.5f, 7},
                                                          {36.5f, 13},
                                                          {36.5f, 24},
                                                          {36.5f, 30},
                                                          {36.5f, 36.25f},
                                                          {29, 36.25f},
                                                          {44, 36.25f},
                                                          {25.5f, 22},
                                                          {52, 25.25f},
                                                          {19, 30.5f},
                                                          {36.5f, 41},
                                                          {25.5f, 47}}};

}  // namespace

Mind::Mind(std::uint32_t seed) : bits_(seed * 0x9e3779b1u) {
  bits_.discard(4);  // Neighbouring seeds begin alike.
  speed_ = between(1.5f, 5);
}

Vector3f Mind::decide(const Character& character) {
  const Vector3f& position = character.position;
  if (steps_ % steps_of_a_round == 0) {
    const bool has_failed = (position - round_start_).squaredNorm() < hand * hand;
    failed_rounds_ = steps_ > 0 && has_failed ? failed_rounds_ + 1 : 0;
    if (steps_ == 0 || has_failed) choose_goal(position);
    round_start_ = position;
  }
  ++steps_;
  Vector3f way(goal_.x() - position.x(), goal_.y() - position.y(), 0);
  if (way.squaredNorm() < 1) {
    choose_goal(position);
    way = {goal_.x() - position.x(), goal_.y() - position.y(), 0};
  }
  const float length = way.norm();
  return length > 0 ? Vector3f(speed_ / length * way) : Vector3f::Zero();
}

void Mind::choose_goal(const Vector3f& position) {
  const float kind = between(0, 1);
  if (kind < 0.5f) {
    const auto& sight = sights[static_cast<std::size_t>(between(0, float{sights.size()})) % sights.size()];
    goal_ = {sight[0], sight[1], 0};
  } else if (kind < 0.75f) {
    goal_ = {between(margin, width - margin), between(margin, depth - margin), 0};
  } else {
    const auto near = [&](float x, float size) { return std::clamp(x + between(-5, 5), margin, size - margin); };
    goal_ = {near(position.x(), width), near(position.y(), depth), 0};
  }
}

float Mind::between(float low, float high) {
  const std::uint32_t drawn = static_cast<std::uint32_t>(bits_()) >> 7;
  return low + (high - low) * (static_cast<float>(drawn) * 0x1p-24f);
}

}  // namespace surehit::example
