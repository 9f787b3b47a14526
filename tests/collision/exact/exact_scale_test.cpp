#include "exact/exact_scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "exact/exact_terms.hpp"
#include "support/scalars.hpp"

namespace surehit::test::exact_scale_test {
namespace {

using namespace detail;

/// Returns the number of bits that the type has.
template <int B>
constexpr int room_of(const WideInt<B>& /*integer*/) {
  return B;
}

/// The largest numbers that a placed triangle can have, in the smallest unit (I16).
template <typename Scalar>
class ExactScaleOf : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;
  using Size = PlacedSize<Scalar>;
  using Bits = detail::Bits<Size>;

  static constexpr Scalar largest = Limits::max();
  static constexpr Scalar smallest = Limits::denorm_min();
  static constexpr Scalar entry = 0x1p64F;

  ExactScaleOf() {
    placement.pose.linear << entry, entry, entry, entry, -entry, 0, 0, entry, -entry;
    placement.motion.setConstant(smallest);
    placement.moves = true;
  }

  static Vector3<Scalar> all(Scalar x) { return {x, x, x}; }

  /// Returns the number of bits of the largest component of S, D, E1 and E2.
  [[nodiscard]] int bits_of(const Path<Scalar>& path, const PlacedTriangle<Scalar>& triangle) const {
    const Scale<Scalar> scale(path, triangle);
    EXPECT_EQ(scale.points.exponent, Size::min_exponent);
    Differences<Size> vectors[4];
    set_vectors(path, triangle, scale, vectors[0], vectors[1], vectors[2], vectors[3]);
    int bits = 0;
    for (const auto& vector : vectors) {
      for (const auto& component : vector) bits = std::max(bits, component.bit_length());
    }
    return bits;
  }

  Placement<Scalar> placement;
};
TYPED_TEST_SUITE(ExactScaleOf, Scalars, ScalarNames);

TYPED_TEST(ExactScaleOf, integers_of_placed_triangles_need_all_of_their_bits) {
  constexpr TypeParam largest = TestFixture::largest;
  const Path<TypeParam> path = Segment<TypeParam>{this->all(largest), this->all(-largest)};
  int bits = 0;
  for (const TypeParam a : {-largest, largest}) {
    for (const TypeParam b : {-largest, largest}) {
      for (const TypeParam translation : {-largest, largest}) {
        this->placement.pose.translation = this->all(translation);
        const Triangle<TypeParam> local = {this->all(a), this->all(b), this->all(0)};
        const PlacedTriangle<TypeParam> triangle{local, this->placement, TestFixture::smallest};
        bits = std::max(bits, this->bits_of(path, triangle));
      }
    }
  }
  EXPECT_EQ(bits, TestFixture::Bits::difference);
}

TYPED_TEST(ExactScaleOf, factors_of_placed_triangles_need_all_of_their_bits) {
  using Factor = PlacedFactor<WideInt<TestFixture::Bits::difference>, TypeParam>;
  BinaryUnit unit;
  // The lowest bit of this number is the lowest one that an entry can have.
  const TypeParam odd = TypeParam{0x1p-64F} * (1 + std::numeric_limits<TypeParam>::epsilon());
  unit.include<TypeParam>({odd, TestFixture::entry, 0});
  const auto entry = Factor::entry(TestFixture::entry, unit);
  EXPECT_EQ(entry.bit_length(), room_of(entry));
  unit = {};
  unit.include<TypeParam>({TestFixture::smallest, TestFixture::largest, 1});
  EXPECT_EQ(unit.exponent, Decomposed<TypeParam>::min_exponent);
  const auto coordinate = Factor::coordinate(TestFixture::largest, -TestFixture::largest, unit);
  EXPECT_EQ(coordinate.bit_length(), room_of(coordinate));
  const auto share = Factor::share(1, unit);
  EXPECT_EQ(share.bit_length(), room_of(share));
}

}  // namespace
}  // namespace surehit::test::exact_scale_test
