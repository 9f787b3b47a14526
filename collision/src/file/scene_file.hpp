#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "scene/scene_state.hpp"
#include "surehit/byte_sink.hpp"
#include "surehit/load_result.hpp"

namespace surehit::detail {

/// Saves what was set last in a scene. Returns false if the sink did not take all bytes.
template <typename Scalar>
[[nodiscard]] bool save(const SceneState<Scalar>& state, const ByteSink& sink);

/// Loads a scene into new states, and commits it. Returns what is wrong, or nothing.
template <typename Scalar>
[[nodiscard]] std::optional<InvalidFile> load(std::span<const std::byte> bytes, const LoadOptions& options,
                                              SceneState<Scalar>& state, CommittedShare<Scalar>& committed);

}  // namespace surehit::detail
