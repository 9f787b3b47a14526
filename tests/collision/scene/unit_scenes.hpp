#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "collision/unit_triangles.hpp"
#include "surehit/scene.hpp"

namespace surehit::test {

/// A collider of some unit triangles above each other, triangle i at height i.
template <typename Scalar>
std::shared_ptr<Collider<Scalar>> stack_collider(int count, const std::vector<std::uint32_t>& masks = {}) {
  return std::make_shared<Collider<Scalar>>(stack_of_triangles<Scalar>(count).view(), with_masks(masks));
}

/// A pose that moves the mesh up.
template <typename Scalar>
Pose<Scalar> at_height(Scalar height) {
  return Pose<Scalar>::translated({0, 0, height});
}

/// A pose with this matrix, and without a translation.
template <typename Scalar>
Pose<Scalar> with_rows(const Vector3<Scalar>& x, const Vector3<Scalar>& y, const Vector3<Scalar>& z) {
  Pose<Scalar> pose;
  pose.linear.row(0) = x.transpose();
  pose.linear.row(1) = y.transpose();
  pose.linear.row(2) = z.transpose();
  return pose;
}

}  // namespace surehit::test
