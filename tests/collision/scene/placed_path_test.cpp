#include "scene/placed_path.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "collision/filter/on_every_instruction_set.hpp"
#include "exact_path.hpp"
#include "place_lanes_on_targets.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"

namespace surehit::test::placed_path_test {
namespace {

using detail::InstanceFrame;
using detail::PathRange;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A path, an instance and the box of its mesh. All of their numbers are exact.
template <typename Scalar>
struct Case {
  detail::Placement<Scalar> placement = {};
  Box<double> box = {};
  Path<Scalar> path = Line<Scalar>{Vector3<Scalar>::Zero(), Vector3<Scalar>::Zero()};
  PathRange<Scalar> range = {0, 1};
  Scalar share = 1;

  ExactMatrix matrix = {};
  ExactMatrix inverse_matrix = {};
  ExactVector direction = {};  ///< D in the frame of the scene.

  void set_exact() {
    for (Eigen::Index i = 0; i < 3; ++i) matrix[static_cast<std::size_t>(i)] = exact(placement.pose.linear.row(i));
    inverse_matrix = inverse(matrix);
    direction = exact_direction(path);
    if (path.has_end()) direction = direction - mpq_class(double{share}) * exact(placement.motion);
  }
  /// Returns the path at t in the frame of the mesh.
  [[nodiscard]] ExactVector local_at(const mpq_class& t) const {
    return inverse_matrix * (exact(path.start) + t * direction - exact(placement.pose.translation));
  }
  /// Returns the part of the range in which the path is in the box.
  [[nodiscard]] std::optional<std::array<mpq_class, 2>> in_box() const {
    const detail::InstanceBox sides = {{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}};
    const auto inside = exact_range_in(sides, local_at(0), inverse_matrix * direction, range);
    if (!inside || !inside->first || !inside->last) return std::nullopt;
    return std::array{*inside->first, *inside->last};
  }
};

/// Returns a number of [low, high).
double real(Random& random, double low, double high) { return low + (high - low) * random.unit<double>(); }

/// Draws an instance near the origin or far away, and a path that comes near it in half of all cases.
template <typename Scalar>
Case<Scalar> draw_case(Random& random) {
  const auto number = [&](double size) { return static_cast<Scalar>(real(random, -size, size)); };
  const auto vector = [&](double size) { return Vector3<Scalar>(number(size), number(size), number(size)); };
  const double far = random.one_in(3) ? std::exp2(real(random, 0, std::is_same_v<Scalar, float> ? 20 : 40)) : 0;
  SceneFamily family = all_scene_families[random.below(all_scene_families.size() - 1)];
  Case<Scalar> drawn;
  drawn.placement.pose = draw_pose<Scalar>(family, random);
  drawn.placement.pose.translation += vector(far);
  if (random.one_in(2)) {
    drawn.placement.motion = vector(random.one_in(2) ? 1 : 1 + far);
    drawn.placement.moves = true;
    if (random.one_in(3)) drawn.share = static_cast<Scalar>(std::exp2(-real(random, 0, 140)));
  }
  const double size = std::exp2(real(random, -10, 10));
  const Vector3<Scalar> middle = vector(random.one_in(2) ? 0 : 100 * size);
  const Vector3<Scalar> one = middle + vector(size);
  const Vector3<Scalar> other = random.one_in(8) ? one : Vector3<Scalar>(middle + vector(size));
  drawn.box.extend(one.template cast<double>());
  drawn.box.extend(other.template cast<double>());
  // The path leads through a point near the mesh.
  const Vector3<double> inside = (drawn.box.low + drawn.box.high) / 2 + vector(size).template cast<double>();
  const Vector3<double> target = drawn.placement.pose.linear.template cast<double>() * inside +
                                 drawn.placement.pose.translation.template cast<double>();
  const double reach = size * std::exp2(real(random, -5, 25));
  const Vector3<double> way = vector(reach).template cast<double>();
  const double before = real(random, -0.5, 1.5);
  const Vector3<Scalar> start = (target - before * way).template cast<Scalar>();
  const Vector3<Scalar> end = (target + (1 - before) * way).template cast<Scalar>();
  const std::size_t kind = random.below(3);
  if (kind == 0) drawn.path = Segment<Scalar>{start, random.one_in(20) ? start : end};
  if (kind == 1) drawn.path = Ray<Scalar>{start, end - start};
  if (kind == 2) drawn.path = Line<Scalar>{start, end - start};
  drawn.range = PathRange<Scalar>(drawn.path, QueryOptions<Scalar>{});
  if (random.one_in(4)) drawn.range.last = static_cast<Scalar>(real(random, 0, 1));
  drawn.set_exact();
  return drawn;
}

/// The largest shares that errors took up of their bounds.
struct Shares {
  double inverse = 0, anchor = 0, start = 0, direction = 0, position = 0, reach = 0;
};

template <typename Scalar>
class PlacedPathOf : public testing::Test {};
TYPED_TEST_SUITE(PlacedPathOf, Scalars);

template <typename Scalar>
void expect_frame(const Case<Scalar>& drawn, const InstanceFrame& frame, Shares& shares) {
  mpq_class near_off;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < 3; ++j) {
      const mpq_class error = drawn.inverse_matrix[i][j] - mpq_class(frame.inverse[j][i]);
      shares.inverse = std::max(shares.inverse, share_of(error, frame.inverse_error * std::fabs(frame.inverse[j][i])));
    }
    mpq_class anchor(double{drawn.placement.pose.translation[axis]});
    for (std::size_t j = 0; j < 3; ++j) anchor += drawn.matrix[i][j] * mpq_class(frame.anchor[j]);
    anchor -= mpq_class(frame.placed_anchor[i]) + mpq_class(frame.placed_anchor_rest[i]);
    shares.anchor = std::max(shares.anchor, share_of(anchor, frame.largest_placed_anchor_error));
    anchor += mpq_class(frame.placed_anchor_rest[i]) - mpq_class(double{frame.near_rest[i]});
    near_off += abs(anchor);
  }
  EXPECT_TRUE(near_off <= mpq_class(frame.near_slack));
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

template <typename Scalar>
void expect_path(const Case<Scalar>& drawn, const detail::PlacedPath<Scalar>& placed, Shares& shares) {
  const mpq_class moved_t(placed.moved.moved_t);
  const ExactVector start = drawn.local_at(moved_t);
  const ExactVector way = drawn.inverse_matrix * drawn.direction;
  const ExactVector start_off = start - exact(placed.moved.start);
  const ExactVector way_off = way - exact(placed.moved.direction);
  shares.start = std::max(shares.start, largest_share(start_off, placed.start_error));
  shares.direction = std::max(shares.direction, largest_share(way_off, placed.direction_error));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    for (const double corner : {drawn.box.low[axis], drawn.box.high[axis]}) {
      shares.reach = std::max(shares.reach, share_of(start[i] - mpq_class(corner), placed.reach));
    }
  }
  if (const auto inside = drawn.in_box()) {
    for (const mpq_class& t : *inside) {
      const ExactVector off = start_off + (t - moved_t) * way_off;
      for (std::size_t i = 0; i < 3; ++i) {
        shares.position = std::max(shares.position, share_of(off[i], placed.moved.position_error[i]));
      }
    }
  }
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
  expect_path(drawn, placed, shares);
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
    const Case<TypeParam> drawn = draw_case<TypeParam>(random);
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
    expect_path(drawn, placed.refined(), shares);
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
        Case<TypeParam> drawn = draw_case<TypeParam>(random);
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
      Case<float> drawn = draw_case<float>(random);
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
