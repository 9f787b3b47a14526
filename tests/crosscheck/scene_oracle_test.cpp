#include "support/scene_oracle.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "collision/unit_triangles.hpp"
#include "support/case_count.hpp"
#include "support/exact_mesh_oracle.hpp"
#include "support/exact_oracle.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/small_meshes.hpp"

namespace surehit::test::scene_oracle_test {
namespace {

const GeneratedMesh<double> floor_mesh = stack_of_triangles<double>(1);
constexpr InstanceId id_0{0, 0};
constexpr InstanceId id_1{1, 4};

Placement<double> moved_by(const Vector3d& motion) { return {{}, motion}; }
Placement<double> placed_by(const Eigen::Matrix3d& linear, const Vector3d& translation = Vector3d::Zero()) {
  return {{linear, translation}};
}

SceneOracle<double> oracle_of(const Placement<double>& placement) {
  SceneOracle<double> oracle;
  oracle.add(id_0, floor_mesh.view(), {}, placement);
  return oracle;
}

void expect_hit(const SceneOracle<double>& oracle, const Pathd& path, const Hitd& expected) {
  const auto hits = oracle.all_hits(path);
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_TRUE(same_bits(hits[0], SceneHitd{expected, id_0})) << hex_text(hits[0]);
}

TEST(SceneOracle, sees_the_image_of_a_corner) {
  Eigen::Matrix3d linear;
  linear << 0, -2, 0, 2, 0, 0, 0, 0, 1;
  const auto oracle = oracle_of(placed_by(linear, {10, 20, 30}));
  const Triangled image = oracle.triangle(id_0, 0);
  EXPECT_EQ(image.a, Vector3d(10, 20, 30));
  EXPECT_EQ(image.b, Vector3d(10, 22, 30));
  EXPECT_EQ(image.c, Vector3d(8, 20, 30));
  expect_hit(oracle, Segmentd{{9.5, 20.5, 31}, {9.5, 20.5, 27}}, {0.25, 0.25, 0.25, 0, Side::front});
}

TEST(SceneOracle, sees_corners_that_no_number_is) {
  // The floor is at 2^60 + 1, halfway between two ends of paths that differ by 256.
  const double far = 0x1p60;
  SceneOracle<double> oracle;
  const GeneratedMesh<double> mesh = stack_of_triangles<double>(2);
  oracle.add(id_0, mesh.view(), {}, placed_by(Eigen::Matrix3d::Identity(), {0, 0, far}));
  const auto hits = oracle.all_hits(Segmentd{{0, 0, far - 128}, {0, 0, far + 256}});
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_EQ(hits[0].t, nearest<double>(mpq_class(128, 384)));
  EXPECT_EQ(hits[1].t, nearest<double>(mpq_class(129, 384)));
  EXPECT_EQ(oracle.triangle(id_0, 1).a[2], far);
}

TEST(SceneOracle, mirrored_triangle_shows_its_other_side) {
  const auto oracle = oracle_of(placed_by(Vector3d(1, -1, 1).asDiagonal().toDenseMatrix()));
  expect_hit(oracle, Segmentd{{0.25, -0.25, 1}, {0.25, -0.25, -1}}, {0.5, 0.25, 0.25, 0, Side::back});
}

TEST(SceneOracle, instance_moves_while_a_segment_is_on_its_way) {
  // Up by 3, while the point goes down by 1: they meet after a quarter.
  const auto rising = oracle_of(moved_by({0, 0, 3}));
  expect_hit(rising, Segmentd{{0.25, 0.25, 1}, {0.25, 0.25, 0}}, {0.25, 0.25, 0.25, 0, Side::front});
  // A point that is overtaken from below is met from the front.
  expect_hit(rising, Segmentd{{0.25, 0.25, 1}, {0.25, 0.25, 2}}, {0.5, 0.25, 0.25, 0, Side::front});
  // One that keeps its distance is not met, and one that lies on the floor is met at once.
  EXPECT_TRUE(rising.all_hits(Segmentd{{0.25, 0.25, 1}, {0.25, 0.25, 4}}).empty());
  expect_hit(rising, Segmentd{{0.25, 0.25, 0}, {0.25, 0.25, 3}}, {0, 0.25, 0.25, 0, Side::edge_on});
}

TEST(SceneOracle, rays_and_lines_see_the_instance_at_its_pose) {
  const auto rising = oracle_of(moved_by({0, 0, 3}));
  expect_hit(rising, Rayd{{0.25, 0.25, 1}, {0, 0, -1}}, {1, 0.25, 0.25, 0, Side::front});
  expect_hit(rising, Lined{{0.25, 0.25, 1}, {0, 0, 1}}, {-1, 0.25, 0.25, 0, Side::back});
}

TEST(SceneOracle, ties_go_by_instance_and_then_by_triangle) {
  SceneOracle<double> oracle;
  GeneratedMesh<double> twice = stack_of_triangles<double>(1);
  twice.add(unit_triangle<double>());
  oracle.add(id_1, twice.view(), {}, {});
  oracle.add(id_0, twice.view(), {}, {});
  const auto hits = oracle.all_hits(Segmentd{{0, 0, 1}, {0, 0, -1}});
  ASSERT_EQ(hits.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(hits[i].instance, i < 2 ? id_0 : id_1);
    EXPECT_EQ(hits[i].triangle, i % 2);
  }
}

TEST(SceneOracle, leaves_out_what_options_leave_out) {
  SceneOracle<double> oracle;
  const GeneratedMesh<double> stack = stack_of_triangles<double>(2);
  const std::vector<std::uint32_t> masks = {1, 2};
  oracle.add(id_0, stack.view(), masks, {.mask = 1});
  oracle.add(id_1, stack.view(), masks, {.mask = 2});
  const Segmentd across{{0, 0, -1}, {0, 0, 3}};
  const auto count = [&](const SceneQueryOptionsd& options) { return oracle.all_hits(across, options).size(); };
  EXPECT_EQ(count({}), 4U);
  EXPECT_EQ(count({.mask = 1}), 2U);
  EXPECT_EQ(count({.instance_mask = 2}), 2U);
  EXPECT_EQ(count({.mask = 2, .instance_mask = 1}), 1U);
  EXPECT_EQ(count({.ignored_instance = id_1}), 2U);
  EXPECT_EQ(count({.ignored_instance = {1, 3}}), 4U);
  EXPECT_EQ(count({.ignored_instance = id_1, .ignored_triangle = 0}), 3U);
  EXPECT_EQ(count({.ignored_triangle = 0}), 4U);
  EXPECT_EQ(count({.max_t = 0.25}), 2U);
  EXPECT_EQ(count({.culling = Culling::back}), 0U);
}

TEST(SceneOracle, ends_of_a_segment_are_where_the_instance_then_is) {
  const auto rising = oracle_of(moved_by({0, 0, 3}));
  const SceneQueryOptionsd ignoring{.ignore_end_contact = true};
  EXPECT_TRUE(rising.all_hits(Segmentd{{0.25, 0.25, 5}, {0.25, 0.25, 3}}, ignoring).empty());
  EXPECT_EQ(rising.all_hits(Segmentd{{0.25, 0.25, 1}, {0.25, 0.25, 0}}, ignoring).size(), 1U);
}

TEST(SceneOracle, last_free_point_is_in_front_of_where_the_instance_is_by_then) {
  const auto rising = oracle_of(moved_by({0, 0, 1}));
  const Segmentd down{{0.25, 0.25, 1}, {0.25, 0.25, 0}};
  const auto hits = rising.all_hits(down);
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_EQ(hits[0].t, 0.5);
  EXPECT_EQ(rising.last_free_point(down, hits[0])[2], 0.5 + 0x1p-53);
}

/// The oracle of pairs has its own corners, and is crosschecked with CGAL.
TEST(SceneOracle, is_that_of_a_mesh_where_nothing_is_placed_or_moves) {
  Random random(11);
  for (std::size_t i = case_count(300); i > 0; --i) {
    const auto mesh = draw_small_mesh<double>(random.below(small_mesh_kind_count), random);
    const ExactMeshOracle<double> mesh_oracle(mesh.view(), {});
    SceneOracle<double> oracle;
    oracle.add(id_0, mesh.view(), {}, {});
    for (const Pathd& path : mesh.paths) {
      const QueryOptionsd drawn = draw_options(random, random.unit<double>());
      const SceneQueryOptionsd options{.min_t = drawn.min_t,
                                       .max_t = drawn.max_t,
                                       .culling = drawn.culling,
                                       .ignore_start_contact = drawn.ignore_start_contact,
                                       .ignore_end_contact = drawn.ignore_end_contact};
      const auto hits = oracle.all_hits(path, options);
      const auto expected = mesh_oracle.all_hits(path, drawn);
      ASSERT_EQ(hits.size(), expected.size()) << hex_text(path);
      for (std::size_t hit = 0; hit < hits.size(); ++hit) {
        ASSERT_TRUE(same_bits<double>(static_cast<const Hitd&>(hits[hit]), expected[hit])) << hex_text(path);
      }
      if (hits.empty() || path.kind != PathKind::segment) continue;
      const Segmentd segment{path.start, path.toward};
      ASSERT_EQ(oracle.last_free_point(segment, hits[0], options),
                mesh_oracle.last_free_point(segment, expected[0], drawn));
    }
  }
}

TEST(SceneOracle, determinant_is_exact) {
  Posed pose;
  pose.linear << 1 + 0x1p-40, 1, 0, 1, 1 - 0x1p-40, 0, 0, 0, 1;
  mpq_class expected = -1;
  expected >>= 80;
  EXPECT_EQ(exact_determinant(pose), expected);
}

}  // namespace
}  // namespace surehit::test::scene_oracle_test
