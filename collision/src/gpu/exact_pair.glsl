// Decides a path and a triangle in whole numbers. GPU.md has the lemmas G23 to G26. This text is GLSL and C++ alike,
// and comes after `pair_kernel.glsl` and `wide_int.glsl`.

const int max_octaves = 21;                                // G23
const real share_error = 96.0 * max_gap * max_gap;         // G25
const real no_limit = 1267650600228229401496703205376.0;   // 2^100 stands for infinity in a range.
const real per_max_t = 1.0 / 79228162514264337593543950336.0;  // 2^-96 (G25)

// The bits of the numbers of a path and of a triangle: start, toward, a, b and c.
struct PairBits {
  uvec3 start;
  uvec3 toward;
  uvec3 a;
  uvec3 b;
  uvec3 c;
};

struct WideVector {
  WideInt x;
  WideInt y;
  WideInt z;
};

// What a path and a triangle have in common.
struct ExactContact {
  uint verdict;
  uint side;
  WideInt height;  // t is height / det, and det is positive.
  WideInt det;
  // The weights of b and c are u / whole and v / whole, and whole is positive. If the path is in the plane, they are
  // (u + t u_way) / whole and (v + t v_way) / whole.
  WideInt u;
  WideInt v;
  WideInt whole;
  WideInt u_way;
  WideInt v_way;
  bool has_start;  // The triangle has the path's point at t = 0,
  bool has_end;    // and that at t = 1.
};

// A denormal has the exponent of the least normal numbers.
int exponent_of(uint bits) { return max(int(bits >> 23u & 0xffu), 1); }
uint significand_of(uint bits) { return (bits & 0x7fffffu) + ((bits & 0x7f800000u) == 0u ? 0u : 0x800000u); }

// Returns a number in units of 2^(unit - 150). It has at most 45 bits.
WideInt in_units(uint bits, int unit) {
  int shift = max(exponent_of(bits) - unit, 0);
  uint above = shift == 0 ? 0u : significand_of(bits) >> (32 - shift);
  return turned(int_of(significand_of(bits) << shift, above, 0u, 0u, 0u), bits >= 0x80000000u);
}

WideVector vector_in_units(uvec3 bits, int unit) {
  WideVector result;
  result.x = in_units(bits.x, unit);
  result.y = in_units(bits.y, unit);
  result.z = in_units(bits.z, unit);
  return result;
}

// The exponents of the least and the largest numbers besides 0.
int least_exponent_of(uint bits) { return significand_of(bits) == 0u ? 255 : exponent_of(bits); }
int least_exponent_of(uvec3 bits) {
  return min(min(least_exponent_of(bits.x), least_exponent_of(bits.y)), least_exponent_of(bits.z));
}
int largest_exponent_of(uvec3 bits) {
  return max(max(exponent_of(bits.x), exponent_of(bits.y)), exponent_of(bits.z));
}

WideVector difference_of(WideVector x, WideVector y) {
  WideVector result;
  result.x = difference_of(x.x, y.x);
  result.y = difference_of(x.y, y.y);
  result.z = difference_of(x.z, y.z);
  return result;
}

// Returns x y - z w. All have at most 64 bits with their signs.
WideInt minor_of(WideInt x, WideInt y, WideInt z, WideInt w) {
  return sum_with_short_product(sum_with_short_product(int_of(0u, 0u, 0u, 0u, 0u), x, y, false), z, w, true);
}

WideVector cross_of(WideVector p, WideVector q) {
  WideVector result;
  result.x = minor_of(p.y, q.z, p.z, q.y);
  result.y = minor_of(p.z, q.x, p.x, q.z);
  result.z = minor_of(p.x, q.y, p.y, q.x);
  return result;
}

