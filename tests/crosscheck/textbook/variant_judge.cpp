#include "variant_judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "support/exact_oracle.hpp"
#include "support/random.hpp"
#include "vector_formulas.hpp"

namespace surehit::test {
namespace {

/// Returns |computed - exact| in ulps of the Scalar nearest to the exact value, or of `at_least` if this is larger.
template <typename Scalar>
double error_in_ulps(Scalar computed, const mpq_class& exact, Scalar at_least) {
  using Limits = std::numeric_limits<Scalar>;
  if (!std::isfinite(computed)) return std::numeric_limits<double>::infinity();
  const Scalar size = std::min(std::max(std::abs(nearest<Scalar>(exact)), at_least), Limits::max());
  const int ulp = std::ilogb(size) + 1 - Limits::digits;
  mpq_class error = abs(mpq_class(double{computed}) - exact);
  if (ulp < 0) error <<= static_cast<mp_bitcnt_t>(-ulp);
  if (ulp > 0) error >>= static_cast<mp_bitcnt_t>(ulp);
  return std::min(error.get_d(), std::numeric_limits<double>::max());
}

template <typename Scalar>
Tally judged(const TextbookAnswer<Scalar>& answer, const std::optional<ExactContact>& exact) {
  Tally tally;
  tally.hits = exact.has_value();
  tally.false_hits = answer && !exact;
  tally.missed = exact && !answer;
  if (answer && exact) {
    const auto errors = [&](Scalar at_least) {
      return std::array{error_in_ulps(answer->t, exact->t, at_least), error_in_ulps(answer->u, exact->u, at_least),
                        error_in_ulps(answer->v, exact->v, at_least)};
    };
    // Denormal numbers have the ulp of the smallest normal one.
    tally.worst_ulps = errors(std::numeric_limits<Scalar>::min());
    tally.worst_errors = errors(Scalar{0.5});
  }
  return tally;
}

/// Two triangles that share an edge, and a segment to a point of it.
template <typename Scalar>
struct Seam {
  Triangle<Scalar> left;
  Triangle<Scalar> right;
  Segment<Scalar> segment;
};

/// The second triangle is the mirror image of the first one in the middle of the edge, but for a tilt along the normal
/// of the first one. Tilt and segment are within 70 degrees of this normal together.
template <typename Scalar>
Seam<Scalar> draw_seam(Random& random) {
  const auto symmetric_vector = [&] {
    Vector3<Scalar> vector;
    for (int axis = 0; axis < 3; ++axis) vector[axis] = random.symmetric<Scalar>();
    return vector;
  };
  const Vector3<Scalar> p = symmetric_vector();
  const Vector3<Scalar> q = symmetric_vector();
  const Vector3<Scalar> r = symmetric_vector();
  const Vector3<Scalar> n = cross(difference(q, p), difference(r, p));
  const Scalar size = std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])});
  const Scalar tilt = random.symmetric<Scalar>() / 4;
  const Scalar weight = (1 + 6 * random.unit<Scalar>()) / 8;
  const Vector3<Scalar> aside = symmetric_vector();
  Vector3<Scalar> s;
  Vector3<Scalar> start;
  Vector3<Scalar> end;
  for (int axis = 0; axis < 3; ++axis) {
    s[axis] = p[axis] + q[axis] - r[axis] + tilt * n[axis];
    const Scalar way = n[axis] + size * aside[axis] / 4;
    const Scalar target = p[axis] + weight * (q[axis] - p[axis]);
    start[axis] = target + way;
    end[axis] = target - way;
  }
  // Meshes have their corners in any rotation.
  const auto rotated = [&](const Vector3<Scalar>& a, const Vector3<Scalar>& b, const Vector3<Scalar>& c) {
    const std::uint64_t turn = random.below(3);
    return turn == 0 ? Triangle<Scalar>{a, b, c} : turn == 1 ? Triangle<Scalar>{b, c, a} : Triangle<Scalar>{c, a, b};
  };
  const Triangle<Scalar> left = rotated(p, q, r);
  return {left, rotated(q, p, s), {start, end}};
}

}  // namespace

void Tally::add(const Tally& more) {
  hits += more.hits;
  false_hits += more.false_hits;
  missed += more.missed;
  for (std::size_t i = 0; i < worst_ulps.size(); ++i) {
    worst_ulps[i] = std::max(worst_ulps[i], more.worst_ulps[i]);
    worst_errors[i] = std::max(worst_errors[i], more.worst_errors[i]);
  }
}

template <typename Scalar>
Tallies judge_family(PairFamily family, std::size_t pairs) {
  const auto& variants = textbook_variants<Scalar>();
  Tallies tallies;
  Random random(1);
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    const auto [segment, triangle] = draw_pair<Scalar>(family, random);
    const Path<Scalar> path(segment);
    const Path<Scalar> line = path_along(segment, PathKind::line);
    const std::optional<ExactContact> contact = exact_contact(path, triangle);
    const std::optional<ExactContact> of_line = exact_contact(line, triangle);
    const std::optional<ExactContact> of_front = contact && contact->side == Side::front ? contact : std::nullopt;
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const Asked asked = variants[i].asked;
      const auto& exact = asked == Asked::line ? of_line : asked == Asked::front ? of_front : contact;
      tallies[i].add(judged(variants[i].answer(asked == Asked::line ? line : path, triangle), exact));
    }
  }
  return tallies;
}

template <typename Scalar>
std::array<std::size_t, textbook_variant_count> count_leaks(std::size_t pairs) {
  const auto& variants = textbook_variants<Scalar>();
  std::array<std::size_t, textbook_variant_count> leaks = {};
  Random random(1);
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    const auto [left, right, segment] = draw_seam<Scalar>(random);
    if (!exact_contact<Scalar>(segment, left) && !exact_contact<Scalar>(segment, right)) continue;
    for (std::size_t i = 0; i < variants.size(); ++i) {
      Path<Scalar> path(segment);
      if (variants[i].asked == Asked::line) path = path_along(segment, PathKind::line);
      leaks[i] += !variants[i].answer(path, left) && !variants[i].answer(path, right);
    }
  }
  return leaks;
}

template Tallies judge_family<float>(PairFamily, std::size_t);
template Tallies judge_family<double>(PairFamily, std::size_t);
template std::array<std::size_t, textbook_variant_count> count_leaks<float>(std::size_t);
template std::array<std::size_t, textbook_variant_count> count_leaks<double>(std::size_t);

}  // namespace surehit::test
