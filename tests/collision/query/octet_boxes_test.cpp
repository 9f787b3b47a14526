#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <surehit/intersect.hpp>
#include <vector>

#include "collision/family_cases.hpp"
#include "grid/grid.hpp"
#include "query/octet_boxes-inl.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_text.hpp"

namespace surehit::test::octet_boxes_test {
namespace {

namespace in_lanes = detail::HWY_NAMESPACE;

constexpr std::size_t octet = MeshBlocks<float>::octet;
constexpr std::size_t size = 4 * octet;

/// A list of 32 triangles, with the boxes of its octets. No list of more is a grid of its own.
class BoxedList {
 public:
  explicit BoxedList(const std::vector<Triangle<float>>& triangles)
      : triangles_(triangles), grid_(mesh().view(), box_of(mesh().view()), {}), blocks_(mesh().view(), grid_) {}

  [[nodiscard]] const std::vector<Triangle<float>>& triangles() const { return triangles_; }
  /// Returns whether all triangles are in one list.
  [[nodiscard]] bool is_whole() const { return grid_.is_one_list(); }
  [[nodiscard]] in_lanes::TriangleList<float> list() const {
    const std::size_t count = triangles_.size();
    const float* const block = blocks_.block(grid_.top()[0].list(), 0);
    return {blocks_.corners(block), count, 0, blocks_.edge_size(block), blocks_.octet_boxes(0, count)};
  }
  [[nodiscard]] std::uint64_t met(const Path<float>& path, const QueryOptions<float>& options, std::size_t from) const {
    const detail::PathRange<float> range(path, options);
    return in_lanes::octets_met(detail::KernelPath<float>(path, 0.0F), list(), from, range.first, range.last);
  }

 private:
  [[nodiscard]] GeneratedMesh<float> mesh() const {
    GeneratedMesh<float> mesh;
    for (const Triangle<float>& triangle : triangles_) mesh.add(triangle);
    return mesh;
  }

