// Whole numbers of 160 bits. GPU.md has the lemma G23. There are no loops and no arrays, because compilers for devices
// take minutes over them. This text is GLSL and C++ alike, and comes after `hit_rounding.glsl`.

// The sum of a, 2^32 b, 2^64 c, 2^96 d and 2^128 e, less 2^160 if e begins with a 1.
struct WideInt {
  uint a;
  uint b;
  uint c;
  uint d;
  uint e;
};

WideInt int_of(uint a, uint b, uint c, uint d, uint e) {
  WideInt result;
  result.a = a;
  result.b = b;
  result.c = c;
  result.d = d;
  result.e = e;
  return result;
}

bool is_negative(WideInt x) { return x.e >= 0x80000000u; }
bool is_zero(WideInt x) { return (x.a | x.b | x.c | x.d | x.e) == 0u; }
bool is_positive(WideInt x) { return !is_negative(x) && !is_zero(x); }

uint carry_of(bool carries) { return carries ? 1u : 0u; }

// A number of two words.
struct TwoWords {
  uint low;
  uint high;
};

// Returns x + y + z, where z is 0 or 1.
TwoWords word_sum_of(uint x, uint y, uint z) {
  TwoWords result;
  uint part = y + z;
  result.low = x + part;
  result.high = carry_of(part < z) | carry_of(result.low < x);
  return result;
}

WideInt sum_with(WideInt x, WideInt y, uint carry) {
  TwoWords of_a = word_sum_of(x.a, y.a, carry);
  TwoWords of_b = word_sum_of(x.b, y.b, of_a.high);
  TwoWords of_c = word_sum_of(x.c, y.c, of_b.high);
  TwoWords of_d = word_sum_of(x.d, y.d, of_c.high);
  return int_of(of_a.low, of_b.low, of_c.low, of_d.low, x.e + y.e + of_d.high);
}

WideInt sum_of(WideInt x, WideInt y) { return sum_with(x, y, 0u); }
WideInt difference_of(WideInt x, WideInt y) { return sum_with(x, int_of(~y.a, ~y.b, ~y.c, ~y.d, ~y.e), 1u); }
WideInt negated(WideInt x) { return difference_of(int_of(0u, 0u, 0u, 0u, 0u), x); }

// Returns x + y, or x - y.
WideInt sum_or_difference_of(WideInt x, WideInt y, bool subtracts) {
  uint flips = subtracts ? 0xffffffffu : 0u;
  return sum_with(x, int_of(y.a ^ flips, y.b ^ flips, y.c ^ flips, y.d ^ flips, y.e ^ flips), flips & 1u);
}

// Returns the number, or its negative.
WideInt turned(WideInt x, bool is_turned) { return sum_or_difference_of(int_of(0u, 0u, 0u, 0u, 0u), x, is_turned); }
WideInt size_of(WideInt x) { return turned(x, is_negative(x)); }

// Returns x y + z + w.
TwoWords word_product_of(uint x, uint y, uint z, uint w) {
  TwoWords result;
  umulExtended(x, y, result.high, result.low);
  result.low += z;
  result.high += carry_of(result.low < z);
  result.low += w;
  result.high += carry_of(result.low < w);
  return result;
}

// A number of six words: `first` and 2^32 `rest`. It is not negative.
struct WideRow {
  uint first;
  WideInt rest;
};

// Returns x y + z. Neither y nor z is taken for negative.
WideRow row_of(uint x, WideInt y, WideInt z) {
  TwoWords of_a = word_product_of(x, y.a, z.a, 0u);
  TwoWords of_b = word_product_of(x, y.b, z.b, of_a.high);
  TwoWords of_c = word_product_of(x, y.c, z.c, of_b.high);
  TwoWords of_d = word_product_of(x, y.d, z.d, of_c.high);
  TwoWords of_e = word_product_of(x, y.e, z.e, of_d.high);
  WideRow result;
  result.first = of_a.low;
  result.rest = int_of(of_b.low, of_c.low, of_d.low, of_e.low, of_e.high);
  return result;
}

// Returns sum + x y, or sum - x y. x has at most 64 bits with its sign, and y 96.
WideInt sum_with_product(WideInt sum, WideInt x, WideInt y, bool subtracts) {
  WideInt p = size_of(x);
  WideInt q = size_of(y);
  TwoWords a_a = word_product_of(p.a, q.a, 0u, 0u);
  TwoWords a_b = word_product_of(p.a, q.b, a_a.high, 0u);
  TwoWords a_c = word_product_of(p.a, q.c, a_b.high, 0u);
  TwoWords b_a = word_product_of(p.b, q.a, a_b.low, 0u);
  TwoWords b_b = word_product_of(p.b, q.b, a_c.low, b_a.high);
  TwoWords b_c = word_product_of(p.b, q.c, a_c.high, b_b.high);
  bool is_below = is_negative(x) != is_negative(y);
  return sum_or_difference_of(sum, int_of(a_a.low, b_a.low, b_b.low, b_c.low, b_c.high), is_below != subtracts);
}

