// Decides in pairs of floats what the kernel leaves open. GPU.md has the lemma G21. This text is GLSL and C++ alike,
// and comes after `hit_rounding.glsl`.

// What is known of a path and a triangle.
const uint is_missed = 0;
const uint is_hit = 1;
const uint is_open = 2;

// The sides, as in an answer.
const uint edge_on = 0;
const uint front = 1;
const uint back = 2;

const real slack_of_sums = 1.5;          // G21
const real slack_of_t = 16.0 * max_gap;  // G21
const real min_t_of_pairs = 4.0 / 1152921504606846976.0;  // 2^-58 (G5)
const real max_t_of_pairs = 633825300114114700748351602688.0;  // 2^99 (G21)

struct PairVerdict {
  uint verdict;
  real lower;  // A hit has its t between these two.
  real upper;
  bool is_front;
};

// The weights of the two ends of a range, as in `PathLimits`.
struct EndWeights {
  real t_first;
  real det_first;
  real t_last;
  real det_last;
};

// Returns `is_hit` if a number is certainly above 0, and `is_missed` if it is certainly below.
uint verdict_of(FloatPair x, real bound) {
  precise real limit = 2.0 * bound;
  if (x.high > limit) return is_hit;
  return x.high < -limit ? is_missed : is_open;
}

// The end of a range: t_weight T + det_weight det.
uint verdict_of_end(PairDeterminants of, real t_weight, real det_weight) {
  FloatPair of_t = product_of_pairs(pair_of(t_weight, 0.0), of.height);
  FloatPair of_det = product_of_pairs(pair_of(det_weight, 0.0), of.det);
  precise real bound = slack_of_sums * (abs(t_weight) * of.height_bound + abs(det_weight) * of.det_bound);
  FloatPair sum = sum_of_pairs(of_t, of_det);
  return verdict_of(sum_of(sum.high, sum.low), bound);
}

PairVerdict decide(PairDeterminants of, EndWeights ends) {
  PairVerdict result;
  result.verdict = is_open;
  result.lower = 0.0;
  result.upper = 0.0;
  result.is_front = of.is_front;
  if (!of.is_certain) return result;
  FloatPair rest = sum_of_pairs(sum_of_pairs(of.det, negated(of.u)), negated(of.v));
  precise real rest_bound = slack_of_sums * (of.det_bound + of.u_bound + of.v_bound);
  uint of_u = verdict_of(of.u, of.u_bound);
  uint of_v = verdict_of(of.v, of.v_bound);
  uint of_w = verdict_of(sum_of(rest.high, rest.low), rest_bound);
  uint of_first = verdict_of_end(of, ends.t_first, ends.det_first);
  uint of_last = verdict_of_end(of, ends.t_last, ends.det_last);
  if (of_u == is_missed || of_v == is_missed || of_w == is_missed || of_first == is_missed || of_last == is_missed) {
    result.verdict = is_missed;
    return result;
  }
  if (of_u != is_hit || of_v != is_hit || of_w != is_hit || of_first != is_hit || of_last != is_hit) return result;
  precise real t = of.height.high / of.det.high;
  precise real radius =
      2.0 * (of.height_bound + abs(t) * of.det_bound) / of.det.high + (slack_of_t * abs(t) + min_t_of_pairs);
  precise real lower = t - radius;
  precise real upper = t + radius;
  if (!(abs(lower) < max_t_of_pairs && abs(upper) < max_t_of_pairs)) return result;
  result.verdict = is_hit;
  result.lower = lower;
  result.upper = upper;
  return result;
}
