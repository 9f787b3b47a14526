#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "path_range.hpp"

namespace surehit::detail {

// The error bound of the Möller-Trumbore determinants in working precision.
//
// Names:
//     eps             The unit roundoff: 2^-24 for float, 2^-53 for double.
//     eta             The smallest denormal.
//     L               The constant `largest_size`.
//     D, E1, E2, S    The exact direction of the path, b - a, c - a, and start - a.
//     d, e, f, s      The largest components of D, E1, E2 and S, as computed.
//     first, last     The limits of the range on t.
//
//     Determinant          Its product of sizes
//     det = E1·(D × E2)    d e f;
//     T   = E2·(S × E1)    f s e;
//     U   = S·(D × E2)     s d f;
//     V   = D·(S × E1)     d s e;
//     W   = det - U - V    d e f + s d f + d s e.
//
// K1. Let the path meet the triangle at t. Let u, v and w = 1 - u - v be the weights of b, c and a there.
//     Then T = t det, U = u det, V = v det and W = w det. This also holds for det = 0 and for degenerate triangles.
// Proof. The contact is start + t D = a + u E1 + v E2. So S = u E1 + v E2 - t D. Put this S into T, U and V.
//     A triple product with two parallel factors is zero. So one of the three terms is left in each of them.
//     For V it is v D·(E2 × E1) = v det.
//
// K2. A computed determinant is off by at most 48 eps times its product of sizes.
//     This and K4 leave out a factor 1 + O(eps), which K5 includes.
// Proof. A determinant is a sum of six products of three components. Each product passes through at most 8 roundings:
//
//     differences of coordinates        3;
//     inner product                     1;
//     difference in a cross product     1;
//     outer product                     1;
//     sums                              2.
//
//     There are fewer if a product and a sum are fused. The direction of a ray is not rounded.
//     So each product is off by at most gamma_8 times itself, which is 8 eps.
//     See Higham, "Accuracy and Stability of Numerical Algorithms", lemma 3.1.
//     No product exceeds the product of sizes. There are six of them, and 6 · 8 = 48.
//
// K3. No determinant exceeds 6 times its product of sizes.
// Proof. It is a sum of six products, and K2 bounds each of them.
//
// K4. W and the ends of the range are off by at most 60 eps times their products of sizes:
//
//     W = det - U - V                60 eps (d e f + s d f + d s e);
//     t_weight T + det_weight det    60 eps (|t_weight| f s e + |det_weight| d e f).
//
// Proof. By K2, each term is already off by 48 eps. At most two more roundings follow.
//     For W they are two differences. For an end they are a product and a sum.
//     T is not rounded when it is multiplied, because t_weight is 1, 0 or -1.
//     By K3, a rounding adds at most eps times 6 products of sizes. The sum is 48 + 2 · 6 = 60.
//
// K5. The bound of K4 may be computed with rounding if 66 eps replace 60 eps.
// Proof. A term of the bound passes through at most 9 roundings. Its three sizes are off by eps each.
//     K2 and K4 left out a few eps. The distance s may be too small by a factor 1 - 2^-21 (P1).
//     All of this is below 2^-18 of the bound. The step from 60 to 66 is a tenth of it.
//
// K6. In double, the bounds also hold for paths and lists of floats, though edge size and reach are floats.
// Proof. Coordinates of floats and their differences are below 2^130, which is far below `largest_size`.
//     The edge size was rounded to float, which may make it smaller by 2^-24, and the reach by 2^-20 (P1).
//     A term has at most three of them. So this is far below the tenth that K5 leaves.
//
// K7. Underflow changes W and the ends of the range by at most 12 eta (1 + l) (1 + |first|).
//     Here l is the largest size, and `first` is either limit of the range.
// Proof. Only products lose something by underflow: at most eta / 2 each. This adds up as follows:
//
//     component of a cross product    eta;
//     determinant                     3 eta l + 3 eta / 2;
//     W                               9 eta l + 9 eta / 2;
//     first det                       |first| (3 eta l + 3 eta / 2) + eta / 2;
//     T - first det                   (1 + |first|) (3 eta l + 3 eta / 2) + eta / 2.
//
// K8. The constant 32 eta L, times 1 + |first| for an end, covers all underflow.
// Proof. By K7, the determinants lose at most 12 eta (1 + L) (1 + |first|).
//     The bound itself is computed, and its products lose eta / 2 each.
//     The largest factor of such a loss is 2 s + e <= 5 L, because the s of a list may be up to 2 L.
//     Together, the products lose at most 4 eta (1 + L) (1 + |first|). Finally, 16 (1 + L) < 32 L.
//     The constant only matters if sizes are below about 2^-30 in float, or 2^-240 in double.
//
// K9. If all sizes are at most L and all limits at most `largest_limit`, nothing overflows.
// Proof. By K3, a determinant is at most 6 L^3. So an end is at most 6 L^3 (1 + `largest_limit`).
//     This is below 12 L^3 `largest_limit`.
//
// K10. Let n and m be computed, and N and M exact. Let |N - n| <= r_n and |M - m| <= r_m < |m|. Then:
//
//     |N / M - n / m| <= (r_n + |n / m| r_m) / (|m| - r_m);
//     |N / M - n / m| <= (r_n + |N / M| r_m) / |m|.
//
// Proof. N / M - n / m = ((N - n) - (n / m) (M - m)) / M. With |M| >= |m| - r_m, this gives the first bound.
//     N / M - n / m = ((N - n) - (N / M) (M - m)) / m. This gives the second bound.
template <typename Scalar>
struct KernelBound {
  /// The relative error bound (K5).
  static constexpr Scalar relative = 66 * (std::numeric_limits<Scalar>::epsilon() / 2);
  /// The maximum size for which the bound holds (K8, K9).
  static constexpr Scalar largest_size = std::is_same_v<Scalar, float> ? Scalar(0x1p34) : Scalar(0x1p300);
  static constexpr Scalar underflow = 32 * std::numeric_limits<Scalar>::denorm_min() * largest_size;  ///< See K8.
  /// The maximum absolute limit on t for which the bound holds (K9).
  static constexpr Scalar largest_limit = Scalar(0x1p16);
};
static_assert(12 * 0x1p34 * 0x1p34 * 0x1p34 * 0x1p16 < double{std::numeric_limits<float>::max()});

/// The two conditions of a range on t. Each end requires t_weight T + det_weight det >= 0, once det's sign is taken
/// out. The lower end is T - first det, and the upper end is last det - T. An infinite end requires nothing: its
/// condition is det >= 0, which always holds here.
template <typename Scalar>
struct RangeWeights {
  // The initial values are those of a whole segment, because most queries ask for it.
  Scalar t_first = 1;                              ///< The weight of T at the lower end.
  Scalar det_first = 0;                            ///< The weight of det at the lower end.
  Scalar t_last = -1;                              ///< The weight of T at the upper end.
  Scalar det_last = 1;                             ///< The weight of det at the upper end.
  Scalar t_bound = KernelBound<Scalar>::relative;  ///< The relative bound of T, or 0 if neither end has T.
  Scalar det_size = 2;                             ///< 1 plus the larger absolute weight of det.
  bool is_whole = true;                            ///< True if the range is [0, 1].
  bool decides = true;                             ///< True if the two conditions are all that the range requires.

