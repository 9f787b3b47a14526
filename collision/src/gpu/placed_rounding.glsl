// The determinants of a hit of an instance in pairs of floats: brings the triangle into the frame of the scene, and
// leaves the path as it is. GPU.md has the lemmas G19 and G20. This text is GLSL and C++ alike, as those that come
// before it: `hit_rounding.glsl` and `placed_path.glsl`.

const real product_share = 24.0 * max_gap * max_gap;     // G19
const real difference_share = 32.0 * max_gap * max_gap;  // G19
const real way_share = 8.0 * max_gap * max_gap;          // G19
const real max_placed_size = 34359738368.0;              // 2^35 (G20)

FloatPair row_with_pairs(real a, real b, real c, PairVector x) {
  FloatPair of_x_and_y =
      sum_of_pairs(product_of_pairs(pair_of(a, 0.0), x.x), product_of_pairs(pair_of(b, 0.0), x.y));
  return sum_of_pairs(of_x_and_y, product_of_pairs(pair_of(c, 0.0), x.z));
}

// Returns the product of the pose's matrix and a vector. Its low parts may be large (G19).
PairVector placed_pairs(Instance at, PairVector x) {
  PairVector result;
  result.x = row_with_pairs(at.linear[0], at.linear[1], at.linear[2], x);
  result.y = row_with_pairs(at.linear[3], at.linear[4], at.linear[5], x);
  result.z = row_with_pairs(at.linear[6], at.linear[7], at.linear[8], x);
  return result;
}

PairVector pair_difference_of(PairVector x, PairVector y) {
  PairVector result;
  result.x = sum_of_pairs(x.x, negated(y.x));
  result.y = sum_of_pairs(x.y, negated(y.y));
  result.z = sum_of_pairs(x.z, negated(y.z));
  return result;
}

PairVector in_order(PairVector x) {
  PairVector result;
  result.x = sum_of(x.x.high, x.x.low);
  result.y = sum_of(x.y.high, x.y.low);
  result.z = sum_of(x.z.high, x.z.low);
  return result;
}

vec3 vector_of(real numbers[3]) {
  vec3 result;
  result.x = numbers[0];
  result.y = numbers[1];
  result.z = numbers[2];
  return result;
}

real row_size_of(real a, real b, real c, PairVector x) {
  precise real result = abs(a) * abs(x.x.high) + abs(b) * abs(x.y.high) + abs(c) * abs(x.z.high);
  return result;
}

// Returns the largest sum of the sizes of the products in a row of `placed_pairs`.
real size_of_products(Instance at, PairVector x) {
  real of_x = row_size_of(at.linear[0], at.linear[1], at.linear[2], x);
  real of_y = row_size_of(at.linear[3], at.linear[4], at.linear[5], x);
  real of_z = row_size_of(at.linear[6], at.linear[7], at.linear[8], x);
  return max(max(of_x, of_y), of_z);
}

// The image of an edge of a triangle, from one corner to another (G19).
OffVector placed_edge(Instance at, vec3 from, vec3 to) {
  PairVector edge = difference_of(to, from);
  precise real error = product_share * size_of_products(at, edge) + placing_flushes;
  return off_by(error, in_order(placed_pairs(at, edge)));
}

// The way of a path, as the instance sees it (G19).
OffVector placed_way(Instance at, vec3 start, vec3 toward, bool is_segment) {
  if (!is_segment) return off_by(0.0, pairs_of(toward));
  PairVector way = difference_of(toward, start);
  vec3 motion = vector_of(at.motion);
  precise real error = way_share * (size_of_pairs(way) + largest_of(motion)) + placing_flushes;
  return off_by(error, in_order(pair_difference_of(way, pairs_of(motion))));
}

// The start of a path, as seen from the image of a corner (G19).
OffVector placed_offset(Instance at, vec3 start, vec3 corner) {
  PairVector from = difference_of(start, vector_of(at.translation));
  PairVector to = pairs_of(corner);
  precise real error = difference_share * (size_of_pairs(from) + size_of_products(at, to)) + placing_flushes;
  return off_by(error, in_order(pair_difference_of(from, placed_pairs(at, to))));
}

// Returns the determinants of a path and the image of a triangle. They are not certain if their sizes are too large.
PairDeterminants placed_determinants_of(Instance at, vec3 start, vec3 toward, bool is_segment, vec3 a, vec3 b,
                                        vec3 c) {
  OffVector d = placed_way(at, start, toward, is_segment);
  OffVector e = placed_edge(at, a, b);
  OffVector f = placed_edge(at, a, c);
  OffVector s = placed_offset(at, start, a);
  real size = max(max(size_of_pairs(d.pairs), size_of_pairs(e.pairs)),
                  max(size_of_pairs(f.pairs), size_of_pairs(s.pairs)));
  PairDeterminants result = determinants_of(d, e, f, s);
  result.is_certain = result.is_certain && size <= max_placed_size;
  return result;
}

// Rounds a certain hit of a triangle of an instance.
RoundedHit round_placed_hit(Instance at, vec3 start, vec3 toward, bool is_segment, vec3 a, vec3 b, vec3 c) {
  return round_determinants(placed_determinants_of(at, start, toward, is_segment, a, b, c));
}
