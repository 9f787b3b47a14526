#include "mesh/mesh_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/scalars.hpp"

namespace surehit::test::mesh_blocks_test {
namespace {

template <typename Scalar>
class MeshBlocksTest : public testing::Test {
 protected:
  static Grid grid_of(const GeneratedMesh<Scalar>& mesh, const GridOptions& options) {
    return Grid(mesh.view(), box_of(mesh.view()), options);
  }

  /// Every list has the corners of its triangles, and the size of their longest edge before them.
  static void expect_copies(const GeneratedMesh<Scalar>& mesh, const Grid& grid, const MeshBlocks<Scalar>& blocks) {
    for (const LeafCell& leaf : LeafCells(grid)) {
      if (leaf.word.is_empty()) continue;
      const auto ids = grid.triangles(leaf.word);
      const Scalar* block = blocks.block(leaf.word.list(), grid.first_entry(leaf.word));
      Scalar edge_size = 0;
      for (std::size_t i = 0; i < ids.size(); ++i) {
        const Triangle<Scalar> copied = MeshBlocks<Scalar>::triangle(blocks.corners(block), ids.size(), i);
        const Triangle<Scalar> given = mesh.view().triangle(ids[i]);
        EXPECT_EQ(copied.a, given.a) << i << " of " << ids.size();
        EXPECT_EQ(copied.b, given.b) << i << " of " << ids.size();
        EXPECT_EQ(copied.c, given.c) << i << " of " << ids.size();
        for (const Vector3<Scalar>& edge : {Vector3<Scalar>(given.b - given.a), Vector3<Scalar>(given.c - given.a)}) {
          edge_size = std::max(edge_size, edge.cwiseAbs().maxCoeff());
        }
      }
      EXPECT_EQ(blocks.edge_size(block), edge_size);
      expect_octet_boxes(MeshBlocks<Scalar>::corners(block), ids.size(),
                         blocks.octet_boxes(grid.first_entry(leaf.word), ids.size()));
    }
  }

  /// The boxes of a list's octets are exact, if there are any. The last one has the triangles after it too.
  static void expect_octet_boxes(const Scalar* corners, std::size_t count, const Scalar* boxes) {
    constexpr std::size_t octet = MeshBlocks<Scalar>::octet;
    const bool is_long = std::is_same_v<Scalar, float> && count >= 4 * octet;
    ASSERT_EQ(boxes != nullptr, is_long) << count;
    if (!is_long) return;
    const std::size_t box_count = count / octet;
    for (std::size_t i = 0; i < box_count; ++i) {
      Box<Scalar> box;
      const std::size_t end = i + 1 == box_count ? count : octet * (i + 1);
      for (std::size_t k = octet * i; k < end; ++k) {
        const Triangle<Scalar> triangle = MeshBlocks<Scalar>::triangle(corners, count, k);
        for (const auto* corner : {&triangle.a, &triangle.b, &triangle.c}) box.extend(*corner);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(boxes[axis * box_count + i], box.low[static_cast<Eigen::Index>(axis)]) << i << " of " << box_count;
        EXPECT_EQ(boxes[(3 + axis) * box_count + i], box.high[static_cast<Eigen::Index>(axis)]) << i;
      }
    }
  }

