#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "query/path_range.hpp"

namespace surehit::detail {

// The bound of Möller-Trumbore in working precision. u is the unit roundoff; d, e, f and s are the largest components,
// as computed, of D, E1, E2 and S.
//
// det = E1·(D × E2) is a sum of six products of three factors. Each product passes through at most 8 roundings: three
// differences, the inner product and the difference in the cross product, the outer product and two sums (fewer where a
// multiplication is fused with the sum; a ray's D is not rounded at all). So the computed det is off by at most
// gamma_8 · 6 |D||E1||E2| <= 48 u d e f up to factors 1 + O(u) (Higham, "Accuracy and Stability", lemma 3.1), and
// likewise T = E2·(S × E1) with f s e, U = S·(D × E2) with s d f, V = D·(S × E1) with d s e. No |det| exceeds 6 d e f.
//
// What is combined from them adds its own roundings, each at most u times the operands' sizes, 6 d e f and so on:
//   W = det - U - V                48 u + 2 · 6 u of each
//   t_weight T + det_weight det    48 u + 2 · 6 u of each, and T is not rounded when it is multiplied by 1, 0 or -1
// so that 60 u of each product of sizes bounds them all. The bound is itself computed with at most 9 roundings in any
// of its terms, and holds sizes that are off by u each: 66 leaves a tenth for that, where 11 u would do.
//
// Of one triangle the sum of the sizes of the six products, as computed, bounds them closer than 6 d e f does, and the
// size of det with them: 11 u of it stands for 66 u d e f, where W and the range need 10 u, 8 u and their own 2. A sum
// is computed with at most 8 roundings in any of its terms, and what is combined of sums with 6 more, which take far
// less than the tenth that is left.
//
// Underflow: a product may lose half the least denormal, eta / 2. In det: eta in each component of the cross product,
// times e, three times over, and 3 eta / 2 in the dot product; likewise in T, U and V with f, s and d; in first det:
// |first| times that and eta / 2. With the largest size l, all of W or of what the range asks is below 12 eta (1 + l)
// (1 + |first|). The bound itself multiplies eta / 2 by 3 l or less, and by 1 + |first|, twice at most; of what a sum
// of six products loses, 11 u count. Sizes are up to `largest_size`, L, so that 32 eta L (1 + |first|) holds both; it
// counts only where a mesh's sizes are below some 2^-30, or 2^-240 in double.
//
// Overflow: with every size up to `largest_size`, the largest number formed is under 6 · 2 · largest_size^3 ·
// largest_limit.
template <typename Scalar>
struct KernelBound {
  static constexpr Scalar relative = 66 * (std::numeric_limits<Scalar>::epsilon() / 2);
  static constexpr Scalar largest_size = std::is_same_v<Scalar, float> ? Scalar(0x1p34) : Scalar(0x1p300);
  static constexpr Scalar underflow = 32 * std::numeric_limits<Scalar>::denorm_min() * largest_size;
  static constexpr Scalar largest_limit = Scalar(0x1p16);
};
static_assert(12 * 0x1p34 * 0x1p34 * 0x1p34 * 0x1p16 < double{std::numeric_limits<float>::max()});

/// What a range asks of a pair: that t_weight T + det_weight det be at least zero once det's sign is taken out, for its
/// lower end (T - first det) and for its upper one (last det - T). An end at infinity asks nothing: of det itself.
template <typename Scalar>
struct RangeWeights {
  // As for the whole of a segment, which is what most queries ask.
  Scalar t_first = 1;
  Scalar det_first = 0;
  Scalar t_last = -1;
  Scalar det_last = 1;
  Scalar t_bound = KernelBound<Scalar>::relative;  ///< relative bound of T; 0 where T is not asked
  Scalar det_size = 2;                             ///< 1 + the greater weight of det, by size
  bool is_whole = true;                            ///< [0, 1]
  bool decides = true;                             ///< whether nothing else is left to decide

  explicit RangeWeights(const PathRange<Scalar>& range) {
    is_whole = range.first == 0 && range.last == 1;
    if (is_whole) return;
    const auto weigh = [&](Scalar limit, Scalar sign, Scalar& t_weight, Scalar& det_weight) {
      const bool small = std::fabs(limit) <= KernelBound<Scalar>::largest_limit;
      decides &= small || std::isinf(limit);
      t_weight = small ? sign : 0;
      det_weight = small ? -sign * limit : 1;
    };
    weigh(range.first, 1, t_first, det_first);
    weigh(range.last, -1, t_last, det_last);
    t_bound = KernelBound<Scalar>::relative * std::max(t_first, -t_last);
    det_size = 1 + std::max(std::fabs(det_first), std::fabs(det_last));
  }
};

/// What the determinants of one path and any triangle of one list are off by at most. `d` is the largest component of
/// D, `edge` that of any E1 and E2, and `s` no less than that of any S, so that a list has one bound of each for all of
/// its triangles: bounds for each lane would be a fifth of the kernel's operations. A size that is too large makes no
/// bound smaller, nor what is lost when it underflows greater than with the true size.
template <typename Scalar>
struct ListBounds {
  Scalar side;    ///< of U, V and W: the bound of W
  Scalar range;   ///< of both that the range asks: the greater of theirs
  Scalar det;     ///< of det,
  Scalar height;  ///< of T, and no less than that of det
  // Below the sum of a bound and det's there is no hit, whatever det's sign is:
  Scalar least_side;  ///< -(side + det)
  Scalar least_end;   ///< -(range + det), for the ends of [0, 1]

  ListBounds() = default;
  ListBounds(Scalar d, Scalar s, Scalar edge, const RangeWeights<Scalar>& weights) {
    using Bound = KernelBound<Scalar>;
    const Scalar d_edge = d * edge * Bound::relative;
    const Scalar s_edges = s * (edge * edge);
    side = d_edge * (2 * s + edge) + Bound::underflow;
    det = d_edge * edge + Bound::underflow;
    height = s_edges * Bound::relative + det;
    range = s_edges * weights.t_bound + det * weights.det_size;
    least_side = -(side + det);
    least_end = -(range + det);
  }
};

}  // namespace surehit::detail
