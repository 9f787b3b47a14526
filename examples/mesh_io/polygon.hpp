#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace surehit::example {

/// Checks an index that counts from 0 against the vertices there are. Throws InputError.
[[nodiscard]] std::uint32_t checked_corner(std::int64_t index, std::uint64_t vertex_count);

/// Splits a polygon into a fan: corner 0 with each following pair. Throws InputError where there are less than 3
/// corners.
void append_fan(const std::vector<std::uint32_t>& corners, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace surehit::example
