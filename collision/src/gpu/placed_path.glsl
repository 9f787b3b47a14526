// Brings a path into the frame of an instance's mesh. GPU.md has the lemmas G15 and G17. This text is GLSL and C++
// alike, so that a test can attack it with roundings that a device may choose. The device's floats are `real` here, and
// `max_gap` is that of `hit_rounding.glsl`. Only what is `precise` is computed as it is written (G1).

const real max_placed_start = 4294967296.0;              // 2^32 (G16)
const real max_placed_way = 8589934592.0;                // 2^33 (G16)
const real max_placed_error = 4096.0;                    // 2^12 (G16)
const real max_padding = 4294967296.0;                   // 2^32 (G17)
const real placing_flushes = max_gap * max_gap * max_gap / 2048.0;  // 2^-80 (G15)
const real min_placed_rate = 1.0 / 1152921504606846976.0;  // 2^-60 (G17)
const real max_placed_t = 1152921504606846976.0;         // 2^60 (G17)

// An instance, as the host uploads it.
struct Instance {
  real inverse[9];      // The inverse of the pose's matrix, rounded. All matrices are in rows.
  real linear[9];       // The pose's matrix.
  real translation[3];
  real motion[3];
  real share;           // The sum of the sizes of the largest row of `inverse`, times `max_gap`.
  real reach;           // No coordinate of the mesh is larger.
  uint root;            // The root of the mesh's tree.
  uint mask;
  uint index;           // The index of the instance.
  uint flags;
};

// A path in the frame of a mesh, as a start and a direction.
struct PlacedPath {
  vec3 start;
  vec3 way;
  real start_error;  // No component of the start is off by more than this (G15).
  real way_error;    // The same of the direction.
  real padding;      // In the box of the mesh, no component of the path is off by more than this (G17).
  bool is_placed;    // False if the errors, or the numbers, are too large for the kernel.
};

real largest_of(vec3 x) { return max(max(abs(x.x), abs(x.y)), abs(x.z)); }

// Returns the sum of the products of a row and a vector.
real product_with_row(real a, real b, real c, vec3 x) {
  precise real result = a * x.x + b * x.y + c * x.z;
  return result;
}

vec3 product_with_inverse(Instance at, vec3 x) {
  vec3 result;
  result.x = product_with_row(at.inverse[0], at.inverse[1], at.inverse[2], x);
  result.y = product_with_row(at.inverse[3], at.inverse[4], at.inverse[5], x);
  result.z = product_with_row(at.inverse[6], at.inverse[7], at.inverse[8], x);
  return result;
}

vec3 rounded_difference_of(vec3 x, real y_x, real y_y, real y_z) {
  precise real of_x = x.x - y_x;
  precise real of_y = x.y - y_y;
  precise real of_z = x.z - y_z;
  vec3 result;
  result.x = of_x;
  result.y = of_y;
  result.z = of_z;
  return result;
}

// Places a path that begins at `start` and has the direction `way`, which is rounded for a segment. `max_t` is the
// largest size of a t in its range.
PlacedPath place(Instance at, vec3 start, vec3 way, bool is_segment, real max_t) {
  vec3 from = rounded_difference_of(start, at.translation[0], at.translation[1], at.translation[2]);
  vec3 moved = way;
  if (is_segment) moved = rounded_difference_of(way, at.motion[0], at.motion[1], at.motion[2]);
  PlacedPath result;
  result.start = product_with_inverse(at, from);
  result.way = product_with_inverse(at, moved);
  precise real start_error = at.share * (5.0 * largest_of(from)) + placing_flushes;
  precise real way_error = at.share * (largest_of(way) + 5.0 * largest_of(moved)) + placing_flushes;
  result.start_error = start_error;
  result.way_error = way_error;
  real start_size = largest_of(result.start);
  real way_size = largest_of(result.way);
  result.is_placed = start_size <= max_placed_start && way_size <= max_placed_way && start_error <= max_placed_error &&
                     way_error <= max_placed_error;
  // In the box of the mesh, the fastest axis bounds t (G17).
  precise real twice_error = 2.0 * way_error;
  real all_t = max_t;
  if (way_size >= twice_error && way_size >= min_placed_rate) {
    precise real t_in_box = 2.5 * (at.reach + start_size + start_error) / way_size;
    all_t = t_in_box < max_t ? t_in_box : max_t;
  }
  result.is_placed = result.is_placed && all_t <= max_placed_t;
  result.padding = 0.0;
  if (!result.is_placed) return result;
  precise real padding = 1.125 * (start_error + all_t * (way_error + 2.0 * min_placed_rate));
  result.padding = padding;
  result.is_placed = padding <= max_padding;
  return result;
}
