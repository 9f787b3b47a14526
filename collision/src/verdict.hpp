#pragma once

namespace surehit::detail {

/// What a stage says of a path and a triangle. A miss or a hit is certain.
enum class Verdict : unsigned char { miss, hit, undecided };

}  // namespace surehit::detail
