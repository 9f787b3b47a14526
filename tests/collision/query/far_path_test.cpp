#include "query/far_path.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "collider_state.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::far_path_test {
namespace {

using detail::FarPath;
using detail::KernelPath;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Where far paths begin for the kernel, beside the bounds P1 to P3.
class FarPathTest : public testing::Test {
 protected:
  /// Returns a path from afar that meets the mesh's box or not.
  static Path<float> draw(PathDrawer<float>& drawer) {
    const Vector3<float> target = drawer.random().one_in(2) ? drawer.point_on_mesh() : drawer.point_around_mesh();
    const Vector3<float> way = drawer.point_around_mesh() - target;
    const float times = std::exp2(3 + 15 * drawer.random().unit<float>());
    const Vector3<float> start = target + way * times;
    return drawer.any_kind({start, drawer.random().one_in(2) ? target : Vector3<float>(target - way * times)});
  }

  void attack(const GeneratedMesh<float>& mesh, std::size_t paths) {
    const Grid grid(mesh.view(), box_of(mesh.view()), {});
    const GridFrame& frame = grid.frame();
    PathDrawer<float> drawer(mesh.view(), 5);
    for (std::size_t i = case_count(paths); i > 0; --i) {
      const Path<float> path = draw(drawer);
      const float first_t = path.has_start() ? 0 : -infinity;
      const float last_t = path.has_end() ? 1 : infinity;
      ClippedPath clipped;
      const auto in_float = clipped.clip_in_float(frame, path, first_t, last_t);
      const FarClip far(frame, path, first_t, last_t, in_float, clipped);
      if (far.is_free) expect_within_bounds(path, far, frame);
    }
  }

  void expect_within_bounds(const Path<float>& path, const FarClip& far, const GridFrame& frame) {
    ++free_;
    const FarPath far_path(path, far);
    const KernelPath<float> kernel = far_path.kernel_path(frame);
    EXPECT_EQ(far_path.kernel_range().first, -infinity);
    EXPECT_EQ(far_path.kernel_range().last, far.is_end ? 0 : infinity);
    double to_corner = 0;
    double from_start = 0;
    double error = 0;
    double way = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      const mpq_class start(double{path.start[k]});
      const mpq_class toward(double{path.toward[k]});
      const mpq_class d = path.has_end() ? mpq_class(toward - start) : toward;
      const mpq_class exact = start + mpq_class(far.moved_t) * d;
      error = std::max(error, mpq_class(abs(exact - mpq_class(double{kernel.start[axis]}))).get_d());
      for (const double corner : {frame.low[axis], frame.high[axis]}) {
        to_corner = std::max(to_corner, mpq_class(abs(exact - mpq_class(corner))).get_d());
        from_start = std::max(from_start, mpq_class(abs(start - mpq_class(corner))).get_d());
      }
      way = std::max(way, mpq_class(abs(d)).get_d());
      EXPECT_EQ(kernel.d[axis], path.has_end() ? path.toward[k] - path.start[k] : path.toward[k]);
    }
    // The reach has the way to the farthest corner (P1), and the error of the start (P2). P1 leaves room for roundings.
    const double of_error = double{kernel.reach} * (1 + 0x1p-20) - to_corner;
    EXPECT_LE(error / (8 * 0x1p-24), of_error) << hex_text(path);
    if (error > 0) worst_share_ = std::max(worst_share_, error / (8 * 0x1p-24) / of_error);
    EXPECT_GE(double{kernel.d_size} * (1 + 0x1p-22), way) << hex_text(path);
    EXPECT_GE(double{far_path.reach_from_start(kernel)}, from_start) << hex_text(path);
  }

  /// The worst share of the bound of the start.
  double worst_share_ = 0;
  std::size_t free_ = 0;  ///< The number of paths whose start was moved.
};

TEST_F(FarPathTest, begins_within_its_bounds) {
  Random random(82);
  for (const float offset : {0.0F, 30.0F, 5000.0F}) {
    attack(placed<float>(rough_ground<float>(12, 0.3F, random), 3, {offset, -offset, offset}), 4'000);
  }
  EXPECT_GT(free_, 0U);
  RecordProperty("worst_share", std::to_string(worst_share_));
  EXPECT_LT(worst_share_, 1);
  EXPECT_GT(worst_share_, 0.5) << "room to waste";
}

/// The parameter of the kernel and that of the path bound each other.
TEST_F(FarPathTest, rounds_parameters_outward) {
  GeneratedMesh<float> mesh = placed<float>(lattice_cube<float>(4), 1, {0, 0, 0});
  const Grid grid(mesh.view(), box_of(mesh.view()), {});
  struct Bounds {
    float t_lower, t_upper;
  };
  Random random(83);
  for (std::size_t i = case_count(2'000); i > 0; --i) {
    const Vector3<float> way = {1000 + random.unit<float>(), random.unit<float>(), random.unit<float>()};
    const Path<float> path = Segment<float>{-way, way * (1 + random.unit<float>())};
    ClippedPath clipped;
    const auto in_float = clipped.clip_in_float(grid.frame(), path, 0, 1);
    const FarClip far(grid.frame(), path, 0, 1, in_float, clipped);
    if (!far.is_free) continue;
    const FarPath far_path(path, far);
    const float t = 0x1p-10F * random.symmetric<float>();
    Bounds bounds = {t, t};
    far_path.set_parameter(bounds);
    const mpq_class exact = mpq_class(far.moved_t) + mpq_class(double{t});
    EXPECT_LE(mpq_class(double{bounds.t_lower}), exact);
    EXPECT_GE(mpq_class(double{bounds.t_upper}), exact);
    EXPECT_GT(double{bounds.t_lower}, exact.get_d() * (1 - 0x1p-21));
    EXPECT_LT(double{bounds.t_upper}, exact.get_d() * (1 + 0x1p-21));
    const mpq_class limit = mpq_class(double{bounds.t_upper}) - mpq_class(far.moved_t);
    EXPECT_GE(mpq_class(double{detail::kernel_limit(far_path, bounds.t_upper)}), limit);
  }
  EXPECT_EQ(detail::kernel_limit(Path<float>(Segment<float>{{0, 0, 0}, {1, 1, 1}}), 0.3F), 0.3F);
}

/// The kernel decides nearly all triangles of far paths. From their own starts it decided few of those that they meet.
TEST_F(FarPathTest, leaves_few_triangles_undecided) {
  Random random(84);
  const auto mesh = placed<float>(rough_ground<float>(40, 0.3F, random), 3, {1, 2, 3});
  const Collider<float> collider(mesh.view());
  PathDrawer<float> drawer(mesh.view(), 6);
  QueryStatistics statistics;
  std::size_t hits = 0;
  for (std::size_t i = 0; i < 1'000; ++i) {
    const Vector3<float> target = drawer.point_around_mesh();
    const Vector3<float> start = target + 300 * (drawer.point_around_mesh() - target);
    const Path<float> path = Segment<float>{start, drawer.random().one_in(2) ? target : 2 * target - start};
    hits += collider.first_hit(path, {}, &statistics) ? 1 : 0;
    (void)collider.any_hit(path, {}, &statistics);
  }
  EXPECT_GT(hits, 100U);
  EXPECT_LT(statistics.undecided * 20, hits);
}

}  // namespace
}  // namespace surehit::test::far_path_test
