#pragma once

#include <optional>

namespace surehit::test {

/// What a textbook test says of a hit.
template <typename Scalar>
struct TextbookHit {
  Scalar t;
  Scalar u;
  Scalar v;
};

/// Nothing is a miss.
template <typename Scalar>
using TextbookAnswer = std::optional<TextbookHit<Scalar>>;

}  // namespace surehit::test
