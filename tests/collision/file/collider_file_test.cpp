#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "collider_state.hpp"
#include "collision/same_answers.hpp"
#include "support/instruction_sets.hpp"
#include "support/path_drawer.hpp"
#include "support/saved_file.hpp"
#include "support/saved_meshes.hpp"
#include "support/scalars.hpp"
#include "support/threads.hpp"

namespace surehit::test::collider_file_test {
namespace {

using Reason = InvalidFile::Reason;

template <typename Scalar>
class ColliderFile : public testing::Test {
 protected:
  static Collider<Scalar> loaded(const Bytes& bytes, const LoadOptions& options = {}) {
    Collider<Scalar> collider;
    const LoadResult result = collider.try_load(bytes, options);
    EXPECT_TRUE(result) << result.error().what();
    return collider;
  }
};
TYPED_TEST_SUITE(ColliderFile, Scalars, ScalarNames);

TYPED_TEST(ColliderFile, loads_what_was_saved) {
  std::set<std::uint32_t> levels;
  std::size_t inner_grids = 0;
  for (const SavedMesh<TypeParam>& made : saved_meshes<TypeParam>()) {
    SCOPED_TRACE(made.name);
    const Collider<TypeParam> collider = made.collider();
    const Bytes bytes = saved(collider);
    const Collider<TypeParam> loaded = this->loaded(bytes);
    EXPECT_EQ(saved(loaded), bytes);
    EXPECT_EQ(saved(this->loaded(bytes, {.is_trusted = true})), bytes);
    ASSERT_EQ(loaded.triangle_count(), collider.triangle_count());
    EXPECT_EQ(loaded.box().low, collider.box().low);
    EXPECT_EQ(loaded.box().high, collider.box().high);
    EXPECT_EQ(loaded.grid_summary().resolution, collider.grid_summary().resolution);
    EXPECT_EQ(loaded.grid_summary().levels, collider.grid_summary().levels);
    for (std::uint32_t id = 0; id < loaded.triangle_count(); ++id) EXPECT_EQ(loaded.mask(id), collider.mask(id));
    levels.insert(loaded.grid_summary().levels);
    inner_grids += detail::ColliderState<TypeParam>::of(loaded).grid.inner_frames().size();
    if (loaded.triangle_count() == 0) continue;
    PathDrawer<TypeParam> drawer(made.mesh.view(), 73);
    std::vector<Path<TypeParam>> paths;
    for (int i = 0; i < 60; ++i) paths.push_back(drawer.draw());
    expect_same_answers(loaded, collider, paths);
    expect_same_answers(loaded, collider, paths, {.mask = 3});
  }
  EXPECT_EQ(levels.size(), 3U);  // None, one and two.
  EXPECT_GE(inner_grids, 5U);
}

/// A loaded collider is the same inside too, so the same work is done.
TYPED_TEST(ColliderFile, visits_what_was_visited) {
  for (const SavedMesh<TypeParam>& made : saved_meshes<TypeParam>()) {
    if (made.mesh.triangles.empty()) continue;
    SCOPED_TRACE(made.name);
    const Collider<TypeParam> collider = made.collider();
    const Collider<TypeParam> loaded = this->loaded(saved(collider));
    PathDrawer<TypeParam> drawer(made.mesh.view(), 79);
    QueryStatistics statistics;
    QueryStatistics expected;
    for (int i = 0; i < 60; ++i) {
      const Path<TypeParam> path = drawer.draw();
      static_cast<void>(loaded.first_hit(path, {}, &statistics));
      static_cast<void>(collider.first_hit(path, {}, &expected));
    }
    expect_same(statistics, expected);
  }
}

TYPED_TEST(ColliderFile, has_the_same_bytes_on_every_instruction_set) {
  for (const SavedMesh<TypeParam>& made : saved_meshes<TypeParam>()) {
    SCOPED_TRACE(made.name);
    const Bytes bytes = saved(made.collider());
    for (const std::int64_t target : instruction_sets()) {
      SCOPED_TRACE(name_of_instruction_set(target));
      const ForcedInstructionSet forced(target);
      EXPECT_EQ(saved(made.collider()), bytes);
      static_cast<void>(this->loaded(bytes));
    }
  }
}

TYPED_TEST(ColliderFile, has_the_same_bytes_after_a_rebuild) {
  Collider<TypeParam> collider;
  for (const SavedMesh<TypeParam>& made : saved_meshes<TypeParam>()) {
    SCOPED_TRACE(made.name);
    const Bytes bytes = saved(made.collider());
    ASSERT_TRUE(collider.try_rebuild(made.mesh.view(), {made.grid, made.masks}));
    EXPECT_EQ(saved(collider), bytes);
    ASSERT_TRUE(collider.try_rebuild(made.mesh.view().vertices()));
    EXPECT_EQ(saved(collider), bytes);
    Collider<TypeParam> loaded = this->loaded(bytes);
    ASSERT_TRUE(loaded.try_rebuild(made.mesh.view().vertices()));
    EXPECT_EQ(saved(loaded), bytes);
  }
}

/// Wide indices and wide entries, built and loaded with threads and without.
TYPED_TEST(ColliderFile, holds_a_large_mesh) {
  Random random(83);
  const GeneratedMesh<TypeParam> mesh = rough_ground<TypeParam>(257, TypeParam{0.01F}, random);
  const Threads threads(3);
  const Collider<TypeParam> collider(mesh.view());
  const Bytes bytes = saved(collider);
  EXPECT_EQ(ColliderParts(bytes).index_width, 4U);
  EXPECT_EQ(ColliderParts(bytes).entry_width, 3U);
  EXPECT_EQ(saved(Collider<TypeParam>(mesh.view(), BuildOptions{.executor = threads})), bytes);
  EXPECT_EQ(saved(this->loaded(bytes)), bytes);
  EXPECT_EQ(saved(this->loaded(bytes, {.executor = threads})), bytes);
}

TYPED_TEST(ColliderFile, loads_bytes_of_any_alignment) {
  const Bytes bytes = saved(saved_meshes<TypeParam>()[4].collider());
  for (std::size_t shift = 0; shift < 16; ++shift) {
    Bytes shifted(shift);
    shifted.insert(shifted.end(), bytes.begin(), bytes.end());
    Collider<TypeParam> collider;
    ASSERT_TRUE(collider.try_load(std::span(shifted).subspan(shift)));
    EXPECT_EQ(saved(collider), bytes);
  }
}

TYPED_TEST(ColliderFile, begins_as_described) {
  const Bytes bytes = saved(Collider<TypeParam>());
  const std::vector<unsigned> expected = {
      0x89, 's', 'r', 'h', 't', 13, 10, 26, 4, 3, 2, 1, 1, 0, 'c', sizeof(TypeParam), 104, 0, 0, 0, 0, 0, 0, 0};
  ASSERT_EQ(bytes.size(), 104U);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(std::to_integer<unsigned>(bytes[i]), expected[i]) << i;
}

TYPED_TEST(ColliderFile, ends_where_the_sink_is_full) {
  const Collider<TypeParam> collider = saved_meshes<TypeParam>()[4].collider();
  const std::size_t whole = saved(collider).size();
  for (const std::size_t room : {std::size_t{0}, std::size_t{100}, whole / 2, whole - 1, whole}) {
    std::size_t taken = 0;
    bool is_full = false;
    const bool is_saved = collider.save([&](std::span<const std::byte> piece) {
      EXPECT_FALSE(is_full);
      is_full = piece.size() > room - taken;
      taken += is_full ? 0 : piece.size();
      return !is_full;
    });
    EXPECT_EQ(is_saved, room == whole);
  }
}

TYPED_TEST(ColliderFile, failed_load_changes_nothing) {
  Collider<TypeParam> collider = saved_meshes<TypeParam>()[4].collider();
  const Bytes bytes = saved(collider);
  Bytes damaged = bytes;
  damaged.back() ^= std::byte{1};
  const LoadResult result = collider.try_load(damaged);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().reason, Reason::wrong_checksum);
  EXPECT_EQ(result.error().offset, bytes.size() - 8);
  EXPECT_EQ(saved(collider), bytes);
  EXPECT_THROW(static_cast<void>(Collider<TypeParam>::load(damaged)), InvalidFile);
  EXPECT_EQ(saved(Collider<TypeParam>::load(bytes)), bytes);
}

}  // namespace
}  // namespace surehit::test::collider_file_test
