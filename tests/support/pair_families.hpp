#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>

#include "support/random.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Kinds of pairs that are hard in different ways.
enum class PairFamily : std::uint8_t {
  general,
  aimed_at_edges,
  aimed_at_vertices,
  ends_on_plane,
  ends_beside_plane,  ///< one ulp away from the plane
  overlapping_in_plane,
  touching_in_plane,
  disjoint_in_plane,
  near_parallel,  ///< in the plane but for 1 to 8 ulps
  slivers,
  degenerate_triangles,
  zero_length,
  small_integers,
  mixed_magnitudes,  ///< from the least denormal to the largest number
  far_from_origin,
};

inline constexpr std::array all_pair_families = {
    PairFamily::general,           PairFamily::aimed_at_edges,       PairFamily::aimed_at_vertices,
    PairFamily::ends_on_plane,     PairFamily::ends_beside_plane,    PairFamily::overlapping_in_plane,
    PairFamily::touching_in_plane, PairFamily::disjoint_in_plane,    PairFamily::near_parallel,
    PairFamily::slivers,           PairFamily::degenerate_triangles, PairFamily::zero_length,
    PairFamily::small_integers,    PairFamily::mixed_magnitudes,     PairFamily::far_from_origin,
};

[[nodiscard]] std::string name_of(PairFamily family);
inline void PrintTo(PairFamily family, std::ostream* out) { *out << name_of(family); }

template <typename Scalar>
struct Pair {
  Segment<Scalar> segment;
  Triangle<Scalar> triangle;
};

/// The next finite pair of a family. Call it in the default floating-point environment: it then draws the same
/// everywhere.
template <typename Scalar>
[[nodiscard]] Pair<Scalar> draw_pair(PairFamily family, Random& random);

/// The segment itself, or the ray or line from its start towards its end.
template <typename Scalar>
[[nodiscard]] Path<Scalar> path_along(const Segment<Scalar>& segment, PathKind kind);

/// Options that are hard for a contact at t: limits at it, right beside it and at the path's own ends, and the contacts
/// of both ends. Masks and ids stay as they are.
template <typename Scalar>
[[nodiscard]] QueryOptions<Scalar> draw_options(Random& random, Scalar t);

}  // namespace surehit::test
