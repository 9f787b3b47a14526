// Rounds t, u and v of a hit in pairs of floats. GPU.md has the lemmas G10 to G14. This text is GLSL and C++ alike, so
// that a test can attack it with roundings that a device may choose. The device's floats are `real` here. Only what is
// `precise` is computed as it is written (G1).

const real max_gap = 1.0 / 8388608.0;                 // 2^-23: floats around 1 are at most this far apart (G1).
const real pair_relative = 40.0 * max_gap * max_gap;  // G12
const real pair_flushes = max_gap * max_gap / 16.0;   // 2^-50 (G12)
const real min_pair_size = 1.0 / 1048576.0;           // 2^-20 (G12)
const real slack_of_bounds = 1.125;                   // G13
const real min_size_of_errors = 1048576.0;            // 2^20 (G19)
const real share_of_second_order = 1.0 / 32768.0;     // 2^-15 (G19)
const real max_quotient = 1152921504606846976.0;      // 2^60 (G13)
const real min_quotient = 1.0 / max_quotient;

// The sum of two floats, of which `low` is about as small as an error of rounding.
struct FloatPair {
  real high;
  real low;
};

struct PairVector {
  FloatPair x;
  FloatPair y;
  FloatPair z;
};

FloatPair pair_of(real high, real low) {
  FloatPair result;
  result.high = high;
  result.low = low;
  return result;
}

// Returns x + y, off by at most 2^-46 of it (G10). `larger` is no less in size.
FloatPair ordered_sum_of(real larger, real smaller) {
  precise real sum = larger + smaller;
  precise real part = sum - larger;
  precise real rest = smaller - part;
  return pair_of(sum, rest);
}

FloatPair sum_of(real x, real y) {
  bool is_ordered = abs(x) >= abs(y);
  return ordered_sum_of(is_ordered ? x : y, is_ordered ? y : x);
}

// Returns x with the upper 12 bits of its significand alone.
real upper_half(real x) { return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u); }

// Returns x y exactly (G11).
FloatPair product_of(real x, real y) {
  real x_upper = upper_half(x);
  real y_upper = upper_half(y);
  precise real x_lower = x - x_upper;
  precise real y_lower = y - y_upper;
  precise real product = x * y;
  precise real rest = x_upper * y_upper - product + x_upper * y_lower + x_lower * y_upper + x_lower * y_lower;
  return pair_of(product, rest);
}

FloatPair negated(FloatPair x) { return pair_of(-x.high, -x.low); }

FloatPair sum_of_pairs(FloatPair x, FloatPair y) {
  FloatPair high = sum_of(x.high, y.high);
  precise real low = x.low + y.low + high.low;
  return pair_of(high.high, low);
}

FloatPair product_of_pairs(FloatPair x, FloatPair y) {
  FloatPair product = product_of(x.high, y.high);
  precise real low = x.high * y.low + x.low * y.high + product.low;
  return ordered_sum_of(product.high, low);
}

PairVector pairs_of(vec3 x) {
  PairVector result;
  result.x = pair_of(x.x, 0.0);
  result.y = pair_of(x.y, 0.0);
  result.z = pair_of(x.z, 0.0);
  return result;
}

PairVector difference_of(vec3 x, vec3 y) {
  PairVector result;
  result.x = sum_of(x.x, -y.x);
  result.y = sum_of(x.y, -y.y);
  result.z = sum_of(x.z, -y.z);
  return result;
}

real size_of_pairs(PairVector p) {
  return max(max(abs(p.x.high), abs(p.y.high)), max(abs(p.z.high), min_pair_size));
}

// Returns x y - z w.
FloatPair component_of(FloatPair x, FloatPair y, FloatPair z, FloatPair w) {
  FloatPair all = sum_of_pairs(product_of_pairs(x, y), negated(product_of_pairs(z, w)));
  return sum_of(all.high, all.low);
}

PairVector cross_of_pairs(PairVector p, PairVector q) {
  PairVector result;
  result.x = component_of(p.y, q.z, p.z, q.y);
  result.y = component_of(p.z, q.x, p.x, q.z);
  result.z = component_of(p.x, q.y, p.y, q.x);
  return result;
}

