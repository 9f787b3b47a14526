// The determinants in double, for the instruction set that Highway compiles this for.

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

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A vector of three components for each lane.
template <class D>
struct Vectors {
  hn::Vec<D> x, y, z;
};

/// Möller and Trumbore's determinants of a path and a triangle in each lane, and the products of sizes that their
/// bounds are shares of (kernel_bound.hpp). Where a size is beyond what the bound allows for, the radius is infinite.
template <class D>
class DoubleDeterminants {
  using V = hn::Vec<D>;
  using Bound = KernelBound<double>;

 public:
  HWY_INLINE DoubleDeterminants(D d, const Vectors<D>& start, const Vectors<D>& direction, const Vectors<D>& a,
                                const Vectors<D>& b, const Vectors<D>& c)
      : d_(d) {
    const Vectors<D> e1 = difference(b, a);
    const Vectors<D> e2 = difference(c, a);
    const Vectors<D> s = difference(start, a);
    d_size = size(direction);
    const V e1_size = size(e1), e2_size = size(e2), s_size = size(s);
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
    // Far more than 12 eta (1 + largest) (1 + |first|), and for small sizes far less than one constant for all is.
    underflow_ = hn::IfThenElse(hn::Le(largest, hn::Set(d, Bound::largest_size)),
                                hn::Mul(hn::Add(one, largest), hn::Set(d, std::numeric_limits<double>::min())),
                                hn::Set(d, std::numeric_limits<double>::infinity()));
  }

  /// The bound on what a determinant, or a sum of some, is off by.
  [[nodiscard]] HWY_INLINE V radius(V sizes) const {
    return hn::MulAdd(sizes, hn::Set(d_, Bound::relative), underflow_);
  }

  V det, height, u, v;
  V det_size, height_size, u_size, v_size;
  V d_size;  ///< the largest component of the direction

 private:
  HWY_INLINE static Vectors<D> difference(const Vectors<D>& x, const Vectors<D>& y) {
    return {hn::Sub(x.x, y.x), hn::Sub(x.y, y.y), hn::Sub(x.z, y.z)};
  }
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

/// Quotients by one denominator in each lane, whose sign is certain: two divisions for all of them.
///
/// With n, r_n and d, r_d the values and radii: |N/D - n/d| <= (r_n + |n/d| r_d) / (|d| - r_d). The inverse of d is off
/// by u of itself, q = n (1/d) by 2 u |q|, the sums and the other inverse by a few u of themselves, and q - e and q + e
/// by u (|q| + e), all of which the factor and the term 2^-51 |q| cover. A q that underflows is off by 2^-1075 besides,
/// which r_d / (|d| - r_d) may enlarge, so it counts with |q|; its product with r_d may underflow, which 1 / (|d| -
/// r_d) may enlarge, so that counts with r_n; a few times as much is for what underflows after it. The least normal
/// number stands for each: a denormal operand costs some machines a hundred cycles. The inverse itself must not
/// underflow: beyond `largest_denominator` nothing is told.
template <class D>
struct Quotients {
  using V = hn::Vec<D>;

  HWY_INLINE static Quotients by(D d, V denominator, V radius) {
    constexpr double largest_denominator = 0x1p1000;
    const V one = hn::Set(d, 1);
    const V size = hn::Abs(denominator);
    const V infinity = hn::Set(d, std::numeric_limits<double>::infinity());
    return {
        hn::Div(one, denominator), radius,
        hn::IfThenElse(hn::Le(size, hn::Set(d, largest_denominator)), hn::Div(one, hn::Sub(size, radius)), infinity)};
  }

  struct Interval {
    V lower, upper;  ///< not finite where that cannot be told
  };
  [[nodiscard]] HWY_INLINE Interval of(V numerator, V numerator_radius) const {
    const D d;
    const V quotient = hn::Mul(numerator, inverse);
    const V size = hn::Abs(quotient);
    const V underflow = hn::Set(d, std::numeric_limits<double>::min());
    const V error =
        hn::Mul(hn::MulAdd(hn::Add(size, underflow), radius, hn::Add(numerator_radius, underflow)), max_inverse);
    const V bound = hn::MulAdd(error, hn::Set(d, radius_growth), hn::MulAdd(size, hn::Set(d, 0x1p-51), underflow));
    return {hn::Sub(quotient, bound), hn::Add(quotient, bound)};
  }

  V inverse;
  V radius;
  V max_inverse;  ///< of what the denominator may be, by size
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
