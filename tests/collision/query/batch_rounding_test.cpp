#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "support/brute_force.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::batch_rounding_test {
namespace {

template <typename AnyPath>
AnyPath path_of(const Segment<float>& segment) {
  if constexpr (std::is_same_v<AnyPath, Segment<float>>) {
    return segment;
  } else {
    return {segment.start, segment.end - segment.start};
  }
}

/// First hits of batches of `segments`, or of rays or lines along them, of every size up to `most`: each must be what
/// `intersect` says of that triangle and path, to the bit, and the first one that there is.
template <typename AnyPath>
void expect_rounded(const GeneratedMesh<float>& mesh, const std::vector<Segment<float>>& segments, std::size_t most,
                    QueryStatistics& statistics) {
  std::vector<AnyPath> paths;
  std::vector<Hit<float>> expected;
  for (const Segment<float>& segment : segments) {
    paths.push_back(path_of<AnyPath>(segment));
    const auto hits = brute_force_hits<float>(mesh.view(), paths.back());
    expected.push_back(hits.empty() ? Hit<float>{} : hits.front());
  }
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    const Collider<float> collider(mesh.view());
    SCOPED_TRACE(name_of_instruction_set(target));
    std::size_t first = 0;
    for (std::size_t count = 1; count <= most && !testing::Test::HasFailure(); ++count) {
      first = (first + 7) % (paths.size() - count + 1);
      std::vector<Hit<float>> hits(count);
      collider.first_hits(std::span<const AnyPath>(paths).subspan(first, count), hits, {.statistics = &statistics});
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_TRUE(same_bits(hits[i], expected[first + i]))
            << hex_text(Path<float>(paths[first + i])) << ", path " << i << " of " << count << ": " << hex_text(hits[i])
            << " and not " << hex_text(expected[first + i]);
      }
    }
  }
}

void expect_all_kinds_rounded(const GeneratedMesh<float>& mesh, const std::vector<Segment<float>>& segments,
                              std::size_t most, QueryStatistics& statistics) {
  expect_rounded<Segment<float>>(mesh, segments, most, statistics);
  expect_rounded<Ray<float>>(mesh, segments, most, statistics);
  expect_rounded<Line<float>>(mesh, segments, most, statistics);
}

class BatchRoundingOnFamily : public testing::TestWithParam<PairFamily> {};

