#include <gtest/gtest.h>

#include <cstddef>
#include <new>
#include <string>
#include <vector>

#include "allocations.hpp"
#include "deformations.hpp"
#include "same_answers.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"

namespace surehit::test::rebuild_allocation_test {
namespace {

template <typename Scalar>
class RebuildAllocation : public testing::Test {
 protected:
  RebuildAllocation() {
    Random random(73);
    mesh_ = scattered_triangles<Scalar>(500, Scalar{0.25}, random);
  }

  static VertexView<Scalar> view_of(const GeneratedMesh<Scalar>& mesh) {
    return std::span<const Vector3<Scalar>>(mesh.vertices);
  }
  /// The mesh turned over: the same box and lists of the same sizes, elsewhere.
  [[nodiscard]] GeneratedMesh<Scalar> turned() const {
    GeneratedMesh<Scalar> mesh = mesh_;
    for (auto& vertex : mesh.vertices) vertex = -vertex;
    return mesh;
  }

  /// Whichever of its allocations is the one that fails.
  static void expect_kept_where_it_fails(const GeneratedMesh<Scalar>& mesh, const BuildOptions& options) {
    const Collider<Scalar> expected_before(mesh.view(), options);
    const auto moved = deformed(mesh, deformations<Scalar>().back());
    const Collider<Scalar> expected_after(moved.view(), options);
    std::vector<Path<Scalar>> before;
    std::vector<Path<Scalar>> after;
    for (int i = 0; i < 20; ++i) {
      before.push_back(PathDrawer<Scalar>(mesh.view(), static_cast<std::uint64_t>(i)).draw());
      after.push_back(PathDrawer<Scalar>(moved.view(), static_cast<std::uint64_t>(i)).draw());
    }
    std::size_t failures = 0;
    for (bool failed = true; failed; ++failures) {
      SCOPED_TRACE(std::to_string(failures) + " allocations succeed");
      Collider<Scalar> collider(mesh.view(), options);
      const auto rebuild = [&] {
        const ScarceMemory memory(failures);
        collider.rebuild(view_of(moved));
      };
      failed = false;
      try {
        rebuild();
      } catch (const std::bad_alloc&) {
        failed = true;
      }
      if (failed) {
        expect_same_answers(collider, expected_before, before);
        collider.rebuild(view_of(moved));
      }
      expect_same_answers(collider, expected_after, after);
      if (HasFailure()) return;
    }
    EXPECT_GT(failures, 10U);
  }

  GeneratedMesh<Scalar> mesh_;
  BuildOptions nested_{GridOptions{.resolution = {3, 3, 3}, .crowded = 8}, {}};
};
TYPED_TEST_SUITE(RebuildAllocation, Scalars, ScalarNames);

TYPED_TEST(RebuildAllocation, counter_counts) {
  // Called as a function, which a compiler may not leave out as it may a new-expression.
  EXPECT_EQ(allocations_of([] { ::operator delete(::operator new(10)); }), 1U);
}

TYPED_TEST(RebuildAllocation, none_after_two_of_the_same_sizes) {
  for (const BuildOptions& options : {BuildOptions{}, this->nested_}) {
    Collider<TypeParam> collider(this->mesh_.view(), options);
    EXPECT_GT(allocations_of([&] { collider.rebuild(this->view_of(this->mesh_)); }), 0U);
    collider.rebuild(this->view_of(this->mesh_));
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(allocations_of([&] { collider.rebuild(this->view_of(this->mesh_)); }), 0U);
    }
  }
}

TYPED_TEST(RebuildAllocation, none_for_shapes_that_both_halves_have_held) {
  for (const BuildOptions& options : {BuildOptions{}, this->nested_}) {
    Collider<TypeParam> collider(this->mesh_.view(), options);
    const auto turned = this->turned();
    const auto rebuild_twice_as_each = [&] {
      for (int i = 0; i < 4; ++i) collider.rebuild(this->view_of(i < 2 ? this->mesh_ : turned));
    };
    rebuild_twice_as_each();
    EXPECT_EQ(allocations_of(rebuild_twice_as_each), 0U);
  }
}

TYPED_TEST(RebuildAllocation, none_for_a_smooth_mesh) {
  const auto mesh = smooth_bowl<TypeParam>(20);
  Collider<TypeParam> collider(mesh.view());
  for (int i = 0; i < 2; ++i) collider.rebuild(this->view_of(mesh));
  EXPECT_EQ(allocations_of([&] { collider.rebuild(this->view_of(mesh)); }), 0U);
}

TYPED_TEST(RebuildAllocation, none_for_a_mesh_that_shrinks) {
  Collider<TypeParam> collider(this->mesh_.view());
  collider.rebuild(this->view_of(this->mesh_));
  collider.rebuild(this->view_of(this->mesh_));
  auto smaller = this->mesh_;
  for (int i = 0; i < 5; ++i) {
    for (auto& vertex : smaller.vertices) vertex /= 2;
    EXPECT_EQ(allocations_of([&] { collider.rebuild(this->view_of(smaller)); }), 0U);
  }
}

TYPED_TEST(RebuildAllocation, that_fails_keeps_the_answers_from_before) {
  this->expect_kept_where_it_fails(this->mesh_, this->nested_);
  this->expect_kept_where_it_fails(smooth_bowl<TypeParam>(20), {});
}

}  // namespace
}  // namespace surehit::test::rebuild_allocation_test
