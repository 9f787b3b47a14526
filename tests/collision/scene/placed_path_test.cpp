#include "scene/placed_path.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "collision/filter/on_every_instruction_set.hpp"
#include "path_and_instance.hpp"
#include "place_lanes_on_targets.hpp"
#include "placed_path_shares.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"

namespace surehit::test::placed_path_test {
namespace {

using detail::InstanceFrame;
using detail::PathRange;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <typename Scalar>
using Case = PathAndInstance<Scalar>;

template <typename Scalar>
class PlacedPathOf : public testing::Test {};
TYPED_TEST_SUITE(PlacedPathOf, Scalars);

/// The largest shares that errors took up of their bounds.
struct Shares : PathShares {
  double inverse = 0, anchor = 0;
};

template <typename Scalar>
void expect_frame(const Case<Scalar>& drawn, const InstanceFrame& frame, Shares& shares) {
  const AnchorError error(drawn, frame);
  shares.inverse = std::max(shares.inverse, share_of_inverse(drawn, frame));
  shares.anchor = std::max(shares.anchor, largest_share(error.with_rest, frame.largest_placed_anchor_error));
  EXPECT_TRUE(AnchorError::sum(error.with_near_rest) <= mpq_class(frame.near_slack));
  const ExactVector motion = exact(drawn.placement.motion);
  for (unsigned corner = 0; corner < 8; ++corner) {
    ExactVector local;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      local[i] = (corner >> i & 1) != 0 ? drawn.box.high[axis] : drawn.box.low[axis];
    }
    const ExactVector placed = drawn.matrix * local + exact(drawn.placement.pose.translation);
    mpq_class square;
    for (std::size_t i = 0; i < 3; ++i) {
      for (const mpq_class& at : {placed[i], mpq_class(placed[i] + motion[i])}) {
        EXPECT_TRUE(frame.low[i] == -infinity || mpq_class(frame.low[i]) <= at);
        EXPECT_TRUE(frame.high[i] == infinity || mpq_class(frame.high[i]) >= at);
      }
      const mpq_class off = placed[i] - mpq_class(frame.placed_anchor[i]) - mpq_class(frame.placed_anchor_rest[i]);
      square += off * off;
    }
    EXPECT_TRUE(!frame.is_usable || square <= mpq_class(frame.radius) * mpq_class(frame.radius));
  }
  EXPECT_EQ(frame.is_mirrored, exact_determinant(drawn.placement.pose) < 0);
}

/// The kernel's sizes must include the errors of its path (I8).
template <typename MeshScalar, typename Scalar>
void expect_kernel_path(const Case<Scalar>& drawn, const detail::PlacedPath<Scalar>& placed) {
  const auto kernel = placed.template kernel_path<MeshScalar>();
  if (std::isinf(kernel.d_size)) return;
  const double eps = std::numeric_limits<MeshScalar>::epsilon() / 2;
  const mpq_class scale(placed.kernel_scale());
  const ExactVector start = drawn.local_at(mpq_class(placed.moved.moved_t));
  const ExactVector way = scale * (drawn.inverse_matrix * drawn.direction);
  mpq_class start_off, way_off, s_size, d_size;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    start_off = std::max(start_off, mpq_class(abs(start[i] - mpq_class(double{kernel.start[i]}))));
    way_off = std::max(way_off, mpq_class(abs(way[i] - mpq_class(double{kernel.d[i]}))));
    d_size = std::max(d_size, mpq_class(std::fabs(double{kernel.d[i]})));
    for (const double corner : {drawn.box.low[axis], drawn.box.high[axis]}) {
      s_size = std::max(s_size, mpq_class(abs(mpq_class(double{kernel.start[i]}) - mpq_class(corner))));
    }
  }
  EXPECT_TRUE(mpq_class(double{kernel.reach}) >= s_size + start_off / mpq_class(8 * eps));
  EXPECT_TRUE(mpq_class(double{kernel.d_size}) >= d_size + way_off / mpq_class(8 * eps));
}

/// The kernel's range must be the exact one, or the kernel must be certain of nothing.
template <typename MeshScalar, typename Scalar>
void expect_kernel_range(const Case<Scalar>& drawn, const detail::PlacedPath<Scalar>& placed) {
  const auto weights = placed.template kernel_weights<MeshScalar>();
  const mpq_class moved_t(placed.moved.moved_t);
  const mpq_class scale(placed.kernel_scale());
  const auto expect_end = [&](double t, MeshScalar t_weight, MeshScalar det_weight, int sign) {
    if (t_weight == 0) {  // There is no such end, or it is too far away for the kernel.
      EXPECT_TRUE(!weights.decides || std::isinf(t));
      return;
    }
    EXPECT_EQ(t_weight, static_cast<MeshScalar>(sign));
    EXPECT_EQ(mpq_class(double{det_weight}) * -sign * scale, mpq_class(t) - moved_t);
    EXPECT_LE(1 + std::fabs(det_weight), weights.det_size);
  };
  expect_end(drawn.range.first, weights.t_first, weights.det_first, 1);
  expect_end(drawn.range.last, weights.t_last, weights.det_last, -1);
}