  RangeWeights() = default;
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
  /// Returns the weights of a range of length 1 that contains 0: from `first` to `last`.
  [[nodiscard]] static RangeWeights of_part(Scalar first, Scalar last) {
    RangeWeights weights;
    weights.det_first = -first;
    weights.det_last = last;
    weights.is_whole = false;
    return weights;  // The other members are those of [0, 1].
  }
};

/// Error bounds for the determinants of one path and any triangle of one list. A list has one bound of each kind for
/// all of its triangles, because bounds for each lane take more operations. `d` is the largest component of D.
/// `edge` is the largest one of any E1 or E2. No component of any S exceeds `s`. Sizes that are too large are safe: no
/// bound becomes smaller, and K8 allows for them.
template <typename Scalar>
struct ListBounds {
  Scalar side;      ///< The bound of W, which also holds for U and V.
  Scalar range;     ///< The bound of both ends of the range.
  Scalar det;       ///< The bound of det.
  Scalar height;    ///< The bound of T.
  Scalar min_side;  ///< A side below this is a miss for any sign of det (K13). It is -(side + det).
  Scalar min_end;   ///< An end of [0, 1] below this is a miss for any sign of det (K14). It is -(range + det).

  ListBounds() = default;
  ListBounds(Scalar d, Scalar s, Scalar edge, const RangeWeights<Scalar>& weights) {
    using Bound = KernelBound<Scalar>;
    const Scalar d_edge = d * edge * Bound::relative;
    const Scalar s_edges = s * (edge * edge);
    side = d_edge * (2 * s + edge) + Bound::underflow;  // K5, K8
    det = d_edge * edge + Bound::underflow;
    height = s_edges * Bound::relative + Bound::underflow;
    range = s_edges * weights.t_bound + det * weights.det_size;
    min_side = -(side + det);
    min_end = -(range + det);
  }
};

}  // namespace surehit::detail
