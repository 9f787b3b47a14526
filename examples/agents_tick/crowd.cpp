#include "agents_tick/crowd.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace surehit::example {
namespace {

constexpr float walking_speed = 1.5f;
constexpr float view_range = 60;
constexpr float cosine_of_view = 0.5f;  ///< of half of the cone
constexpr std::array<float, 3> heights = {1.625f, 1.25f, 0.5f};
constexpr float step_height = heights[2];

struct Neighbour {
  float square;
  std::uint32_t agent;
};

bool is_nearer(const Neighbour& a, const Neighbour& b) {
  return a.square < b.square || (a.square == b.square && a.agent < b.agent);
}

/// The agents in a vision cone, the nearest first, at most `count` of them.
std::vector<Neighbour> seen_in_cone(const std::vector<Agent>& agents, std::uint32_t from, std::size_t count) {
  std::vector<Neighbour> found;
  const Agent& viewer = agents[from];
  for (std::uint32_t i = 0; i < agents.size(); ++i) {
    const Vector3f away = agents[i].foot - viewer.foot;
    const float square = away.squaredNorm();
    if (i == from || square > view_range * view_range) continue;
    if (away.dot(viewer.heading) < cosine_of_view * std::sqrt(square)) continue;
    found.push_back({square, i});
  }
  const std::size_t kept = std::min(count, found.size());
  std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(kept), found.end(), is_nearer);
  found.resize(kept);
  return found;
}

Vector3f at_height(const Vector3f& foot, float height) { return foot + Vector3f(0, 0, height); }

}  // namespace

Crowd::Crowd(std::size_t agents, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  const auto between = [&](float low, float high) {
    return low + (high - low) * (static_cast<float>(bits() >> 40) * 0x1p-24f);
  };
  const auto street = [&] {
    const auto number = static_cast<float>(1 + (bits() >> 32) % (Town::plots_in_a_row - 1));
    return Town::plot_size * number + 0.75f * between(-Town::street_half_width, Town::street_half_width);
  };
  while (agents_.size() < agents) {
    const float along = between(1, Town::size - 1);
    const float across = street();
    const bool is_along_x = bits() >> 63 != 0;
    const Vector3f heading(between(-1, 1), between(-1, 1), 0);
    const float square = heading.squaredNorm();
    if (square < 0.01f || square > 1) continue;
    agents_.push_back({{is_along_x ? along : across, is_along_x ? across : along, 0}, heading / std::sqrt(square)});
  }
}

std::vector<Look> Crowd::looks(std::size_t wanted) const {
  // Some agents see few others, so the rest have more than an equal share.
  const std::size_t max_neighbours = 2 * wanted / (heights.size() * std::max<std::size_t>(1, agents_.size())) + 2;
  std::vector<std::vector<Neighbour>> neighbours;
  for (std::uint32_t i = 0; i < agents_.size(); ++i) neighbours.push_back(seen_in_cone(agents_, i, max_neighbours));
  std::vector<Look> looks;
  for (std::size_t rank = 0; rank < max_neighbours; ++rank) {
    for (std::uint8_t part = 0; part < heights.size(); ++part) {
      for (std::uint32_t i = 0; i < agents_.size() && looks.size() < wanted; ++i) {
        if (rank < neighbours[i].size()) looks.push_back({i, neighbours[i][rank].agent, part});
      }
    }
  }
  return looks;
}

std::vector<Segmentf> Crowd::segments(std::span<const Look> looks) const {
  std::vector<Segmentf> segments;
  segments.reserve(looks.size());
  for (const Look& look : looks) {
    segments.push_back(
        {at_height(agents_[look.from].foot, heights[0]), at_height(agents_[look.to].foot, heights[look.part])});
  }
  return segments;
}

std::size_t Crowd::walk(const Town& town, const std::optional<Executor>& executor) {
  const SceneQueryOptionsf options{.instance_mask = blocks_movement};
  std::vector<Segmentf> steps;
  for (const Agent& agent : agents_) {
    const Vector3f start = at_height(agent.foot, step_height);
    steps.push_back({start, start + time_step * walking_speed * agent.heading});
  }
  std::vector<SceneHitf> hits(steps.size());
  town.scene().first_hits(steps, hits, {.options = options, .executor = executor});
  std::size_t at_glass = 0;
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    Agent& agent = agents_[i];
    Vector3f stop = steps[i].end;
    if (hits[i].triangle != no_triangle) {
      stop = town.scene().last_free_point(steps[i], hits[i], options);
      Vector3f normal = town.scene().normal(hits[i].instance, hits[i].triangle);
      normal.z() = 0;
      const Vector3f turned = agent.heading - 2 * agent.heading.dot(normal) * normal;
      agent.heading = hits[i].side == Side::edge_on ? Vector3f(-agent.heading) : turned.normalized();
      at_glass += (town.scene().mask(hits[i].instance) & blocks_sight) == 0;
    }
    agent.foot = {stop.x(), stop.y(), 0};
  }
  return at_glass;
}

}  // namespace surehit::example
