#version 450
#extension GL_GOOGLE_include_directive : require

// Says of each path of a dispatch what is certain: a miss, a triangle that it hits (first, where this is asked), or
// nothing. With SCENE defined, the paths go through a scene, and otherwise through one mesh. GPU.md has the lemmas.
// Only what is `precise` is computed as it is written (G1).

#define real float
#define OUT(type) out type
#include "hit_rounding.glsl"
#include "pair_kernel.glsl"
#ifdef SCENE
#include "placed_path.glsl"
#include "placed_rounding.glsl"
#else
#include "wide_int.glsl"
#include "exact_pair.glsl"
#endif

const uint threads_in_group = 64;
layout(local_size_x = threads_in_group) in;
layout(constant_id = 0) const uint wants_first = 1;
layout(constant_id = 1) const uint is_quick = 0;  // 1 in the first dispatch of a task, which decides in floats alone.

// Memory is read in whole vectors, because devices load them at once.
struct TreeNode {
  uvec4 low;   // The bits of three floats, and the first of its triangles or instances, or of its two children.
  uvec4 high;  // The bits of three floats, and the number of its triangles or instances, or 0 if it has children.
};

struct TreeTriangle {
  uvec4 corners_1, corners_2;  // The bits of eight floats of the corners.
  uvec4 rest;                  // The bits of the last float, the id, the mask, and the plane.
};

#include "path_kernel.glsl"

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
  uint again;     // Apart from the others: the path that a thread of the second dispatch looks at.
};

// The numbers are counted from 0 for each task. The first dispatch counts what the second one has to do.
layout(std430, binding = 5) buffer Leftovers {
  uint leftover_count;
  uint miss_count;
  uint again_count;
  uint again_groups;  // This and the next two are the size of the second dispatch.
  uint one_1, one_2;
  uint unused_1, unused_2;
  Leftover leftovers[];
};

#ifdef SCENE
layout(std430, binding = 6) readonly buffer SceneNodes { TreeNode scene_nodes[]; };
layout(std430, binding = 7) readonly buffer Instances { Instance instances[]; };
#endif

layout(push_constant) uniform Dispatch {
  uint path_count;
  uint is_segment;   // 1 if each path has a start and an end, 0 if it has an origin and a direction.
  uint limits_step;  // 1 if each path has limits of its own, 0 if all have the same.
  uint max_steps;    // A path that takes more steps is undecided, so that no dispatch takes long.
  uint lists;        // 1 if the host looks at no answers, but at a list of what is left to it.
};

// A decision in pairs takes about as long as so many steps, and so does an exact one.
const uint steps_of_pairs = 32;
const uint steps_of_exact = 64;

// What is no triangle.
const uint miss = 0xffffffffu;
const uint undecided = 0xfffffffeu;

// The answers to `any_hits` are words. Those to `first_hits` are five words: t, u, v, the triangle's id and the side.
// In a scene, the index of the instance follows.
const uint any_miss = 0;
const uint any_hit = 1;
const uint any_undecided = 2;
const uint no_side = 0;
const uint is_not_rounded = 4;  // It is added to the side.
const uint side_undecided = 8;
const uint edge_on_for_host = 3;  // Memory that was never written has only zeros, and is no answer.

#ifdef SCENE
const uint words_per_answer = 6;
const uint max_depth = 128;         // Those of the scene's tree and those of a mesh's.
const uint in_scene = 0x80000000u;  // A node of the scene's tree has this bit in its number.
const uint is_mirrored = 1;         // The flags of an instance.
const uint is_left_to_host = 2;     // The device has no mesh of it, or cannot place a path there.
#else
const uint words_per_answer = 5;
const uint max_depth = 64;
#endif

TreeNode node_at(uint number) {
#ifdef SCENE
  if ((number & in_scene) != 0) return scene_nodes[number & ~in_scene];
#endif
  return nodes[number];
}