template <typename Scalar>
void expect_placed(const Case<Scalar>& drawn, const detail::PlacedPath<Scalar>& placed, Shares& shares) {
  shares.include({drawn, placed});
  expect_kernel_path<Scalar>(drawn, placed);
  expect_kernel_range<Scalar>(drawn, placed);
  if constexpr (std::is_same_v<Scalar, double>) {
    expect_kernel_path<float>(drawn, placed);
    expect_kernel_range<float>(drawn, placed);
  }
}

TYPED_TEST(PlacedPathOf, IsNeverFartherOffThanItsBounds) {
  Random random(20261125);
  Shares shares;
  std::size_t near = 0;
  std::size_t beside = 0;
  const std::size_t cases = case_count(20000);
  for (std::size_t i = 0; i < cases; ++i) {
    const Case<TypeParam> drawn = draw_path_and_instance<TypeParam>(random);
    const InstanceFrame frame = InstanceFrame::of(drawn.placement, drawn.box);
    expect_frame(drawn, frame, shares);
    const detail::ScenePath<TypeParam> scene_path(drawn.path, drawn.range, drawn.share);
    const detail::PlacedPath<TypeParam> placed(scene_path, drawn.placement, frame);
    using Status = typename detail::PlacedPath<TypeParam>::Status;
    if (placed.status == Status::beside) {
      ++beside;
      EXPECT_FALSE(drawn.in_box()) << "a path that comes to the mesh is called beside it";
    }
    if (placed.status != Status::near) continue;
    ++near;
    expect_placed(drawn, placed, shares);
    shares.include({drawn, placed.refined()});
    if (testing::Test::HasFailure()) FAIL() << "case " << i;
  }
  for (const double share :
       {shares.inverse, shares.anchor, shares.start, shares.direction, shares.position, shares.reach}) {
    EXPECT_LE(share, 1);
  }
  // A bound that is far too large would hide a mistake in its derivation.
  EXPECT_GT(shares.inverse, 0.05);
  EXPECT_GT(shares.start, 0.01);
  EXPECT_GT(shares.direction, 0.01);
  EXPECT_GT(shares.reach, 0.9);
  EXPECT_GT(near, cases / 6);
  EXPECT_GT(beside, cases / 20);
  testing::Test::RecordProperty(
      "shares", testing::PrintToString(std::array{shares.inverse, shares.anchor, shares.start, shares.direction,
                                                  shares.position, shares.reach}));
}

TYPED_TEST(PlacedPathOf, HasTheSameBoundsSideBySide) {
  constexpr std::size_t lanes = detail::PlacedLanes::max_lanes;
  on_every_instruction_set([&] {
    Random random(20261126);
    Shares shares;
    std::size_t near = 0;
    std::size_t beside = 0;
    const std::size_t batches = case_count(1600);
    for (std::size_t i = 0; i < batches; ++i) {
      const auto kind = static_cast<PathKind>(random.below(3));
      std::vector<Case<TypeParam>> cases;
      while (cases.size() < lanes) {
        Case<TypeParam> drawn = draw_path_and_instance<TypeParam>(random);
        if (drawn.path.kind == kind) cases.push_back(std::move(drawn));
      }
      std::vector<InstanceFrame> frames;
      std::vector<detail::ScenePath<TypeParam>> paths;
      for (const auto& drawn : cases) {
        frames.push_back(InstanceFrame::of(drawn.placement, drawn.box));
        paths.emplace_back(drawn.path, drawn.range, drawn.share);
      }
      std::vector<PairToPlace<TypeParam>> pairs;
      for (std::size_t lane = 0; lane < lanes; ++lane) pairs.push_back({&paths[lane], &frames[lane]});
      const std::size_t count = 1 + random.below(lanes);
      detail::PlacedLanes side_by_side;
      place_side_by_side<TypeParam>(std::span(pairs).first(count), kind == PathKind::segment, side_by_side);
      EXPECT_EQ(side_by_side.near & side_by_side.beside, 0u);
      EXPECT_EQ((side_by_side.near | side_by_side.beside) >> count, 0u);
      for (std::size_t lane = 0; lane < count; ++lane) {
        const Case<TypeParam>& drawn = cases[lane];
        if ((side_by_side.beside >> lane & 1) != 0) {
          ++beside;
          EXPECT_FALSE(drawn.in_box()) << "a path that comes to the mesh is called beside it";
        }
        if ((side_by_side.near >> lane & 1) == 0) continue;
        ++near;
        expect_placed(drawn, {paths[lane], drawn.placement, frames[lane], side_by_side, lane}, shares);
      }
      if (testing::Test::HasFailure()) FAIL() << "batch " << i;
    }
    for (const double share : {shares.start, shares.direction, shares.position, shares.reach}) EXPECT_LE(share, 1);
    EXPECT_GT(near, batches / 16);
    EXPECT_GT(beside, batches / 2);
  });
}

