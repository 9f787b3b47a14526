#version 450
#extension GL_GOOGLE_include_directive : require

// Says of each path of a dispatch what is certain: a miss, a triangle that it hits (first, where this is asked), or
// nothing. GPU.md has the lemmas G1 to G14. Only what is `precise` is computed as it is written (G1).

#define real float
#include "hit_rounding.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint wants_first = 1;

struct TreeNode {
  float low_x, low_y, low_z;
  uint first;  // The first of its triangles, or the first of its two children.
  float high_x, high_y, high_z;
  uint count;  // The number of its triangles. A node with children has 0.
};

struct TreeTriangle {
  float corners[9];
  uint id;
  uint mask;
  uint unused;
};

struct PathLimits {
  float t_first, det_first, t_last, det_last;  // The weights of the two ends of the range.
  float first, last;                           // The range. 2^100 stands for infinity.
  uint mask;
  uint ignored;
  uint flags;
};

layout(std430, binding = 0) readonly buffer Nodes { TreeNode nodes[]; };
layout(std430, binding = 1) readonly buffer Triangles { TreeTriangle triangles[]; };
layout(std430, binding = 2) readonly buffer Paths { uint path_words[]; };  // Six a path. No float is read unchecked.
layout(std430, binding = 3) readonly buffer Limits { PathLimits limits[]; };
layout(std430, binding = 4) writeonly buffer Answers { uint answers[]; };

// What is left to the host of a path.
struct Leftover {
  uint path;
  uint triangle;  // The triangle that is hit and not rounded, or `miss` if the path is undecided.
  uint words[6];  // The path.
};

// The numbers are counted from 0 in each dispatch.
layout(std430, binding = 5) buffer Leftovers {
  uint leftover_count;
  uint miss_count;
  uint unused_1, unused_2;
  Leftover leftovers[];
};

layout(push_constant) uniform Dispatch {
  uint path_count;
  uint is_segment;   // 1 if each path has a start and an end, 0 if it has an origin and a direction.
  uint limits_step;  // 1 if each path has limits of its own, 0 if all have the same.
  uint max_steps;    // A path that takes more steps is undecided, so that no dispatch takes long.
  uint lists;        // 1 if the host looks at no answers, but at a list of what is left to it.
};

// What is no triangle.
const uint miss = 0xffffffffu;
const uint undecided = 0xfffffffeu;

// The answers to `any_hits` are words. Those to `first_hits` are five words: t, u, v, the triangle's id and the side.
const uint any_miss = 0;
const uint any_hit = 1;
const uint any_undecided = 2;
const uint no_side = 0;
const uint front = 1;
const uint back = 2;
const uint is_not_rounded = 4;  // It is added to the side.
const uint side_undecided = 8;

// The flags of a path's limits.
const uint keeps_front = 1;
const uint keeps_back = 2;
const uint is_whole = 4;       // The range is [0, 1].
const uint hits_nothing = 8;   // The range is empty.
const uint is_for_host = 16;   // The kernel cannot weigh the range.

const float relative = 72.0 * max_gap;               // G3
const float min_size = 1.0 / 1073741824.0;           // 2^-30 (G2)
const uint max_bits = 0x50000000u;                   // Those of 2^33 (G2).
const float min_rate = 1.0 / 1152921504606846976.0;  // 2^-60 (G6)
const float still_slack = 2.0 * min_rate;            // G6
const float t_slack = 16.0 * max_gap;                // G6
const float min_t = 4.0 * min_rate;                  // G6
const float beyond = 1.2676506e30;                   // 2^100

const uint max_depth = 64;

// A path as the walk and the kernel need it.
vec3 start;
vec3 toward;      // The end or the direction.
vec3 way;         // D
float way_size;   // d
vec3 inverse;     // 1 / D, where the path moves.
bvec3 is_moving;  // On these axes, the path moves fast enough to be cut.
vec3 still;       // How far outside of a box a path may be that hardly moves on the axis, or `beyond`.
PathLimits range;

float size_of(vec3 x) { return max(max(abs(x.x), abs(x.y)), max(abs(x.z), min_size)); }

vec3 cross_of(vec3 x, vec3 y) {
  precise vec3 left = x.yzx * y.zxy;
  precise vec3 right = x.zxy * y.yzx;
  precise vec3 result = left - right;
  return result;
}

float dot_of(vec3 x, vec3 y) {
  precise vec3 products = x * y;
  precise float result = products.x + (products.y + products.z);
  return result;
}

