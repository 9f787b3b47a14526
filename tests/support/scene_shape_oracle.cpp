#include <algorithm>
#include <cstddef>
#include <tuple>
#include <variant>

#include "support/scene_oracle.hpp"
#include "support/swept_truth.hpp"

namespace surehit::test {
namespace {

/// The numbers of a shape. A ball has a size of zero, a box has its half extents, and a capsule has its half axis.
struct Numbers {
  DyadicVector start;
  DyadicVector end;
  DyadicVector size;
  Dyadic radius;
  bool is_box;
};

template <typename Scalar>
Numbers numbers_of(const SweptSphere<Scalar>& sphere) {
  return {dyadic(sphere.start), dyadic(sphere.end), {}, Dyadic(double{sphere.radius}), false};
}
template <typename Scalar>
Numbers numbers_of(const SweptBox<Scalar>& box) {
  return {dyadic(box.start), dyadic(box.end), dyadic(box.half_extents), {}, true};
}
template <typename Scalar>
Numbers numbers_of(const SweptCapsule<Scalar>& capsule) {
  return {dyadic(capsule.start), dyadic(capsule.end), dyadic(capsule.half_axis), Dyadic(double{capsule.radius}), false};
}

/// A shape as an instance sees it, in whole numbers of 2^exponent.
class SeenShape {
 public:
  /// The unit is that of the instance's mesh, or finer.
  SeenShape(const Numbers& shape, const DyadicVector& motion, long mesh_exponent) : is_box_(shape.is_box) {
    const DyadicVector step = shape.end - shape.start - motion;
    exponent_ = mesh_exponent;
    const auto see = [&](const Dyadic& x) {
      if (!x.is_zero()) exponent_ = std::min(exponent_, x.exponent());
    };
    for (const DyadicVector* const vector : {&shape.start, &step, &shape.size}) {
      for (const Dyadic& x : *vector) see(x);
    }
    see(shape.radius);
    digits_ = static_cast<mp_bitcnt_t>(mesh_exponent - exponent_);
    radius_ = shape.radius.in_units_of(exponent_);
    for (std::size_t i = 0; i < 3; ++i) {
      start_[i] = shape.start[i].in_units_of(exponent_);
      step_[i] = step[i].in_units_of(exponent_);
      size_[i] = shape.size[i].in_units_of(exponent_);
      const mpz_class reach = abs(size_[i]) + radius_;
      const mpz_class end = start_[i] + step_[i];
      low_[i] = (start_[i] < end ? start_[i] : end) - reach;
      high_[i] = (start_[i] < end ? end : start_[i]) + reach;
    }
  }

  /// Returns the corners of a triangle of the mesh, in the unit of this shape.
  [[nodiscard]] std::array<WholeVector, 3> converted(std::array<WholeVector, 3> corners) const {
    for (WholeVector& corner : corners) {
      for (mpz_class& x : corner) x <<= digits_;
    }
    return corners;
  }
  /// Whether a box around the shape's way and one around a triangle keep apart. Most pairs need no more.
  [[nodiscard]] bool is_apart(const std::array<WholeVector, 3>& corners) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto beyond = [&](const WholeVector& corner) { return corner[i] > high_[i]; };
      const auto before = [&](const WholeVector& corner) { return corner[i] < low_[i]; };
      if (std::all_of(corners.begin(), corners.end(), beyond)) return true;
      if (std::all_of(corners.begin(), corners.end(), before)) return true;
    }
    return false;
  }
  [[nodiscard]] SweptTruth truth(const std::array<WholeVector, 3>& corners) const {
    if (is_box_) return truth_of(WholeBoxPair{start_, step_, size_, corners});
    return truth_of(WholeCapsulePair{start_, step_, size_, corners, radius_ * radius_});
  }
  /// Returns the sign of the step times the normal.
  [[nodiscard]] int sign_along(const std::array<WholeVector, 3>& corners) const {
    const auto& [a, b, c] = corners;
    mpz_class product = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      product += step_[i] * ((b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]));
    }
    return sgn(product);
  }

 private:
  bool is_box_;
  long exponent_;
  mp_bitcnt_t digits_;
  WholeVector start_, step_, size_;
  WholeVector low_, high_;  ///< A box around the way.
  mpz_class radius_;
};

