#pragma once

#include "surehit/path.hpp"

namespace surehit::detail {

/// Returns the unit vector along a cross product that `exact_cross` has computed, within 2 ulp(1). A zero stays zero.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> unit_of_cross(const Vector3<double>& cross);

}  // namespace surehit::detail
