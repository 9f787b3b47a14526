#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "collider_state.hpp"
#include "surehit/byte_sink.hpp"
#include "surehit/load_result.hpp"

namespace surehit::detail {

/// Returns the size of a saved collider in bytes.
template <typename Scalar>
[[nodiscard]] std::uint64_t saved_bytes(const ColliderState<Scalar>& state);

/// Saves a collider. Returns false if the sink did not take all bytes.
template <typename Scalar>
[[nodiscard]] bool save(const ColliderState<Scalar>& state, const ByteSink& sink);

/// Loads a collider into a new state. Returns what is wrong, or nothing. `base` is the index of the first byte in the
/// whole file, if the collider is a part of it.
template <typename Scalar>
[[nodiscard]] std::optional<InvalidFile> load(std::span<const std::byte> bytes, std::size_t base,
                                              const LoadOptions& options, ColliderState<Scalar>& state);

}  // namespace surehit::detail
