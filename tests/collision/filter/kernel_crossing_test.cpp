#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "collision/drawn_triangles.hpp"
#include "collision/family_cases.hpp"
#include "collision/rational_determinants.hpp"
#include "coordinate_changes.hpp"
#include "kernel_list.hpp"
#include "on_every_instruction_set.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"

namespace surehit::test::kernel_crossing_test {
namespace {

using detail::PathRange;

template <typename Scalar>
constexpr Scalar no_limit = std::numeric_limits<Scalar>::infinity();

template <typename Scalar>
mpq_class exact_t(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  const RationalDeterminants exact = rational_determinants(path, triangle);
  return exact.height / exact.det;
}

/// Not below x.
template <typename Scalar>
Scalar rounded_up(const mpq_class& x) {
  const auto rounded = nearest<Scalar>(x);
  if (!std::isfinite(rounded)) return rounded > 0 ? rounded : std::numeric_limits<Scalar>::lowest();
  return mpq_class(double{rounded}) < x ? std::nextafter(rounded, no_limit<Scalar>) : rounded;
}

/// Where the certain hits of a list are, and what the kernel makes of some of them.
template <typename Scalar>
class CertainHits {
 public:
  CertainHits(const Path<Scalar>& path, const std::vector<Triangle<Scalar>>& triangles, const KernelList<Scalar>& list,
              const PathRange<Scalar>& range, std::size_t from)
      : path_(path), list_(list), range_(range), from_(from), certain_(list.verdicts_from(path, range, from).certain) {
    std::uint64_t certain = certain_;
    if constexpr (std::is_same_v<Scalar, float>) {
      certain |= list.in_double_from(path, range, from, no_limit<Scalar>).verdicts.certain;
    }
    for (std::uint64_t left = certain; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      t_[lane] = exact_t(path, triangles[std::min(from + lane, triangles.size() - 1)]);
    }
  }

  [[nodiscard]] std::uint64_t certain() const { return certain_; }
  [[nodiscard]] const mpq_class& t(std::size_t lane) const { return t_[lane]; }

  /// Expects that the interval holds the first t of these, and that the lanes hold every one that shares it. This is
  /// for those that do not begin after the limit. The limit takes away only what it puts out of reach.
  void expect_first(std::uint64_t certain, Scalar limit) const {
    const KernelFirst<Scalar> open = list_.first_from(path_, from_, certain, no_limit<Scalar>);
    expect_first(certain, limit, list_.first_from(path_, from_, certain, limit), open);
  }
  /// The same of what is known in double.
  void expect_first_in_double(Scalar limit) const requires std::is_same_v<Scalar, float> {
    const auto [verdicts, first] = list_.in_double_from(path_, range_, from_, limit);
    expect_first(verdicts.certain, limit, first, list_.in_double_from(path_, range_, from_, no_limit<Scalar>).first);
  }

  /// Expects that each of these is the first one where it is alone.
  void expect_first_of_one() const {
    for (std::uint64_t left = certain_; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      const KernelFirst<Scalar> lone = list_.first_of_one_from(path_, from_, lane);
      const KernelFirst<Scalar> first = list_.first_from(path_, from_, std::uint64_t{1} << lane, no_limit<Scalar>);
      EXPECT_EQ(lone.lanes, first.lanes);
      EXPECT_EQ(lone.t_lower, first.t_lower);
      EXPECT_EQ(lone.t_upper, first.t_upper);
    }
  }

