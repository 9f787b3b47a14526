#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <surehit/surehit.hpp>
#include <vector>

// The variables of those code blocks in README.md and in the guides that are not whole programs.

inline const std::vector<surehit::Vector3f> vertices = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
inline const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
inline surehit::Colliderf level{surehit::TriangleMeshViewf(vertices, triangles)};
inline const std::vector<surehit::Vector3f> moved_vertices = {{0, 0, 1}, {10, 0, 1}, {10, 10, 1}, {0, 10, 1}};
inline const std::vector<std::array<std::uint32_t, 3>> other_triangles = {{0, 1, 2}};
inline const surehit::TriangleMeshViewf other_mesh(moved_vertices, other_triangles);

inline const surehit::Trianglef triangle = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
inline const std::vector<bool> is_glass = {false, true};
inline constexpr std::uint32_t door = 1;
inline constexpr std::uint32_t open_door = 0;

inline const surehit::Vector3f eye = {1, 1, 1};
inline const surehit::Vector3f target = {9, 2, 1};
inline const surehit::Segmentf step = {{5, 5, 1}, {5, 5, -1}};
inline const surehit::SweptSpheref ball = {{5, 5, 3}, {5, 5, -3}, 0.5F};
inline const std::vector<surehit::Segmentf> steps = {step, {{1, 1, 1}, {1, 1, 2}}};
inline const surehit::QueryOptionsf options_of_steps[] = {{.ignored_triangle = 0}, {.max_t = 0.5F}};

// Two points of each agent lie in an array of agents.
struct Agent {
  float health = 0;
  std::array<float, 3> eye = {};
  std::array<float, 3> foot = {};
};
inline const std::vector<Agent> agents = {{1, {1, 1, 2}, {1, 1, -1}}, {1, {2, 2, 2}, {2, 2, 1}}};
inline const auto eyes = surehit::VertexViewf::strided(agents[0].eye.data(), agents.size(), sizeof(Agent));
inline const auto feet = surehit::VertexViewf::strided(agents[0].foot.data(), agents.size(), sizeof(Agent));

inline std::vector<surehit::Hitf> hits(steps.size());
inline std::vector<std::uint8_t> blocked(agents.size());

// What is placed in scenes.
inline const auto crate_mesh = std::make_shared<surehit::Colliderf>(surehit::TriangleMeshViewf(vertices, triangles));
inline constexpr std::array<float, 4> turn = {0, 0.70710678F, 0, 0.70710678F};  // by a right angle about y
inline constexpr std::uint32_t solid = 1;
inline std::vector<surehit::SceneHitf> scene_hits(steps.size());

// What writes bytes to a file.
inline const auto file = [](std::span<const std::byte> /*bytes*/) { return true; };

// A job system that does all tasks on this thread.
inline const auto jobs = [](std::size_t count, const surehit::Executor::Task& task) {
  for (std::size_t i = 0; i < count; ++i) task(i);
};