FloatPair dot_of_pairs(PairVector p, PairVector q) {
  FloatPair of_x_and_y = sum_of_pairs(product_of_pairs(p.x, q.x), product_of_pairs(p.y, q.y));
  FloatPair all = sum_of_pairs(of_x_and_y, product_of_pairs(p.z, q.z));
  return sum_of(all.high, all.low);
}

// Returns the sum of the sizes of all six products in p · (q × r), apart from roundings.
real products_of(PairVector p, PairVector q, PairVector r) {
  precise real in_x = abs(p.x.high) * (abs(q.y.high * r.z.high) + abs(q.z.high * r.y.high));
  precise real in_y = abs(p.y.high) * (abs(q.z.high * r.x.high) + abs(q.x.high * r.z.high));
  precise real in_z = abs(p.z.high) * (abs(q.x.high * r.y.high) + abs(q.y.high * r.x.high));
  precise real all = in_x + in_y + in_z;
  return all;
}

// Returns how far off p · (q × r) is at most (G12).
real bound_of(PairVector p, PairVector q, PairVector r) {
  precise real of_sizes = size_of_pairs(p) * size_of_pairs(q) * size_of_pairs(r);
  precise real bound = pair_relative * products_of(p, q, r) + pair_flushes * of_sizes;
  return bound;
}

// What is left of n - q m, and how far off that is at most (G13).
struct Remainder {
  real rest;
  real bound;
};

Remainder remainder_of(FloatPair n, real n_bound, FloatPair m, real m_bound, real q) {
  FloatPair product = product_of(q, m.high);
  precise real large = n.high - product.high;
  precise real high = large - product.low;
  precise real small = q * m.low;
  precise real low = n.low - small;
  precise real rest = high + low;
  precise real roundings = max_gap * (abs(large) + abs(high) + abs(small) + abs(low) + abs(rest));
  precise real bound = n_bound + abs(q) * m_bound + roundings;
  Remainder result;
  result.rest = rest;
  result.bound = bound;
  return result;
}

struct RoundedNumber {
  real number;
  bool is_rounded;
};

bool is_in_range(real q) { return abs(q) >= min_quotient && abs(q) <= max_quotient; }

// Returns the float nearest to n / m, where that is certain. m is positive (G14).
RoundedNumber quotient_of(FloatPair n, real n_bound, FloatPair m, real m_bound) {
  RoundedNumber result;
  result.number = 0.0;
  result.is_rounded = false;
  precise real guess = n.high / m.high;
  if (!is_in_range(guess)) return result;
  precise real step = remainder_of(n, n_bound, m, m_bound, guess).rest / m.high;
  precise real q = guess + step;
  if (!is_in_range(q)) return result;
  Remainder of_q = remainder_of(n, n_bound, m, m_bound, q);
  bool is_beyond = (of_q.rest < 0.0) == (q < 0.0);  // n / m is farther from 0 than q is.
  uint bits = floatBitsToUint(q);
  real next = uintBitsToFloat(is_beyond ? bits + 1u : bits - 1u);
  precise real gap = abs(next - q);
  precise real half_way = 0.5 * gap * m.high;
  precise real bound = slack_of_bounds * (of_q.bound + 1.25 * gap * (abs(m.low) + m_bound));
  precise real max_rest = abs(of_q.rest) + bound;
  precise real min_rest = abs(of_q.rest) - bound;
  precise real beyond_next = 2.5 * half_way;
  precise real widest = 0.5 * half_way;
  bool is_nearest = max_rest < half_way && bound < widest;
  bool is_next_nearest = min_rest > half_way && max_rest < beyond_next;
  result.is_rounded = is_nearest || is_next_nearest;
  result.number = is_nearest ? q : next;
  return result;
}

struct RoundedHit {
  real t;
  real u;
  real v;
  bool is_front;
  bool is_rounded;
};

// A vector in pairs, of which no component is off by more than `error` besides its rounding.
struct OffVector {
  PairVector pairs;
  real error;
};

OffVector off_by(real error, PairVector pairs) {
  OffVector result;
  result.pairs = pairs;
  result.error = error;
  return result;
}

