#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "collision/rational_determinants.hpp"
#include "coordinate_changes.hpp"
#include "double_kernel_on_targets.hpp"
#include "error_share.hpp"
#include "filter/kernel_bound.hpp"
#include "on_every_instruction_set.hpp"
#include "support/case_count.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"

namespace surehit::test::double_kernel_test {
namespace {

using detail::Bounded;

/// Pairs, checked all together and so in all lanes.
template <typename Scalar>
class CheckedPairs {
 public:
  void add(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
    pairs_.push_back(coordinates_of(path, triangle));
    exact_.push_back(rational_determinants(path, triangle));
    text_.push_back(hex_text(path) + hex_text(triangle));
  }

  /// Returns how many quotients were told.
  std::size_t check() const {
    std::size_t told = 0;
    double worst = 0;
    on_every_instruction_set([&] {
      std::vector<LaneDeterminants> of(pairs_.size());
      double_determinants(pairs_, of);
      std::vector<Bounded> numerators;
      std::vector<Bounded> denominators;
      for (std::size_t i = 0; i < of.size(); ++i) {
        SCOPED_TRACE(text_[i]);
        expect_below_one(share_of(of[i].det, exact_[i].det), worst);
        expect_below_one(share_of(of[i].height, exact_[i].height), worst);
        expect_below_one(share_of(of[i].u, exact_[i].u), worst);
        expect_below_one(share_of(of[i].v, exact_[i].v), worst);
        for (const Bounded& numerator : {of[i].height, of[i].u, of[i].v}) {
          numerators.push_back(numerator);
          denominators.push_back(of[i].det);
        }
      }
      std::vector<std::array<double, 2>> results(numerators.size());
      quotients(numerators, denominators, results);
      for (std::size_t i = 0; i < of.size(); ++i) {
        if (!(std::fabs(of[i].det.value) > of[i].det.radius)) continue;
        SCOPED_TRACE(text_[i]);
        const RationalDeterminants& exact = exact_[i];
        expect_below_one(share_of(results[3 * i], exact.height / exact.det), worst);
        expect_below_one(share_of(results[3 * i + 1], exact.u / exact.det), worst);
        expect_below_one(share_of(results[3 * i + 2], exact.v / exact.det), worst);
        told += std::isfinite(results[3 * i][0]) && std::isfinite(results[3 * i][1]) ? 1 : 0;
      }
    });
    testing::Test::RecordProperty("worst_share", std::to_string(worst));
    return told;
  }

 private:
  static void expect_below_one(double share, double& worst) {
    EXPECT_LE(share, 1);
    worst = std::max(worst, share);
  }

