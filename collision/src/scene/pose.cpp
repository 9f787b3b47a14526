#include "surehit/pose.hpp"

#include <cmath>

#include "support/floating_point_environment.hpp"
#include "support/rounding_flags.hpp"

namespace surehit {

template <FloatOrDouble Scalar>
Pose<Scalar> Pose<Scalar>::rigid(const std::array<Scalar, 4>& quaternion, const Vector3<Scalar>& translation) {
  const FloatingPointEnvironment environment;
  const double x = quaternion[0], y = quaternion[1], z = quaternion[2], w = quaternion[3];
  const auto entry = [](double value) { return static_cast<Scalar>(value); };
  Pose pose;
  pose.linear << entry(1 - 2 * (y * y + z * z)), entry(2 * (x * y - w * z)), entry(2 * (x * z + w * y)),
      entry(2 * (x * y + w * z)), entry(1 - 2 * (x * x + z * z)), entry(2 * (y * z - w * x)),
      entry(2 * (x * z - w * y)), entry(2 * (y * z + w * x)), entry(1 - 2 * (x * x + y * y));
  pose.translation = translation;
  return pose.without_tiny_entries();
}

template <FloatOrDouble Scalar>
Pose<Scalar> Pose<Scalar>::scaled(const Vector3<Scalar>& factors) const {
  const FloatingPointEnvironment environment;
  return Pose{linear * factors.asDiagonal(), translation}.without_tiny_entries();
}

template <FloatOrDouble Scalar>
Pose<Scalar> Pose<Scalar>::without_tiny_entries() const {
  const FloatingPointEnvironment environment;
  constexpr Scalar min_size = 0x1p-64;
  return {linear.unaryExpr([](Scalar entry) { return std::fabs(entry) < min_size ? Scalar{0} : entry; }), translation};
}

template struct Pose<float>;
template struct Pose<double>;

}  // namespace surehit