// Returns p · q, or its negative. The components of p have at most 64 bits with their signs, and those of q 96.
WideInt dot_of(WideVector p, WideVector q, bool is_turned) {
  WideInt of_x = sum_with_product(int_of(0u, 0u, 0u, 0u, 0u), p.x, q.x, is_turned);
  WideInt of_x_and_y = sum_with_product(of_x, p.y, q.y, is_turned);
  return sum_with_product(of_x_and_y, p.z, q.z, is_turned);
}

bool is_zero(WideVector x) { return is_zero(x.x) && is_zero(x.y) && is_zero(x.z); }

// Returns a vector with its components in turn, so that this one is the last.
WideVector seen_along(WideVector of, bool is_x, bool is_y) {
  WideVector result = of;
  if (is_x) {
    result.x = of.y;
    result.y = of.z;
    result.z = of.x;
  } else if (is_y) {
    result.x = of.z;
    result.y = of.x;
    result.z = of.y;
  }
  return result;
}

WideInt seen_cross_of(WideVector p, WideVector q) { return minor_of(p.x, q.y, p.y, q.x); }

// Returns true if a weight is below 0 wherever the path is: at the start, and at the end or for all t after it.
bool is_beside(WideInt of_start, WideInt of_end, WideInt of_way, bool has_limit) {
  return is_negative(of_start) && (has_limit ? is_negative(of_end) : !is_positive(of_way));
}

// A path in the plane of a triangle, seen along an axis on which the normal is not 0 (G24).
ExactContact contact_in_plane(ExactContact contact, WideVector d, WideVector e, WideVector f, WideVector s,
                              WideVector normal, WideVector across, bool has_limit) {
  bool is_x = !is_zero(normal.x);
  bool is_y = !is_x && !is_zero(normal.y);
  d = seen_along(d, is_x, is_y);
  e = seen_along(e, is_x, is_y);
  f = seen_along(f, is_x, is_y);
  s = seen_along(s, is_x, is_y);
  WideInt whole = seen_along(normal, is_x, is_y).z;
  bool turns = is_negative(whole);
  // At t, the weights are (of_start + t of_way) / whole.
  WideInt u = seen_cross_of(s, f);
  WideInt v = seen_cross_of(e, s);
  WideInt u_way = seen_cross_of(d, f);
  WideInt v_way = seen_cross_of(e, d);
  // On which sides of the path's line the corners are.
  WideInt of_a = seen_along(across, is_x, is_y).z;
  WideInt of_b = difference_of(of_a, v_way);
  WideInt of_c = sum_of(of_a, u_way);
  bool is_left = is_negative(of_a) && is_negative(of_b) && is_negative(of_c);
  bool is_right = is_positive(of_a) && is_positive(of_b) && is_positive(of_c);
  contact.whole = turned(whole, turns);
  contact.u = turned(u, turns);
  contact.v = turned(v, turns);
  contact.u_way = turned(u_way, turns);
  contact.v_way = turned(v_way, turns);
  WideInt w = difference_of(difference_of(contact.whole, contact.u), contact.v);
  WideInt w_way = negated(sum_of(contact.u_way, contact.v_way));
  WideInt u_end = sum_of(contact.u, contact.u_way);
  WideInt v_end = sum_of(contact.v, contact.v_way);
  WideInt w_end = sum_of(w, w_way);
  bool lacks_u = is_negative(contact.u);
  bool lacks_v = is_negative(contact.v);
  bool lacks_w = is_negative(w);
  contact.has_start = !lacks_u && !lacks_v && !lacks_w;
  contact.has_end = !is_negative(u_end) && !is_negative(v_end) && !is_negative(w_end);
  bool is_apart = is_left || is_right || is_beside(contact.u, u_end, contact.u_way, has_limit) ||
                  is_beside(contact.v, v_end, contact.v_way, has_limit) || is_beside(w, w_end, w_way, has_limit);
  contact.verdict = is_apart ? is_missed : has_limit || contact.has_start ? is_hit : is_open;
  // The path begins inside, or enters where the last one of the weights becomes 0 that are below 0 at the start. If two
  // are, the side of the corner between both tells which one that is.
  bool has_u_after_v = is_negative(of_a) != turns;
  bool has_v_after_w = is_negative(of_b) != turns;
  bool has_w_after_u = is_negative(of_c) != turns;
  bool enters_by_u = lacks_u && (!lacks_v || has_u_after_v) && (!lacks_w || !has_w_after_u);
  bool enters_by_v = lacks_v && !enters_by_u && (!lacks_w || has_v_after_w);
  bool enters_by_w = lacks_w && !enters_by_u && !enters_by_v;
  WideInt none = int_of(0u, 0u, 0u, 0u, 0u);
  contact.height = none;
  contact.det = int_of(1u, 0u, 0u, 0u, 0u);
  if (enters_by_u) {
    contact.height = negated(contact.u);
    contact.det = contact.u_way;
    contact.u = none;
    contact.u_way = none;
  } else if (enters_by_v) {
    contact.height = negated(contact.v);
    contact.det = contact.v_way;
    contact.v = none;
    contact.v_way = none;
  } else if (enters_by_w) {
    contact.height = negated(w);
    contact.det = w_way;
  }
  if (contact.has_start) {
    contact.u_way = none;
    contact.v_way = none;
  }
  bool is_at_a = is_zero(of_a) && (enters_by_u || enters_by_v);
  bool is_at_b = is_zero(of_b) && (enters_by_v || enters_by_w);
  bool is_at_c = is_zero(of_c) && (enters_by_w || enters_by_u);
  if (is_at_a || is_at_b || is_at_c) {
    contact.u = none;
    contact.v = none;
    contact.u_way = none;
    contact.v_way = none;
    if (is_at_b) contact.u = contact.whole;
    if (is_at_c) contact.v = contact.whole;
  }
  return contact;
}

