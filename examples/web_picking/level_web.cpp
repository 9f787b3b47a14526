// The built-in level in JavaScript's memory: functions that return addresses and counts of numbers.

#include <cstddef>
#include <cstdint>

#include "level/level.hpp"

namespace surehit::example {
namespace {

Level level;

}  // namespace
}  // namespace surehit::example

using surehit::example::level;

#define SUREHIT_EXPORT(Result, name) extern "C" __attribute__((export_name(#name))) Result level_##name

SUREHIT_EXPORT(void, build)() { level = surehit::example::build_level(); }
SUREHIT_EXPORT(const float*, vertices)() { return level.mesh.vertices.front().data(); }
SUREHIT_EXPORT(std::size_t, vertex_count)() { return level.mesh.vertices.size(); }
SUREHIT_EXPORT(const std::uint32_t*, triangles)() { return level.mesh.triangles.front().data(); }
SUREHIT_EXPORT(std::size_t, triangle_count)() { return level.mesh.triangles.size(); }
