#include "support/instruction_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "collider_state.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::instruction_sets_test {
namespace {

/// All answers to some paths, single and in batches.
template <typename Scalar>
struct Answers {
  std::vector<Hit<Scalar>> first;  ///< a miss has no triangle
  std::vector<std::uint8_t> any;
  std::vector<std::vector<Hit<Scalar>>> all;
  std::vector<Hit<Scalar>> batch_first;
  std::vector<std::uint8_t> batch_any;

  template <typename AnyPath>
  Answers(const Collider<Scalar>& collider, const std::vector<AnyPath>& paths, const QueryOptions<Scalar>& options)
      : all(paths.size()), batch_first(paths.size()), batch_any(paths.size()) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      first.push_back(collider.first_hit(paths[i], options).value_or(Hit<Scalar>{}));
      any.push_back(collider.any_hit(paths[i], options) ? 1 : 0);
      collider.all_hits(paths[i], all[i], options);
    }
    collider.first_hits(paths, batch_first, {.options = options});
    collider.any_hits(paths, batch_any, {.options = options});
  }

  [[nodiscard]] std::size_t hit_count() const {
    return static_cast<std::size_t>(std::count(any.begin(), any.end(), std::uint8_t{1}));
  }

  template <typename AnyPath>
  void expect_same(const Answers& other, const std::vector<AnyPath>& paths) const {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      SCOPED_TRACE(hex_text(Path<Scalar>(paths[i])));
      EXPECT_TRUE(same_bits(first[i], other.first[i])) << hex_text(first[i]) << " or " << hex_text(other.first[i]);
      EXPECT_TRUE(same_bits(batch_first[i], other.first[i]))
          << hex_text(batch_first[i]) << " or " << hex_text(other.first[i]);
      EXPECT_EQ(any[i], other.any[i]);
      EXPECT_EQ(batch_any[i], other.any[i]);
      ASSERT_EQ(all[i].size(), other.all[i].size());
      for (std::size_t k = 0; k < all[i].size(); ++k) EXPECT_TRUE(same_bits(all[i][k], other.all[i][k]));
    }
  }
};

template <typename Scalar>
class InstructionSets : public testing::Test {
 protected:
  void expect_same_answers(const GeneratedMesh<Scalar>& mesh, std::size_t paths) {
    for (const GridOptions& grid : {GridOptions{}, GridOptions{.resolution = {3, 4, 2}, .crowded = 3}}) {
      const Collider<Scalar> collider(mesh.view(), BuildOptions{grid, {}});
      PathDrawer<Scalar> drawer(mesh.view(), 17);
      std::vector<Segment<Scalar>> segments;
      std::vector<Ray<Scalar>> rays;
      std::vector<Line<Scalar>> lines;
      for (std::size_t i = case_count(paths); i > 0; --i) {
        for (Path<Scalar> path : {drawer.draw(), drawer.draw_axis_parallel(), drawer.draw_from_afar(Scalar{1e6F})}) {
          segments.push_back({path.start, path.toward});
          const Vector3<Scalar> direction = path.has_end() ? Vector3<Scalar>(path.toward - path.start) : path.toward;
          rays.push_back({path.start, direction});
          lines.push_back({path.start, direction});
        }
      }
      expect_same_answers(collider, segments, {});
      expect_same_answers(collider, rays, {});
      expect_same_answers(collider, lines, {});
      expect_same_answers(collider, segments, draw_options(drawer.random(), Scalar{0.5F}));
      expect_same_answers(collider, rays, {.max_t = Scalar{0.75F}, .culling = Culling::back});
    }
    EXPECT_GT(hits_, 0U);
  }

  template <typename AnyPath>
  void expect_same_answers(const Collider<Scalar>& collider, const std::vector<AnyPath>& paths,
                           const QueryOptions<Scalar>& options) {
    const Answers<Scalar> best(collider, paths, options);
    hits_ += best.hit_count();
    best.expect_same(best, paths);
    for (const std::int64_t target : instruction_sets()) {
      const ForcedInstructionSet forced(target);
      const Collider<Scalar> forced_collider(collider);  // A copy chooses its instruction set again.
      SCOPED_TRACE(name_of_instruction_set(target));
      Answers<Scalar>(forced_collider, paths, options).expect_same(best, paths);
    }
  }