// Returns how a path meets a triangle in a range, in which 2^100 stands for infinity. It stays open if their numbers
// are too far apart in size, if the path has no length, if the triangle has no area, or if the range begins or ends at
// another t than the path (G24).
ExactContact exact_contact_of(PairBits of, bool is_segment, real range_first, real range_last) {
  ExactContact contact;
  contact.verdict = is_open;
  contact.side = edge_on;
  int unit = min(min(min(least_exponent_of(of.start), least_exponent_of(of.toward)), least_exponent_of(of.a)),
                 min(least_exponent_of(of.b), least_exponent_of(of.c)));
  int largest = max(max(max(largest_exponent_of(of.start), largest_exponent_of(of.toward)), largest_exponent_of(of.a)),
                    max(largest_exponent_of(of.b), largest_exponent_of(of.c)));
  bool has_begin = range_first > -no_limit;
  bool has_limit = range_last < no_limit;
  if (largest - unit > max_octaves) return contact;
  bool begins_elsewhere = has_begin && (range_first < 0.0 || range_first > 0.0);
  bool ends_elsewhere = has_limit && (range_last < 1.0 || range_last > 1.0);
  if (begins_elsewhere || ends_elsewhere) return contact;
  WideVector from = vector_in_units(of.start, unit);
  WideVector d = vector_in_units(of.toward, unit);
  if (is_segment) d = difference_of(d, from);
  WideVector a = vector_in_units(of.a, unit);
  WideVector e = difference_of(vector_in_units(of.b, unit), a);
  WideVector f = difference_of(vector_in_units(of.c, unit), a);
  WideVector s = difference_of(from, a);
  WideVector normal = cross_of(e, f);
  if (is_zero(d) || is_zero(normal)) return contact;
  WideVector across = cross_of(s, d);
  WideInt det = dot_of(d, normal, true);
  WideInt height = dot_of(s, normal, false);
  contact.verdict = is_missed;
  if (is_zero(det)) {
    if (!is_zero(height)) return contact;
    contact.verdict = is_open;
    if (!has_begin || has_limit != is_segment) return contact;
    return contact_in_plane(contact, d, e, f, s, normal, across, has_limit);
  }
  bool turns = is_negative(det);
  contact.side = turns ? back : front;
  contact.det = turned(det, turns);
  contact.u_way = int_of(0u, 0u, 0u, 0u, 0u);
  contact.v_way = contact.u_way;
  contact.whole = contact.det;
  contact.height = turned(height, turns);
  contact.u = dot_of(f, across, turns);
  contact.v = dot_of(e, across, !turns);
  WideInt w = difference_of(difference_of(contact.whole, contact.u), contact.v);
  WideInt to_end = difference_of(contact.det, contact.height);
  bool is_inside = !is_negative(contact.u) && !is_negative(contact.v) && !is_negative(w);
  bool is_in_range = !(has_begin && is_negative(contact.height)) && !(has_limit && is_negative(to_end));
  if (is_inside && is_in_range) contact.verdict = is_hit;
  contact.has_start = is_zero(height);
  contact.has_end = is_zero(to_end);
  return contact;
}

