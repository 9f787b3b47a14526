#include "exact/limbs.hpp"

#include <algorithm>
#include <array>

#include "exact/int128.hpp"
#include "exact/rounded_to_nearest.hpp"

namespace surehit::detail::limbs {
namespace {

/// Writes a + b, and returns its size. The result may be a or b.
int set_sum(Limb* result, Magnitude a, Magnitude b) {
  const Magnitude& longer = a.size < b.size ? b : a;
  const Magnitude& shorter = a.size < b.size ? a : b;
  Limb carry = 0;
  for (int i = 0; i < longer.size; ++i) {
    const Uint128 sum = Uint128{longer.limb[i]} + (i < shorter.size ? shorter.limb[i] : 0) + carry;
    result[i] = static_cast<Limb>(sum);
    carry = static_cast<Limb>(sum >> 64);
  }
  result[longer.size] = carry;
  return longer.size + (carry != 0 ? 1 : 0);
}

/// Writes large - small, and returns its size. The result may be either.
int set_difference(Limb* result, Magnitude large, Magnitude small) {
  Limb borrow = 0;
  for (int i = 0; i < large.size; ++i) {
    const Uint128 difference = Uint128{large.limb[i]} - (i < small.size ? small.limb[i] : 0) - borrow;
    result[i] = static_cast<Limb>(difference);
    borrow = static_cast<Limb>(difference >> 64) & 1;
  }
  return trimmed(result, large.size);
}

/// The digits of a product, from the lowest on. Products are added by column (Comba 1990), so they need no memory.
class ProductDigits {
 public:
  ProductDigits(Magnitude a, Magnitude b) : a_(a), b_(b) {}

  [[nodiscard]] Limb next() {
    Uint128 low = carry_[0];
    Uint128 high = carry_[1];
    for (int i = std::max(0, index_ - b_.size + 1); i < std::min(a_.size, index_ + 1); ++i) {
      const Uint128 product = Uint128{a_.limb[i]} * b_.limb[index_ - i];
      low += static_cast<Limb>(product);
      high += static_cast<Limb>(product >> 64);
    }
    ++index_;
    high += low >> 64;
    carry_ = {static_cast<Limb>(high), static_cast<Limb>(high >> 64)};
    return static_cast<Limb>(low);
  }

