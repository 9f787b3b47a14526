#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "collision/contact_oracle.hpp"
#include "collision/family_cases.hpp"
#include "kernel_list.hpp"
#include "on_every_instruction_set.hpp"
#include "support/case_count.hpp"
#include "support/instruction_sets.hpp"
#include "support/neighbour.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"

namespace surehit::test::block_kernel_test {
namespace {

using detail::PathRange;
using detail::Verdict;

/// On every instruction set that the machine has: what one calls certain is true, so that no two can disagree.
template <typename Scalar>
void expect_never_wrong(const Path<Scalar>& path, const std::vector<Triangle<Scalar>>& triangles,
                        const KernelList<Scalar>& list, std::size_t i, QueryOptions<Scalar> options) {
  keep_limits_alone(options);
  const PathRange<Scalar> range(path, options);
  if (range.is_empty()) return;
  std::optional<bool> truth;
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    Verdict verdict = list.verdict(path, range, i);
    if constexpr (std::is_same_v<Scalar, float>) {
      const Verdict in_double = list.verdict_in_double(path, range, i);
      if (verdict != Verdict::undecided) {
        EXPECT_EQ(in_double, verdict) << name_of_instruction_set(target) << ": " << hex_text(path)
                                      << hex_text(triangles[i]);
      }
      verdict = in_double;
    }
    if (verdict == Verdict::undecided) continue;
    if (!truth) truth = exact_contact(path, triangles[i], options).has_value();
    EXPECT_EQ(verdict == Verdict::hit, *truth)
        << name_of_instruction_set(target) << ": " << hex_text(path) << hex_text(triangles[i]) << hex_text(options)
        << ", triangle " << i << " of " << triangles.size();
  }
}

template <typename Scalar>
void expect_never_wrong(const Path<Scalar>& path, const Triangle<Scalar>& triangle, QueryOptions<Scalar> options) {
  expect_never_wrong(path, {triangle}, KernelList<Scalar>(triangle), 0, options);
}

class BlockKernelOnFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  void check_alone() {
    visit_family<Scalar>(GetParam(), 21, 3'000,
                         [](const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                            const QueryOptions<Scalar>& options) { expect_never_wrong(path, triangle, options); });
  }

  /// Lists of 1 to 35 triangles, each path against its own triangle and another one.
  template <typename Scalar>
  void check_in_lists() {
    Random random(31);
    for (std::size_t i = case_count(150); i > 0 && !HasFailure(); --i) {
      const auto [segments, triangles] = FamilyList<Scalar>(GetParam(), random);
      const KernelList<Scalar> list(triangles);
      for (std::size_t k = 0; k < segments.size(); ++k) {
        const auto kind = static_cast<PathKind>(random.below(3));
        const Path<Scalar> path = path_along(segments[k], kind);
        expect_never_wrong(path, triangles, list, k, {});
        expect_never_wrong(path, triangles, list, random.below(triangles.size()),
                           draw_options(random, random.unit<Scalar>()));
      }
    }
  }
};

TEST_P(BlockKernelOnFamily, is_never_wrong_for_float) { check_alone<float>(); }
TEST_P(BlockKernelOnFamily, is_never_wrong_for_double) { check_alone<double>(); }
TEST_P(BlockKernelOnFamily, is_never_wrong_in_lists_of_float) { check_in_lists<float>(); }
TEST_P(BlockKernelOnFamily, is_never_wrong_in_lists_of_double) { check_in_lists<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, BlockKernelOnFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
Pair<Scalar> pair_of(const std::array<Scalar, 15>& x) {
  return {{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}}, {{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}}};
}

template <typename Scalar>
class BlockKernel : public testing::Test {
 protected:
  static Verdict verdict(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                         const QueryOptions<Scalar>& options = {}) {
    return KernelList<Scalar>(triangle).verdict(path, PathRange<Scalar>(path, options), 0);
  }
  static void expect_undecided(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
    EXPECT_EQ(verdict(path, triangle), Verdict::undecided);
  }

