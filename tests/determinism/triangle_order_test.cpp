#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "answers.hpp"
#include "support/case_count.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"

namespace surehit::test::triangle_order_test {
namespace {

/// Triangles and paths whose corners are whole numbers from 0 to 4: thick with ties, on common edges and vertices, in
/// common planes and in copies.
///
/// A t is a quotient of T and det, or in a triangle's plane or along its segment of two-dimensional determinants; all
/// are whole numbers up to 3 · 4 · 32 = 384 (a direction's components by a normal's). Two different quotients p/q and
/// r/s differ by at least 1/(qs). This is a share of 1/(rq) > 2^-18 of the larger one, so they do not round to the same
/// float. So hits tie where their rounded t are the same.
template <typename Scalar>
class TriangleOrder : public testing::Test {
 protected:
  static constexpr std::size_t triangle_count = 400;

  using Mesh = std::vector<std::array<std::uint32_t, 3>>;

  TriangleOrder() {
    for (int z = 0; z <= 4; ++z) {
      for (int y = 0; y <= 4; ++y) {
        for (int x = 0; x <= 4; ++x) {
          vertices.push_back({static_cast<Scalar>(x), static_cast<Scalar>(y), static_cast<Scalar>(z)});
        }
      }
    }
    while (mesh.size() < triangle_count) {
      const auto copied = static_cast<std::size_t>(random.below(mesh.size() + 1));
      mesh.push_back(random.one_in(4) && copied < mesh.size() ? mesh[copied]
                                                              : std::array{vertex(), vertex(), vertex()});
    }
    questions.options = asked_options<Scalar>();
    for (std::size_t i = case_count(1000); i > 0; --i) {
      const Vector3<Scalar> start = point();
      const Vector3<Scalar> end = point();
      const Vector3<Scalar> direction = end - start;
      // Ids of ignored triangles do not outlive a permutation.
      const std::size_t options = random.one_in(4) ? 1 : 0;
      switch (random.below(4)) {
        case 0:
          questions.all.push_back({Ray<Scalar>{start, direction}, options});
          break;
        case 1:
          questions.all.push_back({Line<Scalar>{start, direction}, options});
          break;
        default:
          questions.all.push_back({Segment<Scalar>{start, end}, options});
      }
    }
  }

  std::uint32_t vertex() { return static_cast<std::uint32_t>(random.below(vertices.size())); }
  Vector3<Scalar> point() {
    const auto& [x, y, z] = vertices[vertex()];
    return {x, y, z};
  }

  [[nodiscard]] Answers<Scalar> answers_of(const Mesh& triangles) const {
    const Collider<Scalar> collider({vertices, triangles});
    return Answers<Scalar>(collider, questions);
  }

  /// By t, then by id.
  static bool is_before(const Hit<Scalar>& left, const Hit<Scalar>& right) {
    return std::tie(left.t, left.triangle) < std::tie(right.t, right.triangle);
  }

  Random random{47};
  std::vector<std::array<Scalar, 3>> vertices;
  Mesh mesh;
  Questions<Scalar> questions;
};
TYPED_TEST_SUITE(TriangleOrder, Scalars, ScalarNames);

TYPED_TEST(TriangleOrder, answers_of_permuted_triangles_are_the_same_and_ties_go_by_the_new_ids) {
  const Answers<TypeParam> original = this->answers_of(this->mesh);
  std::size_t moved_ties = 0;
  for (int permutation = 0; permutation < 2; ++permutation) {
    std::vector<std::uint32_t> new_ids(this->mesh.size());
    std::iota(new_ids.begin(), new_ids.end(), 0U);
    for (std::size_t i = new_ids.size(); i > 1; --i) std::swap(new_ids[i - 1], new_ids[this->random.below(i)]);
    auto permuted = this->mesh;
    for (std::size_t i = 0; i < new_ids.size(); ++i) permuted[new_ids[i]] = this->mesh[i];

    const Answers<TypeParam> answers = this->answers_of(permuted);
    for (std::size_t id = 0; id < this->questions.all.size(); ++id) {
      Answer<TypeParam> expected = original.all()[id];
      for (Hit<TypeParam>& hit : expected.all) hit.triangle = new_ids[hit.triangle];
      std::sort(expected.all.begin(), expected.all.end(), this->is_before);
      if (!expected.all.empty()) {
        if (expected.all.front().triangle != new_ids[expected.first.triangle]) ++moved_ties;
        expected.first = expected.all.front();
        expected.first_of_batch = expected.first;
      }
      EXPECT_TRUE(answers.all()[id].same_as(expected)) << hex_text(this->questions.all[id].path);
    }
  }
  EXPECT_GT(moved_ties, this->questions.all.size() / 10);
}

}  // namespace
}  // namespace surehit::test::triangle_order_test
