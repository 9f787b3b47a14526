#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "grid/grid.hpp"
#include "support/exact_cells.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"

namespace surehit::test::grid_frame_test {
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

  /// Boxes of every size, position and thinness.
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
        box({0, 0, 7}, {1, 1, 7 + 0x1p-18F}),
        box({0, 0, 7}, {1, 1, 7 + 0x1p-21F}),
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

TYPED_TEST(GridFrameTest, steps_among_top_cells_as_the_path_is_mirrored) {
  GridFrame frame = GridFrame::around(this->box({0, 0, 0}, {5, 6, 7}), {5, 6, 7}, 16);
  frame.coarsen(4);
  ASSERT_EQ(frame.cells, (std::array<std::uint32_t, 3>{5, 6, 7}));
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const GridFrame::TopOrder& order = frame.top_orders.at(octant);
    const auto number_of = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
      if ((octant & 1) != 0) x = 4 - x;
      if ((octant & 2) != 0) y = 5 - y;
      if ((octant & 4) != 0) z = 6 - z;
      return x + 5 * y + 30 * z;
    };
    EXPECT_EQ(order.index(detail::Int4{2, 3, 4, 0}), number_of(2, 3, 4)) << octant;
    EXPECT_EQ(order.index(detail::Int4{0, 5, 1, 0}), number_of(0, 5, 1)) << octant;
    for (std::uint32_t axes = 0; axes < 8; ++axes) {
      const auto one_on = [&](int axis) { return static_cast<std::int32_t>(axes >> axis & 1); };
      const std::int32_t next = number_of(2 + one_on(0), 3 + one_on(1), 4 + one_on(2));
      EXPECT_EQ(order.step.at(axes), next - number_of(2, 3, 4)) << octant << ' ' << axes;
    }
  }
}

TYPED_TEST(GridFrameTest, box_lies_inside_the_outer_planes_by_two_paddings) {
  for (const auto& box : this->boxes()) {
    for (const std::uint32_t division : {1U, 4U, 16U}) {
      const GridFrame frame = GridFrame::around(box, {5, 6, 7}, division);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const mpq_class low = in_frame(frame, box.low)[axis];
        const mpq_class high = in_frame(frame, box.high)[axis];
        const double resolution = frame.resolution(axis);
        EXPECT_GE(low, 1.999 * frame.padding(axis));
        EXPECT_LE(high, resolution - 1.999 * frame.padding(axis));
      }
    }
  }
}

TYPED_TEST(GridFrameTest, box_fills_the_grid_where_it_is_wide_enough) {
  for (const auto& box : this->boxes()) {
    const GridFrame frame = GridFrame::around(box, {5, 6, 7}, 4);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (frame.cells[axis] == 1) continue;
      const mpq_class width = in_frame(frame, box.high)[axis] - in_frame(frame, box.low)[axis];
      EXPECT_GE(width, frame.resolution(axis) * 0.9999);
    }
    const auto i = (box.high / 2 - box.low / 2).maxCoeff();
    if (i > std::numeric_limits<TypeParam>::denorm_min()) {
      EXPECT_GT(*std::max_element(frame.cells.begin(), frame.cells.end()), 1U) << "the longest axis is divided";
    }
  }
}

TYPED_TEST(GridFrameTest, padding_is_at_most_a_sixteenth_of_a_cell_whatever_is_wished) {
  for (const auto& box : this->boxes()) {
    for (const double wish : {1.0, 100.0, 1e6, 1e12, 1e300, std::numeric_limits<double>::infinity()}) {
      for (const std::uint32_t division : {1U, 4U, 16U}) {
        const GridFrame frame = GridFrame::around(box, {wish, wish, wish}, division);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(frame.division, division);
          EXPECT_GE(frame.cells[axis], 1U);
          EXPECT_EQ(frame.resolution(axis), frame.cells[axis] * division);
          EXPECT_LE(frame.resolution(axis), std::uint32_t{1} << 15);
          EXPECT_LE(16 * frame.padding(axis), 1);
          EXPECT_GE(frame.padding(axis), 32 * 0x1p-24 * frame.resolution(axis)) << "what the roundings may add up to";
        }
      }
    }
  }
}

