#pragma once

#include <optional>

#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Whether an answer about a finite path and triangle, asked without options, is right in every field. Decided in
/// integers, of 128 bits where these suffice and else of GMP, it costs a small part of what rationals do. It shares
/// nothing with the library. Call it in the default floating-point environment.
template <typename Scalar>
[[nodiscard]] bool is_right(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                            const std::optional<Hit<Scalar>>& answer);

}  // namespace surehit::test