  /// Small multiples of powers of two around `exponent`. They often cancel exactly.
  static Pair<Scalar> draw_near(Random& random, int exponent) {
    std::array<Scalar, 15> x;
    for (Scalar& coordinate : x) {
      coordinate = std::ldexp(static_cast<Scalar>(random.between(-3, 3)), exponent + static_cast<int>(random.below(3)));
      if (random.one_in(4)) coordinate = neighbour(coordinate, static_cast<int>(random.between(-2, 2)));
    }
    return pair_of(x);
  }
};
TYPED_TEST_SUITE(BlockKernel, Scalars, ScalarNames);

/// Else the other tests would look at one alone.
TYPED_TEST(BlockKernel, runs_on_the_instruction_set_that_is_forced) {
  std::vector<std::size_t> lanes;
  on_every_instruction_set([&] { lanes.push_back(kernel_lanes<TypeParam>()); });
  EXPECT_TRUE(std::is_sorted(lanes.rbegin(), lanes.rend())) << "the best first";
  for (const std::size_t count : lanes) EXPECT_LE(count, 64 / sizeof(TypeParam));
  this->RecordProperty("instruction_sets", std::to_string(lanes.size()));
}

TYPED_TEST(BlockKernel, is_never_wrong_on_any_bit_patterns) {
  Random random(22);
  for (std::size_t i = case_count(20'000); i > 0 && !this->HasFailure(); --i) {
    std::array<TypeParam, 15> x;
    for (TypeParam& coordinate : x) coordinate = random.any_finite<TypeParam>();
    const auto [segment, triangle] = pair_of(x);
    expect_never_wrong<TypeParam>(segment, triangle, {});
  }
}

TYPED_TEST(BlockKernel, is_never_wrong_at_sizes_at_which_products_overflow_or_underflow) {
  using Limits = std::numeric_limits<TypeParam>;
  Random random(23);
  const int largest_size = Limits::max_exponent == 128 ? 34 : 300;
  for (const int exponent :
       {Limits::min_exponent - Limits::digits + 2, Limits::min_exponent / 3, Limits::min_exponent / 2, largest_size - 4,
        largest_size - 2, Limits::max_exponent / 3, Limits::max_exponent - 6}) {
    for (std::size_t i = case_count(8'000); i > 0 && !this->HasFailure(); --i) {
      const auto [segment, triangle] = this->draw_near(random, exponent);
      expect_never_wrong<TypeParam>(segment, triangle, {});
      expect_never_wrong(path_along(segment, PathKind::ray), triangle, draw_options(random, random.unit<TypeParam>()));
    }
  }
}

/// Far shorter than the triangle's edges: the ends are weighed by squares of the edges, not by their length.
TYPED_TEST(BlockKernel, is_never_wrong_about_short_paths_that_end_in_the_plane) {
  Random random(27);
  const auto draw = [&] { return Vector3<TypeParam>::NullaryExpr([&] { return random.symmetric<TypeParam>(); }); };
  for (std::size_t i = case_count(20'000); i > 0 && !this->HasFailure(); --i) {
    const Triangle<TypeParam> triangle{draw(), draw(), draw()};
    const TypeParam u = random.unit<TypeParam>() / 2;
    const TypeParam v = random.unit<TypeParam>() / 2;
    Segment<TypeParam> segment;
    segment.end = triangle.a + u * (triangle.b - triangle.a) + v * (triangle.c - triangle.a);
    segment.start = segment.end + std::ldexp(TypeParam{1}, -static_cast<int>(random.below(16))) * draw();
    if (random.one_in(2)) std::swap(segment.start, segment.end);
    expect_never_wrong<TypeParam>(segment, triangle, {});
  }
}

TYPED_TEST(BlockKernel, decides_nearly_every_random_pair) {
  on_every_instruction_set([&] {
    Random random(24);
    const std::size_t pairs = case_count(20'000);
    std::size_t undecided = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
      std::array<TypeParam, 15> x;
      for (TypeParam& coordinate : x) coordinate = random.symmetric<TypeParam>();
      const auto [segment, triangle] = pair_of(x);
      undecided += this->verdict(segment, triangle) == Verdict::undecided;
    }
    EXPECT_LE(undecided, pairs / 100);
  });
}

TYPED_TEST(BlockKernel, leaves_huge_coordinates_undecided) {
  const TypeParam huge = std::numeric_limits<TypeParam>::max();
  const Triangle<TypeParam> unit{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  on_every_instruction_set([&] {
    for (const TypeParam x : {huge, -huge}) {
      const Segment<TypeParam> segment{{0, 0, -1}, {0, 0, 1}};
      this->expect_undecided(segment, {{-1, -1, 0}, {x, -1, 0}, {0, 1, 0}});
      this->expect_undecided(segment, {{-1, -1, x}, {1, -1, x}, {0, 1, x}});
      this->expect_undecided(Segment<TypeParam>{{0, 0, -1}, {0, x, 1}}, unit);
      this->expect_undecided(Ray<TypeParam>{{0, x, -1}, {0, 0, 1}}, unit);
      this->expect_undecided(Ray<TypeParam>{{0, 0, -1}, {0, 0, x}}, unit);
    }
  });
}

/// Whose products do not overflow, but may lose more when they underflow than the bound allows for.
TYPED_TEST(BlockKernel, leaves_a_direction_undecided_that_is_too_large_for_the_bound) {
  const TypeParam large = 4 * detail::KernelBound<TypeParam>::largest_size;
  const Triangle<TypeParam> unit{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  on_every_instruction_set([&] { this->expect_undecided(Ray<TypeParam>{{0, 0, -large / 8}, {0, 0, large}}, unit); });
}

/// Each size is far from overflow. Only the products of the determinants overflow, and not their bounds.
TYPED_TEST(BlockKernel, leaves_sizes_undecided_whose_products_overflow) {
  const TypeParam size = detail::KernelBound<TypeParam>::largest_size;
  const TypeParam quarter = size / 4;
  const Triangle<TypeParam> triangle{{-quarter, -quarter, 0}, {quarter, -quarter, 0}, {0, quarter, 0}};
  const TypeParam largest = std::numeric_limits<TypeParam>::max() / size / size;
  on_every_instruction_set([&] {
    EXPECT_EQ(this->verdict(Line<TypeParam>{{0, 0, -1}, {0, 0, size}}, triangle), Verdict::hit);
    EXPECT_EQ(this->verdict(Line<TypeParam>{{0, 0, -1}, {0, 0, 6 * largest}}, triangle), Verdict::undecided);
  });
}

/// The list's longest edge is every triangle's.
TYPED_TEST(BlockKernel, leaves_a_list_undecided_if_one_of_its_triangles_is_huge) {
  const TypeParam huge = std::numeric_limits<TypeParam>::max();
  const Triangle<TypeParam> unit{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  const std::vector<Triangle<TypeParam>> triangles = {unit, {{0, 0, 0}, {huge, 0, 0}, {0, huge, 0}}};
  const Path<TypeParam> path = Segment<TypeParam>{{0, 0, -1}, {0, TypeParam{0.1F}, 1}};
  on_every_instruction_set([&] {
    EXPECT_EQ(KernelList<TypeParam>(unit).verdict(path, PathRange<TypeParam>(path, {}), 0), Verdict::hit);
    EXPECT_EQ(KernelList<TypeParam>(triangles).verdict(path, PathRange<TypeParam>(path, {}), 0), Verdict::undecided);
    if constexpr (std::is_same_v<TypeParam, float>) {
      EXPECT_EQ(KernelList<TypeParam>(triangles).verdict_in_double(path, PathRange<TypeParam>(path, {}), 0),
                Verdict::undecided);
    }
  });
}

TEST(BlockKernelInDouble, decides_small_triangles_beside_a_large_one) {
  // It is so large that a small one is nowhere clear of its list's bound in float.
  const float large = std::ldexp(1.0F, std::numeric_limits<float>::digits / 2);
  const std::vector<Trianglef> triangles = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                            {{2, 0, 0}, {3, 0, 0}, {2, 1, 0}},
                                            {{-large, 0, -1}, {large, 0, -1}, {0, large, -1}}};
  const KernelList<float> list(triangles);
  const Pathf path = Segmentf{{0.25F, 0.25F, 1}, {0.25F, 0.25F, -0.5F}};
  const PathRange<float> range(path, {});
  on_every_instruction_set([&] {
    for (const std::size_t small : {0U, 1U}) EXPECT_EQ(list.verdict(path, range, small), Verdict::undecided);
    EXPECT_EQ(list.verdict_in_double(path, range, 0), Verdict::hit);
    EXPECT_EQ(list.verdict_in_double(path, range, 1), Verdict::miss);
  });
}

TEST(BlockKernelInDouble, looks_at_the_lanes_that_it_is_given) {
  const std::vector<Trianglef> triangles(40, Trianglef{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
  const KernelList<float> list(triangles);
  const Pathf path = Segmentf{{0, 0, -1}, {0, 0.1F, 1}};
  on_every_instruction_set([&] {
    const std::uint64_t all = (std::uint64_t{1} << kernel_lanes<float>()) - 1;
    Random random(44);
    for (int i = 0; i < 20; ++i) {
      const std::uint64_t lanes = random.bits() & all;
      const auto in_double = list.in_double_from(path, PathRange<float>(path, {}), 0, 1, lanes);
      EXPECT_EQ(in_double.verdicts.possible, lanes);
      EXPECT_EQ(in_double.verdicts.certain, lanes);
      EXPECT_EQ(in_double.first.lanes, lanes);
    }
  });
}

TEST(BlockKernelInDouble, decides_a_path_from_far_away) {
  const float far = 0x1p20F;
  const Trianglef triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const KernelList<float> list(triangle);
  on_every_instruction_set([&] {
    for (const bool hits : {true, false}) {
      const float x = hits ? 0x1p-20F : -0x1p-20F;
      const Pathf path = Segmentf{{x, 0.25F, far}, {x, 0.25F, -far}};
      const PathRange<float> range(path, {});
      EXPECT_EQ(list.verdict(path, range, 0), Verdict::undecided);
      EXPECT_EQ(list.verdict_in_double(path, range, 0), hits ? Verdict::hit : Verdict::miss);
    }
  });
}

TYPED_TEST(BlockKernel, leaves_a_limit_too_large_for_the_bound_open) {
  const Ray<TypeParam> ray{{0, 0, -1}, {0, 0, 1}};
  const Triangle<TypeParam> triangle{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  on_every_instruction_set([&] {
    EXPECT_EQ(this->verdict(ray, triangle, {.max_t = 4}), Verdict::hit);
    EXPECT_EQ(this->verdict(ray, triangle, {.max_t = TypeParam{0.5F}}), Verdict::miss);
    EXPECT_EQ(this->verdict(ray, triangle, {.max_t = TypeParam{1e9}}), Verdict::undecided);
    EXPECT_EQ(this->verdict(ray, triangle, {.min_t = 4}), Verdict::miss);
    EXPECT_EQ(this->verdict(ray, triangle, {.min_t = TypeParam{1e9}}), Verdict::undecided);
  });
}

TYPED_TEST(BlockKernel, leaves_an_edge_undecided_and_not_what_is_clear_of_it) {
  const Triangle<TypeParam> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto at = [&](TypeParam y) {
    return this->verdict(Segment<TypeParam>{{TypeParam{0.25}, y, -1}, {TypeParam{0.25}, y, 1}}, triangle);
  };
  const TypeParam clear = 1000 * std::numeric_limits<TypeParam>::epsilon();
  on_every_instruction_set([&] {
    EXPECT_EQ(at(0), Verdict::undecided);
    EXPECT_EQ(at(clear), Verdict::hit);
    EXPECT_EQ(at(-clear), Verdict::miss);
  });
}

/// Tests the bounds of kernel_bound.hpp to within one step of what is measured. D is 2 long, and E1 and E2 are 1 long.
TYPED_TEST(BlockKernel, is_certain_from_its_bounds_on) {
  const TypeParam eps = std::numeric_limits<TypeParam>::epsilon() / 2;
  const TypeParam quarter{0.25};
  const TypeParam half{0.5};
  const Triangle<TypeParam> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto down_at = [&](TypeParam x, TypeParam y) {
    return this->verdict(Segment<TypeParam>{{x, y, 1}, {x, y, -1}}, triangle);
  };
  const auto down_from = [&](TypeParam z, const QueryOptions<TypeParam>& options) {
    return this->verdict(Ray<TypeParam>{{quarter, quarter, z}, {0, 0, -2}}, triangle, options);
  };
  const auto along = [&](TypeParam from, TypeParam to) {
    return this->verdict(Segment<TypeParam>{{quarter, quarter, from}, {quarter, quarter, to}}, triangle);
  };
  on_every_instruction_set([&] {
    // The bound of a side is 66 eps |D| |E| (2 |S| + |E|) = 396 eps. For a miss, det's bound is added.
    // That is 66 eps |D| |E|² = 132 eps. U is 2 x, and W is 2 (1/2 - y).
    EXPECT_EQ(down_at(198 * eps, quarter), Verdict::undecided);
    EXPECT_EQ(down_at(199 * eps, quarter), Verdict::hit);
    EXPECT_EQ(down_at(-264 * eps, quarter), Verdict::undecided);
    EXPECT_EQ(down_at(-265 * eps, quarter), Verdict::miss);
    EXPECT_EQ(down_at(half, half - 198 * eps), Verdict::undecided);
    EXPECT_EQ(down_at(half, half - 199 * eps), Verdict::hit);
    EXPECT_EQ(down_at(half, half + 264 * eps), Verdict::undecided);
    EXPECT_EQ(down_at(half, half + 265 * eps), Verdict::miss);
    // The bound of an end is 66 eps |E|² (|S| + 2 |D|). It is 280.5 eps for a segment that begins at z, where T is z.
    // It is 396 eps for a segment that ends at -z, where det - T is z.
    EXPECT_EQ(along(280 * eps, -2), Verdict::undecided);
    EXPECT_EQ(along(281 * eps, -2), Verdict::hit);
    EXPECT_EQ(along(-412 * eps, -2), Verdict::undecided);
    EXPECT_EQ(along(-413 * eps, -2), Verdict::miss);
    EXPECT_EQ(along(2, -392 * eps), Verdict::undecided);
    EXPECT_EQ(along(2, -400 * eps), Verdict::hit);
    EXPECT_EQ(along(2, 524 * eps), Verdict::undecided);
    EXPECT_EQ(along(2, 532 * eps), Verdict::miss);
    // For a ray, the bound of T is 66 eps |E|² (|S| + 2 |D|) = 66 eps (1/4 + 4) = 280.5 eps. T is z.
    EXPECT_EQ(down_from(280 * eps, {}), Verdict::undecided);
    EXPECT_EQ(down_from(281 * eps, {}), Verdict::hit);
    EXPECT_EQ(down_from(-280 * eps, {}), Verdict::undecided);
    EXPECT_EQ(down_from(-281 * eps, {}), Verdict::miss);
    // The bound of 3 det - T is 66 eps |E|² (|S| + (1 + 3) |D|) = 66 eps (6 + 8) = 924 eps. 3 det - T is 6 - z.
    EXPECT_EQ(down_from(6 - 920 * eps, {.max_t = 3}), Verdict::undecided);
    EXPECT_EQ(down_from(6 - 928 * eps, {.max_t = 3}), Verdict::hit);
    EXPECT_EQ(down_from(6 + 920 * eps, {.max_t = 3}), Verdict::undecided);
    EXPECT_EQ(down_from(6 + 928 * eps, {.max_t = 3}), Verdict::miss);
  });
}

/// A ray from so far away that sides are certain of nothing, in a plane beside the triangle's: its first end is
/// certainly below zero if det is positive, and above it if det is negative.
TYPED_TEST(BlockKernel, leaves_an_end_undecided_where_det_may_be_of_either_sign) {
  const TypeParam far = std::ldexp(TypeParam{1}, std::numeric_limits<TypeParam>::digits - 11);
  const Triangle<TypeParam> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto beside = [&](TypeParam height) {
    const Vector3<TypeParam> start{-far, TypeParam{0.25}, height};
    return this->verdict(Ray<TypeParam>{start, {1, 0, 0}}, triangle);
  };
  on_every_instruction_set([&] {
    for (const TypeParam side : {TypeParam{0.05F}, TypeParam{-0.05F}}) {
      EXPECT_EQ(beside(side), Verdict::undecided);
      EXPECT_EQ(beside(4 * side), Verdict::miss);  // by its sides
    }
  });
}

/// A list ends anywhere among the lanes; what lies behind it is none of its triangles.
TYPED_TEST(BlockKernel, tells_nothing_of_lanes_beyond_the_count) {
  std::vector<Triangle<TypeParam>> triangles(64, {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
  const KernelList<TypeParam> list(triangles);
  const Path<TypeParam> hit = Segment<TypeParam>{{0, 0, -1}, {0, TypeParam{0.1F}, 1}};
  const Path<TypeParam> touch = Segment<TypeParam>{{0, -1, -1}, {0, -1, 1}};
  const Path<TypeParam> miss = Segment<TypeParam>{{5, 0, -1}, {5, 0, 1}};
  on_every_instruction_set([&] {
    for (std::size_t count = 1; count <= kernel_lanes<TypeParam>(); ++count) {
      const std::size_t from = list.size() - count;
      const std::uint64_t all = (std::uint64_t{1} << count) - 1;
      const KernelVerdicts hits = list.verdicts_from(hit, PathRange<TypeParam>(hit, {}), from);
      EXPECT_EQ(hits.possible, all);
      EXPECT_EQ(hits.certain, all);
      const KernelVerdicts touches = list.verdicts_from(touch, PathRange<TypeParam>(touch, {}), from);
      EXPECT_EQ(touches.possible, all);
      EXPECT_EQ(touches.certain, 0U);
      const KernelVerdicts misses = list.verdicts_from(miss, PathRange<TypeParam>(miss, {}), from);
      EXPECT_EQ(misses.possible, 0U);
      EXPECT_EQ(misses.certain, 0U);
    }
  });
}

/// Each lane has the verdict of its own triangle, whatever the others hold.
TYPED_TEST(BlockKernel, keeps_lanes_apart) {
  const Triangle<TypeParam> hit{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  const Triangle<TypeParam> miss{{4, -1, 0}, {6, -1, 0}, {5, 1, 0}};
  const Triangle<TypeParam> touch{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const Path<TypeParam> path = Segment<TypeParam>{{0, 0, -1}, {0, 0, 1}};
  Random random(27);
  on_every_instruction_set([&] {
    for (std::size_t i = 0; i < 200; ++i) {
      std::vector<Triangle<TypeParam>> triangles(1 + random.below(40));
      std::vector<Verdict> expected(triangles.size());
      for (std::size_t k = 0; k < triangles.size(); ++k) {
        expected[k] = static_cast<Verdict>(random.below(3));
        triangles[k] = expected[k] == Verdict::miss ? miss : expected[k] == Verdict::hit ? hit : touch;
      }
      const KernelList<TypeParam> list(triangles);
      for (std::size_t k = 0; k < triangles.size(); ++k) {
        EXPECT_EQ(list.verdict(path, PathRange<TypeParam>(path, {}), k), expected[k]);
      }
    }
  });
}

}  // namespace
}  // namespace surehit::test::block_kernel_test