uint first_of(TreeNode node) { return node.low.w; }
uint count_of(TreeNode node) { return node.high.w; }

bool misses_node(TreeNode node, out float enters) {
  return misses_box(uintBitsToFloat(node.low.xyz), uintBitsToFloat(node.high.xyz), enters);
}

uint asked;  // The path.

uvec3 path_bits(uint path, uint from) {
  uint at = 6 * path + from;
  return uvec3(path_words[at], path_words[at + 1], path_words[at + 2]);
}

bool read_path(uint path) {
  asked = path;
  return take_path(path_bits(path, 0), path_bits(path, 3), is_segment != 0);
}

// The certain hits of a path so far, and what is undecided (G7, G8).
uint best;           // The place of the triangle whose certain hit begins first, or `miss`.
uint best_instance;  // The instance that has it.
float best_lower;    // Its t is at least this,
float best_upper;    // and at most this.
float limit;         // Some certain hit has its t here or before.
float others;        // All other hits have their t here or later.
bool rounds_best;    // True once the walk has ended, and the best one is rounded.
RoundedHit best_hit;
uint best_side;
bool has_open;       // True if something is undecided.
uint steps;          // What the walk has taken so far.

bool may_go_on() { return steps < max_steps; }

// Notes that something is undecided. Its hits have their t at `enters` or later. Returns true if no first hit can be
// certain any more, because no certain hit is before all others (G8).
bool leave_open(float enters) {
  has_open = true;
  others = min(others, enters);
  return wants_first != 0 && others <= range.first;
}

uvec3 bits_of(TreeTriangle triangle, uint corner) {
  if (corner == 0) return triangle.corners_1.xyz;
  if (corner == 1) return uvec3(triangle.corners_1.w, triangle.corners_2.xy);
  return uvec3(triangle.corners_2.zw, triangle.rest.x);
}

vec3 corner_of(TreeTriangle triangle, uint corner) { return uintBitsToFloat(bits_of(triangle, corner)); }

uint id_at(uint triangle) { return triangles[triangle].rest.y; }

// Returns the same for triangles of a mesh that lie in one plane across an axis, and 0 for others.
uint plane_at(uint triangle) { return triangles[triangle].rest.w; }

// What is known of a triangle before it counts.
struct Meeting {
  uint verdict;
  uint side;
  float lower;
  float upper;
  int order;  // -1 if the triangle certainly comes before the best one, 1 if after it, and 0 if neither is certain.
};

#ifndef SCENE
// Finds out exactly how a path and a triangle meet (G24).
ExactContact exact_contact_with(TreeTriangle triangle) {
  PairBits of;
  of.start = path_bits(asked, 0);
  of.toward = path_bits(asked, 3);
  of.a = bits_of(triangle, 0);
  of.b = bits_of(triangle, 1);
  of.c = bits_of(triangle, 2);
  return exact_contact_of(of, is_segment != 0, range.first, range.last);
}

// Hits of triangles in one plane are told apart without that (G22).
bool overlaps_best(uint triangle, Meeting met) {
  if (best == miss) return false;
  uint plane = plane_at(best);
  bool is_told = met.side != edge_on && plane != 0 && plane == plane_at(triangle);
  return !is_told && wants_first != 0 && met.lower <= best_upper && met.upper >= best_lower;
}

