#pragma once

#include <optional>

#include "surehit/instance.hpp"
#include "surehit/pose.hpp"

namespace surehit::detail {

/// Returns what is invalid in a pose, or nothing. The first invalid entry counts, and then the determinant.
template <typename Scalar>
[[nodiscard]] std::optional<InvalidInstance> find_invalid(const Pose<Scalar>& pose);

}  // namespace surehit::detail