// Sets numbers between which t is, where it is height / det. Returns false if it may be too large for that (G25).
bool has_interval(WideInt height, WideInt det, OUT(real) lower, OUT(real) upper) {
  real num = pair_from(height).high;
  real den = pair_from(det).high;
  precise real share = abs(num) * per_max_t;
  precise real t = num / den;
  precise real radius = slack_of_t * abs(t) + min_t_of_pairs;
  precise real below = t - radius;
  precise real above = t + radius;
  lower = below;
  upper = above;
  return share < den;
}

// A sum of two products, and how far off it is at most.
struct PairSum {
  FloatPair sum;
  real bound;
};

// Returns start den + way num, where t is num / den (G25).
PairSum weight_of(WideInt start, WideInt way, FloatPair num, FloatPair den) {
  FloatPair of_start = product_of_pairs(pair_from(start), den);
  FloatPair of_way = product_of_pairs(pair_from(way), num);
  FloatPair sum = sum_of_pairs(of_start, of_way);
  precise real bound = share_error * (abs(of_start.high) + abs(of_way.high));
  PairSum result;
  result.sum = sum_of(sum.high, sum.low);
  result.bound = bound;
  return result;
}

// Returns (start + t way) / whole, rounded once where this is certain (G25). `num` and `den` are those of t, and `den`
// and `whole` are positive.
RoundedNumber rounded_share_of(WideInt start, WideInt way, FloatPair num, FloatPair den, FloatPair whole) {
  PairSum weight = weight_of(start, way, num, den);
  FloatPair all = product_of_pairs(whole, den);
  precise real d_bound = share_error * all.high;
  RoundedNumber result = quotient_of(weight.sum, weight.bound, all, d_bound);
  if (is_zero(start) && is_zero(way)) {
    result.number = 0.0;
    result.is_rounded = true;
  }
  return result;
}

// Rounds t, u and v of a contact whose t is known (G25).
RoundedHit round_contact(ExactContact contact) {
  FloatPair zero = pair_of(0.0, 0.0);
  FloatPair one = pair_of(1.0, 0.0);
  WideInt none = int_of(0u, 0u, 0u, 0u, 0u);
  FloatPair height = pair_from(contact.height);
  FloatPair det = pair_from(contact.det);
  FloatPair whole = pair_from(contact.whole);
  bool is_in_plane = contact.side == edge_on;
  FloatPair num = zero;
  FloatPair den = one;
  if (is_in_plane) {
    num = height;
    den = det;
  }
  RoundedNumber t = rounded_share_of(contact.height, none, zero, one, det);
  RoundedNumber u = rounded_share_of(contact.u, contact.u_way, num, den, whole);
  RoundedNumber v = rounded_share_of(contact.v, contact.v_way, num, den, whole);
  RoundedHit result;
  result.t = t.number;
  result.u = u.number;
  result.v = v.number;
  result.is_front = contact.side == front;
  result.is_rounded = t.is_rounded && u.is_rounded && v.is_rounded;
  return result;
}
