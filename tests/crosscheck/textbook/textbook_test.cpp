#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <string>

#include "support/case_count.hpp"
#include "variant_judge.hpp"

namespace surehit::test::textbook_test {
namespace {

template <typename Scalar>
std::size_t place_of(const char* letter) {
  return static_cast<std::size_t>(&textbook_variant<Scalar>(letter) - textbook_variants<Scalar>().data());
}

/// What the exact answers say of the variants on a family, by letter.
template <typename Scalar>
class Judged {
 public:
  explicit Judged(PairFamily family) : tallies_(judge_family<Scalar>(family, case_count(judged_pairs))) {}
  const Tally& operator[](const char* letter) const { return tallies_[place_of<Scalar>(letter)]; }

 private:
  Tallies tallies_;
};

class TextbookFamilies : public testing::TestWithParam<PairFamily> {};

template <typename Scalar>
void check_family(PairFamily family) {
  const Judged<Scalar> judged(family);
  EXPECT_EQ(judged["surehit"].false_hits, 0u);
  EXPECT_EQ(judged["surehit"].missed, 0u);
  for (const double ulps : judged["surehit"].worst_ulps) EXPECT_LE(ulps, 0.5);

  // What a smaller epsilon refuses, a larger one refuses too.
  const char* smaller = "b";
  for (const char* larger : {"d8", "d6", "d3"}) {
    EXPECT_LE(judged[larger].false_hits, judged[smaller].false_hits) << larger;
    EXPECT_GE(judged[larger].missed, judged[smaller].missed) << larger;
    smaller = larger;
  }
  // What has a det besides zero, gets the same answer without a test of it.
  EXPECT_GE(judged["c"].false_hits, judged["b"].false_hits);
  EXPECT_LE(judged["c"].missed, judged["b"].missed);
}

TEST_P(TextbookFamilies, are_right_in_surehit_and_worse_with_larger_epsilons_in_float) {
  check_family<float>(GetParam());
}
TEST_P(TextbookFamilies, are_right_in_surehit_and_worse_with_larger_epsilons_in_double) {
  check_family<double>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Families, TextbookFamilies, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
class TextbookVariants : public testing::Test {};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TextbookVariants, Scalars, );

TYPED_TEST(TextbookVariants, are_wrong_both_ways_at_edges) {
  const Judged<TypeParam> judged(PairFamily::aimed_at_edges);
  for (const auto& variant : textbook_variants<TypeParam>()) {
    if (std::string(variant.letter) == "surehit") continue;
    EXPECT_GT(judged[variant.letter].false_hits, 0u) << variant.letter;
    EXPECT_GT(judged[variant.letter].missed, 0u) << variant.letter;
  }
}

/// Watertight edges are the same numbers for both triangles but for their signs, so no segment is outside of both.
TYPED_TEST(TextbookVariants, let_segments_through_seams_unless_they_are_watertight) {
  const auto leaks = count_leaks<TypeParam>(case_count(judged_pairs));
  for (const auto& variant : textbook_variants<TypeParam>()) {
    const bool is_tight = std::string(variant.letter) == "surehit" || std::string(variant.letter) == "h";
    EXPECT_EQ(leaks[place_of<TypeParam>(variant.letter)] == 0, is_tight) << variant.letter;
  }
}

TYPED_TEST(TextbookVariants, miss_most_hits_in_the_plane) {
  const Judged<TypeParam> judged(PairFamily::overlapping_in_plane);
  for (const char* letter : {"a", "b", "d8", "d6", "d3", "e", "f", "h"}) {
    EXPECT_GT(judged[letter].missed, judged[letter].hits / 2) << letter;
  }
}

TYPED_TEST(TextbookVariants, hit_with_nan_if_nothing_is_asked_of_det) {
  EXPECT_EQ(Judged<TypeParam>(PairFamily::overlapping_in_plane)["c"].worst_ulps[0],
            std::numeric_limits<double>::infinity());
  const Judged<TypeParam> disjoint(PairFamily::disjoint_in_plane);
  EXPECT_GT(disjoint["c"].false_hits, 2 * disjoint["b"].false_hits);
}

TYPED_TEST(TextbookVariants, hit_points_anywhere_if_they_are_watertight) {
  const Judged<TypeParam> judged(PairFamily::zero_length);
  EXPECT_GT(judged["h"].false_hits, judged["h"].hits);
}

TYPED_TEST(TextbookVariants, lose_hits_to_epsilons) {
  const Judged<TypeParam> judged(PairFamily::ends_on_plane);
  EXPECT_GT(judged["d3"].missed, judged["b"].missed);
}

TYPED_TEST(TextbookVariants, confuse_front_and_back_in_the_plane) {
  const Judged<TypeParam> judged(PairFamily::overlapping_in_plane);
  EXPECT_GT(judged["g1"].false_hits, 0u);
  EXPECT_GT(judged["g2"].false_hits, 0u);
}

}  // namespace
}  // namespace surehit::test::textbook_test