 private:
  void expect_first(std::uint64_t certain, Scalar limit, const KernelFirst<Scalar>& first,
                    const KernelFirst<Scalar>& open) const {
    EXPECT_EQ(first.lanes & ~open.lanes, 0U);
    EXPECT_EQ(open.lanes & ~certain, 0U);
    EXPECT_EQ(first.t_lower, open.t_lower);
    EXPECT_EQ(first.t_upper, open.t_upper);
    std::optional<mpq_class> least;
    for (std::uint64_t left = certain; left != 0; left &= left - 1) {
      const mpq_class& t = t_[static_cast<std::size_t>(std::countr_zero(left))];
      if (!least || t < *least) least = t;
    }
    if (!least) {
      EXPECT_EQ(first.t_lower, no_limit<Scalar>);
      EXPECT_EQ(first.t_upper, no_limit<Scalar>);
      return;
    }
    EXPECT_TRUE(is_at_most(first.t_lower, *least)) << first.t_lower << " and not " << least->get_d();
    EXPECT_TRUE(is_at_least(first.t_upper, *least)) << first.t_upper << " and not " << least->get_d();
    for (std::uint64_t left = certain; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      if (t_[lane] == *least) {
        EXPECT_NE(open.lanes >> lane & 1, 0U) << "lane " << lane << " is a first one";
      }
      if ((open.lanes >> lane & 1) != 0 && is_at_least(limit, t_[lane])) {
        EXPECT_NE(first.lanes >> lane & 1, 0U) << "lane " << lane << " does not begin after the limit " << limit;
      }
    }
  }

  static bool is_at_most(Scalar x, const mpq_class& t) {
    return std::isinf(x) ? x < 0 : mpq_class(double{x}) <= t;  // a NaN has no position
  }
  static bool is_at_least(Scalar x, const mpq_class& t) { return std::isinf(x) ? x > 0 : mpq_class(double{x}) >= t; }

  const Path<Scalar>& path_;
  const KernelList<Scalar>& list_;
  PathRange<Scalar> range_;
  std::size_t from_;
  std::uint64_t certain_;
  std::array<mpq_class, 64> t_;
};

/// All of the list, a vector at a time, on every instruction set; counts the certain hits.
template <typename Scalar>
void expect_first_in_list(const Path<Scalar>& path, const std::vector<Triangle<Scalar>>& triangles,
                          const KernelList<Scalar>& list, Random& random, std::size_t& hits) {
  const PathRange<Scalar> range(path, {});
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    for (std::size_t from = 0; from < triangles.size(); from += kernel_lanes<Scalar>()) {
      const CertainHits<Scalar> certain_hits(path, triangles, list, range, from);
      const std::uint64_t certain = certain_hits.certain();
      if (certain == 0) continue;
      hits += static_cast<std::size_t>(std::popcount(certain));
      SCOPED_TRACE(
          name_of_instruction_set(target) + ": " + hex_text(path) +
          hex_text(
              triangles[std::min(from + static_cast<std::size_t>(std::countr_zero(certain)), triangles.size() - 1)]) +
          " is the first of " + std::to_string(std::popcount(certain)));
      certain_hits.expect_first(certain, no_limit<Scalar>);
      certain_hits.expect_first(certain & random.bits(), no_limit<Scalar>);
      std::uint64_t one = certain;
      for (std::uint64_t skipped = random.below(static_cast<std::uint64_t>(std::popcount(certain))); skipped > 0;
           --skipped) {
        one &= one - 1;
      }
      const mpq_class& t = certain_hits.t(static_cast<std::size_t>(std::countr_zero(one)));
      certain_hits.expect_first(certain, rounded_up<Scalar>(t));
      certain_hits.expect_first(certain, random.symmetric<Scalar>());
      certain_hits.expect_first_of_one();
      if constexpr (std::is_same_v<Scalar, float>) {
        certain_hits.expect_first_in_double(no_limit<Scalar>);
        certain_hits.expect_first_in_double(rounded_up<Scalar>(t));
      }
    }
  }
}

class KernelCrossingOnFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  void check() {
    Random random(51);
    std::size_t hits = 0;
    visit_family<Scalar>(GetParam(), 52, 500,
                         [&](const Path<Scalar>& path, const Triangle<Scalar>& triangle, const QueryOptions<Scalar>&) {
                           expect_first_in_list(path, {triangle}, KernelList<Scalar>(triangle), random, hits);
                         });
    RecordProperty("certain_hits", std::to_string(hits));
  }

  /// Every triangle against its own path and some others'.
  template <typename Scalar>
  void check_in_lists() {
    Random random(53);
    std::size_t hits = 0;
    for (std::size_t i = case_count(100); i > 0 && !HasFailure(); --i) {
      const auto [segments, triangles] = FamilyList<Scalar>(GetParam(), random);
      const KernelList<Scalar> list(triangles);
      for (std::size_t k = 0; k < 8; ++k) {
        const Path<Scalar> path =
            path_along(segments[random.below(segments.size())], static_cast<PathKind>(random.below(3)));
        expect_first_in_list(path, triangles, list, random, hits);
      }
    }
    RecordProperty("certain_hits", std::to_string(hits));
  }
};

