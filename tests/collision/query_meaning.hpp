#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "support/exact_oracle.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"
#include "unit_triangles.hpp"

namespace surehit::test {

/// Asks about one path and one triangle in every way there is, and fails where two ways disagree: `intersect`, the
/// queries of a collider that holds this triangle alone, and the rationals.
template <typename Scalar>
class QueryMeaning : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;
  using Answer = std::optional<Hit<Scalar>>;

  static Answer ask(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                    const QueryOptions<Scalar>& options = {}) {
    SCOPED_TRACE(hex_text(path) + hex_text(triangle) + hex_text(options));
    const Answer answer = intersect(path, triangle, options);
    GeneratedMesh<Scalar> mesh;
    mesh.add(triangle);
    const Collider<Scalar> collider(mesh.view());
    expect_same(collider.first_hit(path, options), answer);
    EXPECT_EQ(collider.any_hit(path, options), answer.has_value());
    std::vector<Hit<Scalar>> hits;
    collider.all_hits(path, hits, options);
    EXPECT_EQ(hits.size(), answer ? 1u : 0u);
    if (!hits.empty()) expect_same(hits.front(), answer);
    if (const auto truth = exact_contact(path, triangle, options)) {
      expect_same(rounded_hit<Scalar>(*truth), answer);
    } else {
      EXPECT_FALSE(answer);
    }
    return answer;
  }

  static void expect_hit(const Answer& answer, Scalar t, Scalar u, Scalar v, Side side) {
    ASSERT_TRUE(answer);
    EXPECT_TRUE(same_bits(*answer, Hit<Scalar>{t, u, v, 0, side})) << hex_text(*answer);
  }

  /// A unit triangle at z = 0 and the segment from `from` to `to` above (x, y).
  static Answer ask_across(Scalar x, Scalar y, Scalar from, Scalar to, const QueryOptions<Scalar>& options = {}) {
    return ask(Segment<Scalar>{{x, y, from}, {x, y, to}}, unit_triangle<Scalar>(), options);
  }

 private:
  static void expect_same(const Answer& left, const Answer& right) {
    ASSERT_EQ(left.has_value(), right.has_value());
    if (left) {
      EXPECT_TRUE(same_bits(*left, *right)) << hex_text(*left) << hex_text(*right);
    }
  }
};

}  // namespace surehit::test
