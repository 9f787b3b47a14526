// The path of a thread, and what is certain of it beside a box or a triangle. GPU.md has the lemmas G2 to G6, and G16
// and G17 for placed paths. This text is GLSL and C++ alike, so that a test can attack it with roundings that a device
// may choose. The device's floats are `real` here, and `OUT(type)` is a parameter that is written. Only what is
// `precise` is computed as it is written (G1).

struct PathLimits {
  real t_first, det_first, t_last, det_last;  // The weights of the two ends of the range.
  real first, last;                           // The range. 2^100 stands for infinity.
  uint mask;
  uint ignored;           // The triangle that is left out. In a scene it is one of `ignored_instance`.
  uint flags;
  uint instance_mask;
  uint ignored_instance;  // `miss` if there is none.
};

// The flags of a path's limits.
const uint keeps_front = 1;
const uint keeps_back = 2;
const uint is_whole = 4;       // The range is [0, 1].
const uint hits_nothing = 8;   // The range is empty.
const uint is_for_host = 16;   // The kernel cannot weigh the range.
const uint ignores_start = 32;  // Triangles that contain the start are left out.
const uint ignores_end = 64;    // Those that contain the end are.

const real relative = 72.0 * max_gap;               // G3
const real min_size = 1.0 / 1073741824.0;           // 2^-30 (G2)
const uint max_bits = 0x50000000u;                   // Those of 2^33 (G2).
const real min_rate = 1.0 / 1152921504606846976.0;  // 2^-60 (G6)
const real still_slack = 2.0 * min_rate;            // G6
const real t_slack = 16.0 * max_gap;                // G6
const real min_t = 4.0 * min_rate;                  // G6
const real beyond = 1.2676506e30;                   // 2^100
const real growth_of_error = 1048576.0;             // 1 / (8 h) (G16)

// A path as it was given.
vec3 given_start;
vec3 toward;  // The end or the direction.

// The path as the walk and the kernel need it.
vec3 start;
vec3 way;         // D
real way_size;   // d
vec3 inverse;     // 1 / D, where the path moves.
bvec3 is_moving;  // On these axes, the path moves fast enough to be cut.
vec3 still;       // How far outside of a box a path may be that hardly moves on the axis, or `beyond`.
PathLimits range;
#ifdef SCENE
// How far off a path is that was placed in the frame of a mesh. All three are 0 in the frame of the scene.
real start_growth;  // What S counts more because of this (G16).
real way_growth;    // The same of D.
real padding;       // How far boxes are moved outward (G17).
#else
const real start_growth = 0.0;
const real way_growth = 0.0;
const real padding = 0.0;
#endif

real size_of(vec3 x) { return max(max(abs(x.x), abs(x.y)), max(abs(x.z), min_size)); }

vec3 cross_of(vec3 x, vec3 y) {
  precise vec3 left = x.yzx * y.zxy;
  precise vec3 right = x.zxy * y.yzx;
  precise vec3 result = left - right;
  return result;
}

real dot_of(vec3 x, vec3 y) {
  precise vec3 products = x * y;
  precise real result = products.x + (products.y + products.z);
  return result;
}

// Sets what a path needs at boxes. `stays` is true on axes where the path may be taken for one that does not move.
void set_way(vec3 given, bvec3 stays) {
  way = given;
  is_moving = greaterThanEqual(abs(way), vec3(min_rate));
  precise vec3 quotients = vec3(1.0) / mix(vec3(1.0), way, is_moving);
  inverse = quotients;
  still = mix(vec3(beyond), vec3(still_slack), stays);
  precise real size = size_of(way) + way_growth;
  way_size = size;
}

// Takes the numbers of a path. Returns false if they are too large for the bounds, or are not finite (G2).
bool take_path(uvec3 from, uvec3 to, bool is_segment) {
  uvec3 sizes = max(from & 0x7fffffffu, to & 0x7fffffffu);
  if (any(greaterThan(sizes, uvec3(max_bits)))) return false;
  given_start = uintBitsToFloat(from);
  start = given_start;
  toward = uintBitsToFloat(to);
  precise vec3 step = toward - start;
#ifdef SCENE
  start_growth = 0.0;
  way_growth = 0.0;
  padding = 0.0;
#endif
  // A ray stays where it is on an axis only if its direction is zero there. A segment is short.
  bvec3 stays = is_segment ? lessThan(abs(step), vec3(min_rate)) : equal(to & 0x7fffffffu, uvec3(0));
  set_way(is_segment ? step : toward, stays);
  return true;
}

