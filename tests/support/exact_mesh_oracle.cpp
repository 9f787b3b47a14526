#include "support/exact_mesh_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "support/exact_oracle.hpp"
#include "support/neighbour.hpp"

namespace surehit::test {
namespace {

/// round(start + s (end - start)), each coordinate rounded once.
template <typename Scalar>
Vector3<Scalar> rounded_point(const Segment<Scalar>& segment, const mpq_class& s) {
  Vector3<Scalar> point;
  for (int axis = 0; axis < 3; ++axis) {
    const mpq_class start = double{segment.start[axis]};
    const mpq_class end = double{segment.end[axis]};
    point[axis] = nearest<Scalar>(start + s * (end - start));
  }
  return point;
}

}  // namespace

template <typename Scalar>
bool ExactMeshOracle<Scalar>::takes_part(std::uint32_t triangle, const QueryOptions<Scalar>& options) const {
  const std::uint32_t mask = masks_.empty() ? ~std::uint32_t{0} : masks_[triangle];
  return (mask & options.mask) != 0 && triangle != options.ignored_triangle;
}

template <typename Scalar>
std::vector<Hit<Scalar>> ExactMeshOracle<Scalar>::all_hits(const Path<Scalar>& path,
                                                           const QueryOptions<Scalar>& options) const {
  std::vector<std::pair<mpq_class, Hit<Scalar>>> contacts;
  for (std::uint32_t i = 0; i < mesh_.triangle_count(); ++i) {
    if (!takes_part(i, options)) continue;
    if (const auto contact = exact_contact(path, mesh_.triangle(i), options)) {
      contacts.emplace_back(contact->t, rounded_hit<Scalar>(*contact, i));
    }
  }
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const auto& left, const auto& right) { return left.first < right.first; });
  std::vector<Hit<Scalar>> hits;
  for (const auto& [t, hit] : contacts) hits.push_back(hit);
  return hits;
}

/// The shorter segment's min_t is the number below the nearest to min_t / s: an ulp too low can only stop the point
/// earlier.
template <typename Scalar>
Vector3<Scalar> ExactMeshOracle<Scalar>::last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                         const QueryOptions<Scalar>& options) const {
  const mpq_class t = double{hit.t};
  mpq_class step = mpq_class(double{neighbour(hit.t, 1)}) - t;
  for (mpq_class s = t - step; s > 0; step *= 2, s = t - step) {
    const Segment<Scalar> shorter{segment.start, rounded_point(segment, s)};
    QueryOptions<Scalar> rescaled = options;
    rescaled.max_t = std::numeric_limits<Scalar>::infinity();
    if (std::isfinite(options.min_t)) {
      rescaled.min_t = neighbour(nearest<Scalar>(mpq_class(double{options.min_t}) / s), -1);
    }
    if (all_hits(shorter, rescaled).empty()) return shorter.end;
  }
  return segment.start;
}

template class ExactMeshOracle<float>;
template class ExactMeshOracle<double>;

}  // namespace surehit::test
