#pragma once

#include <Eigen/Core>
#include <array>
#include <type_traits>

#include "surehit/attributes.hpp"
#include "surehit/path.hpp"

namespace surehit {

/// Where an instance is: a corner v of its mesh is at linear v + translation, in exact arithmetic. No corner is
/// rounded.
///
/// `linear` may rotate, scale, mirror and shear. Each of its entries must be 0, or between 2^-64 and 2^64 in magnitude.
/// Its exact determinant must not be 0. The translation must be finite.
template <FloatOrDouble Scalar>
struct Pose {
  /// A matrix of three rows and columns.
  using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

  Matrix3 linear = Matrix3::Identity();                   ///< What turns and stretches the mesh about its origin.
  Vector3<Scalar> translation = Vector3<Scalar>::Zero();  ///< Where the mesh's origin is.

  /// Returns a pose that moves the mesh, and does not turn it.
  [[nodiscard]] static Pose translated(const Vector3<Scalar>& translation) {
    return {Matrix3::Identity(), translation};
  }

  /// Returns a pose that turns the mesh, and then moves it. `quaternion` has x, y, z and w, and is a unit quaternion.
  ///
  /// Each entry of the matrix is rounded a few times, so the result is a rotation within some ulp(1). Entries below
  /// 2^-64 in magnitude become 0. The instance is the exact image under the rounded matrix.
  [[nodiscard]] SUREHIT_API static Pose rigid(const std::array<Scalar, 4>& quaternion,
                                              const Vector3<Scalar>& translation);
  /// Does the same for an `Eigen::Quaternion`, or for another type with x(), y(), z() and w().
  template <typename Quaternion>
  requires requires(const Quaternion& q) { q.x() + q.y() + q.z() + q.w(); }
  [[nodiscard]] static Pose rigid(const Quaternion& quaternion, const Vector3<Scalar>& translation) {
    return rigid(std::array<Scalar, 4>{quaternion.x(), quaternion.y(), quaternion.z(), quaternion.w()}, translation);
  }

  /// Returns this pose for a mesh that is stretched first, by a factor along each of its axes. A negative factor
  /// mirrors the mesh. Each entry of the matrix is rounded once. It becomes 0 below 2^-64 in magnitude.
  [[nodiscard]] SUREHIT_API Pose scaled(const Vector3<Scalar>& factors) const;
  /// Does the same with one factor for all axes.
  [[nodiscard]] Pose scaled(Scalar factor) const { return scaled(Vector3<Scalar>{factor, factor, factor}); }
  /// Returns this pose with 0 for each entry of `linear` that is below 2^-64 in magnitude. A matrix of computed sines
  /// and cosines has such entries where the true ones are 0, and a scene refuses them.
  [[nodiscard]] SUREHIT_API Pose without_tiny_entries() const;
};

extern template struct SUREHIT_API Pose<float>;
extern template struct SUREHIT_API Pose<double>;

using Posef = Pose<float>;   ///< A pose in float.
using Posed = Pose<double>;  ///< A pose in double.

}  // namespace surehit