  std::vector<Triangle<float>> triangles_;
  Grid grid_;
  MeshBlocks<float> blocks_;
};

/// Returns the number of hits. The octet of each is among those that the path may meet.
std::size_t expect_met(const BoxedList& boxed, const Path<float>& path, const QueryOptions<float>& options) {
  std::size_t hits = 0;
  for (std::size_t i = 0; i < boxed.triangles().size(); ++i) {
    if (!intersect(path, boxed.triangles()[i], options)) continue;
    ++hits;
    for (std::size_t from = 0; from <= i; from += octet) {
      EXPECT_TRUE(boxed.met(path, options, from) >> (i - from) / octet & 1)
          << i << " of " << boxed.triangles().size() << " from " << from << '\n'
          << hex_text(path) << hex_text(boxed.triangles()[i]);
    }
  }
  return hits;
}

class OctetBoxesOfFamily : public testing::TestWithParam<PairFamily> {};

TEST_P(OctetBoxesOfFamily, are_met_where_a_triangle_is) {
  Random random(91);
  std::size_t lists = 0;
  for (std::size_t k = case_count(200); k > 0 && !HasFailure(); --k) {
    std::vector<Segment<float>> segments(size);
    std::vector<Triangle<float>> triangles;
    for (Segment<float>& segment : segments) {
      const auto pair = draw_pair<float>(GetParam(), random);
      segment = pair.segment;
      triangles.push_back(pair.triangle);
    }
    const BoxedList boxed(triangles);
    if (!boxed.is_whole()) continue;
    ++lists;
    for (const Segment<float>& segment : segments) {
      for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
        const Path<float> path = path_along(segment, kind);
        expect_met(boxed, path, {});
        expect_met(boxed, path, draw_options(random, random.unit<float>()));
      }
    }
  }
  EXPECT_GT(lists, case_count(200) / 2);
}

INSTANTIATE_TEST_SUITE_P(Families, OctetBoxesOfFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

/// Returns triangles that do not reach beyond one number on each axis. Their boxes are points, faces or edges of cubes.
std::vector<Triangle<float>> flat_triangles(Random& random) {
  std::vector<Triangle<float>> triangles(size);
  const std::size_t axis = random.below(3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto height = static_cast<float>(i / octet) / 3;
    const auto corner = [&] {
      Vector3<float> x = {random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>()};
      x[static_cast<Eigen::Index>(axis)] = height;
      return x;
    };
    triangles[i] = {corner(), corner(), corner()};
  }
  return triangles;
}

TEST(OctetBoxes, without_thickness_are_met_by_what_ends_in_them) {
  Random random(92);
  std::size_t hits = 0;
  for (std::size_t k = case_count(3'000); k > 0 && !HasFailure(); --k) {
    const BoxedList boxed(flat_triangles(random));
    ASSERT_TRUE(boxed.is_whole());
    for (const Triangle<float>& triangle : boxed.triangles()) {
      const Vector3<float> start = {random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>()};
      hits += expect_met(boxed, path_along(Segment<float>{start, triangle.b}, PathKind::segment), {});
      // Through the corner: t is rarely a float, and the range ends at the nearest one.
      const Vector3<float> end = triangle.a + (triangle.a - start) * random.unit<float>();
      const Path<float> path = path_along(Segment<float>{start, end}, PathKind::segment);
      const auto hit = intersect(path, triangle);
      if (!hit) continue;
      QueryOptions<float> options;
      options.max_t = std::nextafter(hit->t, 2.0F);
      options.min_t = std::nextafter(hit->t, -2.0F);
      hits += expect_met(boxed, path, options);
    }
  }
  EXPECT_GT(hits, case_count(3'000));
}

TEST(OctetBoxes, are_passed_over_where_the_path_is_beside_them) {
  Random random(93);
  std::size_t passed = 0;
  std::size_t beside = 0;
  for (std::size_t k = case_count(2'000); k > 0; --k) {
    const BoxedList boxed(flat_triangles(random));
    const std::size_t boxes = boxed.triangles().size() / octet;
    for (const bool is_still : {false, true}) {
      Vector3<float> start = {random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>()};
      Vector3<float> end = {random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>()};
      const auto still = static_cast<Eigen::Index>(random.below(3));
      if (is_still) end[still] = start[still];
      const std::uint64_t met = boxed.met(path_along(Segment<float>{start, end}, PathKind::segment), {}, 0);
      for (std::size_t i = 0; i < boxes; ++i) {
        double enters = 0;
        double leaves = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto on = static_cast<Eigen::Index>(axis);
          const double low = boxed.list().boxes[axis * boxes + i];
          const double high = boxed.list().boxes[(3 + axis) * boxes + i];
          const double way = double{end[on]} - start[on];
          if (way == 0) {
            if (start[on] < low || start[on] > high) enters = 2;
            continue;
          }
          enters = std::max(enters, std::min((low - start[on]) / way, (high - start[on]) / way));
          leaves = std::min(leaves, std::max((low - start[on]) / way, (high - start[on]) / way));
        }
        if (enters <= leaves + 1e-5) continue;
        ++beside;
        passed += (met >> i & 1) == 0 ? 1U : 0U;
      }
    }
  }
  EXPECT_EQ(passed, beside);
  EXPECT_GT(beside, case_count(2'000));
}

/// Here the boxes are of a list that no grid has made.
TEST(OctetBoxes, of_the_last_triangles_count_for_those_after_them) {
  constexpr std::size_t boxes = 9;
  std::vector<float> sides(6 * boxes + 16, 1.0F);
  for (std::size_t i = 0; i < boxes; ++i) {
    sides[i] = static_cast<float>(2 * i);
    sides[boxes + i] = sides[2 * boxes + i] = 0;
    sides[3 * boxes + i] = static_cast<float>(2 * i + 1);
  }
  for (const std::size_t count : {octet * boxes, octet * boxes + 3, octet * boxes + 7}) {
    const in_lanes::TriangleList<float> list{nullptr, count, 0, 1, sides.data()};
    const auto met = [&](float x, std::size_t from) {
      const Path<float> path = path_along(Segment<float>{{x, 0.5F, 0.5F}, {x + 0.5F, 0.5F, 0.5F}}, PathKind::segment);
      return in_lanes::octets_met(detail::KernelPath<float>(path, 0.0F), list, from, 0, 1);
    };
    for (std::size_t i = 0; i < boxes; ++i) {
      const auto x = static_cast<float>(2 * i) + 0.25F;
      const std::uint64_t from_first = met(x, 0);
      const std::uint64_t from_second = met(x, octet * in_lanes::max_octets);
      EXPECT_EQ(from_first, i < in_lanes::max_octets ? std::uint64_t{1} << i : 0) << i;
      EXPECT_EQ(from_second & 1, i == boxes - 1 ? 1U : 0U) << i;
      // The bit after the last box is for the triangles after it.
      EXPECT_EQ(from_second >> 1 & 1, i == boxes - 1 ? 1U : 0U) << i;
      EXPECT_EQ(met(static_cast<float>(2 * i) + 1.25F, 0), 0U) << i;
    }
    EXPECT_EQ(met(2 * (boxes - 1), octet * boxes) & 1, 1U) << count;
  }
}

TEST(OctetBoxes, are_met_by_slow_paths) {
  const Triangle<float> triangle{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  const BoxedList boxed(std::vector<Triangle<float>>(size, triangle));
  const Path<float> path(PathKind::ray, {0, 0.25F, -1}, {1.25F * 0x1p-70F, 0, 0x1p-70F});
  ASSERT_TRUE(intersect(path, triangle));
  EXPECT_EQ(boxed.met(path, {}, 0) & 15, 15U);
}

TEST(OctetBoxes, of_sizes_that_might_overflow_are_met) {
  std::vector<Triangle<float>> triangles(size, Triangle<float>{{0, 0, 0}, {0x1p34F, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(BoxedList(triangles).met(path_along(Segment<float>{{0, 0, 5}, {1, 1, 5}}, PathKind::segment), {}, 0) & 7,
            0U);
  triangles[0].b[0] = std::numeric_limits<float>::max();
  EXPECT_EQ(BoxedList(triangles).met(path_along(Segment<float>{{0, 0, 5}, {1, 1, 5}}, PathKind::segment), {}, 0) & 15,
            15U);
}

}  // namespace
}  // namespace surehit::test::octet_boxes_test