TYPED_TEST(GridFrameTest, has_the_resolution_that_is_wished_where_padding_allows) {
  const GridFrame frame = GridFrame::around(this->box({0, 0, 3}, {2, 1, 3}), {5, 1000, 8}, 16);
  EXPECT_EQ(frame.cells, (std::array<std::uint32_t, 3>{5, 1000, 1})) << "a flat axis has one cell";
  EXPECT_EQ(frame.resolution(1), 16'000U);
  const GridFrame fractional = GridFrame::around(this->box({0, 0, 0}, {1, 1, 1}), {0, 0.5, 2.9}, 1);
  EXPECT_EQ(fractional.cells, (std::array<std::uint32_t, 3>{1, 1, 2}));
  const GridFrame fine = GridFrame::around(this->box({0, 0, 0}, {1, 1, 1}), {1e9, 1e9, 1e9}, 16);
  EXPECT_EQ(fine.cells, (std::array<std::uint32_t, 3>{2048, 2048, 2048}));
}

/// What is multiplied by the scale in float is multiplied by the same number as in double.
TYPED_TEST(GridFrameTest, scale_is_a_float) {
  for (const auto& box : this->boxes()) {
    for (const std::uint32_t division : {1U, 16U}) {
      for (const double scale : GridFrame::around(box, {5, 600, 7}, division).scale) {
        EXPECT_GT(scale, 0);
        EXPECT_EQ(double{static_cast<float>(scale)}, scale);
      }
    }
  }
}

/// Paths are placed in float where that says exactly where the frame is.
TYPED_TEST(GridFrameTest, has_floats_where_these_hold_it) {
  const auto has_floats = [&](TypeParam low, TypeParam high) {
    return GridFrame::around(this->box({low, 0, 0}, {high, 1, 1}), {5, 6, 7}, 1).has_floats;
  };
  EXPECT_TRUE(has_floats(-3, 1));
  EXPECT_TRUE(has_floats(TypeParam{0.1F}, TypeParam{1.7F}));
  constexpr bool is_float = std::is_same_v<TypeParam, float>;
  EXPECT_EQ(has_floats(TypeParam(0.1), 2), is_float);
  EXPECT_EQ(has_floats(std::nextafter(TypeParam{1}, TypeParam{0}), 2), is_float);
  EXPECT_FALSE(has_floats(-std::ldexp(TypeParam{1}, 70), std::ldexp(TypeParam{1}, 70)));
}

/// The padding gives a vertex three roundings of float; in double it takes far less until it is rounded at last.
TYPED_TEST(GridFrameTest, places_with_few_roundings) {
  Random random(20240229);
  for (const auto& box : this->boxes()) {
    const GridFrame frame = GridFrame::around(box, {300, 7, 1e6}, 4);
    for (int i = 0; i < 300; ++i) {
      Vector3<TypeParam> point;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const TypeParam weight = random.unit<TypeParam>();
        point[k] = std::clamp(box.low[k] * (1 - weight) + box.high[k] * weight, box.low[k], box.high[k]);
      }
      const ExactPoint exact = in_frame(frame, point);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double placed = frame.to_cells(axis, frame.scaled(point[static_cast<Eigen::Index>(axis)]));
        const double resolution = frame.resolution(axis);
        EXPECT_LE(abs(mpq_class(placed) - exact[axis]), 0x1p-29 * resolution);
        const double rounded = static_cast<float>(placed);
        EXPECT_LE(abs(mpq_class(rounded) - exact[axis]), 1.5 * 0x1p-24 * resolution);
        EXPECT_GE(placed, 0);
        EXPECT_LE(placed, resolution);
      }
    }
  }
}

TYPED_TEST(GridFrameTest, scales_by_a_power_of_two) {
  const GridFrame large = GridFrame::around(this->box({0, 0, 0}, {1000, 1, 1}), {1, 1, 1}, 1);
  EXPECT_EQ(large.scaled(1000), 1000 * std::ldexp(1.0, large.exponent));
  EXPECT_EQ(large.scaled(0), 0);
  EXPECT_LT(large.exponent, 0);
  const GridFrame small = GridFrame::around(this->box({0, 0, 0}, {0x1p-100F, 0, 0}), {1, 1, 1}, 1);
  EXPECT_EQ(small.scaled(0x1p-100), std::ldexp(1.0, small.exponent - 100));
  EXPECT_GT(small.exponent, 0);
}

TYPED_TEST(GridFrameTest, brings_every_box_to_a_size_of_about_one) {
  for (const auto& box : this->boxes()) {
    const GridFrame frame = GridFrame::around(box, {1, 1, 1}, 1);
    mpq_class widest = 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const mpq_class width =
          scaled_exactly(box.high[axis], frame.exponent) - scaled_exactly(box.low[axis], frame.exponent);
      EXPECT_LE(width, 1);
      widest = std::max(widest, width);
    }
    if ((box.high / 2 - box.low / 2).maxCoeff() > std::numeric_limits<TypeParam>::denorm_min()) {
      EXPECT_GE(widest, 0.25);
    }
  }
}

}  // namespace
}  // namespace surehit::test::grid_frame_test
