#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "surehit/collider.hpp"

namespace surehit::test {

template <typename Scalar>
void expect_same(const std::optional<Hit<Scalar>>& left, const std::optional<Hit<Scalar>>& right) {
  ASSERT_EQ(left.has_value(), right.has_value());
  if (left) {
    EXPECT_TRUE(same_bits(*left, *right)) << hex_text(*left) << " or " << hex_text(*right);
  }
}

template <typename Scalar>
void expect_same(std::span<const Hit<Scalar>> left, std::span<const Hit<Scalar>> right) {
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_TRUE(same_bits(left[i], right[i])) << hex_text(left[i]) << " or " << hex_text(right[i]);
  }
}

inline void expect_same(const QueryStatistics& left, const QueryStatistics& right) {
  EXPECT_EQ(left.paths, right.paths);
  EXPECT_EQ(left.cells, right.cells);
  EXPECT_EQ(left.candidates, right.candidates);
  EXPECT_EQ(left.undecided, right.undecided);
  EXPECT_EQ(left.exact_decisions, right.exact_decisions);
  EXPECT_EQ(left.exact_orders, right.exact_orders);
  EXPECT_EQ(left.exact_roundings, right.exact_roundings);
  EXPECT_EQ(left.unclipped, right.unclipped);
}

/// Asks two colliders about one path in every way that there is, and expects the same bits. Returns whether the path
/// hits.
template <typename Scalar>
bool expect_same_single_answers(const Collider<Scalar>& left, const Collider<Scalar>& right, const Path<Scalar>& path,
                                const QueryOptions<Scalar>& options = {}) {
  SCOPED_TRACE(hex_text(path));
  const auto odd = [](const Hit<Scalar>& hit) { return hit.triangle % 2 == 1; };
  const std::optional<Hit<Scalar>> first = left.first_hit(path, options);
  expect_same(first, right.first_hit(path, options));
  expect_same(left.first_hit(path, odd, options), right.first_hit(path, odd, options));
  EXPECT_EQ(left.any_hit(path, options), right.any_hit(path, options));
  EXPECT_EQ(left.any_hit(path, odd, options), right.any_hit(path, odd, options));
  std::vector<Hit<Scalar>> of_left;
  std::vector<Hit<Scalar>> of_right;
  left.all_hits(path, of_left, options);
  right.all_hits(path, of_right, options);
  expect_same<Scalar>(of_left, of_right);
  left.all_hits(path, of_left, odd, options);
  right.all_hits(path, of_right, odd, options);
  expect_same<Scalar>(of_left, of_right);
  if (first && path.has_end()) {
    const Segment<Scalar> segment = {path.start, path.toward};
    const Vector3<Scalar> free = left.last_free_point(segment, *first, options);
    const Vector3<Scalar> expected = right.last_free_point(segment, *first, options);
    for (Eigen::Index axis = 0; axis < 3; ++axis) EXPECT_TRUE(same_bits(free[axis], expected[axis]));
  }
  return first.has_value();
}

template <typename Scalar, typename AnyPath>
void expect_same_batch_answers(const Collider<Scalar>& left, const Collider<Scalar>& right,
                               const std::vector<AnyPath>& paths, const QueryOptions<Scalar>& options = {}) {
  std::vector<Hit<Scalar>> hits(paths.size());
  std::vector<Hit<Scalar>> expected_hits(paths.size());
  left.first_hits(paths, hits, {.options = options});
  right.first_hits(paths, expected_hits, {.options = options});
  expect_same<Scalar>(hits, expected_hits);
  std::vector<std::uint8_t> blocked(paths.size());
  std::vector<std::uint8_t> expected_blocked(paths.size());
  left.any_hits(paths, blocked, {.options = options});
  right.any_hits(paths, expected_blocked, {.options = options});
  EXPECT_EQ(blocked, expected_blocked);
}

/// The same of many paths, one by one and in batches. Returns how many of them hit.
template <typename Scalar>
std::size_t expect_same_answers(const Collider<Scalar>& left, const Collider<Scalar>& right,
                                const std::vector<Path<Scalar>>& paths, const QueryOptions<Scalar>& options = {}) {
  std::size_t hits = 0;
  std::vector<Segment<Scalar>> segments;
  std::vector<Ray<Scalar>> rays;
  std::vector<Line<Scalar>> lines;
  for (const Path<Scalar>& path : paths) {
    if (expect_same_single_answers(left, right, path, options)) ++hits;
    if (path.kind == PathKind::segment) segments.push_back({path.start, path.toward});
    if (path.kind == PathKind::ray) rays.push_back({path.start, path.toward});
    if (path.kind == PathKind::line) lines.push_back({path.start, path.toward});
  }
  expect_same_batch_answers(left, right, segments, options);
  expect_same_batch_answers(left, right, rays, options);
  expect_same_batch_answers(left, right, lines, options);
  return hits;
}

}  // namespace surehit::test