 private:
  Magnitude a_;
  Magnitude b_;
  int index_ = 0;
  std::array<Limb, 2> carry_ = {0, 0};
};

/// Sets x to x - factor × other, plus other as often as needed to bring it into [0, other). Returns how often that is.
/// The difference must be in (-4 other, other).
int reduce(Limb* x, int& size, Limb factor, Magnitude other) {
  const int length = std::max(size, other.size + 1);
  std::fill(x + size, x + length, Limb{0});
  Limb borrow = 0;  // This is the product's high half plus the borrow of the subtraction.
  for (int i = 0; i < length; ++i) {
    const Uint128 product = Uint128{factor} * (i < other.size ? other.limb[i] : 0) + borrow;
    const auto low = static_cast<Limb>(product);
    borrow = static_cast<Limb>(product >> 64) + (x[i] < low ? 1 : 0);
    x[i] -= low;
  }
  int times = 0;
  // A negative value is in two's complement here. A carry out of the top limb shows that it is no longer negative.
  for (bool below_zero = borrow != 0; below_zero; ++times) {
    Limb carry = 0;
    for (int i = 0; i < length; ++i) {
      const Uint128 sum = Uint128{x[i]} + (i < other.size ? other.limb[i] : 0) + carry;
      x[i] = static_cast<Limb>(sum);
      carry = static_cast<Limb>(sum >> 64);
    }
    below_zero = carry == 0;
  }
  size = trimmed(x, length);
  return times;
}

}  // namespace

Limb bits_from(Magnitude a, int lowest) {
  if (lowest < 0) return lowest <= -64 ? 0 : bits_from(a, 0) << -lowest;
  const int at = lowest / 64;
  const int shift = lowest % 64;
  const Limb low = at < a.size ? a.limb[at] >> shift : 0;
  const Limb high = shift != 0 && at + 1 < a.size ? a.limb[at + 1] << (64 - shift) : 0;
  return low | high;
}

int compare(Magnitude a, Magnitude b) {
  if (a.size != b.size) return a.size < b.size ? -1 : 1;
  for (int i = a.size - 1; i >= 0; --i) {
    if (a.limb[i] != b.limb[i]) return a.limb[i] < b.limb[i] ? -1 : 1;
  }
  return 0;
}

int compare_products(Magnitude a, Magnitude b, Magnitude c, Magnitude d) {
  ProductDigits first_digits(a, b);
  ProductDigits second_digits(c, d);
  int order = 0;
  for (int size = std::max(a.size + b.size, c.size + d.size); size > 0; --size) {
    const Limb first = first_digits.next();
    const Limb second = second_digits.next();
    if (first != second) order = first < second ? -1 : 1;  // Higher digits come later and overrule lower ones.
  }
  return order;
}

int set_product(Limb* result, Magnitude a, Magnitude b) {
  if (a.size == 0 || b.size == 0) return 0;
  std::fill_n(result, b.size, Limb{0});
  for (int i = 0; i < a.size; ++i) {
    Limb carry = 0;
    for (int j = 0; j < b.size; ++j) {
      const Uint128 sum = Uint128{a.limb[i]} * b.limb[j] + result[i + j] + carry;
      result[i + j] = static_cast<Limb>(sum);
      carry = static_cast<Limb>(sum >> 64);
    }
    result[i + b.size] = carry;
  }
  return trimmed(result, a.size + b.size);
}

void add(Limb* limb, int& size, bool& negative, Magnitude other, bool other_negative) {
  if (other.size == 0) return;
  const Magnitude own = {limb, size};
  if (size == 0) {
    std::copy_n(other.limb, other.size, limb);
    size = other.size;
    negative = other_negative;
  } else if (negative == other_negative) {
    size = set_sum(limb, own, other);
  } else if (const int order = compare(own, other); order == 0) {
    size = 0;
  } else if (order > 0) {
    size = set_difference(limb, own, other);
  } else {
    size = set_difference(limb, other, own);
    negative = other_negative;
  }
}

int shift_left(Limb* limb, int size, int count, int capacity) {
  if (size == 0 || count == 0) return size;
  const int whole = count / 64;
  const int bits = count % 64;
  for (int i = size; i >= 0; --i) {
    const Limb high = i < size ? limb[i] << bits : 0;
    const Limb low = bits != 0 && i > 0 ? limb[i - 1] >> (64 - bits) : 0;
    if (i + whole < capacity) limb[i + whole] = high | low;
  }
  std::fill_n(limb, whole, Limb{0});
  return trimmed(limb, std::min(size + whole + 1, capacity));
}

// This is one step of Knuth's long division with digits of 64 bits (The Art of Computer Programming 2, section 4.3.1,
// algorithm D). A shift first gives the quotient 63 or 64 bits. The leading bits then give an estimate, which is at
// most 3 too large. The remainder corrects it. Of all bits below the quotient, rounding only needs to know whether the
// remainder is zero.
template <typename Scalar>
Scalar rounded_quotient(Limb* numerator, int numerator_size, Limb* denominator, int denominator_size, int exponent,
                        bool negative) {
  if (numerator_size == 0) return 0;
  const int capacity = std::max(numerator_size, denominator_size) + 2;
  const int shift = 63 - (bit_length({numerator, numerator_size}) - bit_length({denominator, denominator_size}));
  if (shift >= 0) {
    numerator_size = shift_left(numerator, numerator_size, shift, capacity);
  } else {
    denominator_size = shift_left(denominator, denominator_size, -shift, capacity);
  }
  const Magnitude n = {numerator, numerator_size};
  const Magnitude d = {denominator, denominator_size};
  const int below = bit_length(d) - 64;
  const Uint128 leading = (Uint128{bits_from(n, below + 64)} << 64) | bits_from(n, below);
  Limb estimate = quotient(leading, bits_from(d, below));
  estimate -= static_cast<Limb>(reduce(numerator, numerator_size, estimate, d));
  return rounded_to_nearest<Scalar>(estimate, numerator_size != 0, exponent - shift, negative);
}

template float rounded_quotient(Limb*, int, Limb*, int, int, bool);
template double rounded_quotient(Limb*, int, Limb*, int, int, bool);

}  // namespace surehit::detail::limbs