  Random random_{20240229};
  std::size_t hits_ = 0;
};
TYPED_TEST_SUITE(InstructionSets, Scalars, ScalarNames);

TYPED_TEST(InstructionSets, are_chosen_when_a_collider_is_made_or_copied) {
  using State = detail::ColliderState<TypeParam>;
  const auto mesh = scattered_triangles<TypeParam>(2, TypeParam{0.5F}, this->random_);
  const Collider<TypeParam> best(mesh.view());
  std::set<const detail::Searches<TypeParam>*> searches;
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    const Collider<TypeParam> made(mesh.view());
    const Collider<TypeParam> copied(best);
    EXPECT_EQ(State::of(made).searches, State::of(copied).searches);
    searches.insert(State::of(made).searches);
  }
  // The library may have no code for some of them, and uses that of others then.
  EXPECT_EQ(searches.size() > 1, instruction_sets().size() > 1);
  EXPECT_EQ(State::of(best).searches, State::of(Collider<TypeParam>(mesh.view())).searches);
}

TYPED_TEST(InstructionSets, answer_alike_on_scattered_triangles) {
  this->expect_same_answers(scattered_triangles<TypeParam>(500, 0.2F, this->random_), 200);
}

TYPED_TEST(InstructionSets, answer_alike_on_rough_ground) {
  const auto ground = rough_ground<TypeParam>(20, 0.1F, this->random_);
  this->expect_same_answers(with_small_copy(ground, {0.3F, -0.2F, 0.1F}), 200);
}

TYPED_TEST(InstructionSets, answer_alike_on_a_smooth_surface) {
  this->expect_same_answers(smooth_bowl<TypeParam>(20), 200);
}

TYPED_TEST(InstructionSets, answer_alike_on_vertices_and_edges_of_a_lattice) {
  this->expect_same_answers(lattice_cube<TypeParam>(6), 200);
}

TYPED_TEST(InstructionSets, answer_alike_on_flat_meshes) {
  this->expect_same_answers(
      flattened<TypeParam>(scattered_triangles<TypeParam>(200, 0.3F, this->random_), 1, TypeParam{3}), 100);
}

TYPED_TEST(InstructionSets, answer_alike_on_a_prop_in_a_level) {
  const auto level = rough_ground<TypeParam>(6, 0.3F, this->random_);
  const auto prop = scattered_triangles<TypeParam>(400, 0.2F, this->random_);
  const auto mesh = joined(level, placed<TypeParam>(prop, 1e-3F, {0.31F, 0.27F, 0.1F}));
  const Collider<TypeParam> collider(mesh.view());
  EXPECT_FALSE(detail::ColliderState<TypeParam>::of(collider).grid.inner_frames().empty());
  this->expect_same_answers(mesh, 200);
}

TYPED_TEST(InstructionSets, answer_alike_on_a_main_part_and_a_stray_triangle) {
  auto mesh = rough_ground<TypeParam>(20, 0.3F, this->random_);
  mesh.add({{1000, 1000, 1000}, {1500, 1000, 1000}, {1000, 1500, 1000}});
  const Collider<TypeParam> collider(mesh.view());
  EXPECT_EQ(detail::ColliderState<TypeParam>::of(collider).grid.inner_frames().size(), 1U);
  this->expect_same_answers(mesh, 200);
}

TYPED_TEST(InstructionSets, answer_alike_far_from_the_origin) {
  const auto ground = rough_ground<TypeParam>(12, 0.3F, this->random_);
  this->expect_same_answers(placed<TypeParam>(ground, 100, {1e7F, -1e7F, 1e7F}), 100);
}

}  // namespace
}  // namespace surehit::test::instruction_sets_test
