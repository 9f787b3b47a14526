#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "surehit/collider.hpp"

namespace surehit::test {

/// What is asked of a collider about one path.
template <typename Scalar>
struct Question {
  Path<Scalar> path;
  std::size_t options = 0;  ///< which of the set's
};

template <typename Scalar>
struct Questions {
  std::vector<QueryOptions<Scalar>> options;
  std::vector<Question<Scalar>> all;
  std::size_t every_all = 1;  ///< of so many questions, one asks for all hits too

  [[nodiscard]] const QueryOptions<Scalar>& options_of(std::size_t id) const { return options[all[id].options]; }
};

/// Keeps the first sixteenth of what is asked, for a library that is slow to answer.
template <typename T>
void keep_few(std::vector<T>& asked) {
  asked.erase(asked.begin() + static_cast<std::ptrdiff_t>(asked.size() / 16), asked.end());
}

/// None; those that compare t; those that ask about contacts and triangles.
template <typename Scalar>
[[nodiscard]] std::vector<QueryOptions<Scalar>> asked_options() {
  return {{},
          {.min_t = Scalar{0.25}, .max_t = Scalar{0.75}, .culling = Culling::back},
          {.mask = 1, .ignored_triangle = 7, .ignore_start_contact = true, .ignore_end_contact = true}};
}

/// Under `mask = 1`, every third triangle is left out.
[[nodiscard]] inline std::vector<std::uint32_t> asked_masks(std::size_t triangles) {
  std::vector<std::uint32_t> masks;
  for (std::size_t i = 0; i < triangles; ++i) masks.push_back(i % 3 == 0 ? 2 : 3);
  return masks;
}

}  // namespace surehit::test