// Finds out exactly what is open, and whether a triangle comes before the best one (G24 to G26). At the end of a walk,
// rounds the best one.
void settle(uint triangle, inout Meeting met) {
  WideInt height;
  WideInt det;
  bool has_order = true;
  for (uint i = 0; i < 2; ++i) {
    bool is_asked = has_order && met.verdict == is_hit && overlaps_best(triangle, met);
    if (i == 0) is_asked = rounds_best || met.verdict == is_open || is_asked;
    if (is_asked) {
      steps += steps_of_exact;
      ExactContact contact = exact_contact_with(triangles[i == 0 ? triangle : best]);
      has_order = contact.verdict == is_hit && !is_negative(contact.height);
      if (wants_first != 0 && rounds_best) {
        if (contact.verdict == is_hit) {
          best_hit = round_contact(contact);
          best_side = contact.side;
        }
        return;
      }
      if (i == 0) {
        height = contact.height;
        det = contact.det;
        bool is_left_out = ((range.flags & ignores_start) != 0 && contact.has_start) ||
                           ((range.flags & ignores_end) != 0 && contact.has_end);
        if (met.verdict == is_open) {
          met.side = contact.side;
          met.verdict = contact.verdict == is_hit && is_left_out ? is_missed : contact.verdict;
          if (met.verdict == is_hit && wants_first != 0) {
            if (!has_interval(height, det, met.lower, met.upper)) met.verdict = is_open;
          }
        }
      } else if (has_order) {
        met.order = order_of_products(height, contact.det, contact.height, det);
        if (met.order == 0) met.order = id_at(triangle) < id_at(best) ? -1 : 1;
      }
    }
  }
}
#endif

// Notes a certain hit.
void take_hit(uint triangle, uint instance, Meeting met) {
  float lower = met.lower;
  float upper = met.upper;
  limit = min(limit, upper);
  if (best != miss && best_instance == instance && plane_at(best) != 0 && met.side != edge_on &&
      plane_at(best) == plane_at(triangle)) {
    // Both have the same t, and the lower id comes first (G22).
    best_lower = max(best_lower, lower);
    best_upper = min(best_upper, upper);
    if (id_at(triangle) < id_at(best)) best = triangle;
    return;
  }
  if (met.order > 0) return;
  if (met.order < 0) {
    best = triangle;
    best_lower = lower;
    best_upper = upper;
    return;
  }
  if (lower < best_lower) {
    others = min(others, best_lower);
    best = triangle;
    best_instance = instance;
    best_lower = lower;
    best_upper = upper;
  } else {
    others = min(others, lower);
  }
}

// Decides in pairs what the kernel has left open (G21).
PairVerdict decide_in_pairs(vec3 a, vec3 b, vec3 c, uint instance) {
  steps += steps_of_pairs;
#ifdef SCENE
  PairDeterminants of = placed_determinants_of(instances[instance], given_start, toward, is_segment != 0, a, b, c);
#else
  PairDeterminants of = pair_determinants_of(given_start, toward, is_segment != 0, a, b, c);
#endif
  return decide(of, EndWeights(range.t_first, range.det_first, range.t_last, range.det_last));
}

// Returns true if the kernel, or a decision in pairs, is certain that a triangle is missed. Otherwise says what is
// known. What is open is hit at `enters` or later.
bool misses_triangle(TreeTriangle triangle, uint instance, bool is_turned, inout Meeting met, inout float enters) {
  vec3 a = corner_of(triangle, 0);
  vec3 b = corner_of(triangle, 1);
  vec3 c = corner_of(triangle, 2);
  bool is_front;
  met.verdict = classify(a, b, c, met.lower, met.upper, is_front);
  if (met.verdict == is_open) {
    if (misses_box(min(min(a, b), c), max(max(a, b), c), enters)) return true;
    if (is_quick != 0) return false;
    PairVerdict decided = decide_in_pairs(a, b, c, instance);
    met.verdict = decided.verdict;
    met.lower = decided.lower;
    met.upper = decided.upper;
    is_front = decided.is_front;
  } else {
    is_front = is_front != is_turned;
  }
  met.side = is_front ? front : back;
  return met.verdict == is_missed;
}

