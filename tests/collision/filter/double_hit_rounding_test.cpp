#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "collision/rational_determinants.hpp"
#include "coordinate_changes.hpp"
#include "double_kernel_on_targets.hpp"
#include "on_every_instruction_set.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"

namespace surehit::test::double_hit_rounding_test {
namespace {

/// Returns how much of the bound an error takes up, or 0 if the bound is too large to claim anything.
double share_of(const WordInterval& of, const mpq_class& truth) {
  if (!(of.bound < 0x1p-40 * std::fabs(of.high))) return 0;
  return mpq_class(abs(mpq_class(of.high) + mpq_class(of.low) - truth) / mpq_class(of.bound)).get_d();
}
double worst_share(const LaneHit& hit, const RationalDeterminants& of) {
  return std::max({share_of(hit.t_interval, of.height / of.det), share_of(hit.u_interval, of.u / of.det),
                   share_of(hit.v_interval, of.v / of.det)});
}

/// Pairs of one kind that meet, rounded all together and so in all lanes.
class RoundedPairs {
 public:
  void add_if_they_meet(const Path<double>& path, const Triangle<double>& triangle) {
    const RationalDeterminants of = rational_determinants(path, triangle);
    if (of.det == 0 || of.u / of.det < 0 || of.v / of.det < 0 || of.w / of.det < 0) return;
    paths_.push_back(path);
    triangles_.push_back(triangle);
    exact_.push_back(of);
  }
  [[nodiscard]] std::size_t count() const { return paths_.size(); }

  /// What is rounded is right. Returns the minimum number of pairs that an instruction set has rounded.
  std::size_t check() const {
    std::size_t min_rounded = paths_.size();
    on_every_instruction_set([&] {
      std::size_t rounded = 0;
      std::vector<LaneHit> hits(paths_.size());
      round_hits(paths_, triangles_, hits);
      for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits[i].is_known) {
          EXPECT_LE(worst_share(hits[i], exact_[i]), 1) << hex_text(paths_[i]) << hex_text(triangles_[i]);
        }
        if (!hits[i].is_rounded) continue;
        ++rounded;
        SCOPED_TRACE(hex_text(paths_[i]) + hex_text(triangles_[i]));
        const RationalDeterminants& of = exact_[i];
        EXPECT_EQ(hits[i].t, nearest<double>(of.height / of.det));
        EXPECT_EQ(hits[i].u, nearest<double>(of.u / of.det));
        EXPECT_EQ(hits[i].v, nearest<double>(of.v / of.det));
        EXPECT_EQ(hits[i].is_front, of.det > 0);
      }
      min_rounded = std::min(min_rounded, rounded);
    });
    return min_rounded;
  }

 private:
  std::vector<Path<double>> paths_;
  std::vector<Triangle<double>> triangles_;
  std::vector<RationalDeterminants> exact_;
};

class DoubleHitRoundingOnFamily : public testing::TestWithParam<PairFamily> {};

TEST_P(DoubleHitRoundingOnFamily, is_never_wrong) {
  for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
    Random random(113);
    RoundedPairs pairs;
    for (std::size_t i = case_count(1'000); i > 0; --i) {
      const auto [segment, triangle] = draw_pair<double>(GetParam(), random);
      pairs.add_if_they_meet(path_along(segment, kind), triangle);
    }
    pairs.check();
  }
}