/// What places segments of one instance takes the steps that place any pairs, and those of the kernel's paths.
TEST(PlacedSegments, HaveTheNumbersOfPlacedPaths) {
  constexpr std::size_t count = 4;
  on_every_instruction_set([&] {
    Random random(20261127);
    std::size_t near = 0;
    std::size_t usable = 0;
    std::size_t precise = 0;
    const std::size_t batches = case_count(1600);
    for (std::size_t i = 0; i < batches; ++i) {
      Case<float> drawn = draw_path_and_instance<float>(random);
      drawn.placement.moves = false;
      const InstanceFrame frame = InstanceFrame::of(drawn.placement, drawn.box);
      // In a grid that is far smaller than the mesh, the errors are too large.
      const Vector3d middle = (drawn.box.low + drawn.box.high) / 2;
      const Vector3d half = (drawn.box.high - drawn.box.low) * std::exp2(-real(random, 1, 40));
      const GridFrame grid = GridFrame::around(Box<double>{middle - half, middle + half}, {16, 9, 25}, 1);
      const PathRange<float> whole(0, 1);
      const Vector3f from = drawn.path.start;
      const Vector3f to = drawn.path.has_end() ? drawn.path.toward : Vector3f(from + drawn.path.toward);
      const std::vector<Path<float>> segments = {Segmentf{from, to}, Segmentf{to, from}, Segmentf{from, from},
                                                 Segmentf{from, (from + to) / 2}};
      std::array<float, 6 * count> numbers;
      std::vector<detail::ScenePath<float>> paths;
      for (std::size_t lane = 0; lane < count; ++lane) {
        Vector3f::Map(&numbers[6 * lane]) = segments[lane].start;
        Vector3f::Map(&numbers[6 * lane + 3]) = segments[lane].toward;
        paths.emplace_back(segments[lane], whole);
      }
      std::vector<PairToPlace<float>> pairs;
      for (const auto& path : paths) pairs.push_back({&path, &frame});
      detail::PlacedLanes expected;
      place_side_by_side<float>(pairs, true, expected);
      PlacedSegmentLanes lanes;
      if (!place_segments(frame, grid, numbers, lanes)) return;
      ASSERT_EQ(lanes.placed.near, expected.near);
      ASSERT_EQ(lanes.placed.beside, expected.beside);
      for (std::size_t lane = 0; lane < count; ++lane) {
        if ((expected.near >> lane & 1) == 0) continue;
        ++near;
        const detail::PlacedPath<float> placed(paths[lane], drawn.placement, frame, expected, lane);
        EXPECT_EQ(lanes.placed.moved_t[lane], placed.moved.moved_t);
        const bool is_precise = (lanes.precise >> lane & 1) != 0;
        precise += is_precise ? 1 : 0;
        MovedPath in_grid = placed.moved;
        for (Eigen::Index axis = 0; axis < 3; ++axis) in_grid.start[axis] = middle[axis];
        EXPECT_TRUE(!is_precise || in_grid.is_precise_in(grid));
        if ((lanes.usable >> lane & 1) == 0) continue;
        ++usable;
        const auto kernel = placed.kernel_path<float>();
        EXPECT_EQ(placed.kernel_scale(), 1);
        EXPECT_FALSE(std::isinf(kernel.d_size));
        EXPECT_EQ(std::memcmp(&lanes.kernel_paths[lane], &kernel, sizeof kernel), 0);
      }
      if (testing::Test::HasFailure()) FAIL() << "batch " << i;
    }
    EXPECT_GT(near, batches / 16);
    EXPECT_GT(usable, near / 2);
    EXPECT_GT(precise, near / 4);
    EXPECT_LT(precise, near);
  });
}

}  // namespace
}  // namespace surehit::test::placed_path_test
