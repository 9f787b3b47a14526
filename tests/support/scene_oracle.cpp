#include "support/scene_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "support/exact_oracle.hpp"
#include "support/neighbour.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
DyadicVector row(const Pose<Scalar>& pose, int index) {
  return dyadic<Scalar>(pose.linear.row(index).transpose());
}

Dyadic dot(const DyadicVector& left, const DyadicVector& right) {
  return left[0] * right[0] + left[1] * right[1] + left[2] * right[2];
}

DyadicVector cross(const DyadicVector& left, const DyadicVector& right) {
  return {left[1] * right[2] - left[2] * right[1], left[2] * right[0] - left[0] * right[2],
          left[0] * right[1] - left[1] * right[0]};
}

/// Returns `least`, or the exponent of the finest unit that one of the numbers needs.
long finest_exponent(const DyadicVector& vector, long least) {
  for (const Dyadic& x : vector) {
    if (!x.is_zero()) least = std::min(least, x.exponent());
  }
  return least;
}

ExactIntegerVector in_units_of(const DyadicVector& vector, long exponent) {
  return {vector[0].in_units_of(exponent), vector[1].in_units_of(exponent), vector[2].in_units_of(exponent)};
}

void shift_left(ExactIntegerVector& vector, long digits) {
  for (mpz_class& x : vector) x <<= static_cast<mp_bitcnt_t>(digits);
}

/// A box in which all points of a path lie, on one axis.
struct Reach {
  Reach(const IntegerPair& pair, std::size_t axis)
      : is_open_below(pair.kind == PathKind::line || (pair.kind == PathKind::ray && pair.direction[axis] < 0)),
        is_open_above(pair.kind == PathKind::line || (pair.kind == PathKind::ray && pair.direction[axis] > 0)),
        low(pair.start[axis]),
        high(pair.start[axis]) {
    if (pair.direction[axis] == 0) is_open_below = is_open_above = false;
    if (pair.direction[axis] < 0) low += pair.direction[axis];
    if (pair.direction[axis] > 0) high += pair.direction[axis];
  }
  /// Whether the path stays away from the interval.
  [[nodiscard]] bool is_apart(const mpz_class& least, const mpz_class& greatest) const {
    return (!is_open_above && high < least) || (!is_open_below && greatest < low);
  }

  bool is_open_below;
  bool is_open_above;
  mpz_class low;
  mpz_class high;
};

using Reaches = std::array<Reach, 3>;

bool is_apart(const Reaches& reaches, const std::array<ExactIntegerVector, 3>& corners) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& [a, b, c] = corners;
    const mpz_class& least = std::min({a[axis], b[axis], c[axis]}, [](const auto& x, const auto& y) { return x < y; });
    const mpz_class& greatest =
        std::max({a[axis], b[axis], c[axis]}, [](const auto& x, const auto& y) { return x < y; });
    if (reaches[axis].is_apart(least, greatest)) return true;
  }
  return false;
}

template <typename Scalar>
QueryOptions<double> pair_options(const SceneQueryOptions<Scalar>& options) {
  QueryOptions<double> result;
  result.min_t = options.min_t;
  result.max_t = options.max_t;
  result.culling = options.culling;
  result.ignore_start_contact = options.ignore_start_contact;
  result.ignore_end_contact = options.ignore_end_contact;
  return result;
}

}  // namespace

template <typename Scalar>
mpq_class exact_determinant(const Pose<Scalar>& pose) {
  return dot(row(pose, 0), cross(row(pose, 1), row(pose, 2))).rational();
}

