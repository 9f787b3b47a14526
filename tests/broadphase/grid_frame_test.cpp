#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/exact_cells.hpp"
#include "support/scalars.hpp"
#include "surehit/grid.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
class GridFrameTest : public testing::Test {
 protected:
  static Box<Scalar> box(const Vector3<Scalar>& low, const Vector3<Scalar>& high) {
    Box<Scalar> box;
    box.low = low;
    box.high = high;
    return box;
  }

  /// Boxes of every size, place and thinness.
  static std::vector<Box<Scalar>> boxes() {
    using Limits = std::numeric_limits<Scalar>;
    const Scalar largest = Limits::max();
    const Scalar least = Limits::denorm_min();
    return {
        box({0, 0, 0}, {1, 1, 1}),
        box({-3, 5, -70}, {1, 6, 1000}),
        box({0, 0, 0}, {0, 0, 0}),
        box({1e30F, -1e30F, 0}, {1e30F, -1e30F, 0}),
        box({0, 0, 7}, {1, 1, 7}),
        box({-largest, -largest, -largest}, {largest, largest, largest}),
        box({-largest, 0, -1}, {largest, least, 1}),
        box({0, 0, 0}, {least, least, least}),
        box({-least, 0, 0}, {least, 3 * least, 0}),
        box({Limits::min(), Limits::min(), 0}, {Limits::min() * 2, Limits::min(), 0}),
        box({1e7F, -1e7F, 1e7F}, {1e7F + 1, -1e7F + 4, 1e7F}),
        box({1, 1, 1}, {1 + Limits::epsilon(), 1, 1}),
    };
  }
};
TYPED_TEST_SUITE(GridFrameTest, Scalars, ScalarNames);

constexpr double padding = GridFrame::padding;

TYPED_TEST(GridFrameTest, BoxFillsTheUnitCubeAndLiesInsideTheOuterPlanes) {
  for (const auto& box : this->boxes()) {
    const GridFrame frame = GridFrame::around(box, {5, 6, 7});
    mpq_class widest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const mpq_class low = in_frame(frame, box.low)[axis];
      const mpq_class high = in_frame(frame, box.high)[axis];
      EXPECT_LE(abs(low), 0x1p-1000) << "the origin is the low corner";
      EXPECT_LE(high, 1);
      EXPECT_GE(mpq_class(low - mpq_class(frame.plane(axis, 0))), 1.5 * padding);
      EXPECT_GE(mpq_class(mpq_class(frame.plane(axis, frame.resolution[axis])) - high), 1.5 * padding);
      widest = std::max(widest, mpq_class(high - low));
    }
    if ((box.high - box.low).maxCoeff() > 3 * std::numeric_limits<TypeParam>::denorm_min()) {
      EXPECT_GE(widest, 0.25);
    }
  }
}

TYPED_TEST(GridFrameTest, PaddingIsAtMostASixteenthOfACellWhateverIsWished) {
  for (const auto& box : this->boxes()) {
    for (const double wish : {1.0, 100.0, 1e6, 1e12, 1e300, std::numeric_limits<double>::infinity()}) {
      const GridFrame frame = GridFrame::around(box, {wish, wish, wish});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_GE(frame.resolution[axis], 1U);
        const std::uint32_t last = frame.resolution[axis];
        for (const std::uint32_t cell : {std::uint32_t{0}, last / 2, last - 1}) {
          const double size = frame.plane(axis, cell + 1) - frame.plane(axis, cell);
          EXPECT_GE(size, 16 * padding * (1 - 0x1p-18)) << "but for the rounding of planes near 1";
        }
      }
    }
  }
}

TYPED_TEST(GridFrameTest, HasTheResolutionThatIsWishedWherePaddingAllows) {
  const GridFrame frame = GridFrame::around(this->box({0, 0, 3}, {2, 1, 3}), {5, 1000, 8});
  EXPECT_EQ(frame.resolution, (std::array<std::uint32_t, 3>{5, 1000, 1})) << "a flat axis has one cell";
  const GridFrame fractional = GridFrame::around(this->box({0, 0, 0}, {1, 1, 1}), {0, 0.5, 2.9});
  EXPECT_EQ(fractional.resolution, (std::array<std::uint32_t, 3>{1, 1, 2}));
}

TYPED_TEST(GridFrameTest, PlanesRiseEvenly) {
  for (const auto& box : this->boxes()) {
    const GridFrame frame = GridFrame::around(box, {300, 300, 300});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::uint32_t cell = 0; cell < frame.resolution[axis]; ++cell) {
        const double size = frame.plane(axis, cell + 1) - frame.plane(axis, cell);
        ASSERT_GT(size, 0);
        ASSERT_NEAR(size, frame.cell_size[axis], 0x1p-50);
      }
    }
  }
}

TYPED_TEST(GridFrameTest, CellAtStandsBetweenItsPlanes) {
  for (const auto& box : this->boxes()) {
    const GridFrame frame = GridFrame::around(box, {300, 7, 1e6});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t count = frame.resolution[axis];
      for (std::uint32_t plane = 0; plane <= count; plane += 1 + count / 1000) {
        const double on = frame.plane(axis, plane);
        for (const double x :
             {std::nextafter(on, -1.0), on, std::nextafter(on, 2.0), on + 0.3 * frame.cell_size[axis]}) {
          const std::uint32_t cell = frame.cell_at(axis, x);
          ASSERT_LT(cell, count);
          EXPECT_TRUE(cell == 0 || frame.plane(axis, cell) <= x) << cell << " for " << x;
          EXPECT_TRUE(cell == count - 1 || x <= frame.plane(axis, cell + 1)) << cell << " for " << x;
        }
      }
    }
  }
}

TYPED_TEST(GridFrameTest, CellAtIsTheFirstOrTheLastForWhatLiesOutside) {
  const GridFrame frame = GridFrame::around(this->box({0, 0, 0}, {1, 1, 1}), {300, 7, 1});
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double x : {-0.1, -1e10, -1e300, -infinity}) EXPECT_EQ(frame.cell_at(axis, x), 0U);
    for (const double x : {1.1, 1e10, 1e300, infinity}) EXPECT_EQ(frame.cell_at(axis, x), frame.resolution[axis] - 1);
    EXPECT_LT(frame.cell_at(axis, std::numeric_limits<double>::quiet_NaN()), frame.resolution[axis]);
  }
}

TYPED_TEST(GridFrameTest, ScalesByAPowerOfTwo) {
  const GridFrame large = GridFrame::around(this->box({0, 0, 0}, {1000, 1, 1}), {1, 1, 1});
  EXPECT_EQ(large.scaled(1000), 1000 * std::ldexp(1.0, large.exponent));
  EXPECT_EQ(large.scaled(0), 0);
  EXPECT_LT(large.exponent, 0);
  const GridFrame small = GridFrame::around(this->box({0, 0, 0}, {0x1p-100F, 0, 0}), {1, 1, 1});
  EXPECT_EQ(small.scaled(0x1p-100), std::ldexp(1.0, small.exponent - 100));
  EXPECT_GT(small.exponent, 0);
}

}  // namespace
}  // namespace surehit::test