TEST_P(BatchRoundingOnFamily, is_that_of_intersect) {
  Random random(71);
  QueryStatistics statistics;
  for (std::size_t i = case_count(4); i > 0; --i) {
    GeneratedMesh<float> mesh;
    std::vector<Segment<float>> segments;
    for (std::size_t k = 0; k < 45; ++k) {
      const auto [segment, triangle] = draw_pair<float>(GetParam(), random);
      mesh.add(triangle);
      segments.push_back(segment);
    }
    expect_all_kinds_rounded(mesh, segments, 40, statistics);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, BatchRoundingOnFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

TEST(BatchRounding, of_random_hits_is_that_of_intersect) {
  Random random(72);
  for (std::size_t i = case_count(6); i > 0; --i) {
    const auto mesh = scattered_triangles<float>(200, 0.7F, random);
    const auto vector = [&]() -> Vector3<float> {
      return Vector3<float>::NullaryExpr([&] { return 2 * random.symmetric<float>(); });
    };
    std::vector<Segment<float>> segments;
    for (std::size_t k = 0; k < 60; ++k) segments.push_back({vector(), vector()});
    QueryStatistics statistics;
    expect_all_kinds_rounded(mesh, segments, 40, statistics);
  }
}

/// t, u or v, or all of them, just between two floats, where no interval around them rounds to one; by turns with
/// others that do, so that both share a vector.
TEST(BatchRounding, of_hits_between_two_floats_is_that_of_intersect) {
  constexpr float eps = std::numeric_limits<float>::epsilon() / 2;
  GeneratedMesh<float> mesh;
  mesh.add({{-eps, -eps, 1}, {2, -eps, 1}, {-eps, 2, 1}});
  mesh.add({{-eps, -eps, 3}, {4, -eps, 3}, {-eps, 4, 3}});
  Random random(73);
  std::vector<Segment<float>> segments;
  for (std::size_t i = 0; i < 60; ++i) {
    const float x = random.one_in(2) ? 0.5F : random.unit<float>();
    const float y = random.one_in(2) ? 0.5F : random.unit<float>() / 2;
    const bool is_between = random.one_in(2);
    // From -eps to 1, by 1 or 2: t = 1 + eps or (1 + eps) / 2.
    segments.push_back({{x, y, is_between ? -eps : 0.0F}, {x, y, is_between ? 2 - eps : 2.0F}});
  }
  QueryStatistics statistics;
  expect_all_kinds_rounded(mesh, segments, 40, statistics);
  EXPECT_GT(statistics.exact_roundings, 0U);
  EXPECT_LT(statistics.exact_roundings, statistics.paths / 2);
}

/// The same of lines that leave the triangles behind them.
TEST(BatchRounding, of_hits_at_negative_t_between_two_floats_is_that_of_intersect) {
  constexpr float eps = std::numeric_limits<float>::epsilon() / 2;
  GeneratedMesh<float> mesh;
  mesh.add({{-eps, -eps, 1}, {2, -eps, 1}, {-eps, 2, 1}});
  Random random(74);
  std::vector<Segment<float>> segments;
  for (std::size_t i = 0; i < 60; ++i) {
    const float x = random.unit<float>();
    const float y = random.unit<float>() / 2;
    // From -eps, by -2: t = -(1 + eps) / 2.
    segments.push_back({{x, y, -eps}, {x, y, -2}});
  }
  QueryStatistics statistics;
  expect_rounded<Line<float>>(mesh, segments, 40, statistics);
  EXPECT_EQ(statistics.exact_roundings, statistics.paths);
}

/// All paths meet a triangle that they ignore. The batch is given this triangle, but it is no hit.
TEST(BatchRounding, of_ignored_triangles_gives_no_hits) {
  GeneratedMesh<float> mesh;
  mesh.add({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  const std::vector<Segment<float>> segments(20, {{0.25F, 0.25F, 0}, {0.25F, 0.25F, 2}});
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    const Collider<float> collider(mesh.view());
    SCOPED_TRACE(name_of_instruction_set(target));
    std::vector<Hit<float>> hits(segments.size());
    collider.first_hits(segments, hits);
    for (const Hit<float>& hit : hits) EXPECT_EQ(hit.triangle, 0U);
    collider.first_hits(segments, hits, {.options = {.ignored_triangle = 0}});
    for (const Hit<float>& hit : hits) EXPECT_EQ(hit.triangle, no_triangle);
  }
}

/// A hit at t = 0, u = 0 or v = 0, and one that rounds to it, is +0.
TEST(BatchRounding, gives_zeros_their_sign) {
  constexpr float least = std::numeric_limits<float>::denorm_min();
  GeneratedMesh<float> mesh;
  mesh.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  mesh.add({{5, 5, -1}, {6, 5, -1}, {5, 6, -1}});
  std::vector<Segment<float>> segments;
  for (std::size_t i = 0; i < 50; ++i) {
    const float x = i % 3 == 0 ? 0.0F : 0.25F;
    const float y = i % 3 == 1 ? 0.0F : i % 5 == 0 ? least : 0.25F;
    segments.push_back({{x, y, i % 2 == 0 ? 1.0F : -1.0F}, {x, y, i % 7 == 0 ? 0.0F : i % 2 == 0 ? -1.0F : 2.0F}});
  }
  QueryStatistics statistics;
  expect_all_kinds_rounded(mesh, segments, 40, statistics);
}

/// A line's t that is negative and rounds to zero is +0 too.
TEST(BatchRounding, gives_zeros_of_negative_t_their_sign) {
  GeneratedMesh<float> mesh;
  mesh.add({{-0x1p-70F, 0, 0}, {0x1.8p-57F, -0x1.8p-57F, 0}, {0x1.8p-57F, 0x1.8p-57F, 0}});
  // Beside it, so that a lane has it alone: a list is filled up with its last one.
  mesh.add({{0x1p-57F, 0, 0}, {0x1p-57F, 0x1p-58F, 0}, {0x1p-57F, 0, 0x1p-58F}});
  // In other lists, and not far, so that the kernel is certain.
  for (const float x : {-0x1p-56F, 0x1p-56F}) mesh.add({{x, x, x}, {x, x, x}, {x, x, x}});
  const std::vector<Line<float>> lines(40, Line<float>{{0, 0, 0x1p-117F}, {0, 0, 0x1p34F}});  // t = -2^-151
  const auto expected = intersect(lines[0], mesh.view().triangle(0));
  ASSERT_TRUE(expected);
  EXPECT_TRUE(same_bits(expected->t, 0.0F));
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    const Collider<float> collider(mesh.view(), BuildOptions{{.resolution = {4, 4, 4}, .crowded = 0}, {}});
    SCOPED_TRACE(name_of_instruction_set(target));
    QueryStatistics statistics;
    std::vector<Hit<float>> hits(lines.size());
    collider.first_hits(lines, hits, {.statistics = &statistics});
    for (const Hit<float>& hit : hits) {
      EXPECT_EQ(hit.triangle, 0U);
      EXPECT_TRUE(same_bits(hit.t, 0.0F));
    }
    EXPECT_TRUE(same_bits(collider.first_hit(lines[0]).value().t, 0.0F));
    EXPECT_EQ(statistics.undecided, 0U);
    EXPECT_EQ(statistics.exact_roundings, 0U);
  }
}

}  // namespace
}  // namespace surehit::test::batch_rounding_test
