// The determinants in double. Highway compiles this for each instruction set.

#if defined(SUREHIT_DOUBLE_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_DOUBLE_KERNEL_INL
#undef SUREHIT_DOUBLE_KERNEL_INL
#else
#define SUREHIT_DOUBLE_KERNEL_INL
#endif

#include <hwy/highway.h>

#include <limits>

#include "filter/bounded.hpp"
#include "filter/kernel_bound.hpp"
#include "surehit/path.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A geometric vector in each lane.
template <class D>
struct Vectors {
  hn::Vec<D> x, y, z;
};

/// Returns x - y.
template <class D>
HWY_INLINE Vectors<D> difference(const Vectors<D>& x, const Vectors<D>& y) {
  return {hn::Sub(x.x, y.x), hn::Sub(x.y, y.y), hn::Sub(x.z, y.z)};
}

/// Returns the directions D of paths of one kind.
template <class D>
HWY_INLINE Vectors<D> directions_of(PathKind kind, const Vectors<D>& start, const Vectors<D>& toward) {
  return kind == PathKind::segment ? difference<D>(toward, start) : toward;
}

/// How much the sizes of a path's start and direction grow, because its numbers have errors (I8).
template <class D>
struct PathSlack {
  hn::Vec<D> start, direction;
};

/// The determinants of Möller and Trumbore, for a path and a triangle in each lane. Each has its product of sizes,
/// which gives its error bound (K4 in kernel_bound.hpp). If a size is above `largest_size`, the radius is infinite or
/// NaN.
template <class D>
class DoubleDeterminants {
  using V = hn::Vec<D>;
  using Bound = KernelBound<double>;

 public:
  /// The path's numbers are exact if there is no slack.
  template <typename... Slack>
  HWY_INLINE DoubleDeterminants(D d, const Vectors<D>& start, const Vectors<D>& direction, const Vectors<D>& a,
                                const Vectors<D>& b, const Vectors<D>& c, const Slack&... slack)
      : d_(d) {
    const Vectors<D> e1 = difference<D>(b, a);
    const Vectors<D> e2 = difference<D>(c, a);
    const Vectors<D> s = difference<D>(start, a);
    d_size = size(direction);
    V s_size = size(s);
    ((d_size = hn::Add(d_size, slack.direction), s_size = hn::Add(s_size, slack.start)), ...);
    const V e1_size = size(e1), e2_size = size(e2);
    const Vectors<D> p = cross(direction, e2);
    const Vectors<D> q = cross(s, e1);
    det = dot(e1, p);
    height = dot(e2, q);
    u = dot(s, p);
    v = dot(direction, q);
    const V edge_sizes = hn::Mul(e1_size, e2_size);
    det_size = hn::Mul(d_size, edge_sizes);
    height_size = hn::Mul(s_size, edge_sizes);
    u_size = hn::Mul(hn::Mul(s_size, d_size), e2_size);
    v_size = hn::Mul(hn::Mul(s_size, d_size), e1_size);
    const V largest = hn::Max(hn::Max(d_size, s_size), hn::Max(e1_size, e2_size));
    const V one = hn::Set(d, 1);
    // K7 asks for 12 eta (1 + largest) (1 + |first|), and the smallest normal number is far above 12 eta (1 + |first|).
    // The constant of K8 would be too large for small sizes.
    underflow_ = hn::IfThenElse(hn::Le(largest, hn::Set(d, Bound::largest_size)),
                                hn::Mul(hn::Add(one, largest), hn::Set(d, std::numeric_limits<double>::min())),
                                hn::Set(d, std::numeric_limits<double>::infinity()));
  }

  /// Returns the error bound of a determinant, or of a sum of some, from its products of sizes (K5).
  [[nodiscard]] HWY_INLINE V radius(V sizes) const {
    return hn::MulAdd(sizes, hn::Set(d_, Bound::relative), underflow_);
  }

  V det, height, u, v;
  V det_size, height_size, u_size, v_size;
  V d_size;  ///< The largest component of the direction.