/// Whether the limit and the culling admit a contact.
template <typename Scalar>
bool is_admitted(const SeenShape& shape, const std::array<WholeVector, 3>& corners, const SweptTruth& truth,
                 const SceneShapeQueryOptions<Scalar>& options) {
  if (options.ignore_start_contact && truth.starts_touching) return false;
  if (options.max_t < 1) {
    const Dyadic limit(double{options.max_t});
    const long exponent = limit.is_zero() ? 0 : limit.exponent();
    if (truth.t.number().compare(limit.in_units_of(exponent), exponent) > 0) return false;
  }
  if (options.culling == Culling::none) return true;
  return shape.sign_along(corners) == (options.culling == Culling::back ? -1 : 1);
}

}  // namespace

template <typename Scalar>
std::optional<std::string> SceneOracle<Scalar>::find_error(const SweptShape<Scalar>& shape,
                                                           const SceneShapeQueryOptions<Scalar>& options,
                                                           const std::vector<SceneShapeHit<Scalar>>& hits) const {
  const Numbers numbers = std::visit([](const auto& any) { return numbers_of(any); }, shape);
  std::vector<QuadraticRoot> times(hits.size());
  std::size_t touched = 0;
  for (const PlacedMesh& mesh : meshes_) {
    const bool is_ignored = mesh.id == options.ignored_instance;
    if ((mesh.mask & options.instance_mask) == 0 || (is_ignored && options.ignored_triangle == no_triangle)) continue;
    const SeenShape seen(numbers, mesh.motion, mesh.exponent);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      if (is_ignored && i == options.ignored_triangle) continue;
      const std::uint32_t mask = mesh.masks.empty() ? ~std::uint32_t{0} : mesh.masks[i];
      if ((mask & options.mask) == 0 || !(options.max_t >= 0)) continue;
      const auto corners = seen.converted(mesh.triangles[i]);
      if (seen.is_apart(corners)) continue;
      const SweptTruth truth = seen.truth(corners);
      if (!truth.touches || !is_admitted(seen, corners, truth, options)) continue;
      const std::string name = "instance " + std::to_string(mesh.id.index) + ", triangle " + std::to_string(i) + ": ";
      const auto hit = std::find_if(hits.begin(), hits.end(),
                                    [&](const auto& one) { return one.instance == mesh.id && one.triangle == i; });
      if (hit == hits.end()) return name + "is touched and has no hit";
      const ShapeHit<Scalar>& answer = *hit;
      if (const auto error = test::find_error(truth, std::optional(answer))) return name + *error;
      times[static_cast<std::size_t>(hit - hits.begin())] = truth.t;
      ++touched;
    }
  }
  if (touched != hits.size()) return "there are hits of what is not touched";
  for (std::size_t i = 1; i < hits.size(); ++i) {
    const int order = times[i - 1].number().compare(times[i].number());
    const bool ascends =
        std::tie(hits[i - 1].instance.index, hits[i - 1].triangle) < std::tie(hits[i].instance.index, hits[i].triangle);
    if (order > 0 || (order == 0 && !ascends)) return "hit " + std::to_string(i) + " is out of order";
  }
  return std::nullopt;
}

template std::optional<std::string> SceneOracle<float>::find_error(const SweptShape<float>&,
                                                                   const SceneShapeQueryOptions<float>&,
                                                                   const std::vector<SceneShapeHit<float>>&) const;
template std::optional<std::string> SceneOracle<double>::find_error(const SweptShape<double>&,
                                                                    const SceneShapeQueryOptions<double>&,
                                                                    const std::vector<SceneShapeHit<double>>&) const;

}  // namespace surehit::test