#ifdef SCENE
// Goes on with the path as it is in the frame of an instance's mesh. Returns false if the kernel cannot. `max_t` is the
// largest size of a t in its range.
bool enter_frame(Instance at, bool is_segment, real max_t) {
  PlacedPath placed = place(at, start, way, is_segment, max_t);
  if (!placed.is_placed) return false;
  start = placed.start;
  precise real of_start = placed.start_error * growth_of_error;
  precise real of_way = placed.way_error * growth_of_error;
  start_growth = of_start;
  way_growth = of_way;
  padding = placed.padding;
  set_way(placed.way, lessThan(abs(placed.way), vec3(min_rate)));
  return true;
}
#endif

// Returns true if the path certainly misses the box in its range (G6, G17). Otherwise it enters at `enters` or later.
bool misses_box(vec3 low, vec3 high, OUT(real) enters) {
  precise vec3 to_low = low - start - padding;
  precise vec3 to_high = high - start + padding;
  enters = beyond;
  if (any(greaterThan(to_low, still)) || any(lessThan(to_high, -still))) return true;
  precise vec3 t_of_low = to_low * inverse;
  precise vec3 t_of_high = to_high * inverse;
  vec3 entries = mix(vec3(-beyond), min(t_of_low, t_of_high), is_moving);
  vec3 exits = mix(vec3(beyond), max(t_of_low, t_of_high), is_moving);
  real entry = max(max(entries.x, entries.y), max(entries.z, range.first));
  real exit = min(min(exits.x, exits.y), min(exits.z, range.last));
  precise real lower = entry - (abs(entry) * t_slack + min_t);
  precise real upper = exit + (abs(exit) * t_slack + min_t);
  enters = lower;
  return lower > upper;
}

// What the kernel computes of a triangle, with the sign of det taken out, and how far off it is at most (G3).
struct KernelNumbers {
  real det;
  real height;
  real u;
  real v;
  real w;
  real det_bound;
  real height_bound;
  real side_bound;  // That of u, v and w.
  bool is_front;    // True if det is positive.
};

KernelNumbers numbers_of(vec3 a, vec3 b, vec3 c) {
  precise vec3 e = b - a;
  precise vec3 f = c - a;
  precise vec3 s = start - a;
  vec3 p = cross_of(way, f);
  vec3 q = cross_of(s, e);
  real det_given = dot_of(e, p);
  real sigma = det_given < 0.0 ? -1.0 : 1.0;
  precise real det = sigma * det_given;
  precise real height = sigma * dot_of(f, q);
  precise real u = sigma * dot_of(s, p);
  precise real v = sigma * dot_of(way, q);
  precise real w = det - u - v;

  real e_size = size_of(e);
  real f_size = size_of(f);
  precise real s_size = size_of(s) + start_growth;
  precise real def = way_size * e_size * f_size;
  precise real sdf = s_size * way_size * f_size;
  precise real dse = way_size * s_size * e_size;
  precise real fse = f_size * s_size * e_size;
  precise real det_bound = relative * def;
  precise real side_bound = relative * (def + sdf + dse);
  precise real height_bound = relative * fse;

  KernelNumbers result;
  result.det = det;
  result.height = height;
  result.u = u;
  result.v = v;
  result.w = w;
  result.det_bound = det_bound;
  result.height_bound = height_bound;
  result.side_bound = side_bound;
  result.is_front = sigma > 0.0;
  return result;
}

// Classifies a triangle (G4). A hit has its t between `lower` and `upper` (G5).
uint classify(vec3 a, vec3 b, vec3 c, OUT(real) lower, OUT(real) upper, OUT(bool) is_front) {
  KernelNumbers of = numbers_of(a, b, c);
  lower = 0.0;
  upper = 0.0;
  is_front = of.is_front;
  real side = min(min(of.u, of.v), of.w);
  precise real side_limit = of.side_bound + of.det_bound;
  bool misses = side < -side_limit;  // G4, as K13
  bool hits = side > of.side_bound;  // G4, as K12
  if ((range.flags & is_whole) != 0) {
    precise real rest = of.det - of.height;
    precise real end_bound = of.height_bound + 2.0 * of.det_bound;
    precise real end_limit = end_bound + of.det_bound;
    real end = min(of.height, rest);
    misses = misses || end < -end_limit;  // G4, as K14
    hits = hits && end > end_bound;
  } else {
    precise real at_first = of.height * range.t_first + of.det * range.det_first;
    precise real at_last = of.height * range.t_last + of.det * range.det_last;
    precise real weight = 1.0 + max(abs(range.det_first), abs(range.det_last));
    precise real end_bound = of.height_bound + weight * of.det_bound;
    real end = min(at_first, at_last);
    misses = misses || (end < -end_bound && of.det > of.det_bound);  // G4, as K15
    hits = hits && end > end_bound;
  }
  if (misses) return is_missed;
  if (!hits) return is_open;
  precise real t = of.height / of.det;
  precise real radius = 2.0 * (of.height_bound + abs(t) * of.det_bound) / of.det + min_t;  // G5
  precise real below = t - radius;
  precise real above = t + radius;
  lower = below;
  upper = above;
  return is_hit;
}