// Gives the triangles of a leaf to the kernel. Returns true if the walk may end.
bool meet_leaf(TreeNode leaf, uint ignored, uint instance, bool is_turned) {
  for (uint i = first_of(leaf); i < first_of(leaf) + count_of(leaf); ++i) {
    TreeTriangle triangle = triangles[i];
    if ((triangle.rest.z & range.mask) == 0 || triangle.rest.y == ignored) continue;
    Meeting met;
    met.verdict = is_open;
    met.order = 0;
    float enters;
    if (!rounds_best && misses_triangle(triangle, instance, is_turned, met, enters)) continue;
#ifndef SCENE
    if (is_quick == 0) {
      settle(i, met);
      if (rounds_best) return true;
      if (met.verdict == is_missed) continue;
    }
#endif
    if (met.verdict == is_open) {
      if (leave_open(enters)) return true;
      continue;
    }
    if ((range.flags & keeps_front) != 0 && met.side != front) continue;
    if ((range.flags & keeps_back) != 0 && met.side != back) continue;
    take_hit(i, instance, met);
    if (wants_first == 0) return true;
  }
  return false;
}

// Rounds the best hit in pairs (G9, G20).
void round_best() {
  TreeTriangle triangle = triangles[best];
  vec3 a = corner_of(triangle, 0);
  vec3 b = corner_of(triangle, 1);
  vec3 c = corner_of(triangle, 2);
#ifdef SCENE
  best_hit = round_placed_hit(instances[best_instance], given_start, toward, is_segment != 0, a, b, c);
#else
  best_hit = round_hit(given_start, toward, is_segment != 0, a, b, c);
#endif
  best_side = best_hit.is_front ? front : back;
}

// The walk through the tree.
TreeNode node;  // Where it is.
uint at;        // The number of this node.
uint waiting[max_depth];  // The numbers of nodes that wait,
float waiting_enters[max_depth];  // and the t at which the path enters them, or an earlier one.
uint depth;     // How many of them there are.
#ifdef SCENE
bool is_in_frame;  // True if the path is in the frame of an instance.
#endif

// Goes on to the next node that waits, unless all that it has comes later than a certain hit (G7). Returns false if
// none is left.
bool go_to_next() {
  // There is no `continue`, because lavapipe 22.3 loses nodes with one here.
  bool has_next = false;
  while (depth > 0 && !has_next) {
    --depth;
    has_next = waiting_enters[depth] <= limit;
  }
  if (has_next) {
    at = waiting[depth];
    node = node_at(at);
#ifdef SCENE
    if (is_in_frame && (at & in_scene) != 0) {
      read_path(asked);
      is_in_frame = false;
    }
#endif
  }
  return has_next;
}

// Goes on to the child that the path enters first. If it meets both, the other one waits. Returns false if no node is
// left. Sets `is_full` if there is no room for one that waits.
bool go_down(inout bool is_full) {
  uint first = first_of(node);
  TreeNode left = node_at(first);
  TreeNode right = node_at(first + 1);
  float left_enters;
  float right_enters;
  bool skips_left = misses_node(left, left_enters);
  bool skips_right = misses_node(right, right_enters);
  skips_left = skips_left || left_enters > limit;  // G7
  skips_right = skips_right || right_enters > limit;
  if (skips_left && skips_right) return go_to_next();
  bool goes_left = !skips_left && (skips_right || left_enters <= right_enters);
  if (!skips_left && !skips_right) {
    is_full = depth == max_depth;
    if (is_full) return false;
    waiting[depth] = goes_left ? first + 1 : first;
    waiting_enters[depth] = goes_left ? right_enters : left_enters;
    ++depth;
  }
  at = goes_left ? first : first + 1;
  if (goes_left) node = left;
  if (!goes_left) node = right;
  return true;
}