// Returns a vector that has this number on all axes.
PairVector all_pairs(real x) {
  PairVector result;
  result.x = pair_of(x, 0.0);
  result.y = pair_of(x, 0.0);
  result.z = pair_of(x, 0.0);
  return result;
}

real size_of_off(OffVector p) {
  precise real of_error = min_size_of_errors * p.error;
  return max(size_of_pairs(p.pairs), of_error);
}

// Returns how far off p · (q × r) is at most (G12, G19).
real off_bound_of(OffVector p, OffVector q, OffVector r) {
  PairVector of_p = all_pairs(p.error);
  PairVector of_q = all_pairs(q.error);
  PairVector of_r = all_pairs(r.error);
  precise real of_errors = products_of(of_p, q.pairs, r.pairs) + products_of(p.pairs, of_q, r.pairs) +
                           products_of(p.pairs, q.pairs, of_r);
  real p_size = size_of_off(p);
  real q_size = size_of_off(q);
  real r_size = size_of_off(r);
  precise real of_sizes = p.error * q_size * r_size + q.error * p_size * r_size + r.error * p_size * q_size;
  precise real bound = bound_of(p.pairs, q.pairs, r.pairs) + 1.0625 * of_errors + share_of_second_order * of_sizes;
  return bound;
}

// The determinants of a path and a triangle in pairs, with the sign of det taken out, and how far off they are at most.
struct PairDeterminants {
  FloatPair det;
  FloatPair height;
  FloatPair u;
  FloatPair v;
  real det_bound;
  real height_bound;
  real u_bound;
  real v_bound;
  bool is_front;    // True if det is positive.
  bool is_certain;  // True if the sign of det is certain (G20).
};

PairDeterminants determinants_of(OffVector d, OffVector e, OffVector f, OffVector s) {
  PairVector p = cross_of_pairs(d.pairs, f.pairs);
  PairVector q = cross_of_pairs(s.pairs, e.pairs);
  PairDeterminants result;
  result.det = dot_of_pairs(e.pairs, p);
  result.height = dot_of_pairs(f.pairs, q);
  result.u = dot_of_pairs(s.pairs, p);
  result.v = dot_of_pairs(d.pairs, q);
  result.is_front = result.det.high > 0.0;
  if (!result.is_front) {
    result.det = negated(result.det);
    result.height = negated(result.height);
    result.u = negated(result.u);
    result.v = negated(result.v);
  }
  result.det_bound = off_bound_of(e, d, f);
  result.height_bound = off_bound_of(f, s, e);
  result.u_bound = off_bound_of(s, d, f);
  result.v_bound = off_bound_of(d, s, e);
  precise real min_det = 4.0 * result.det_bound;
  result.is_certain = result.det.high > min_det;
  return result;
}

// Rounds a certain hit.
RoundedHit round_determinants(PairDeterminants of) {
  RoundedHit result;
  result.is_front = of.is_front;
  result.t = 0.0;
  result.u = 0.0;
  result.v = 0.0;
  result.is_rounded = false;
  if (!of.is_certain) return result;
  RoundedNumber t = quotient_of(of.height, of.height_bound, of.det, of.det_bound);
  RoundedNumber u = quotient_of(of.u, of.u_bound, of.det, of.det_bound);
  RoundedNumber v = quotient_of(of.v, of.v_bound, of.det, of.det_bound);
  result.t = t.number;
  result.u = u.number;
  result.v = v.number;
  result.is_rounded = t.is_rounded && u.is_rounded && v.is_rounded;
  return result;
}

// Returns the determinants of a path, which has a start and an end, or an origin and a direction, and of a triangle.
PairDeterminants pair_determinants_of(vec3 start, vec3 toward, bool is_segment, vec3 a, vec3 b, vec3 c) {
  PairVector d = difference_of(toward, start);
  if (!is_segment) d = pairs_of(toward);
  return determinants_of(off_by(0.0, d), off_by(0.0, difference_of(b, a)), off_by(0.0, difference_of(c, a)),
                         off_by(0.0, difference_of(start, a)));
}

// Rounds a certain hit of such a path.
RoundedHit round_hit(vec3 start, vec3 toward, bool is_segment, vec3 a, vec3 b, vec3 c) {
  return round_determinants(pair_determinants_of(start, toward, is_segment, a, b, c));
}