// Reads a path. Returns false if its numbers are too large for the bounds, or are not finite (G2).
bool read_path(uint path) {
  uvec3 from = uvec3(path_words[6 * path], path_words[6 * path + 1], path_words[6 * path + 2]);
  uvec3 to = uvec3(path_words[6 * path + 3], path_words[6 * path + 4], path_words[6 * path + 5]);
  uvec3 sizes = max(from & 0x7fffffffu, to & 0x7fffffffu);
  if (any(greaterThan(sizes, uvec3(max_bits)))) return false;
  start = uintBitsToFloat(from);
  toward = uintBitsToFloat(to);
  precise vec3 step = toward - start;
  way = is_segment != 0 ? step : toward;
  way_size = size_of(way);
  is_moving = greaterThanEqual(abs(way), vec3(min_rate));
  precise vec3 quotients = vec3(1.0) / mix(vec3(1.0), way, is_moving);
  inverse = quotients;
  // A ray stays where it is on an axis only if its direction is zero there. A segment is short.
  bvec3 stays = is_segment != 0 ? not(is_moving) : equal(to & 0x7fffffffu, uvec3(0));
  still = mix(vec3(beyond), vec3(still_slack), stays);
  return true;
}

// Returns true if the path certainly misses the box in its range (G6). Otherwise it enters at `enters` or later.
bool misses_box(vec3 low, vec3 high, out float enters) {
  precise vec3 to_low = low - start;
  precise vec3 to_high = high - start;
  enters = beyond;
  if (any(greaterThan(to_low, still)) || any(lessThan(to_high, -still))) return true;
  precise vec3 t_of_low = to_low * inverse;
  precise vec3 t_of_high = to_high * inverse;
  vec3 entries = mix(vec3(-beyond), min(t_of_low, t_of_high), is_moving);
  vec3 exits = mix(vec3(beyond), max(t_of_low, t_of_high), is_moving);
  float entry = max(max(entries.x, entries.y), max(entries.z, range.first));
  float exit = min(min(exits.x, exits.y), min(exits.z, range.last));
  precise float lower = entry - (abs(entry) * t_slack + min_t);
  precise float upper = exit + (abs(exit) * t_slack + min_t);
  enters = lower;
  return lower > upper;
}

// What the kernel says of a triangle.
const uint is_missed = 0;
const uint is_hit = 1;
const uint is_open = 2;

// Classifies a triangle (G4). A hit has its t between `lower` and `upper` (G5).
uint classify(vec3 a, vec3 b, vec3 c, out float lower, out float upper, out bool is_front) {
  precise vec3 e = b - a;
  precise vec3 f = c - a;
  precise vec3 s = start - a;
  vec3 p = cross_of(way, f);
  vec3 q = cross_of(s, e);
  float det_given = dot_of(e, p);
  float sigma = det_given < 0.0 ? -1.0 : 1.0;
  precise float det = sigma * det_given;
  precise float height = sigma * dot_of(f, q);
  precise float u = sigma * dot_of(s, p);
  precise float v = sigma * dot_of(way, q);
  precise float w = det - u - v;

  float e_size = size_of(e);
  float f_size = size_of(f);
  float s_size = size_of(s);
  precise float def = way_size * e_size * f_size;
  precise float sdf = s_size * way_size * f_size;
  precise float dse = way_size * s_size * e_size;
  precise float fse = f_size * s_size * e_size;
  precise float det_bound = relative * def;
  precise float side_bound = relative * (def + sdf + dse);
  precise float height_bound = relative * fse;

  lower = 0.0;
  upper = 0.0;
  is_front = sigma > 0.0;
  float side = min(min(u, v), w);
  precise float side_limit = side_bound + det_bound;
  bool misses = side < -side_limit;  // G4, as K13
  bool hits = side > side_bound;     // G4, as K12
  if ((range.flags & is_whole) != 0) {
    precise float rest = det - height;
    precise float end_bound = height_bound + 2.0 * det_bound;
    precise float end_limit = end_bound + det_bound;
    float end = min(height, rest);
    misses = misses || end < -end_limit;  // G4, as K14
    hits = hits && end > end_bound;
  } else {
    precise float at_first = height * range.t_first + det * range.det_first;
    precise float at_last = height * range.t_last + det * range.det_last;
    precise float weight = 1.0 + max(abs(range.det_first), abs(range.det_last));
    precise float end_bound = height_bound + weight * det_bound;
    float end = min(at_first, at_last);
    misses = misses || (end < -end_bound && det > det_bound);  // G4, as K15
    hits = hits && end > end_bound;
  }
  if (misses) return is_missed;
  if (!hits) return is_open;
  precise float t = height / det;
  precise float radius = 2.0 * (height_bound + abs(t) * det_bound) / det + min_t;  // G5
  precise float below = t - radius;
  precise float above = t + radius;
  lower = below;
  upper = above;
  return is_hit;
}

