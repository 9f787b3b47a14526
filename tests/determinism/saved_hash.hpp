#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace surehit::test {

/// `saved_hash` of the hard questions' collider, of the hard prop's, and of the hard scene.
template <typename Scalar>
inline constexpr std::uint64_t published_saved_hash = 0;
template <>
inline constexpr std::uint64_t published_saved_hash<float> = 0xd4de9387f56c0db3u;
template <>
inline constexpr std::uint64_t published_saved_hash<double> = 0xe17ddca97cd56fa1u;
template <typename Scalar>
inline constexpr std::uint64_t published_saved_prop_hash = 0;
template <>
inline constexpr std::uint64_t published_saved_prop_hash<float> = 0x14bb0f5070bc7f89u;
template <>
inline constexpr std::uint64_t published_saved_prop_hash<double> = 0xad23fb97e539211bu;
template <typename Scalar>
inline constexpr std::uint64_t published_saved_scene_hash = 0;
template <>
inline constexpr std::uint64_t published_saved_scene_hash<float> = 0xa101340ad39d80fcu;
template <>
inline constexpr std::uint64_t published_saved_scene_hash<double> = 0xf2fe25d069ba4686u;

/// Returns the checksum of all bytes that a collider or a scene is saved in: the last of them.
template <typename T>
[[nodiscard]] std::uint64_t saved_hash(const T& saved) {
  std::vector<std::byte> bytes;
  const auto append = [&](std::span<const std::byte> piece) {
    bytes.insert(bytes.end(), piece.begin(), piece.end());
    return true;
  };
  std::uint64_t hash = 0;
  if (saved.save(append)) std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
  return hash;
}

}  // namespace surehit::test