TEST_P(KernelCrossingOnFamily, holds_for_float) { check<float>(); }
TEST_P(KernelCrossingOnFamily, holds_for_double) { check<double>(); }
TEST_P(KernelCrossingOnFamily, holds_in_lists_of_float) { check_in_lists<float>(); }
TEST_P(KernelCrossingOnFamily, holds_in_lists_of_double) { check_in_lists<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, KernelCrossingOnFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
class KernelCrossing : public testing::Test {
 protected:
  using Coordinates = std::array<Scalar, 15>;

  /// Half the width of what a certain hit's t may be, and how much of that the error takes up.
  static double share_of(const Coordinates& x, bool is_line) {
    const Segment<Scalar> segment{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
    const Triangle<Scalar> triangle{{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}};
    const Path<Scalar> path = is_line ? Path<Scalar>(Line<Scalar>{segment.start, segment.end}) : Path<Scalar>(segment);
    std::array<Scalar, 9 + 64> corners = {};
    std::copy_n(x.begin() + 6, 9, corners.begin());
    Scalar edge_size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      edge_size = std::max({edge_size, std::fabs(x[9 + k] - x[6 + k]), std::fabs(x[12 + k] - x[6 + k])});
    }
    const KernelTriangles<Scalar> list{corners.data(), 1, edge_size};
    const detail::KernelPath<Scalar> kernel_path(path, (segment.start - triangle.a).cwiseAbs().maxCoeff() - edge_size);
    const detail::RangeWeights<Scalar> weights(PathRange<Scalar>(path, {}));
    if (classify(kernel_path, weights, list, 0).certain == 0) return 0;
    const auto [lanes, lower, upper] = first_of(kernel_path, weights, list, 0, 1, no_limit<Scalar>);
    EXPECT_EQ(lanes, 1U);
    if (!std::isfinite(lower) || !std::isfinite(upper)) return 0;
    const mpq_class middle = (mpq_class(double{lower}) + mpq_class(double{upper})) / 2;
    const mpq_class half_width = (mpq_class(double{upper}) - mpq_class(double{lower})) / 2;
    return mpq_class(abs(middle - exact_t(path, triangle)) / half_width).get_d();
  }

  /// The worst share of all starts, each one made worse step by step.
  static double climb(std::size_t starts, std::size_t steps, bool is_line) {
    Random random(54);
    double worst = 0;
    for (; starts > 0; --starts) {
      Coordinates best;
      double best_share = 0;
      for (int tries = 0; best_share == 0; ++tries) {
        if (tries == 100'000) {
          ADD_FAILURE() << "nothing is known of any hit";
          return 0;
        }
        for (Scalar& coordinate : best) coordinate = draw_coordinate<Scalar>(random);
        best_share = share_of(best, is_line);
      }
      for (std::size_t step = steps; step > 0; --step) {
        Coordinates next = best;
        Scalar& coordinate = next[random.below(next.size())];
        coordinate = changed_coordinate(random, coordinate);
        if (const double share = share_of(next, is_line); share > best_share) {
          best = next;
          best_share = share;
        }
      }
      worst = std::max(worst, best_share);
    }
    return worst;
  }

  void expect_below_one(const std::string& name, double share) {
    testing::Test::RecordProperty("worst_share_" + name, std::to_string(share));
    EXPECT_LT(share, 1) << name;
  }
};
TYPED_TEST_SUITE(KernelCrossing, Scalars, ScalarNames);

/// Many triangles along a path, each hit for certain, from far apart to an ulp apart.
TYPED_TEST(KernelCrossing, holds_for_all_that_one_path_hits) {
  Random random(55);
  std::size_t hits = 0;
  for (std::size_t i = case_count(400); i > 0 && !this->HasFailure(); --i) {
    const Segment<TypeParam> segment{draw_vector<TypeParam>(random), draw_vector<TypeParam>(random)};
    const Path<TypeParam> path = path_along(segment, static_cast<PathKind>(random.below(3)));
    std::vector<Triangle<TypeParam>> triangles(1 + random.below(40));
    const TypeParam spread = std::ldexp(TypeParam{1}, -static_cast<int>(random.below(60)));
    const TypeParam first = random.template unit<TypeParam>() / 2;
    for (Triangle<TypeParam>& triangle : triangles) {
      const TypeParam t = first + spread * random.template unit<TypeParam>();
      triangle = draw_around<TypeParam>(random, segment.start + t * (segment.end - segment.start), TypeParam{0.5});
      if (random.one_in(4)) triangle = triangles.front();
      if (random.one_in(8)) std::swap(triangle.a, triangle.b);
    }
    expect_first_in_list(path, triangles, KernelList<TypeParam>(triangles), random, hits);
  }
  EXPECT_GT(hits, 10 * case_count(400));
  this->RecordProperty("certain_hits", std::to_string(hits));
}

/// Where t, det or the sizes are as large or as small as they get.
TYPED_TEST(KernelCrossing, holds_at_sizes_at_which_products_overflow_or_underflow) {
  using Limits = std::numeric_limits<TypeParam>;
  Random random(56);
  std::size_t hits = 0;
  const int most = Limits::max_exponent == 128 ? 33 : 299;
  for (std::size_t i = case_count(6'000); i > 0 && !this->HasFailure(); --i) {
    const auto scale = [&] {
      const int least = random.one_in(4) ? Limits::min_exponent : -most;
      return std::ldexp(TypeParam{1}, static_cast<int>(random.between(least, most)));
    };
    const Vector3<TypeParam> direction = scale() * draw_vector<TypeParam>(random);
    const Vector3<TypeParam> start = (random.one_in(2) ? scale() : TypeParam{0}) * draw_vector<TypeParam>(random);
    const Vector3<TypeParam> point = start + random.template unit<TypeParam>() * scale() * direction;
    if (!(point.cwiseAbs().maxCoeff() < std::ldexp(TypeParam{1}, most))) continue;
    const Triangle<TypeParam> triangle = draw_around<TypeParam>(random, point, scale());
    for (const Path<TypeParam>& path :
         {Path<TypeParam>(Ray<TypeParam>{start, direction}), Path<TypeParam>(Line<TypeParam>{start, direction}),
          Path<TypeParam>(Segment<TypeParam>{start, point + point - start})}) {
      expect_first_in_list(path, {triangle}, KernelList<TypeParam>(triangle), random, hits);
    }
  }
  EXPECT_GT(hits, case_count(2'500) * instruction_sets().size());
  this->RecordProperty("certain_hits", std::to_string(hits));
}

TYPED_TEST(KernelCrossing, holds_where_hill_climbing_makes_the_error_worst) {
  on_every_instruction_set([&] {
    const std::string name = name_of_instruction_set(hwy::SupportedTargets());
    this->expect_below_one("of_segments_" + name, this->climb(6, case_count(1'000), false));
    this->expect_below_one("of_lines_" + name, this->climb(6, case_count(1'000), true));
  });
}

TYPED_TEST(KernelCrossing, has_little_room_to_waste) { EXPECT_GT(this->climb(6, 1'000, false), 0.02); }

/// t is 1/2, and D is 2 long: 3/2 (66 eps + 1/2 · 66 eps 2) / 2 = 99 eps.
TYPED_TEST(KernelCrossing, is_as_wide_as_its_derivation) {
  const TypeParam eps = std::numeric_limits<TypeParam>::epsilon() / 2;
  const TypeParam quarter{0.25};
  const TypeParam half{0.5};
  const KernelList<TypeParam> list(Triangle<TypeParam>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Path<TypeParam> path = Segment<TypeParam>{{quarter, quarter, 1}, {quarter, quarter, -1}};
  on_every_instruction_set([&] {
    const KernelFirst<TypeParam> first = list.first_from(path, 0, 1, no_limit<TypeParam>);
    EXPECT_EQ(first.t_lower, half - 99 * eps);
    EXPECT_EQ(first.t_upper, half + 99 * eps);
  });
}

/// Else every order would be left to the narrowphase.
TYPED_TEST(KernelCrossing, tells_hits_apart_that_are_not_close) {
  constexpr TypeParam near = 4000 * std::numeric_limits<TypeParam>::epsilon();
  const Triangle<TypeParam> triangle{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  const auto at = [&](TypeParam z) {
    Triangle<TypeParam> moved = triangle;
    for (Vector3<TypeParam>* corner : {&moved.a, &moved.b, &moved.c}) (*corner)[2] = z;
    return moved;
  };
  const Path<TypeParam> path = Segment<TypeParam>{{0, 0, -1}, {0, 0, 1}};
  const KernelList<TypeParam> list(std::vector<Triangle<TypeParam>>{at(near), at(0), at(TypeParam{0.5}), at(0)});
  on_every_instruction_set([&] {
    const std::uint64_t taken = (std::uint64_t{1} << std::min<std::size_t>(4, kernel_lanes<TypeParam>())) - 1;
    const std::uint64_t ties = taken == 1 ? 1 : 0b1010 & taken;
    const auto all = list.first_from(path, 0, taken, no_limit<TypeParam>);
    EXPECT_EQ(all.lanes, ties);
    EXPECT_EQ(list.first_from(path, 0, 0b0001, no_limit<TypeParam>).lanes, 0b0001U);
    EXPECT_EQ(list.first_from(path, 0, taken, TypeParam{0.25}).lanes, 0U) << "all begin after the limit";
    EXPECT_LT(all.t_upper - all.t_lower, near);
  });
}

/// Double has 29 more bits, so the two ends are the same float or neighbours.
TEST(KernelCrossingInDouble, knows_t_to_a_float) {
  Random random(56);
  std::size_t hits = 0;
  for (std::size_t i = case_count(5'000); i > 0; --i) {
    const auto draw = [&] {
      return Vector3f(random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>());
    };
    const Trianglef triangle{draw(), draw(), draw()};
    const Pathf path = Linef{draw(), draw()};
    const PathRange<float> range(path, {});
    const KernelList<float> list(triangle);
    if (list.verdicts_from(path, range, 0).certain == 0) continue;
    const KernelFirst<float> first = list.in_double_from(path, range, 0, no_limit<float>).first;
    ++hits;
    EXPECT_EQ(first.lanes, 1U);
    EXPECT_LE(first.t_upper, std::nextafter(first.t_lower, no_limit<float>)) << hex_text(path) << hex_text(triangle);
  }
  EXPECT_GT(hits, 0U);
}

/// Nothing is known about coordinates that are too large for the bound, so nothing is left out.
TYPED_TEST(KernelCrossing, leaves_all_open_where_sizes_are_too_large) {
  const TypeParam huge = std::numeric_limits<TypeParam>::max();
  const std::vector<Triangle<TypeParam>> triangles = {{{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}},
                                                      {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}},
                                                      {{-huge, -1, 5}, {huge, -1, 5}, {0, 1, 5}}};
  const KernelList<TypeParam> list(triangles);
  const Path<TypeParam> path = Segment<TypeParam>{{0, 0, -1}, {0, 0, 1}};
  on_every_instruction_set([&] {
    const std::uint64_t taken = (std::uint64_t{1} << std::min<std::size_t>(4, kernel_lanes<TypeParam>())) - 1;
    const auto first = list.first_from(path, 0, taken, TypeParam{-7});
    EXPECT_EQ(first.lanes, taken);
    EXPECT_EQ(first.t_lower, -no_limit<TypeParam>);
    EXPECT_EQ(first.t_upper, no_limit<TypeParam>);
    if constexpr (std::is_same_v<TypeParam, float>) {
      const auto in_double = list.in_double_from(path, PathRange<TypeParam>(path, {}), 0, no_limit<TypeParam>);
      EXPECT_EQ(in_double.verdicts.certain, 0U);
      EXPECT_EQ(in_double.verdicts.possible, taken & 0b111);
    }
  });
}

}  // namespace
}  // namespace surehit::test::kernel_crossing_test
