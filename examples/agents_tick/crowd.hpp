#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <surehit/executor.hpp>
#include <surehit/path.hpp>
#include <vector>

#include "agents_tick/town.hpp"

namespace surehit::example {

/// Somebody who walks in a town.
struct Agent {
  Vector3f foot;
  Vector3f heading;  ///< a unit vector in the plan
};

/// A look of one agent at a part of another one.
struct Look {
  std::uint32_t from;
  std::uint32_t to;
  std::uint8_t part;  ///< 0 is the head, 1 the chest and 2 a knee
};

/// Agents that look around and walk.
class Crowd {
 public:
  static constexpr float time_step = 1.0f / 16;

  /// Places agents on the streets.
  Crowd(std::size_t agents, std::uint64_t seed);

  /// Returns looks at what lies in the agents' vision cones, the nearest first. Each agent has its share of them. There
  /// are as many as `wanted`, if the cones have so many.
  [[nodiscard]] std::vector<Look> looks(std::size_t wanted) const;
  [[nodiscard]] std::vector<Segmentf> segments(std::span<const Look> looks) const;

  /// Lets all agents walk for a tick, as one batch. Who meets something stops in front of it and turns. Returns how
  /// many met glass or a railing, which does not block sight.
  std::size_t walk(const Town& town, const std::optional<Executor>& executor);

  [[nodiscard]] const std::vector<Agent>& agents() const { return agents_; }

 private:
  std::vector<Agent> agents_;
};

}  // namespace surehit::example
