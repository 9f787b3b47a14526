// Numbers of twice the precision of double. Highway compiles this for each instruction set.

#if defined(SUREHIT_DOUBLE_WORD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_DOUBLE_WORD_INL
#undef SUREHIT_DOUBLE_WORD_INL
#else
#define SUREHIT_DOUBLE_WORD_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A double word in each lane: the sum of two doubles, of which `high` is the double nearest to the sum.
///
/// The algorithms and their bounds are from Joldes, Muller and Popescu, "Tight and Rigorous Error Bounds for Basic
/// Building Blocks of Double-Word Arithmetic" (2017). Here eps = 2^-53. Factors must be at most 2^900, so that nothing
/// overflows.
///
/// DW1. `exact_sum` and `exact_product` have no error, unless the error of a product underflows (BN3 in bounded.hpp).
/// DW2. The sum of two double words is off by at most 3.1 eps^2 times the exact sum (algorithm 6).
/// DW3. The product of two double words is off by at most 7 eps^2 times the exact product (algorithm 10). If it
///     underflows, it may be off by 2^-1070 in addition.
template <class D>
struct DoubleWords {
  using V = hn::Vec<D>;
  V high;
  V low;

  /// Returns x + y, where x is zero or not smaller than y in size.
  HWY_INLINE static DoubleWords fast_sum(V x, V y) {
    const V sum = hn::Add(x, y);
    return {sum, hn::Sub(y, hn::Sub(sum, x))};
  }
  HWY_INLINE static DoubleWords exact_sum(V x, V y) {
    const V sum = hn::Add(x, y);
    const V y_part = hn::Sub(sum, x);
    return {sum, hn::Add(hn::Sub(x, hn::Sub(sum, y_part)), hn::Sub(y, y_part))};
  }
  HWY_INLINE static DoubleWords exact_product(V x, V y) {
    const V product = hn::Mul(x, y);
#if HWY_NATIVE_FMA
    return {product, hn::MulSub(x, y, product)};
#else
    // Dekker's product (1971), with halves by Veltkamp.
    const auto upper_half = [](V z) {
      const V scaled = hn::Mul(z, hn::Set(D(), 0x1p27 + 1));
      return hn::Sub(scaled, hn::Sub(scaled, z));
    };
    const V x1 = upper_half(x), x2 = hn::Sub(x, x1);
    const V y1 = upper_half(y), y2 = hn::Sub(y, y1);
    const V rest = hn::Add(hn::Sub(hn::Mul(x1, y1), product), hn::Mul(x1, y2));
    return {product, hn::Add(hn::Add(rest, hn::Mul(x2, y1)), hn::Mul(x2, y2))};
#endif
  }

  HWY_INLINE DoubleWords operator-() const { return {hn::Neg(high), hn::Neg(low)}; }
  /// The sum, with the error of DW2.
  HWY_INLINE friend DoubleWords operator+(const DoubleWords& x, const DoubleWords& y) {
    const DoubleWords high = exact_sum(x.high, y.high);
    const DoubleWords low = exact_sum(x.low, y.low);
    const DoubleWords middle = fast_sum(high.high, hn::Add(high.low, low.high));
    return fast_sum(middle.high, hn::Add(low.low, middle.low));
  }
  HWY_INLINE friend DoubleWords operator-(const DoubleWords& x, const DoubleWords& y) { return x + -y; }
  /// The product, with the error of DW3.
  HWY_INLINE friend DoubleWords operator*(const DoubleWords& x, const DoubleWords& y) {
    const DoubleWords product = exact_product(x.high, y.high);
    const V crossed = hn::Add(hn::Mul(x.high, y.low), hn::Mul(x.low, y.high));
    return fast_sum(product.high, hn::Add(product.low, crossed));
  }
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
