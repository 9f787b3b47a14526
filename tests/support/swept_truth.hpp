#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <string>

#include "support/one_root_number.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// What is true of a moving shape and a triangle, in exact numbers.
struct SweptTruth {
  bool touches = false;
  bool starts_touching = false;
  QuadraticRoot t = {};  ///< It is 0 if they touch at the start.
  OneRootNumber u = {};
  OneRootNumber v = {};
  Feature feature = Feature::face;
};

using WholeVector = std::array<mpz_class, 3>;

/// A moving capsule and a triangle in whole numbers of one unit. A ball is a capsule with a half axis of zero. The
/// triangle may be a placed one, and the step that which an instance sees.
struct WholeCapsulePair {
  WholeVector start;
  WholeVector step;
  WholeVector half_axis;
  std::array<WholeVector, 3> corners;
  mpz_class rr;  ///< The square of the radius.
};

/// The same for a moving box.
struct WholeBoxPair {
  WholeVector start;
  WholeVector step;
  WholeVector half_extents;
  std::array<WholeVector, 3> corners;
};

/// Returns what is true of such a pair, as the next functions do.
[[nodiscard]] SweptTruth truth_of(const WholeCapsulePair& pair);
[[nodiscard]] SweptTruth truth_of(const WholeBoxPair& pair);

/// Returns what is true of a moving ball and a triangle. All numbers must be finite, and the radius must not be
/// negative. Call it in the default floating-point environment.
///
/// It follows the definition. A time counts if the centre is then at a distance of the radius from a plane, a line or a
/// corner, at a point that belongs to the triangle. All of them are computed, and the first one is chosen by exact
/// comparisons of roots. It shares nothing with the library or with `sphere_oracle`, and is much faster than the
/// latter.
template <typename Scalar>
[[nodiscard]] SweptTruth truth_of(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle);

/// Returns what is true of a moving capsule. Its centre comes near to the triangle, moved along the core in both
/// directions. This prism has two triangles and three parallelograms.
template <typename Scalar>
[[nodiscard]] SweptTruth truth_of(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle);

/// Returns what is true of a moving box, by the rationals of `box_oracle`.
template <typename Scalar>
[[nodiscard]] SweptTruth truth_of(const SweptBox<Scalar>& box, const Triangle<Scalar>& triangle);

/// Returns the hit that has to be reported. The shape must touch.
template <typename Scalar>
[[nodiscard]] ShapeHit<Scalar> rounded_hit(const SweptTruth& truth);

/// Says what is wrong with an answer, or returns nothing if it is right in every field.
template <typename Scalar>
[[nodiscard]] std::optional<std::string> find_error(const SweptTruth& truth,
                                                    const std::optional<ShapeHit<Scalar>>& answer);

}  // namespace surehit::test
