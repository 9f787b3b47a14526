#pragma once

#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

#include "c_functions.hpp"
#include "c_values.hpp"
#include "support/scene_drawer.hpp"

namespace surehit::test {

/// A drawn scene in C. Its instances have the ids of the same scene in C++.
template <typename Scalar>
class CSceneOf {
 public:
  using C = CFunctions<Scalar>;

  explicit CSceneOf(const DrawnScene<Scalar>& drawn) {
    EXPECT_EQ(C::create_scene(&handle), SUREHIT_OK);
    for (const auto& [index, placement] : drawn.instances) {
      const DrawnMesh& mesh = drawn.meshes[index];
      surehit_instance_id id = {};
      const auto pose = in_c(placement.pose);
      if constexpr (std::is_same_v<Scalar, double>) {
        if (mesh.is_float) {
          auto* const collider = made<float>(mesh);
          EXPECT_EQ(surehit_scened_add_colliderf(handle, collider, &pose, placement.mask, ids.size(), &id), SUREHIT_OK);
          EXPECT_EQ(surehit_colliderf_destroy(collider), SUREHIT_OK);
        }
      }
      if (std::is_same_v<Scalar, float> || !mesh.is_float) {
        auto* const collider = made<Scalar>(mesh);
        EXPECT_EQ(C::add(handle, collider, &pose, placement.mask, ids.size(), &id), SUREHIT_OK);
        EXPECT_EQ(C::destroy(collider), SUREHIT_OK);  // The scene keeps it.
      }
      const auto motion = in_c(placement.motion);
      EXPECT_EQ(C::set_motion(handle, id, &motion), SUREHIT_OK);
      ids.push_back(id);
    }
    EXPECT_EQ(C::commit(handle, nullptr), SUREHIT_OK);
  }
  ~CSceneOf() { EXPECT_EQ(C::destroy_scene(handle), SUREHIT_OK); }
  CSceneOf(const CSceneOf&) = delete;
  CSceneOf& operator=(const CSceneOf&) = delete;

  typename C::SceneHandle* handle = nullptr;
  std::vector<surehit_instance_id> ids;

 private:
  static typename C::Pose in_c(const Pose<Scalar>& pose) {
    return {test::in_c(Vector3<Scalar>(pose.linear.col(0))), test::in_c(Vector3<Scalar>(pose.linear.col(1))),
            test::in_c(Vector3<Scalar>(pose.linear.col(2))), test::in_c(pose.translation)};
  }
  static typename C::Vector in_c(const Vector3<Scalar>& x) { return test::in_c(x); }

  template <typename MeshScalar>
  static auto* made(const DrawnMesh& mesh) {
    std::vector<MeshScalar> numbers;
    for (const auto& vertex : mesh.vertices) {
      for (const double x : vertex) numbers.push_back(static_cast<MeshScalar>(x));
    }
    const typename CFunctions<MeshScalar>::Mesh given = {
        numbers.data(), numbers.size() / 3, 0, mesh.triangles.data(), mesh.triangles.size(), 0, 4};
    surehit_build_options options = {};
    options.size = sizeof options;
    options.masks = mesh.masks.data();
    options.mask_count = mesh.masks.size();
    typename CFunctions<MeshScalar>::ColliderHandle* collider = nullptr;
    EXPECT_EQ(CFunctions<MeshScalar>::create(&given, &options, &collider), SUREHIT_OK) << surehit_last_error();
    return collider;
  }
};

}  // namespace surehit::test