template <typename Scalar>
template <typename MeshScalar>
void SceneOracle<Scalar>::add(InstanceId id, const TriangleMeshView<MeshScalar>& mesh,
                              std::span<const std::uint32_t> masks, const Placement<Scalar>& placement) {
  const DyadicVector rows[] = {row(placement.pose, 0), row(placement.pose, 1), row(placement.pose, 2)};
  const DyadicVector translation = dyadic(placement.pose.translation);
  const auto image = [&](const Vector3<MeshScalar>& corner) {
    const DyadicVector v = dyadic(corner);
    return DyadicVector{dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)} + translation;
  };
  std::vector<std::array<DyadicVector, 3>> images;
  long exponent = 0;
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    const Triangle<MeshScalar> triangle = mesh.triangle(i);
    images.push_back({image(triangle.a), image(triangle.b), image(triangle.c)});
    for (const DyadicVector& corner : images.back()) exponent = finest_exponent(corner, exponent);
  }

  PlacedMesh placed{id, placement.mask, {masks.begin(), masks.end()}, dyadic(placement.motion), exponent, {}, {}, {}};
  for (const auto& [a, b, c] : images) {
    placed.triangles.push_back({in_units_of(a, exponent), in_units_of(b, exponent), in_units_of(c, exponent)});
  }
  for (std::size_t axis = 0; axis < 3 && !images.empty(); ++axis) {
    placed.low[axis] = placed.high[axis] = placed.triangles[0][0][axis];
    for (const auto& triangle : placed.triangles) {
      for (const ExactIntegerVector& corner : triangle) {
        if (corner[axis] < placed.low[axis]) placed.low[axis] = corner[axis];
        if (corner[axis] > placed.high[axis]) placed.high[axis] = corner[axis];
      }
    }
  }
  meshes_.push_back(std::move(placed));
}

template <typename Scalar>
void SceneOracle<Scalar>::add_hits(const PlacedMesh& mesh, const Path<Scalar>& path, const Dyadic& share,
                                   const SceneQueryOptions<Scalar>& options, std::vector<OrderedHit>& hits) {
  if ((mesh.mask & options.instance_mask) == 0 || mesh.triangles.empty()) return;
  const bool is_ignored = mesh.id == options.ignored_instance;
  if (is_ignored && options.ignored_triangle == no_triangle) return;

  // An instance that moves is seen from itself.
  const DyadicVector start = dyadic(path.start);
  const DyadicVector toward = dyadic(path.toward);
  const DyadicVector direction = path.kind == PathKind::segment ? toward - start - share * mesh.motion : toward;
  const long exponent = finest_exponent(start, finest_exponent(direction, mesh.exponent));
  const long digits = mesh.exponent - exponent;
  IntegerPair seen{path.kind, in_units_of(start, exponent), in_units_of(direction, exponent), {}};

  const Reaches reaches = {Reach(seen, 0), Reach(seen, 1), Reach(seen, 2)};
  ExactIntegerVector low = mesh.low;
  ExactIntegerVector high = mesh.high;
  shift_left(low, digits);
  shift_left(high, digits);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (reaches[axis].is_apart(low[axis], high[axis])) return;
  }

  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (is_ignored && i == options.ignored_triangle) continue;
    if (!mesh.masks.empty() && (mesh.masks[i] & options.mask) == 0) continue;
    if (mesh.masks.empty() && options.mask == 0) continue;
    seen.corners = mesh.triangles[i];
    for (ExactIntegerVector& corner : seen.corners) shift_left(corner, digits);
    if (is_apart(reaches, seen.corners)) continue;
    if (const auto contact = first_contact(seen, pair_options(options))) {
      hits.push_back({contact->t, {rounded_hit<Scalar>(*contact, i), mesh.id}});
    }
  }
}

template <typename Scalar>
auto SceneOracle<Scalar>::ordered_hits(const Path<Scalar>& path, const Dyadic& share,
                                       const SceneQueryOptions<Scalar>& options) const -> std::vector<OrderedHit> {
  std::vector<OrderedHit> hits;
  if (!path.start.allFinite() || !path.toward.allFinite()) return hits;
  for (const PlacedMesh& mesh : meshes_) add_hits(mesh, path, share, options, hits);
  std::sort(hits.begin(), hits.end(), [](const OrderedHit& left, const OrderedHit& right) {
    if (left.t != right.t) return left.t < right.t;
    return std::tie(left.hit.instance.index, left.hit.triangle) <
           std::tie(right.hit.instance.index, right.hit.triangle);
  });
  return hits;
}

