#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "far_lanes_on_targets.hpp"
#include "support/instruction_sets.hpp"
#include "walk_error.hpp"

namespace surehit::test::far_lanes_test {
namespace {

constexpr float far_away = std::numeric_limits<float>::infinity();

/// Paths from afar in lanes, beside the 16 eps R that WALK.md (L16) says they stay within, and beside the bounds of the
/// kernel (P1 to P3).
class FarLanesTest : public WalkError<float> {
 protected:
  [[nodiscard]] std::vector<FarLane> clip(const std::vector<RangedFloats>& paths) const {
    return clip_from_afar(grid_.frame(), paths);
  }

  /// Returns segments with the same end that begin many times as far away.
  static std::vector<RangedFloats> from_afar(const Path<float>& path) {
    std::vector<RangedFloats> paths;
    for (const float times : {8.0F, 77.0F, 1e3F, 2e5F}) {
      paths.push_back({Segment<float>{path.toward + (path.start - path.toward) * times, path.toward}, 0, 1});
      // One that passes.
      paths.push_back({Segment<float>{paths.back().path.start, 2 * path.toward - paths.back().path.start}, 0, 1});
    }
    return paths;
  }

  [[nodiscard]] double worst_share(const Path<float>& path) const override {
    const std::vector<RangedFloats> paths = from_afar(path);
    const std::vector<FarLane> lanes = clip(paths);
    double worst = 0;
    for (std::size_t i = 0; i < lanes.size(); ++i) worst = std::max(worst, share_of(paths[i].path, lanes[i]));
    return worst;
  }

  /// Checks what a lane says of a segment, and returns the share of the bound of the walk.
  [[nodiscard]] double share_of(const Path<float>& path, const FarLane& lane) const {
    if (lane.is_near || lane.is_apart) return 0;
    const Course course = this->course(path, lane.octant);
    if (!lane.is_inside) {
      EXPECT_GT(course.first, course.last) << hex_text(path) << " does not miss";
      ++missed_;
      return 0;
    }
    if (lane.is_free) expect_kernel_path(path, lane);
    if (course.first > course.last) return 0;
    if (lane.is_free) {
      ++(lane.is_end ? ended_ : passed_);
      EXPECT_GT(course.first, 0) << hex_text(path) << " begins in the box";
      EXPECT_TRUE(lane.is_end || course.last < 1) << hex_text(path) << " ends in the box";
    }
    ClippedPath clipped;
    clipped.status = ClippedPath::Status::clipped;
    clipped.octant = lane.octant;
    clipped.start = grid_.frame().float_margin;
    clipped.rate = clipped.inverse_rate = detail::all_lanes(0.0F);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      clipped.start[axis] = lane.start[axis];
      clipped.rate[axis] = lane.rate[axis];
      clipped.inverse_rate[axis] = lane.inverse_rate[axis];
      EXPECT_EQ(lane.finest[axis], std::floor(lane.start[axis]));
    }
    clipped.inverse_rate[3] = ClippedPath::max_inverse;
    clipped.end = lane.end;
    return share_for(visited_boxes(clipped), course, 16);
  }

  /// The reach has the way to the farthest corner (P1), and the error of the start (P2, P3).
  void expect_kernel_path(const Path<float>& path, const FarLane& lane) const {
    const GridFrame& frame = grid_.frame();
    double to_corner = 0;
    double from_start = 0;
    double error = 0;
    double way = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      const mpq_class start(double{path.start[k]});
      const mpq_class d = mpq_class(double{path.toward[k]}) - start;
      const mpq_class exact = start + mpq_class(lane.moved_t) * d;
      error = std::max(error, mpq_class(abs(exact - mpq_class(double{lane.kernel.start[axis]}))).get_d());
      double on_axis = 0;
      for (const double corner : {frame.low[axis], frame.high[axis]}) {
        to_corner = std::max(to_corner, mpq_class(abs(exact - mpq_class(corner))).get_d());
        on_axis = std::max(on_axis, std::fabs(double{path.start[k]} - corner));
      }
      from_start = std::max(from_start, std::min(on_axis, mpq_class(abs(d)).get_d()));
      way = std::max(way, mpq_class(abs(d)).get_d());
      EXPECT_EQ(lane.kernel.d[axis], path.toward[k] - path.start[k]);
    }
    const double of_error = double{lane.kernel.reach} * (1 + 0x1p-20) - to_corner;
    EXPECT_LE(error / (8 * 0x1p-24), of_error) << hex_text(path);
    if (error > 0) kernel_share_ = std::max(kernel_share_, error / (8 * 0x1p-24) / of_error);
    EXPECT_GE(double{lane.kernel.d_size} * (1 + 0x1p-22), way) << hex_text(path);
    EXPECT_GE(double{lane.reach_from_start} * (1 + 0x1p-20), from_start) << hex_text(path);
  }

  mutable double kernel_share_ = 0;  ///< The worst share of the bound of the kernel's start.
  mutable std::size_t missed_ = 0;   ///< The number of paths that miss.
  mutable std::size_t ended_ = 0;    ///< The number of paths that count up to their end.
  mutable std::size_t passed_ = 0;   ///< The number of paths that pass the mesh.
};

