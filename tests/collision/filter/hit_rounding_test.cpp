#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "collision/rational_determinants.hpp"
#include "coordinate_changes.hpp"
#include "double_kernel_on_targets.hpp"
#include "error_share.hpp"
#include "on_every_instruction_set.hpp"
#include "support/case_count.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"

namespace surehit::test::hit_rounding_test {
namespace {

bool meet(const RationalDeterminants& of) {
  return of.det != 0 && of.u / of.det >= 0 && of.v / of.det >= 0 && of.w / of.det >= 0;
}

/// The least that may be told: |t| rounded up, and the largest component of the edges, rounded as a list keeps it.
HitSizes sizes_of(const RationalDeterminants& exact, const Triangle<float>& triangle) {
  const mpq_class t = abs(exact.height / exact.det);
  auto t_size = static_cast<float>(t.get_d());
  if (std::isfinite(t_size) && mpq_class(t_size) < t) {
    t_size = std::nextafter(t_size, std::numeric_limits<float>::infinity());
  }
  const float edge =
      std::max((triangle.b - triangle.a).cwiseAbs().maxCoeff(), (triangle.c - triangle.a).cwiseAbs().maxCoeff());
  return {t_size, edge};
}

/// Those of some pairs that meet, checked all together and so in all lanes.
class CheckedHits {
 public:
  void add_if_they_meet(const Path<float>& path, const Triangle<float>& triangle) {
    const RationalDeterminants exact = rational_determinants(path, triangle);
    if (!meet(exact)) return;
    const HitSizes sizes = sizes_of(exact, triangle);
    if (!std::isfinite(sizes.t) || !std::isfinite(sizes.edge)) return;
    pairs_.push_back(coordinates_of(path, triangle));
    sizes_.push_back(sizes);
    exact_.push_back(exact);
    text_.push_back(hex_text(path) + hex_text(triangle));
    // Nothing is known of a path without an end there.
    const double no_end = std::numeric_limits<double>::quiet_NaN();
    for (double& x : ends_.emplace_back()) x = no_end;
    if (!path.has_end()) return;
    for (std::size_t axis = 0; axis < 3; ++axis) ends_.back()[axis] = path.toward[static_cast<Eigen::Index>(axis)];
  }
  [[nodiscard]] std::size_t count() const { return pairs_.size(); }
  /// Returns how many hits were known from their own starts, on all instruction sets.
  [[nodiscard]] std::size_t known_from_hits() const { return known_from_hits_; }

  /// Returns how many intervals were told.
  std::size_t check() const {
    std::size_t told = 0;
    double worst = 0;
    on_every_instruction_set([&] {
      std::vector<LaneIntervals> of(pairs_.size());
      hit_intervals(pairs_, sizes_, of);
      for (std::size_t i = 0; i < of.size(); ++i) {
        SCOPED_TRACE(text_[i]);
        const RationalDeterminants& exact = exact_[i];
        for (const double share : {share_of(of[i].t, exact.height / exact.det), share_of(of[i].u, exact.u / exact.det),
                                   share_of(of[i].v, exact.v / exact.det)}) {
          EXPECT_LE(share, 1);
          worst = std::max(worst, share);
        }
        for (const auto& [lower, upper] : {of[i].t, of[i].u, of[i].v}) {
          told += std::isfinite(lower) && std::isfinite(upper) ? 1 : 0;
        }
      }
      worst = std::max(worst, check_from_hits());
    });
    testing::Test::RecordProperty("worst_share", std::to_string(worst));
    return told;
  }

 private:
  /// Checks intervals from starts that are moved to the hits, and returns the worst share.
  double check_from_hits() const {
    std::vector<LaneIntervals> of(pairs_.size());
    hit_intervals_from_hits(pairs_, ends_, sizes_, of);
    double worst = 0;
    for (std::size_t i = 0; i < of.size(); ++i) {
      SCOPED_TRACE(text_[i] + " from the hit");
      const RationalDeterminants& exact = exact_[i];
      if (!std::isfinite(of[i].t[0])) continue;
      ++known_from_hits_;
      for (const double share : {share_of(of[i].t, exact.height / exact.det), share_of(of[i].u, exact.u / exact.det),
                                 share_of(of[i].v, exact.v / exact.det)}) {
        EXPECT_LE(share, 1);
        worst = std::max(worst, share);
      }
    }
    return worst;
  }

