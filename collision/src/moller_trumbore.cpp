#include "moller_trumbore.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surehit::detail {
namespace {

// The bound. u is the unit roundoff; d, e, f and s are the largest components, as computed, of D, E1, E2 and S.
//
// det = E1·(D × E2) is a sum of six products of three factors. Each product passes through at most 8 roundings: three
// differences, the inner product and the difference in the cross product, the outer product and two sums (fewer where a
// multiplication is fused with the sum; a ray's D is not rounded at all). So the computed det is off by at most
// gamma_8 · 6 |D||E1||E2| <= 48 u d e f up to factors 1 + O(u) (Higham, "Accuracy and Stability", lemma 3.1), and
// likewise T = E2·(S × E1) with f s e, U = S·(D × E2) with s d f, V = D·(S × E1) with d s e. No |det| exceeds 6 d e f.
//
// What is combined from them adds its own roundings, each at most u times the operands' sizes, 6 d e f and so on:
//   W = det - U - V           48 u + 2 · 6 u of each
//   T - first det             48 u + 6 u of T; 48 u + 2 · 6 u of |first| det
// so that 60 u of each product of sizes bounds them all. The bound is itself computed with at most 8 roundings in any
// of its terms, and holds sizes that are off by u each: 66 leaves a tenth for that, where 11 u would do.
//
// Underflow: a product may lose half the least denormal, eta / 2. In det: eta in each component of the cross product,
// times e, three times over, and 3 eta / 2 in the dot product; in first det: |first| times that and eta / 2; in the
// bound: f eta / 2 and twice eta / 2 for each size product, times |first|. All are below 12 eta (1 + largest) (1 +
// |first|), far less than the least normal number times (1 + largest) as long as |first| and |last| stay below
// `largest_limit`.
//
// Overflow: with every size up to `largest_size`, the largest number formed is under 6 · 2 · largest_size^3 ·
// largest_limit.
template <typename Scalar>
struct Bound {
  static constexpr Scalar relative = 66 * (std::numeric_limits<Scalar>::epsilon() / 2);
  static constexpr Scalar underflow = std::numeric_limits<Scalar>::min();
  static constexpr Scalar largest_size = std::is_same_v<Scalar, float> ? Scalar(0x1p34) : Scalar(0x1p300);
  static constexpr Scalar largest_limit = Scalar(0x1p16);
};
static_assert(12 * 0x1p34 * 0x1p34 * 0x1p34 * 0x1p16 < double{std::numeric_limits<float>::max()});
static_assert(12 * (1 + 0x1p16) * 0x1p-149 < double{std::numeric_limits<float>::min()});

template <typename Scalar>
Vector3<Scalar> cross(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

template <typename Scalar>
Scalar dot(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

template <typename Scalar>
Scalar size(const Vector3<Scalar>& x) {
  return std::max({std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2])});
}

}  // namespace

template <typename Scalar>
MollerTrumbore<Scalar>::MollerTrumbore(const Path<Scalar>& path, const PathRange<Scalar>& range)
    : start_(path.start),
      d_(path.kind == PathKind::segment ? Vector3<Scalar>(path.toward - path.start) : path.toward),
      d_size_(size(d_)),
      first_(range.first),
      last_(range.last),
      bounds_first_(std::fabs(first_) <= Bound<Scalar>::largest_limit),
      bounds_last_(std::fabs(last_) <= Bound<Scalar>::largest_limit),
      can_hit_((bounds_first_ || std::isinf(first_)) && (bounds_last_ || std::isinf(last_))) {}

template <typename Scalar>
Verdict MollerTrumbore<Scalar>::classify(const Triangle<Scalar>& triangle) const {
  const Vector3<Scalar> e1 = triangle.b - triangle.a;
  const Vector3<Scalar> e2 = triangle.c - triangle.a;
  const Vector3<Scalar> s = start_ - triangle.a;
  const Scalar e1_size = size(e1);
  const Scalar e2_size = size(e2);
  const Scalar s_size = size(s);
  const Scalar largest = std::max({d_size_, e1_size, e2_size, s_size});
  if (!(largest <= Bound<Scalar>::largest_size)) return Verdict::undecided;

  const Vector3<Scalar> p = cross(d_, e2);
  const Vector3<Scalar> q = cross(s, e1);
  const Scalar det = dot(e1, p);
  const Scalar height = dot(e2, q);
  const Scalar u = dot(s, p);
  const Scalar v = dot(d_, q);
  const Scalar w = det - u - v;

  const Scalar underflow = (1 + largest) * Bound<Scalar>::underflow;
  const Scalar det_size = d_size_ * e1_size * e2_size;
  const Scalar height_size = s_size * e1_size * e2_size;
  const Scalar u_size = s_size * d_size_ * e2_size;
  const Scalar v_size = s_size * d_size_ * e1_size;

  // Each of these, with det's sign taken out, must be at least zero for a hit. So two of certain and opposite signs are
  // a miss, even where det's own sign is not certain: were det zero, a path that meets the triangle would lie in its
  // plane and all of them would vanish. All certain and of one sign are a hit: det = U + V + W then has that sign too.
  bool any_positive = false;
  bool any_negative = false;
  bool all_certain = can_hit_;
  const auto weigh = [&](Scalar value, Scalar sizes) {
    const Scalar bound = Bound<Scalar>::relative * sizes + underflow;
    const bool positive = value > bound;
    const bool negative = value < -bound;
    any_positive |= positive;
    any_negative |= negative;
    all_certain &= positive || negative;
  };
  weigh(u, u_size);
  weigh(v, v_size);
  weigh(w, det_size + u_size + v_size);
  if (bounds_first_) weigh(height - first_ * det, height_size + std::fabs(first_) * det_size);
  if (bounds_last_) weigh(last_ * det - height, height_size + std::fabs(last_) * det_size);
  if (any_positive && any_negative) return Verdict::miss;
  return all_certain ? Verdict::hit : Verdict::undecided;
}

template class MollerTrumbore<float>;
template class MollerTrumbore<double>;

}  // namespace surehit::detail