// Returns the place of a triangle among all, or `miss`, or `undecided`.
uint answer(uint path) {
  range = limits[path * limits_step];
  if ((range.flags & hits_nothing) != 0) return miss;
  if ((range.flags & is_for_host) != 0 || !read_path(path)) return undecided;
  best = miss;
  best_instance = 0;
  best_lower = beyond;
  best_upper = beyond;
  limit = beyond;
  others = beyond;
  has_open = false;
  rounds_best = false;
  uint ignored = range.ignored;
  uint instance = 0;  // The instance whose mesh is walked through.
  bool is_turned = false;
#ifdef SCENE
  float max_t = max(abs(range.first), abs(range.last));
  is_in_frame = false;
  at = in_scene;
#else
  at = 0;
#endif

  float enters;
  node = node_at(at);
  if (misses_node(node, enters)) return miss;
  depth = 0;
  bool has_node = true;
  bool is_full = false;
  for (steps = 0; may_go_on(); ++steps) {
    // The threads of a group go down to their leaves together, and then meet triangles together.
    while (has_node && count_of(node) == 0 && may_go_on()) {
      has_node = go_down(is_full);
      ++steps;
    }
    if (is_full || !may_go_on()) break;
    if (!has_node) {
      if (best == miss) return has_open ? undecided : miss;  // G8
      if (best_upper >= others) return undecided;            // G8
      if (wants_first == 0) return best;
      round_best();
#ifndef SCENE
      rounds_best = is_quick == 0 && !best_hit.is_rounded;
#endif
      if (!rounds_best) return best;
      node.low.w = best;
      node.high.w = 1;
    }
#ifdef SCENE
    if ((at & in_scene) != 0) {
      // A leaf of the scene's tree has one instance. The walk goes on in its mesh (G18).
      Instance placed = instances[first_of(node)];
      bool is_named = placed.index == range.ignored_instance;
      ignored = is_named ? range.ignored : miss;
      if ((placed.mask & range.instance_mask) != 0 && !(is_named && ignored == miss)) {
        misses_node(node, enters);  // The walk came here, so this is only for the time.
        if ((placed.flags & is_left_to_host) != 0 || !enter_frame(placed, is_segment != 0, max_t)) {
          if (leave_open(enters)) return undecided;
        } else {
          is_in_frame = true;
          instance = first_of(node);
          is_turned = (placed.flags & is_mirrored) != 0;
          at = placed.root;
          node = node_at(at);
          if (!misses_node(node, enters) && enters <= limit) continue;
        }
      }
      has_node = go_to_next();
      continue;
    }
#endif
    if (meet_leaf(node, ignored, instance, is_turned)) {
      return wants_first != 0 && !rounds_best ? undecided : best;
    }
    has_node = go_to_next();
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

// Leaves a path to the second dispatch, which is as large as it has to be.
void look_again(uint path) {
  uint place = atomicAdd(again_count, 1u);
  if (place % threads_in_group == 0) atomicAdd(again_groups, 1u);
  leftovers[place].again = path;
}

void main() {
  uint path = gl_GlobalInvocationID.x;
  if (path >= (is_quick != 0 ? path_count : again_count)) return;
  if (is_quick == 0) path = leftovers[path].again;
  uint found = answer(path);
  bool is_certain = found == miss || (found != undecided && (wants_first == 0 || best_hit.is_rounded));
  if (is_quick != 0 && !is_certain) {
    look_again(path);
    return;
  }
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
    id = id_at(found);
    side = best_side;
    weights = vec3(best_hit.t, best_hit.u, best_hit.v);
    if (!best_hit.is_rounded) {
      // Of a path in the plane of the triangle, the host needs the range too (G9).
      bool is_in_plane = side == edge_on;
      side = is_in_plane ? side_undecided : side + is_not_rounded;
      if (lists != 0) list(path, is_in_plane ? miss : id);
    } else if (side == edge_on && lists == 0) {
      side = edge_on_for_host;
    }
  }
  uint place = words_per_answer * path;
  answers[place] = floatBitsToUint(weights.x);
  answers[place + 1] = floatBitsToUint(weights.y);
  answers[place + 2] = floatBitsToUint(weights.z);
  answers[place + 3] = id;
  answers[place + 4] = side;
#ifdef SCENE
  answers[place + 5] = id == miss ? miss : instances[best_instance].index;
#endif
}
