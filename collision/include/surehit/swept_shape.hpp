#pragma once

#include <span>
#include <variant>

#include "surehit/scalar.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/swept_sphere.hpp"

namespace surehit {

/// A moving shape of any kind. Each kind converts to it, so each query of moving shapes takes all of them.
template <FloatOrDouble Scalar>
using SweptShape = std::variant<SweptSphere<Scalar>, SweptBox<Scalar>, SweptCapsule<Scalar>>;

/// Moving shapes of one kind, side by side in memory that the user owns. A container or a span of one kind converts to
/// it. It copies nothing, and must not outlive the shapes.
template <FloatOrDouble Scalar>
using SweptShapeSpan = std::variant<std::span<const SweptSphere<Scalar>>, std::span<const SweptBox<Scalar>>,
                                    std::span<const SweptCapsule<Scalar>>>;

using SweptShapef = SweptShape<float>;           ///< A moving shape in float.
using SweptShaped = SweptShape<double>;          ///< A moving shape in double.
using SweptShapeSpanf = SweptShapeSpan<float>;   ///< Moving shapes in float.
using SweptShapeSpand = SweptShapeSpan<double>;  ///< Moving shapes in double.

}  // namespace surehit
