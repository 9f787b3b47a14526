#include "shape/contact_normal.hpp"

#include <optional>
#include <type_traits>

#include "exact/exact_contact.hpp"
#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/exact_box.hpp"
#include "shape/exact_capsule.hpp"
#include "shape/exact_direction.hpp"
#include "shape/exact_sphere.hpp"
#include "shape/placed_shape_candidate.hpp"
#include "shape/shape_narrowphase.hpp"
#include "shape/sphere_contact.hpp"
#include "support/rounding_flags.hpp"
#include "unit_of_cross.hpp"

namespace surehit::detail {
namespace {

/// Returns the contact of a valid shape, for its direction.
template <typename Shape, typename AnyTriangle>
std::optional<ContactOf<Shape>> contact_of(const Shape& shape, const AnyTriangle& triangle) {
  using Scalar = ScalarOf<Shape>;
  if constexpr (std::is_same_v<Shape, SweptBox<Scalar>>) {
    // A box may pass several sides at once, and integers tell which one is the first.
    return exact_contact(shape, triangle);
  } else {
    using Candidate = std::conditional_t<std::is_same_v<AnyTriangle, Triangle<Scalar>>, ShapeCandidate<Shape>,
                                         PlacedShapeCandidate<Shape>>;
    QueryStatistics statistics;
    const typename Candidate::Options options;
    ContactOf<Shape> contact;
    const ShapeNarrowphase<Shape, Candidate> narrowphase(shape, options, statistics);
    if (!narrowphase.find_contact(triangle, 1, contact)) return std::nullopt;
    return contact;
  }
}

}  // namespace

template <typename Shape, typename AnyTriangle>
Vector3<ScalarOf<Shape>> normal_of_contact(const Shape& shape, const AnyTriangle& triangle) {
  using Scalar = ScalarOf<Shape>;
  const auto contact = is_valid(shape) ? contact_of(shape, triangle) : std::nullopt;
  if (!contact) return Vector3<Scalar>::Zero();
  Vector3<Scalar> along = unit_of<Scalar>(exact_direction(shape, triangle, *contact));
  if (!along.isZero(0)) return along;
  Vector3<Scalar> n = unit_of_cross<Scalar>(exact_cross(triangle));
  if (sign_along(shape, triangle) > 0) n = -n;
  return n;
}

#define SUREHIT_INSTANTIATE(Shape, Scalar)                                                   \
  template Vector3<Scalar> normal_of_contact(const Shape<Scalar>&, const Triangle<Scalar>&); \
  template Vector3<Scalar> normal_of_contact(const Shape<Scalar>&, const PlacedTriangle<Scalar>&);
SUREHIT_INSTANTIATE(SweptSphere, float)
SUREHIT_INSTANTIATE(SweptSphere, double)
SUREHIT_INSTANTIATE(SweptBox, float)
SUREHIT_INSTANTIATE(SweptBox, double)
SUREHIT_INSTANTIATE(SweptCapsule, float)
SUREHIT_INSTANTIATE(SweptCapsule, double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
