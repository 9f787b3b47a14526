#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "collider_state.hpp"
#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/sphere_contact.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "surehit/collider.hpp"
#include "walk/swept_lanes.hpp"

namespace surehit::test {

/// All kinds of moving shapes, for typed tests.
using MovingShapes = testing::Types<SweptSphere<float>, SweptSphere<double>, SweptBox<float>, SweptBox<double>,
                                    SweptCapsule<float>, SweptCapsule<double>>;

template <typename Shape>
using ScalarOfShape = typename decltype(Shape::start)::Scalar;

struct MovingShapeNames {
  template <typename Shape>
  static std::string GetName(int) {
    using Scalar = ScalarOfShape<Shape>;
    const std::string shape = std::is_same_v<Shape, SweptSphere<Scalar>> ? "sphere"
                              : std::is_same_v<Shape, SweptBox<Scalar>>  ? "box"
                                                                         : "capsule";
    return shape + (sizeof(Scalar) == 4 ? "_float" : "_double");
  }
};

/// Returns a shape that reaches `size` up and down from its centre.
template <typename Shape, typename Scalar>
[[nodiscard]] Shape shape_of_size(const Vector3<Scalar>& start, const Vector3<Scalar>& end, Scalar size) {
  if constexpr (std::is_same_v<Shape, SweptSphere<Scalar>>) {
    return {start, end, size};
  } else if constexpr (std::is_same_v<Shape, SweptBox<Scalar>>) {
    return {start, end, {size / 2, size, size}};
  } else {
    return {start, end, {size / 2, size / 4, 0}, size};
  }
}

/// A ground with a copy of itself that is 24 times smaller. Its grid has divided cells, and inner grids.
template <typename Scalar>
struct CrowdedGround {
  CrowdedGround() {
    Random random(20261128);
    const Scalar height = Scalar(0.2);
    const GeneratedMesh<Scalar> ground = rough_ground<Scalar>(16, height, random);
    mesh = with_small_copy(ground, {Scalar(0.3), 0, height});
  }

  [[nodiscard]] static BuildOptions options() { return {.grid = {.resolution = {4, 4, 1}, .crowded = 8}}; }
  [[nodiscard]] static bool has_crowded_cells_and_inner_grids(const Collider<Scalar>& collider) {
    const Grid& grid = detail::ColliderState<Scalar>::of(collider).grid;
    return grid.levels() > 0 && !grid.inner_frames().empty();
  }
  /// Returns true if a batch walks with the shape in a lane, side by side with others.
  template <typename Shape>
  [[nodiscard]] static bool walks_in_a_lane(const Collider<Scalar>& collider, const Shape& shape) {
    const Grid& grid = detail::ColliderState<Scalar>::of(collider).grid;
    return SweptLanes(grid, nullptr).may_enter(detail::swept_extents(shape).half_extents);
  }

  /// Returns shapes that start at a vertex of the ground or of its copy, or above it, so that they graze it. They go to
  /// another vertex, or far beyond it. Two in three are small enough to walk in lanes.
  template <typename Shape>
  [[nodiscard]] std::vector<Shape> shapes(std::size_t count) const {
    Random random(7);
    std::vector<Shape> result;
    const auto vertex = [&] { return mesh.vertices[random.below(mesh.vertices.size())]; };
    for (std::size_t i = 0; i < count; ++i) {
      const Scalar size = Scalar{i % 3 == 0 ? 0x1p-10F : i % 3 == 1 ? 0.0625F : 1.5F};
      const Vector3<Scalar> up{0, 0, size};
      Vector3<Scalar> start = vertex();
      start += up * static_cast<Scalar>(random.below(3));
      Vector3<Scalar> end = vertex() + up;
      if (random.one_in(8)) end *= 1000;
      result.push_back(shape_of_size<Shape, Scalar>(start, end, size));
    }
    return result;
  }

  GeneratedMesh<Scalar> mesh;
};

}  // namespace surehit::test