  std::vector<PairCoordinates> pairs_;
  std::vector<RationalDeterminants> exact_;
  std::vector<std::string> text_;
};

class DoubleKernelOnFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  static void check() {
    Random random(61);
    CheckedPairs<Scalar> pairs;
    for (std::size_t i = case_count(1'000); i > 0; --i) {
      const auto [segment, triangle] = draw_pair<Scalar>(GetParam(), random);
      for (const PathKind kind : {PathKind::segment, PathKind::ray}) pairs.add(path_along(segment, kind), triangle);
    }
    testing::Test::RecordProperty("told", std::to_string(pairs.check()));
  }
};

TEST_P(DoubleKernelOnFamily, holds_for_float) { check<float>(); }
TEST_P(DoubleKernelOnFamily, holds_for_double) { check<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, DoubleKernelOnFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

/// Each lane at another size, so that what one overflows does nothing to its neighbour.
template <typename Scalar>
void check_all_magnitudes(int min_exponent, int max_exponent) {
  Random random(62);
  CheckedPairs<Scalar> pairs;
  for (std::size_t i = case_count(3'000); i > 0; --i) {
    const auto exponent = static_cast<int>(random.between(min_exponent, max_exponent));
    const auto vector = [&]() -> Vector3<Scalar> {
      return Vector3<Scalar>::NullaryExpr([&] {
        const int own = random.one_in(3) ? static_cast<int>(random.between(min_exponent, max_exponent)) : exponent;
        return std::ldexp(random.symmetric<Scalar>(), own);
      });
    };
    const Triangle<Scalar> triangle{vector(), vector(), vector()};
    pairs.add(Segment<Scalar>{vector(), vector()}, triangle);
  }
  EXPECT_GT(pairs.check(), instruction_sets().size() * case_count(3'000) / 40);
}

TEST(DoubleKernel, holds_at_all_magnitudes_of_float) { check_all_magnitudes<float>(-140, 127); }
TEST(DoubleKernel, holds_at_all_magnitudes_of_double) { check_all_magnitudes<double>(-1060, 1022); }
TEST(DoubleKernel, holds_at_the_sizes_up_to_which_it_knows_bounds) { check_all_magnitudes<double>(295, 302); }

/// The worst shares that errors of one pair take up of a determinant's bound and of a quotient's interval.
struct WorstShares {
  double determinant = 0;
  double quotient = 0;
};

WorstShares worst_shares(const std::array<double, 15>& x) {
  const Segment<double> segment{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  const Triangle<double> triangle{{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}};
  const PairCoordinates pair = coordinates_of(Path<double>(segment), triangle);
  LaneDeterminants of;
  double_determinants({&pair, 1}, {&of, 1});
  const RationalDeterminants exact = rational_determinants(Path<double>(segment), triangle);
  WorstShares worst;
  worst.determinant = std::max({share_of(of.det, exact.det), share_of(of.height, exact.height), share_of(of.u, exact.u),
                                share_of(of.v, exact.v)});
  if (!(std::fabs(of.det.value) > of.det.radius)) return worst;
  const std::array<Bounded, 3> numerators = {of.height, of.u, of.v};
  const std::array<Bounded, 3> denominators = {of.det, of.det, of.det};
  std::array<std::array<double, 2>, 3> results;
  quotients(numerators, denominators, results);
  worst.quotient = std::max({share_of(results[0], exact.height / exact.det), share_of(results[1], exact.u / exact.det),
                             share_of(results[2], exact.v / exact.det)});
  return worst;
}

double climb(double WorstShares::*share) {
  Random random(64);
  double worst = 0;
  for (std::size_t start = 0; start < 20; ++start) {
    std::array<double, 15> best;
    for (double& coordinate : best) coordinate = draw_coordinate<double>(random);
    double best_share = worst_shares(best).*share;
    for (std::size_t step = case_count(1'000); step > 0; --step) {
      std::array<double, 15> next = best;
      double& coordinate = next[random.below(next.size())];
      coordinate = changed_coordinate(random, coordinate);
      if (const double next_share = worst_shares(next).*share; next_share > best_share) {
        best = next;
        best_share = next_share;
      }
    }
    worst = std::max(worst, best_share);
  }
  return worst;
}

TEST(DoubleKernel, holds_where_hill_climbing_makes_the_error_worst) {
  on_every_instruction_set([] {
    const std::string name = name_of_instruction_set(hwy::SupportedTargets());
    for (const auto& [what, share] :
         {std::pair("determinants_", &WorstShares::determinant), std::pair("quotients_", &WorstShares::quotient)}) {
      const double worst = climb(share);
      testing::Test::RecordProperty("worst_share_of_" + (what + name), std::to_string(worst));
      EXPECT_LT(worst, 1) << what << name;
      if (runs_all_cases()) {
        EXPECT_GT(worst, 0.05) << what << name << ": room to waste";
      }
    }
  });
}

TEST(DoubleKernel, tells_nothing_beyond_the_size_of_its_bounds) {
  const auto of_size = [](double size) { return PairCoordinates{0, 0, -1, 0, 0, 2, -1, -1, 0, size, -1, 0, 0, 1, 0}; };
  on_every_instruction_set([&] {
    std::vector<PairCoordinates> pairs;
    for (std::size_t i = 0; i < 2 * double_lanes(); ++i) pairs.push_back(of_size(i % 2 == 0 ? 1 : 0x1p302));
    std::vector<LaneDeterminants> of(pairs.size());
    double_determinants(pairs, of);
    for (std::size_t i = 0; i < of.size(); ++i) {
      EXPECT_EQ(std::isfinite(of[i].det.radius), i % 2 == 0);
      EXPECT_EQ(std::isfinite(of[i].height.radius), i % 2 == 0);
    }
  });
}

/// Quotients of all sizes, with radii from none to nearly the whole of what they bound. Where a numerator may be
/// smaller than any exact product, its radius is that of a bound, which is never 0.
TEST(Quotients, hold_the_true_quotient_in_every_lane) {
  Random random(63);
  std::vector<Bounded> numerators;
  std::vector<Bounded> denominators;
  for (std::size_t i = case_count(20'000); i > 0; --i) {
    const int most = random.one_in(3) ? 1020 : 300;
    const auto scaled = [&] {
      return std::ldexp(random.symmetric<double>(), static_cast<int>(random.between(-most - 50, most)));
    };
    const auto radius = [&](double size) {
      switch (random.below(4)) {
        case 0:
          return 0.0;
        case 1:
          return size * std::ldexp(random.unit<double>(), -static_cast<int>(random.below(60)));
        case 2:
          return size * (1 - std::ldexp(random.unit<double>(), -static_cast<int>(random.below(53))));
        default:
          return std::ldexp(random.unit<double>(), -static_cast<int>(random.below(1070)));
      }
    };
    const double numerator = scaled();
    const double denominator = random.one_in(8)
                                   ? std::ldexp(random.symmetric<double>(), static_cast<int>(random.between(995, 1023)))
                                   : scaled();
    const Bounded by{denominator, radius(std::fabs(denominator))};
    if (!(std::fabs(denominator) > by.radius)) continue;
    Bounded of{numerator, random.one_in(8) ? std::fabs(scaled()) : radius(std::fabs(numerator))};
    if (std::fabs(numerator) < detail::min_exact_product) of.radius += detail::KernelBound<double>::underflow;
    numerators.push_back(of);
    denominators.push_back(by);
  }
  double worst = 0;
  std::size_t told = 0;
  on_every_instruction_set([&] {
    std::vector<std::array<double, 2>> results(numerators.size());
    quotients(numerators, denominators, results);
    for (std::size_t i = 0; i < results.size(); ++i) {
      for (const int n : {-1, 1}) {
        for (const int d : {-1, 1}) {
          const mpq_class truth = (mpq_class(numerators[i].value) + n * mpq_class(numerators[i].radius)) /
                                  (mpq_class(denominators[i].value) + d * mpq_class(denominators[i].radius));
          const double share = share_of(results[i], truth);
          ASSERT_LE(share, 1) << std::hexfloat << numerators[i].value << " ± " << numerators[i].radius << " by "
                              << denominators[i].value << " ± " << denominators[i].radius;
          worst = std::max(worst, share);
        }
      }
      told += std::isfinite(results[i][0]) && std::isfinite(results[i][1]) ? 1 : 0;
    }
  });
  EXPECT_GT(told, instruction_sets().size() * numerators.size() / 5);
  testing::Test::RecordProperty("worst_share", std::to_string(worst));
}

/// Their inverses are denormals, which have fewer digits.
TEST(Quotients, by_the_greatest_denominators_hold_the_true_quotient) {
  Random random(64);
  std::vector<Bounded> numerators(case_count(20'000));
  std::vector<Bounded> denominators(numerators.size());
  for (std::size_t i = 0; i < numerators.size(); ++i) {
    numerators[i] = {std::ldexp(random.symmetric<double>(), static_cast<int>(random.between(500, 1023))), 0};
    denominators[i] = {std::ldexp(2 - random.unit<double>() / 2, 1023), 0};
  }
  on_every_instruction_set([&] {
    std::vector<std::array<double, 2>> results(numerators.size());
    quotients(numerators, denominators, results);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const mpq_class truth = mpq_class(numerators[i].value) / mpq_class(denominators[i].value);
      ASSERT_LE(share_of(results[i], truth), 1)
          << std::hexfloat << numerators[i].value << " by " << denominators[i].value;
    }
  });
}

}  // namespace
}  // namespace surehit::test::double_kernel_test