  mutable std::size_t known_from_hits_ = 0;
  std::vector<std::array<double, 3>> ends_;
  std::vector<PairCoordinates> pairs_;
  std::vector<HitSizes> sizes_;
  std::vector<RationalDeterminants> exact_;
  std::vector<std::string> text_;
};

class HitIntervalsOnFamily : public testing::TestWithParam<PairFamily> {};

TEST_P(HitIntervalsOnFamily, hold_what_is_exact) {
  Random random(65);
  CheckedHits hits;
  for (std::size_t i = case_count(1'000); i > 0; --i) {
    const auto [segment, triangle] = draw_pair<float>(GetParam(), random);
    for (const PathKind kind : {PathKind::segment, PathKind::line}) {
      hits.add_if_they_meet(path_along(segment, kind), triangle);
    }
  }
  testing::Test::RecordProperty("told", std::to_string(hits.check()));
}

INSTANTIATE_TEST_SUITE_P(Families, HitIntervalsOnFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

TEST(HitIntervals, hold_what_is_exact_at_all_magnitudes) {
  Random random(66);
  CheckedHits hits;
  for (std::size_t i = case_count(3'000); i > 0; --i) {
    const auto vector_of = [&](int exponent) -> Vector3<float> {
      return Vector3<float>::NullaryExpr([&] { return std::ldexp(random.symmetric<float>(), exponent); });
    };
    const auto exponent = static_cast<int>(random.between(-110, 110));
    const Triangle<float> triangle{vector_of(exponent), vector_of(exponent), vector_of(exponent)};
    const float b = random.unit<float>();
    const float c = (1 - b) * random.unit<float>();
    const Vector3<float> point = triangle.a + b * (triangle.b - triangle.a) + c * (triangle.c - triangle.a);
    const Vector3<float> start = point + vector_of(exponent + static_cast<int>(random.between(-12, 12)));
    const Vector3<float> toward = start + (point - start) * (1 + random.unit<float>());
    hits.add_if_they_meet(Segment<float>{start, toward}, triangle);
    hits.add_if_they_meet(Ray<float>{start, toward - start}, triangle);
  }
  EXPECT_GT(hits.count(), case_count(3'000));
  EXPECT_EQ(hits.check(), instruction_sets().size() * 3 * hits.count());
}

/// Segments from far away, whose u and v are known well only from the hit.
TEST(HitIntervals, hold_what_is_exact_of_far_paths) {
  Random random(68);
  CheckedHits hits;
  for (std::size_t i = case_count(2'000); i > 0; --i) {
    const auto vector_of = [&](int exponent) -> Vector3<float> {
      return Vector3<float>::NullaryExpr([&] { return std::ldexp(random.symmetric<float>(), exponent); });
    };
    const Triangle<float> triangle{vector_of(-7), vector_of(-7), vector_of(-7)};
    const float b = random.unit<float>();
    const float c = (1 - b) * random.unit<float>();
    const Vector3<float> point = triangle.a + b * (triangle.b - triangle.a) + c * (triangle.c - triangle.a);
    const Vector3<float> start = point + vector_of(static_cast<int>(random.between(-7, 16)));
    hits.add_if_they_meet(Segment<float>{start, start + (point - start) * (1 + random.unit<float>())}, triangle);
    // From so far away, the computed direction is rounded.
    const Vector3<float> farther = point + vector_of(static_cast<int>(random.between(20, 60)));
    hits.add_if_they_meet(Segment<float>{farther, point}, triangle);
  }
  EXPECT_GT(hits.count(), case_count(1'000));
  hits.check();
  EXPECT_GT(2 * hits.known_from_hits(), hits.count());
}

double worst_share(const std::array<float, 15>& x) {
  const Path<float> path = Segment<float>{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  const Triangle<float> triangle{{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}};
  const RationalDeterminants exact = rational_determinants(path, triangle);
  if (!meet(exact)) return 0;
  const PairCoordinates pair = coordinates_of(path, triangle);
  const HitSizes sizes = sizes_of(exact, triangle);
  LaneIntervals of;
  hit_intervals({&pair, 1}, {&sizes, 1}, {&of, 1});
  LaneIntervals from_hit;
  const std::array<double, 3> end = {x[3], x[4], x[5]};
  hit_intervals_from_hits({&pair, 1}, {&end, 1}, {&sizes, 1}, {&from_hit, 1});
  double worst = 0;
  for (const LaneIntervals& intervals : {of, from_hit}) {
    worst = std::max({worst, share_of(intervals.t, exact.height / exact.det),
                      share_of(intervals.u, exact.u / exact.det), share_of(intervals.v, exact.v / exact.det)});
  }
  return worst;
}

TEST(HitIntervals, hold_what_is_exact_where_hill_climbing_makes_the_error_worst) {
  on_every_instruction_set([] {
    const std::string name = name_of_instruction_set(hwy::SupportedTargets());
    Random random(67);
    double worst = 0;
    for (std::size_t start = 0; start < 20; ++start) {
      std::array<float, 15> best;
      double best_share = 0;
      for (std::size_t step = case_count(1'000); step > 0; --step) {
        std::array<float, 15> next = best;
        if (best_share == 0) {
          for (float& coordinate : next) coordinate = draw_coordinate<float>(random);
        } else {
          float& coordinate = next[random.below(next.size())];
          coordinate = changed_coordinate(random, coordinate);
        }
        if (const double next_share = worst_share(next); next_share > best_share) {
          best = next;
          best_share = next_share;
        }
      }
      worst = std::max(worst, best_share);
    }
    testing::Test::RecordProperty("worst_share_" + name, std::to_string(worst));
    EXPECT_LT(worst, 1) << name;
    if (runs_all_cases()) {
      EXPECT_GT(worst, 0.02) << name << ": room to waste";
    }
  });
}

TEST(HitIntervals, tell_nothing_of_a_t_of_any_size) {
  const Path<float> path = Segment<float>{{0.25F, 0.25F, -1}, {0.25F, 0.25F, 1}};
  const PairCoordinates pair = coordinates_of(path, Triangle<float>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  on_every_instruction_set([&] {
    const std::vector<PairCoordinates> pairs(2 * double_lanes(), pair);
    std::vector<HitSizes> sizes;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      sizes.push_back({i % 2 == 0 ? 1 : std::numeric_limits<float>::infinity(), 1});
    }
    std::vector<LaneIntervals> of(pairs.size());
    hit_intervals(pairs, sizes, of);
    for (std::size_t i = 0; i < of.size(); ++i) {
      for (const auto& [lower, upper] : {of[i].t, of[i].u, of[i].v}) {
        EXPECT_EQ(static_cast<float>(lower) == static_cast<float>(upper), i % 2 == 0);
      }
    }
  });
}

}  // namespace
}  // namespace surehit::test::hit_rounding_test
