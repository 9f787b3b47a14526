#pragma once

#include <array>
#include <cstdint>

#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "textbook_hit.hpp"

namespace surehit::test {

/// What a variant is asked, and so what the exact answer is.
enum class Asked : std::uint8_t {
  segment,  ///< Whether the segment meets the triangle.
  front,    ///< Whether it meets the triangle's front. What is in its plane does not.
  line,     ///< Whether the line meets the triangle.
};

/// A test of a path and a triangle as textbooks have it.
template <typename Scalar>
struct TextbookVariant {
  const char* letter;  ///< Its short name on the page.
  const char* name;
  Asked asked;
  TextbookAnswer<Scalar> (*answer)(const Path<Scalar>&, const Triangle<Scalar>&);
};

inline constexpr std::size_t textbook_variant_count = 12;

/// Returns all variants. The first one is surehit itself.
template <typename Scalar>
[[nodiscard]] const std::array<TextbookVariant<Scalar>, textbook_variant_count>& textbook_variants();

/// Returns the variant of this letter.
template <typename Scalar>
[[nodiscard]] const TextbookVariant<Scalar>& textbook_variant(const char* letter);

}  // namespace surehit::test