template <typename Scalar>
auto SceneOracle<Scalar>::all_hits(const Path<Scalar>& path, const SceneQueryOptions<Scalar>& options) const -> Hits {
  Hits hits;
  for (const OrderedHit& one : ordered_hits(path, Dyadic(1), options)) hits.push_back(one.hit);
  return hits;
}

template <typename Scalar>
Vector3<Scalar> SceneOracle<Scalar>::last_free_point(const Segment<Scalar>& segment, const SceneHit<Scalar>& hit,
                                                     const SceneQueryOptions<Scalar>& options,
                                                     const Filter& filter) const {
  if (!segment.start.allFinite() || !segment.end.allFinite() || !std::isfinite(hit.t)) return segment.start;
  const Dyadic t(double{hit.t});
  const DyadicVector start = dyadic(segment.start);
  const DyadicVector way = dyadic(segment.end) - start;
  Dyadic step = Dyadic(double{neighbour(hit.t, 1)}) - t;
  for (Dyadic s = t - step; s.rational() > 0; step = step + step, s = t - step) {
    const DyadicVector exact_end = start + s * way;
    Segment<Scalar> shorter{segment.start, {}};
    for (int axis = 0; axis < 3; ++axis) {
      shorter.end[axis] = nearest<Scalar>(exact_end[static_cast<std::size_t>(axis)].rational());
    }
    SceneQueryOptions<Scalar> rescaled = options;
    rescaled.max_t = std::numeric_limits<Scalar>::infinity();
    if (std::isfinite(options.min_t)) {
      rescaled.min_t = neighbour(nearest<Scalar>(mpq_class(double{options.min_t}) / s.rational()), -1);
    }
    const auto hits = ordered_hits(shorter, s, rescaled);
    const auto counts = [&](const OrderedHit& one) { return !filter || filter(one.hit); };
    if (std::none_of(hits.begin(), hits.end(), counts)) return shorter.end;
  }
  return segment.start;
}

template <typename Scalar>
auto SceneOracle<Scalar>::of(InstanceId id) const -> const PlacedMesh& {
  return *std::find_if(meshes_.begin(), meshes_.end(), [&](const PlacedMesh& mesh) { return mesh.id == id; });
}

template <typename Scalar>
std::array<std::array<mpq_class, 3>, 3> SceneOracle<Scalar>::corners(InstanceId id, std::uint32_t triangle) const {
  const PlacedMesh& mesh = of(id);
  std::array<std::array<mpq_class, 3>, 3> corners;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corners[corner][axis] = mpq_class(mesh.triangles[triangle][corner][axis]);
      corners[corner][axis] >>= static_cast<mp_bitcnt_t>(-mesh.exponent);
    }
  }
  return corners;
}

template <typename Scalar>
Triangle<Scalar> SceneOracle<Scalar>::triangle(InstanceId id, std::uint32_t triangle) const {
  const auto exact = corners(id, triangle);
  const auto rounded = [](const std::array<mpq_class, 3>& corner) {
    return Vector3<Scalar>{nearest<Scalar>(corner[0]), nearest<Scalar>(corner[1]), nearest<Scalar>(corner[2])};
  };
  return {rounded(exact[0]), rounded(exact[1]), rounded(exact[2])};
}

template mpq_class exact_determinant(const Pose<float>&);
template mpq_class exact_determinant(const Pose<double>&);
template class SceneOracle<float>;
template class SceneOracle<double>;
#define SUREHIT_INSTANTIATE(Scalar, MeshScalar)                                           \
  template void SceneOracle<Scalar>::add(InstanceId, const TriangleMeshView<MeshScalar>&, \
                                         std::span<const std::uint32_t>, const Placement<Scalar>&);
SUREHIT_INSTANTIATE(float, float)
SUREHIT_INSTANTIATE(float, double)
SUREHIT_INSTANTIATE(double, float)
SUREHIT_INSTANTIATE(double, double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
