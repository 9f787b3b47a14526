#pragma once

namespace surehit::detail {

/// The answer of a stage about a path and a triangle. A miss or a hit is certain.
enum class Verdict : unsigned char { miss, hit, undecided };

}  // namespace surehit::detail