 private:
  HWY_INLINE static Vectors<D> cross(const Vectors<D>& x, const Vectors<D>& y) {
    return {hn::MulSub(x.y, y.z, hn::Mul(x.z, y.y)), hn::MulSub(x.z, y.x, hn::Mul(x.x, y.z)),
            hn::MulSub(x.x, y.y, hn::Mul(x.y, y.x))};
  }
  HWY_INLINE static V dot(const Vectors<D>& x, const Vectors<D>& y) {
    return hn::MulAdd(x.x, y.x, hn::MulAdd(x.y, y.y, hn::Mul(x.z, y.z)));
  }
  HWY_INLINE static V size(const Vectors<D>& x) { return hn::Max(hn::Max(hn::Abs(x.x), hn::Abs(x.y)), hn::Abs(x.z)); }

  [[no_unique_address]] D d_;
  V underflow_;
};

/// Quotients by one denominator in each lane. Its sign must be certain. All quotients share two divisions.
///
/// Let n and m be the values of numerator and denominator, with the radii r_n and r_m. Let q = n (1 / m) as computed,
/// and eps = 2^-53. Let E = (r_n + |q| r_m) / (|m| - r_m), which is the bound of K10.
///
/// Q1. Without underflow, [q - B, q + B] contains the exact quotient, where B = (1 + 16 eps) E + 4 eps |q|.
/// Proof. The inverse and the product are rounded, so q is off by 2 eps |q|. The ends q - B and q + B are rounded too,
///     by eps (|q| + B). Together, the terms in |q| are 3 eps |q|, and 4 eps |q| covers them.
///     The computed E has at most 10 roundings, and eps B is one more. The factor 1 + 16 eps covers them.
///
/// Q2. The term `underflow` covers underflow. Each of these numbers may lose 2^-1075:
///
///     q                   In E, r_m / (|m| - r_m) may enlarge this. So `underflow` is added to |q|.
///     |q| r_m             In E, 1 / (|m| - r_m) may enlarge this. So `underflow` is added to r_n.
///     what comes later    Nothing enlarges this. So `underflow` is added to B, which covers q itself too.
///
/// Proof. It is the smallest normal number, which is far above a few times 2^-1075. A denormal number would be enough,
///     but denormal operands are slow on some machines.
///
/// Q3. The inverse does not underflow. Above `largest_denominator` the bound is infinite, so nothing is certain.
template <class D>
struct Quotients {
  using V = hn::Vec<D>;

  HWY_INLINE static Quotients by(D d, V denominator, V radius) {
    constexpr double largest_denominator = 0x1p1000;
    const V one = hn::Set(d, 1);
    const V size = hn::Abs(denominator);
    const V infinity = hn::Set(d, std::numeric_limits<double>::infinity());
    // Q3
    return {
        hn::Div(one, denominator), radius,
        hn::IfThenElse(hn::Le(size, hn::Set(d, largest_denominator)), hn::Div(one, hn::Sub(size, radius)), infinity)};
  }

  struct Interval {
    V lower, upper;  ///< Both are finite only if the bound is known.
  };
  [[nodiscard]] HWY_INLINE Interval of(V numerator, V numerator_radius) const {
    const D d;
    const V quotient = hn::Mul(numerator, inverse);
    const V size = hn::Abs(quotient);
    const V underflow = hn::Set(d, std::numeric_limits<double>::min());
    // Q1 and Q2
    const V error =
        hn::Mul(hn::MulAdd(hn::Add(size, underflow), radius, hn::Add(numerator_radius, underflow)), max_inverse);
    const V bound = hn::MulAdd(error, hn::Set(d, radius_growth), hn::MulAdd(size, hn::Set(d, 0x1p-51), underflow));
    return {hn::Sub(quotient, bound), hn::Add(quotient, bound)};
  }

  V inverse;      ///< The inverse of the denominator.
  V radius;       ///< The radius of the denominator.
  V max_inverse;  ///< The largest size that the exact inverse may have.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