TEST_F(FarLanesTest, stay_below_their_bounds_on_random_paths) {
  double worst = 0;
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    SCOPED_TRACE(name_of_instruction_set(target));
    worst = std::max(worst, draw_worst(4, 60));
  }
  expect_below_one(worst);
  expect_below_one(kernel_share_);
  EXPECT_GT(kernel_share_, 0.5) << "room to waste";
  EXPECT_GT(missed_, 0U);
  EXPECT_GT(ended_, 0U);
  EXPECT_GT(passed_, 0U);
}

TEST_F(FarLanesTest, stay_below_their_bounds_where_hill_climbing_makes_it_worst) { expect_below_one(climb(6, 150)); }

/// A limit of t inside of the mesh binds. One before it or beyond it does not, and the rest misses.
TEST_F(FarLanesTest, know_which_limits_bind) {
  const Box<float> box = box_of(mesh_.view());
  const Vector3<float> centre = (box.low + box.high) / 2;
  const Vector3<float> way = 100 * (box.high - box.low);
  const Path<float> through = Segment<float>{centre - way, centre + way};
  const Path<float> into = Segment<float>{centre - way, centre};
  const float before_end = 0x1.fffffep-1F;
  const std::vector<RangedFloats> segments = {
      {through, 0, 1},     {through, 0.25F, 0.75F}, {through, 0.5F, 1},      {through, 0, 0.5F}, {through, 0.5F, 0.5F},
      {through, 0, 0.25F}, {through, 0.75F, 1},     {through, 0.75F, 0.25F}, {into, 0, 1},       {into, 0, before_end}};
  const std::vector<RangedFloats> rays = {{Ray<float>{centre - way, way}, 0, far_away},
                                          {Ray<float>{centre + way, way}, 0, far_away}};
  const std::vector<RangedFloats> lines = {{Line<float>{centre + way, way}, -far_away, far_away}};
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    SCOPED_TRACE(name_of_instruction_set(target));
    const std::vector<FarLane> lanes = clip(segments);
    if (lanes.empty()) continue;
    const std::array<bool, 10> is_inside = {true, true, true, true, true, false, false, false, true, true};
    const std::array<bool, 10> is_free = {true, true, false, false, false, false, false, false, true, false};
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      SCOPED_TRACE(i);
      EXPECT_FALSE(lanes[i].is_near || lanes[i].is_apart);
      EXPECT_EQ(lanes[i].is_inside, is_inside[i]);
      EXPECT_EQ(lanes[i].is_free, is_free[i]);
      EXPECT_EQ(lanes[i].is_end, i == 8);
      if (!is_inside[i]) continue;
      const double begin = double{lanes[i].enters} + double{lanes[i].enters_rest};
      EXPECT_EQ(begin > 0.4999, i == 2 || i == 4 || i >= 8);
      EXPECT_GE(lanes[i].end + begin, i < 8 ? 0.5 : before_end);
    }
    EXPECT_EQ(lanes[8].moved_t, 1);
    EXPECT_TRUE(clip(rays)[0].is_free);
    EXPECT_FALSE(clip(rays)[1].is_inside);
    EXPECT_TRUE(clip(lines)[0].is_free);
  }
}

/// What an axis says of a box where the path hardly moves, or does not move at all (L17).
TEST_F(FarLanesTest, know_a_box_beside_which_they_stand) {
  const Box<float> box = box_of(mesh_.view());
  const Vector3<float> size = box.high - box.low;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const float tiny : {0.0F, 0x1p-149F, 0x1p-120F}) {
      std::vector<RangedFloats> rays;
      for (const float side :
           {box.low[axis], box.high[axis], box.low[axis] - size[axis], box.high[axis] + size[axis]}) {
        Vector3<float> way = size;
        Vector3<float> start = (box.low + box.high) / 2 - 50 * size;
        way[axis] = tiny;
        start[axis] = side;
        rays.push_back({Ray<float>{start, way}, 0, far_away});
      }
      const std::vector<FarLane> lanes = clip(rays);
      for (std::size_t i = 0; i < lanes.size(); ++i) {
        EXPECT_EQ(lanes[i].is_inside || lanes[i].is_apart, i < 2) << hex_text(rays[i].path);
      }
    }
  }
}

/// What cannot be clipped with these bounds is clipped in another way.
TEST_F(FarLanesTest, leave_the_farthest_and_the_fastest_apart) {
  const Box<float> box = box_of(mesh_.view());
  const Vector3<float> centre = (box.low + box.high) / 2;
  const auto start = [&](float distance) -> Vector3<float> { return {centre[0] - distance, centre[1], centre[2]}; };
  const std::vector<FarLane> far = clip({{Ray<float>{start(0x1p26F), {1, 0, 0}}, 0, far_away}});
  const std::vector<FarLane> fast = clip({{Ray<float>{start(100), {0x1p64F, 0, 0}}, 0, 1}});
  const std::vector<FarLane> slow = clip({{Ray<float>{start(100), {0x1p-40F, 0, 0}}, 0, far_away}});
  for (const std::vector<FarLane>& lanes : {far, fast, slow}) {
    if (lanes.empty()) continue;
    EXPECT_TRUE(lanes[0].is_apart);
    EXPECT_FALSE(lanes[0].is_inside || lanes[0].is_free);
  }
}

}  // namespace
}  // namespace surehit::test::far_lanes_test