// Returns the place of a triangle among all, or `miss`, or `undecided`.
uint answer(uint path) {
  range = limits[path * limits_step];
  if ((range.flags & hits_nothing) != 0) return miss;
  if ((range.flags & is_for_host) != 0 || !read_path(path)) return undecided;

  float enters;
  TreeNode root = nodes[0];
  if (misses_box(vec3(root.low_x, root.low_y, root.low_z), vec3(root.high_x, root.high_y, root.high_z), enters)) {
    return miss;
  }

  uint best = miss;           // The certain hit that begins first.
  float best_lower = beyond;  // Its t is at least this,
  float best_upper = beyond;  // and at most this.
  float limit = beyond;       // Some certain hit has its t here or before.
  float others = beyond;      // All other hits have their t here or later.
  bool has_open = false;

  uint waiting[max_depth];
  float waiting_enters[max_depth];
  uint depth = 0;
  uint at = 0;
  for (uint steps = 0; steps < max_steps; ++steps) {
    TreeNode node = nodes[at];
    if (node.count == 0) {
      TreeNode left = nodes[node.first];
      TreeNode right = nodes[node.first + 1];
      float left_enters;
      float right_enters;
      bool skips_left = misses_box(vec3(left.low_x, left.low_y, left.low_z),
                                   vec3(left.high_x, left.high_y, left.high_z), left_enters);
      bool skips_right = misses_box(vec3(right.low_x, right.low_y, right.low_z),
                                    vec3(right.high_x, right.high_y, right.high_z), right_enters);
      skips_left = skips_left || left_enters > limit;  // G7
      skips_right = skips_right || right_enters > limit;
      if (!skips_left || !skips_right) {
        bool goes_left = !skips_left && (skips_right || left_enters <= right_enters);
        if (!skips_left && !skips_right) {
          if (depth == max_depth) return undecided;
          waiting[depth] = goes_left ? node.first + 1 : node.first;
          waiting_enters[depth] = goes_left ? right_enters : left_enters;
          ++depth;
        }
        at = goes_left ? node.first : node.first + 1;
        continue;
      }
    }
    for (uint i = node.first; i < node.first + node.count; ++i) {
      TreeTriangle triangle = triangles[i];
      if ((triangle.mask & range.mask) == 0 || triangle.id == range.ignored) continue;
      vec3 a = vec3(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
      vec3 b = vec3(triangle.corners[3], triangle.corners[4], triangle.corners[5]);
      vec3 c = vec3(triangle.corners[6], triangle.corners[7], triangle.corners[8]);
      float lower;
      float upper;
      bool is_front;
      uint verdict = classify(a, b, c, lower, upper, is_front);
      if (verdict == is_missed) continue;
      if (verdict == is_open) {
        float its_enters;
        if (misses_box(min(min(a, b), c), max(max(a, b), c), its_enters)) continue;
        has_open = true;
        others = min(others, its_enters);
        continue;
      }
      if ((range.flags & keeps_front) != 0 && !is_front) continue;
      if ((range.flags & keeps_back) != 0 && is_front) continue;
      if (wants_first == 0) return i;
      limit = min(limit, upper);
      if (lower < best_lower) {
        others = min(others, best_lower);
        best = i;
        best_lower = lower;
        best_upper = upper;
      } else {
        others = min(others, lower);
      }
    }
    // On to the next node that waits, unless all that it has comes later than a certain hit (G7).
    bool has_next = false;
    while (depth > 0 && !has_next) {
      --depth;
      has_next = waiting_enters[depth] <= limit;
    }
    if (!has_next) {
      if (best == miss) return has_open ? undecided : miss;  // G8
      return best_upper < others ? best : undecided;         // G8
    }
    at = waiting[depth];
  }
  return undecided;
}

// Lists what is left to the host of a path.
void list(uint path, uint triangle) {
  uint place = atomicAdd(leftover_count, 1u);
  leftovers[place].path = path;
  leftovers[place].triangle = triangle;
  for (uint i = 0; i < 6; ++i) leftovers[place].words[i] = path_words[6 * path + i];
}

void main() {
  uint path = gl_GlobalInvocationID.x;
  if (path >= path_count) return;
  uint found = answer(path);
  if (lists != 0 && found == miss) atomicAdd(miss_count, 1u);
  if (lists != 0 && found == undecided) list(path, miss);
  if (wants_first == 0) {
    answers[path] = found == miss ? any_miss : found == undecided ? any_undecided : any_hit;
    return;
  }
  uint id = miss;
  uint side = found == miss ? no_side : side_undecided;
  vec3 weights = vec3(0.0);
  if (found != miss && found != undecided) {
    TreeTriangle triangle = triangles[found];
    vec3 a = vec3(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
    vec3 b = vec3(triangle.corners[3], triangle.corners[4], triangle.corners[5]);
    vec3 c = vec3(triangle.corners[6], triangle.corners[7], triangle.corners[8]);
    RoundedHit hit = round_hit(start, toward, is_segment != 0, a, b, c);
    id = triangle.id;
    side = hit.is_front ? front : back;
    weights = vec3(hit.t, hit.u, hit.v);
    if (!hit.is_rounded) {
      side += is_not_rounded;
      if (lists != 0) list(path, id);
    }
  }
  answers[5 * path] = floatBitsToUint(weights.x);
  answers[5 * path + 1] = floatBitsToUint(weights.y);
  answers[5 * path + 2] = floatBitsToUint(weights.z);
  answers[5 * path + 3] = id;
  answers[5 * path + 4] = side;
}