INSTANTIATE_TEST_SUITE_P(Families, DoubleHitRoundingOnFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

/// Returns a path through a random point of the triangle. `distance` is that of its start, in sizes of the triangle.
Segment<double> segment_through(const Triangle<double>& triangle, double distance, Random& random) {
  const double b = random.unit<double>();
  const double c = (1 - b) * random.unit<double>();
  const Vector3<double> point = triangle.a + b * (triangle.b - triangle.a) + c * (triangle.c - triangle.a);
  const double size = (triangle.b - triangle.a).norm();
  const Vector3<double> way = Vector3<double>::NullaryExpr([&] { return random.symmetric<double>(); });
  const Vector3<double> start = point - distance * size * way;
  return {start, start + (1 + random.unit<double>()) * (point - start)};
}

TEST(DoubleHitRounding, rounds_nearly_all_hits_at_all_magnitudes) {
  Random random(114);
  RoundedPairs pairs;
  for (std::size_t i = case_count(3'000); i > 0; --i) {
    const auto exponent = static_cast<int>(random.between(-190, 190));
    const auto vector = [&]() -> Vector3<double> {
      return Vector3<double>::NullaryExpr([&] { return std::ldexp(random.symmetric<double>(), exponent); });
    };
    const Triangle<double> triangle{vector(), vector(), vector()};
    const double distance = std::ldexp(1.0, static_cast<int>(random.between(-4, 8)));
    pairs.add_if_they_meet(segment_through(triangle, distance, random), triangle);
  }
  EXPECT_GT(pairs.count(), case_count(3'000) / 2);
  EXPECT_GE(pairs.check(), pairs.count() * 98 / 100);
}

TEST(DoubleHitRounding, is_never_wrong_beyond_the_sizes_of_its_bound) {
  Random random(115);
  RoundedPairs pairs;
  for (std::size_t i = case_count(3'000); i > 0; --i) {
    const auto draw = [&]() -> Vector3<double> {
      const auto exponent = static_cast<int>(random.between(-1070, 1020));
      return Vector3<double>::NullaryExpr([&] { return std::ldexp(random.symmetric<double>(), exponent); });
    };
    const Triangle<double> triangle{draw(), draw(), draw()};
    if (!(triangle.b - triangle.a).allFinite() || !(triangle.c - triangle.a).allFinite()) continue;
    const Segment<double> segment = segment_through(triangle, 1, random);
    if (segment.start.allFinite() && segment.end.allFinite()) pairs.add_if_they_meet(segment, triangle);
  }
  EXPECT_GT(pairs.count(), 0U);
  pairs.check();
}

TEST(DoubleHitRounding, is_never_wrong_where_hill_climbing_makes_the_error_worst) {
  on_every_instruction_set([] {
    const std::string name = name_of_instruction_set(hwy::SupportedTargets());
    Random random(119);
    const auto worst_share_of = [](const std::array<double, 15>& x) {
      const Path<double> path = Segment<double>{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
      const Triangle<double> triangle{{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}};
      const RationalDeterminants of = rational_determinants(path, triangle);
      if (of.det == 0) return 0.0;
      LaneHit hit;
      round_hits({&path, 1}, {&triangle, 1}, {&hit, 1});
      return hit.is_known ? worst_share(hit, of) : 0;
    };
    double worst = 0;
    for (std::size_t start = 0; start < 20; ++start) {
      std::array<double, 15> best;
      double best_share = 0;
      for (std::size_t step = case_count(1'000); step > 0; --step) {
        std::array<double, 15> next = best;
        if (best_share == 0) {
          for (double& coordinate : next) coordinate = draw_coordinate<double>(random);
        } else {
          double& coordinate = next[random.below(next.size())];
          coordinate = changed_coordinate(random, coordinate);
        }
        if (const double share = worst_share_of(next); share > best_share) {
          best = next;
          best_share = share;
        }
      }
      worst = std::max(worst, best_share);
    }
    testing::Test::RecordProperty("worst_share_" + name, std::to_string(worst));
    EXPECT_LT(worst, 1) << name;
    if (runs_all_cases()) {
      EXPECT_GT(worst, 0.005) << name << ": room to waste";
    }
  });
}

/// Here t is midway between two doubles, 1 and the next one.
TEST(DoubleHitRounding, leaves_ties) {
  RoundedPairs pairs;
  const double low = -0x1p-53;
  const Triangle<double> triangle{{0, 0, low}, {1, 0, low}, {0, 1, low}};
  pairs.add_if_they_meet(Ray<double>{{0.25, 0.125, 1}, {0, 0, -1}}, triangle);
  ASSERT_EQ(pairs.count(), 1U);
  EXPECT_EQ(pairs.check(), 0U);
}

}  // namespace
}  // namespace surehit::test::double_hit_rounding_test
