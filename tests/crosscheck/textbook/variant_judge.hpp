#pragma once

#include <array>
#include <cstddef>

#include "support/pair_families.hpp"
#include "textbook_variant.hpp"

namespace surehit::test {

/// The pairs of each family that the judge draws. The number is fixed, because the table is published.
inline constexpr std::size_t judged_pairs = 10'000;

/// What the exact answers say of one variant on some pairs.
struct Tally {
  std::size_t hits = 0;        ///< The pairs that meet.
  std::size_t false_hits = 0;  ///< The pairs that do not, and that the variant calls hits.
  std::size_t missed = 0;      ///< The pairs that do, and that the variant calls misses.
  /// The max distances of t, u and v from the exact values where both say hit, in ulps of the exact values. They are
  /// infinite for NaN and infinity.
  std::array<double, 3> worst_ulps = {};
  /// The same, in ulps of the exact value or of 1/2, whichever is larger. A weight near zero moves no point by much.
  std::array<double, 3> worst_errors = {};

  void add(const Tally& more);
};

using Tallies = std::array<Tally, textbook_variant_count>;

/// Judges all variants on one family. The rationals are the judge.
template <typename Scalar>
[[nodiscard]] Tallies judge_family(PairFamily family, std::size_t pairs = judged_pairs);

/// How many segments through an edge that two triangles share leave both by what a variant says. None does exactly: the
/// two triangles lie on both sides of the edge, as the segment sees it.
template <typename Scalar>
[[nodiscard]] std::array<std::size_t, textbook_variant_count> count_leaks(std::size_t pairs = judged_pairs);

}  // namespace surehit::test
