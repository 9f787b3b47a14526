#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "support/grid_breaking_meshes.hpp"
#include "surehit/collider.hpp"

namespace surehit::test {

/// A mesh, and how it is built.
template <typename Scalar>
struct SavedMesh {
  std::string name;
  GeneratedMesh<Scalar> mesh;
  GridOptions grid = {};
  std::vector<std::uint32_t> masks = {};

  [[nodiscard]] Collider<Scalar> collider() const {
    Collider<Scalar> collider;
    if (!collider.try_build(mesh.view(), {grid, masks})) return {};
    return collider;
  }
};

/// Meshes of all kinds: with one cell, with bricks, with inner grids, with slabs, and those that break grids.
template <typename Scalar>
[[nodiscard]] std::vector<SavedMesh<Scalar>> saved_meshes() {
  Random random(71);
  const auto prop = [&](Scalar ratio, const Vector3<Scalar>& offset) {
    return placed<Scalar>(scattered_triangles<Scalar>(150, Scalar{0.4F}, random), 1 / ratio, offset);
  };
  std::vector<SavedMesh<Scalar>> all;
  all.push_back({"nothing", {}});
  GeneratedMesh<Scalar> unused;
  unused.vertices = {{1, 2, 3}, {4, 5, 6}};
  all.push_back({"vertices alone", unused});
  GeneratedMesh<Scalar> one;
  one.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  all.push_back({"one triangle", one});
  GeneratedMesh<Scalar> points;
  for (int i = 0; i < 40; ++i) points.add({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  all.push_back({"points in one place", points});
  all.push_back({"scattered", scattered_triangles<Scalar>(300, Scalar{0.25F}, random)});
  all.push_back({"large triangles", scattered_triangles<Scalar>(60, Scalar{2}, random), {.resolution = {9, 8, 7}}});
  all.push_back({"rough ground", rough_ground<Scalar>(9, Scalar{0.5F}, random)});
  all.push_back({"smooth bowl", smooth_bowl<Scalar>(24)});
  all.push_back({"flat", flattened<Scalar>(rough_ground<Scalar>(9, Scalar{0.5F}, random), 1, Scalar{3})});
  all.push_back({"needles", line_of_needles<Scalar>(50, random)});
  all.push_back({"dust", dust_in_square<Scalar>(300, random)});
  all.push_back({"lattice", lattice_cube<Scalar>(4)});
  all.push_back({"fan", double_fan<Scalar>(8), {.crowded = 4}});
  all.push_back({"far apart", grounds_askew<Scalar>(random)});
  all.push_back({"one cell", scattered_triangles<Scalar>(200, Scalar{0.25F}, random), {{1, 1, 1}, 1, 0}});
  all.push_back({"a level of bricks", scattered_triangles<Scalar>(200, Scalar{0.25F}, random), {{2, 2, 2}, 1, 30}});
  all.push_back({"bricks", scattered_triangles<Scalar>(200, Scalar{0.25F}, random), {{2, 2, 2}, 1, 3}});
  const GeneratedMesh<Scalar> level = placed<Scalar>(rough_ground<Scalar>(6, Scalar{0.3F}, random), 8, {0, 0, 0});
  const GeneratedMesh<Scalar> with_prop = joined<Scalar>(level, prop(500, {1, 1, 1}));
  all.push_back({"prop", with_prop, {.crowded = 30}});
  all.push_back({"prop in bricks", with_prop, {{2, 3, 1}, 1, 12}});
  all.push_back({"prop in a prop",
                 joined<Scalar>(joined<Scalar>(with_prop, prop(Scalar{3e5F}, {1, 1, 1})), prop(50, {-3, 2, 1})),
                 {{1, 1, 1}, 1, 20}});
  all.push_back({"stray", joined<Scalar>(with_prop, prop(1, {Scalar{1e30F}, 0, 0}))});
  all.push_back({"tiny", placed<Scalar>(level, std::numeric_limits<Scalar>::min(), {0, 0, 0})});
  all.push_back({"huge", placed<Scalar>(level, std::numeric_limits<Scalar>::max() / 16, {0, 0, 0})});
  SavedMesh<Scalar> masked{"masks", scattered_triangles<Scalar>(100, Scalar{0.25F}, random)};
  for (std::uint32_t i = 0; i < 100; ++i) masked.masks.push_back(i % 7);
  all.push_back(std::move(masked));
  return all;
}

}  // namespace surehit::test
