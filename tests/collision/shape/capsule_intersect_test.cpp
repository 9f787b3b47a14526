#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "support/capsule_families.hpp"
#include "support/capsule_oracle.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
class CapsuleIntersect : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(CapsuleIntersect, Scalars);

/// The number of random pairs of a family. Integers of thousands of bits take their time.
template <typename Scalar>
std::size_t count_of(CapsuleFamily family) {
  const bool is_long = family == CapsuleFamily::mixed_magnitudes;
  return case_count(sizeof(Scalar) == 4 ? (is_long ? 300 : 1000) : (is_long ? 10 : 150));
}

TYPED_TEST(CapsuleIntersect, IsRightInEveryFieldForAllFamilies) {
  for (const CapsuleFamily family : all_capsule_families) {
    Random random(7 + static_cast<std::uint64_t>(family));
    std::size_t hits = 0;
    const std::size_t count = count_of<TypeParam>(family);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [capsule, triangle] = draw_capsule_pair<TypeParam>(family, random);
      const auto hit = intersect(capsule, triangle);
      hits += hit.has_value();
      const auto error = find_error(capsule, triangle, hit);
      ASSERT_EQ(error, std::nullopt) << name_of(family) << ", case " << i;
    }
    EXPECT_GE(hits, count / 20) << name_of(family);
  }
}

}  // namespace
}  // namespace surehit::test