// The same of numbers that have at most 64 bits with their signs.
WideInt sum_with_short_product(WideInt sum, WideInt x, WideInt y, bool subtracts) {
  WideInt p = size_of(x);
  WideInt q = size_of(y);
  TwoWords a_a = word_product_of(p.a, q.a, 0u, 0u);
  TwoWords a_b = word_product_of(p.a, q.b, a_a.high, 0u);
  TwoWords b_a = word_product_of(p.b, q.a, a_b.low, 0u);
  TwoWords b_b = word_product_of(p.b, q.b, a_b.high, b_a.high);
  bool is_below = is_negative(x) != is_negative(y);
  return sum_or_difference_of(sum, int_of(a_a.low, b_a.low, b_b.low, b_b.high, 0u), is_below != subtracts);
}

// Returns the sign of x y - z w. None of them is negative.
int order_of_products(WideInt x, WideInt y, WideInt z, WideInt w) {
  WideInt none = int_of(0u, 0u, 0u, 0u, 0u);
  WideRow p_a = row_of(x.a, y, none);
  WideRow p_b = row_of(x.b, y, p_a.rest);
  WideRow p_c = row_of(x.c, y, p_b.rest);
  WideRow p_d = row_of(x.d, y, p_c.rest);
  WideRow p_e = row_of(x.e, y, p_d.rest);
  WideRow q_a = row_of(z.a, w, none);
  WideRow q_b = row_of(z.b, w, q_a.rest);
  WideRow q_c = row_of(z.c, w, q_b.rest);
  WideRow q_d = row_of(z.d, w, q_c.rest);
  WideRow q_e = row_of(z.e, w, q_d.rest);
  // Products are below 2^300, so their difference in ten words has its sign in the last one.
  WideInt low = difference_of(int_of(p_a.first, p_b.first, p_c.first, p_d.first, 0u),
                              int_of(q_a.first, q_b.first, q_c.first, q_d.first, 0u));
  WideInt middle = difference_of(int_of(p_e.first, p_e.rest.a, p_e.rest.b, p_e.rest.c, p_e.rest.d),
                                 int_of(q_e.first, q_e.rest.a, q_e.rest.b, q_e.rest.c, q_e.rest.d));
  middle = sum_of(middle, int_of(low.e, low.e, low.e, low.e, low.e));
  if (is_negative(middle)) return -1;
  return is_zero(middle) && (low.a | low.b | low.c | low.d) == 0u ? 0 : 1;
}

const real per_half_word = 1.0 / 65536.0;  // Quotients of constants are exact, and others may not be.
const real per_word = 1.0 / 4294967296.0;
const real pair_error = 32.0 * max_gap * max_gap;  // G25

FloatPair with_half_word(FloatPair x, uint word, real scale, real factor) {
  precise real term = real(word) * (scale * factor);
  FloatPair high = ordered_sum_of(x.high, term);
  precise real low = x.low + high.low;
  return pair_of(high.high, low);
}

// Returns a number times 2^-32 in a pair of floats, off by at most `pair_error` of it (G25).
FloatPair pair_from(WideInt x) {
  WideInt size = size_of(x);
  // Its first words, and what the last of them counts.
  bool has_e = size.e != 0u;
  bool has_d = size.d != 0u;
  uint first = has_e ? size.e : has_d ? size.d : size.c;
  uint second = has_e ? size.d : has_d ? size.c : size.b;
  uint third = has_e ? size.c : has_d ? size.b : size.a;
  real scale = has_e ? 18446744073709551616.0 : has_d ? 4294967296.0 : 1.0;  // 2^64, 2^32 or 1
  precise real of_first = real(first >> 16u) * (scale * 281474976710656.0);  // 2^48
  FloatPair result = pair_of(of_first, 0.0);
  result = with_half_word(result, first & 0xffffu, scale, 4294967296.0);
  result = with_half_word(result, second >> 16u, scale, 65536.0);
  result = with_half_word(result, second & 0xffffu, scale, 1.0);
  result = with_half_word(result, third >> 16u, scale, per_half_word);
  result = with_half_word(result, third & 0xffffu, scale, per_word);
  result = ordered_sum_of(result.high, result.low);
  return is_negative(x) ? negated(result) : result;
}
