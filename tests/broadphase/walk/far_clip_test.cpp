#include "walk/far_clip.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "walk_error.hpp"

namespace surehit::test::far_clip_test {
namespace {

using Status = FarClip::Status;

/// Segments from afar, beside the 16 eps R that WALK.md (L16) says the path stays within.
class FarClipTest : public WalkError<float> {
 protected:
  struct Result {
    ClippedPath clipped;
    FarClip far;
  };
  [[nodiscard]] Result clip(const Path<float>& path, float first_t = 0, float last_t = 1) const {
    ClippedPath clipped;
    const auto in_float = clipped.clip_in_float(grid_.frame(), path, first_t, last_t);
    const FarClip far(grid_.frame(), path, first_t, last_t, in_float, clipped);
    return {clipped, far};
  }

  /// Returns a segment with the same end that begins this many times as far away.
  static Path<float> from_afar(const Path<float>& path, float times) {
    return Segment<float>{path.toward + (path.start - path.toward) * times, path.toward};
  }

  [[nodiscard]] double worst_share(const Path<float>& path) const override {
    double worst = 0;
    for (const float times : {8.0F, 77.0F, 1e3F, 2e5F}) worst = std::max(worst, share_of(from_afar(path, times)));
    return worst;
  }

  /// Checks what `FarClip` says of a path, and returns the share of the bound of the walk.
  [[nodiscard]] double share_of(const Path<float>& path) const {
    const auto [clipped, far] = clip(path);
    if (far.status == Status::unknown) return 0;
    const Course course = this->course(path, clipped.octant);
    if (far.status == Status::miss) {
      EXPECT_GT(course.first, course.last) << hex_text(path) << " does not miss";
      return 0;
    }
    ++(far.is_end ? ended_ : far.is_free ? passed_ : bound_);
    expect_point(path, far);
    if (course.first > course.last) return 0;
    if (far.is_free) {
      EXPECT_GT(course.first, 0) << hex_text(path) << " begins in the box";
      EXPECT_TRUE(far.is_end || course.last < 1) << hex_text(path) << " ends in the box";
    }
    return share_for(visited_boxes(clipped), course, 16);
  }

  /// P3: the point before it is rounded to float.
  void expect_point(const Path<float>& path, const FarClip& far) const {
    EXPECT_EQ(far.point[3], 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      const mpq_class start(double{path.start[i]});
      const mpq_class exact = start + mpq_class(far.moved_t) * (mpq_class(double{path.toward[i]}) - start);
      const double size = std::fabs(path.start[i]) + std::fabs(grid_.frame().low[axis]) + std::fabs(far.point[axis]);
      const double error = mpq_class(abs(exact - mpq_class(far.point[axis]))).get_d();
      if (far.is_end) {
        EXPECT_EQ(error, 0) << hex_text(path);
      } else if (size > 0) {
        point_share_ = std::max(point_share_, error / (8 * 0x1p-53 * size));
      }
    }
  }

  mutable double point_share_ = 0;  ///< The worst share of the bound of the point.
  mutable std::size_t ended_ = 0;   ///< The number of paths that count up to their end.
  mutable std::size_t passed_ = 0;  ///< The number of paths that pass the mesh.
  mutable std::size_t bound_ = 0;   ///< The number of paths whose range may end in the mesh.
};

TEST_F(FarClipTest, stays_below_its_bounds_on_random_paths) {
  expect_below_one(draw_worst(20, 300));
  expect_below_one(point_share_);
  EXPECT_GT(ended_, 0U);
  EXPECT_GT(passed_, 0U);
}

TEST_F(FarClipTest, stays_below_its_bounds_where_hill_climbing_makes_it_worst) {
  expect_below_one(climb(12, 400));
  expect_below_one(point_share_);
  RecordProperty("worst_share_of_point", std::to_string(point_share_));
}

/// A limit of t inside of the mesh binds. One before it or beyond it does not, and the rest misses.
TEST_F(FarClipTest, knows_which_limits_bind) {
  const Box<float> box = box_of(mesh_.view());
  const Vector3<float> centre = (box.low + box.high) / 2;
  const Vector3<float> way = 100 * (box.high - box.low);
  const Path<float> through = Segment<float>{centre - way, centre + way};
  EXPECT_TRUE(clip(through).far.is_free);
  EXPECT_TRUE(clip(through, 0.25F, 0.75F).far.is_free);
  for (const auto& [first, last] : {std::array{0.5F, 1.0F}, std::array{0.0F, 0.5F}, std::array{0.5F, 0.5F}}) {
    const auto [clipped, far] = clip(through, first, last);
    EXPECT_EQ(far.status, Status::clipped);
    EXPECT_FALSE(far.is_free);
    EXPECT_LE(clipped.tau.origin[2], 0.5);
    EXPECT_GE(clipped.end + clipped.tau.origin[2], 0.5);
    EXPECT_EQ(first == 0.5F, clipped.tau.origin[2] > 0.4999);
  }
  EXPECT_EQ(clip(through, 0, 0.25F).far.status, Status::miss);
  EXPECT_EQ(clip(through, 0.75F, 1).far.status, Status::miss);
  const Path<float> into = Segment<float>{centre - way, centre};
  EXPECT_TRUE(clip(into).far.is_end);
  EXPECT_TRUE(clip(into).far.is_free);
  EXPECT_EQ(clip(into).far.moved_t, 1);
  EXPECT_FALSE(clip(into, 0, 0x1.fffffep-1F).far.is_end);
  EXPECT_FALSE(clip(into, 0, 0x1.fffffep-1F).far.is_free);
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(clip(Ray<float>{centre - way, way}, 0, infinity).far.is_free);
  EXPECT_TRUE(clip(Line<float>{centre + way, way}, -infinity, infinity).far.is_free);
  EXPECT_EQ(clip(Ray<float>{centre + way, way}, 0, infinity).far.status, Status::miss);
}

/// What it cannot clip with these bounds is clipped in double.
TEST_F(FarClipTest, leaves_the_farthest_and_the_fastest_to_double) {
  const Vector3<float> way = {0x1p24F, 0x1p23F, 0x1p22F};
  const Path<float> far = Segment<float>{-way, way};
  EXPECT_EQ(clip(far).far.status, Status::unknown);
  EXPECT_FALSE(clip(far).far.is_free);
  const ClippedPath in_double(grid_, far, 0, 1);
  const ClippedPath same = clip(far).clipped;
  EXPECT_EQ(same.status, in_double.status);
  EXPECT_EQ(same.octant, in_double.octant);
  EXPECT_EQ(clip(Ray<float>{{-100, 0, 0}, {0x1p64F, 0, 0}}, 0, 1).far.status, Status::unknown);
}

}  // namespace
}  // namespace surehit::test::far_clip_test