  /// What a path meets of a triangle in a list's box, it meets in its slab.
  static void expect_slabs_hold(const GeneratedMesh<Scalar>& mesh, const Grid& grid, const MeshBlocks<Scalar>& blocks) {
    if (!blocks.has_slabs()) return;
    for (const LeafCell& leaf : LeafCells(grid)) {
      if (leaf.word.is_empty()) continue;
      const ExactSlab slab = leaf.placed(blocks.slab(leaf.word));
      const ExactBox box = leaf.listed_box(grid).grown(growth_by(grid.frame(), GridFrame::padding_share / 2));
      for (const std::uint32_t id : grid.triangles(leaf.word)) {
        for (const ExactPoint& corner : part_in(box, in_frame(grid.frame(), mesh.view().triangle(id)))) {
          EXPECT_LE(slab.low, slab.height_of(corner)) << id;
          EXPECT_GE(slab.high, slab.height_of(corner)) << id;
        }
      }
    }
  }
};
TYPED_TEST_SUITE(MeshBlocksTest, Scalars, ScalarNames);

TYPED_TEST(MeshBlocksTest, copies_lists_of_every_length) {
  Random random(5);
  for (std::size_t count = 1; count <= 40; ++count) {
    const auto mesh = scattered_triangles<TypeParam>(count, TypeParam{1}, random);
    const Grid grid = this->grid_of(mesh, {.resolution = {1, 1, 1}, .crowded = 0});
    ASSERT_EQ(grid.entry_count(), count);
    this->expect_copies(mesh, grid, MeshBlocks<TypeParam>(mesh.view(), grid));
  }
}

TYPED_TEST(MeshBlocksTest, copies_the_lists_of_all_cells) {
  Random random(6);
  const auto mesh = scattered_triangles<TypeParam>(2000, TypeParam(0.3), random);
  for (const std::uint32_t crowded : {0U, 8U}) {
    const Grid grid = this->grid_of(mesh, {.crowded = crowded});
    EXPECT_EQ(grid.levels() != 0, crowded != 0);
    this->expect_copies(mesh, grid, MeshBlocks<TypeParam>(mesh.view(), grid));
  }
}

TYPED_TEST(MeshBlocksTest, copies_another_mesh_into_the_same_memory) {
  Random random(7);
  MeshBlocks<TypeParam> blocks;
  for (const std::size_t count : {500U, 20U, 900U, 1U}) {
    const auto mesh = scattered_triangles<TypeParam>(count, TypeParam(0.2), random);
    const Grid grid = this->grid_of(mesh, {});
    MeshBlocks<TypeParam> old(mesh.view(), grid);
    blocks.rebuild(old, mesh.view().vertices(), grid);
    EXPECT_EQ(blocks.triangle_count(), count);
    this->expect_copies(mesh, grid, blocks);
  }
}

TYPED_TEST(MeshBlocksTest, takes_over_the_triangles_of_a_mesh_that_moves) {
  Random random(8);
  auto mesh = scattered_triangles<TypeParam>(300, TypeParam(0.2), random);
  MeshBlocks<TypeParam> blocks(mesh.view(), this->grid_of(mesh, {}));
  MeshBlocks<TypeParam> spare;
  for (int move = 0; move < 3; ++move) {
    for (auto& vertex : mesh.vertices) vertex *= TypeParam(1.5);
    const Grid grid = this->grid_of(mesh, {});
    spare.rebuild(blocks, mesh.view().vertices(), grid);
    std::swap(spare, blocks);
    ASSERT_EQ(blocks.triangle_count(), 300U);
    EXPECT_EQ(blocks.triangle(299).c, mesh.view().triangle(299).c);
    this->expect_copies(mesh, grid, blocks);
  }
}

/// In float; a bowl is smooth however it is placed, and triangles that are scattered are not.
TYPED_TEST(MeshBlocksTest, has_slabs_of_smooth_meshes_only) {
  Random random(10);
  const auto bowl = smooth_bowl<TypeParam>(30);
  for (const GridOptions& options : {GridOptions{}, GridOptions{.resolution = {9, 7, 8}, .crowded = 20}}) {
    for (const auto& mesh : {bowl, placed<TypeParam>(bowl, TypeParam(0.01), {3, -2, 1})}) {
      const Grid grid = this->grid_of(mesh, options);
      const MeshBlocks<TypeParam> blocks(mesh.view(), grid);
      ASSERT_EQ(blocks.has_slabs(), (std::is_same_v<TypeParam, float>));
      this->expect_slabs_hold(mesh, grid, blocks);
    }
  }
  for (const auto& mesh : {scattered_triangles<TypeParam>(2000, TypeParam(0.3), random), lattice_cube<TypeParam>(9),
                           rough_ground<TypeParam>(30, TypeParam(0.1), random)}) {
    EXPECT_FALSE(MeshBlocks<TypeParam>(mesh.view(), this->grid_of(mesh, {})).has_slabs());
  }
}

/// Most lists have one triangle, which fits any slab. Where there are two, they cross.
TYPED_TEST(MeshBlocksTest, has_no_slabs_where_triangles_are_alone) {
  Random random(11);
  const auto mesh = scattered_triangles<TypeParam>(40, TypeParam(0.7), random);
  const Grid grid = this->grid_of(mesh, {.resolution = {40, 40, 40}});
  std::size_t alone = 0;
  std::size_t together = 0;
  for (std::size_t list = 0; list + 1 < grid.lists().size(); ++list) {
    const CellWord word = CellWord::listing(static_cast<std::uint32_t>(list));
    (grid.entry_count(word) == 1 ? alone : together) += 1;
  }
  ASSERT_GT(alone, 4 * together);
  EXPECT_FALSE(MeshBlocks<TypeParam>(mesh.view(), grid).has_slabs());
}

TYPED_TEST(MeshBlocksTest, has_no_slabs_once_the_mesh_moves) {
  auto mesh = smooth_bowl<TypeParam>(30);
  MeshBlocks<TypeParam> blocks(mesh.view(), this->grid_of(mesh, {}));
  ASSERT_EQ(blocks.has_slabs(), (std::is_same_v<TypeParam, float>));
  MeshBlocks<TypeParam> spare;
  for (int move = 0; move < 3; ++move) {
    for (auto& vertex : mesh.vertices) vertex[2] = -vertex[2];
    const Grid grid = this->grid_of(mesh, {});
    spare.rebuild(blocks, mesh.view().vertices(), grid);
    std::swap(spare, blocks);
    EXPECT_FALSE(blocks.has_slabs()) << move;
    EXPECT_EQ(blocks.slabs(), nullptr) << move;
    this->expect_copies(mesh, grid, blocks);
  }
}

/// The grid has more lists and cells than one task.
TYPED_TEST(MeshBlocksTest, is_the_same_with_an_executor) {
  const auto mesh = smooth_bowl<TypeParam>(90);
  const Grid grid = this->grid_of(mesh, {.resolution = {60, 60, 60}});
  ASSERT_GT(grid.lists().size(), 1U << 12);
  ASSERT_GT(grid.top().size(), 1U << 14);
  std::size_t tasks = 0;
  const auto backward = [&](std::size_t count, const Executor::Task& task) {
    for (std::size_t i = count; i > 0; --i) task(i - 1);
    tasks += count;
  };
  const Executor executor(backward);
  const MeshBlocks<TypeParam> blocks(mesh.view(), grid, &executor);
  EXPECT_GT(tasks, 1U);
  const MeshBlocks<TypeParam> expected(mesh.view(), grid);
  ASSERT_EQ(blocks.has_slabs(), expected.has_slabs());
  EXPECT_EQ(blocks.has_slabs(), (std::is_same_v<TypeParam, float>));
  this->expect_copies(mesh, grid, blocks);
  if (!blocks.has_slabs()) return;
  for (std::size_t list = 0; list + 1 < grid.lists().size(); ++list) {
    EXPECT_EQ(blocks.slabs()[list].bits(), expected.slabs()[list].bits()) << list;
  }
}

TYPED_TEST(MeshBlocksTest, numbers_vertices_in_sixteen_bits_where_that_is_enough) {
  Random random(9);
  const std::size_t count = 100;
  const auto drawn = scattered_triangles<TypeParam>(count, TypeParam(0.2), random);
  std::size_t memory_before = 0;
  for (const std::size_t vertex_count : {65536U, 65537U}) {
    // The mesh has this many vertices. Those of the triangles are the last ones.
    const auto skipped = static_cast<std::uint32_t>(vertex_count - drawn.vertices.size());
    GeneratedMesh<TypeParam> mesh = drawn;
    mesh.vertices.insert(mesh.vertices.begin(), skipped, Vector3<TypeParam>::Zero());
    for (auto& corners : mesh.triangles) {
      for (auto& corner : corners) corner += skipped;
    }
    const Grid grid = this->grid_of(mesh, {});
    MeshBlocks<TypeParam> blocks(mesh.view(), grid);
    this->expect_copies(mesh, grid, blocks);
    EXPECT_EQ(blocks.triangle(count - 1).c, mesh.vertices.back());
    EXPECT_EQ(blocks.view().corner(count - 1, 2), vertex_count - 1);
    const std::size_t memory = blocks.memory_bytes();
    if (memory_before != 0) {
      EXPECT_EQ(memory - memory_before, sizeof(Vector3<TypeParam>) + 6 * count);
    }
    memory_before = memory;
    MeshBlocks<TypeParam> moved;
    moved.rebuild(blocks, mesh.view().vertices(), grid);
    this->expect_copies(mesh, grid, moved);
    EXPECT_EQ(moved.view().corner(count - 1, 2), vertex_count - 1);
  }
}

/// The first corners may be half as large as the kernel's bound allows, and the edges as large. Beyond, its bounds are
/// made infinite, for this list alone.
TYPED_TEST(MeshBlocksTest, says_that_coordinates_are_too_large_for_the_kernel) {
  constexpr TypeParam infinity = std::numeric_limits<TypeParam>::infinity();
  const TypeParam max_corner = std::ldexp(TypeParam{1}, sizeof(TypeParam) == sizeof(float) ? 33 : 299);
  const auto expect_edge_size = [&](const Triangle<TypeParam>& triangle, TypeParam expected) {
    GeneratedMesh<TypeParam> mesh;
    mesh.add(triangle);
    const Grid grid = this->grid_of(mesh, {.resolution = {1, 1, 1}});
    const MeshBlocks<TypeParam> blocks(mesh.view(), grid);
    const TypeParam* block = blocks.block(grid.top()[0].list(), grid.first_entry(grid.top()[0]));
    EXPECT_EQ(blocks.edge_size(block), expected);
  };
  for (const bool too_large : {false, true}) {
    const auto beyond = [&](TypeParam limit) { return too_large ? std::nextafter(limit, infinity) : limit; };
    const TypeParam far = beyond(max_corner);
    expect_edge_size({{0, -far, 0}, {1, -far, 0}, {0, -far, 1}}, too_large ? infinity : 1);
    const TypeParam edge = beyond(2 * max_corner);
    expect_edge_size({{0, 0, 0}, {1, 0, 0}, {0, -edge, 0}}, too_large ? infinity : edge);
  }
}

TYPED_TEST(MeshBlocksTest, bounds_lists_beside_a_triangle_that_is_too_large) {
  const TypeParam huge = std::numeric_limits<TypeParam>::max() / 4;
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  mesh.add({{huge, huge, huge}, {huge, huge / 2, huge}, {huge, huge, huge / 2}});
  const Grid grid = this->grid_of(mesh, {.resolution = {4, 4, 4}});
  const MeshBlocks<TypeParam> blocks(mesh.view(), grid);
  std::size_t bounded = 0;
  for (const CellWord word : grid.top()) {
    if (word.is_empty()) continue;
    const TypeParam size = blocks.edge_size(blocks.block(word.list(), grid.first_entry(word)));
    const auto ids = grid.triangles(word);
    const bool has_huge = std::find(ids.begin(), ids.end(), 1U) != ids.end();
    EXPECT_EQ(size, has_huge ? std::numeric_limits<TypeParam>::infinity() : 1);
    bounded += !has_huge;
  }
  EXPECT_GT(bounded, 0U);
}

}  // namespace
}  // namespace surehit::test::mesh_blocks_test
