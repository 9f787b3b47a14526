// What a device decides in pairs of floats, with roundings that Vulkan allows it. No device is asked.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "collision/rational_determinants.hpp"
#include "device_arithmetic.hpp"
#include "filter/kernel_bound.hpp"
#include "path_range.hpp"
#include "support/case_count.hpp"
#include "support/neighbour.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"

namespace surehit::test::gpu_pair_kernel_test {
namespace {

using Arithmetic = DeviceArithmetic;
using detail::PathRange;

Arithmetic::vec3 vector(const Vector3f& x) { return {x[0], x[1], x[2]}; }

/// Decides a pair in a range, and expects that what is certain is so. Returns the verdict.
std::uint32_t decided(const Path<float>& path, const Triangle<float>& triangle, const PathRange<float>& range) {
  Arithmetic device;
  const detail::RangeWeights<float> weights(range);
  const auto of = device.pair_determinants_of(vector(path.start), vector(path.toward), path.kind == PathKind::segment,
                                              vector(triangle.a), vector(triangle.b), vector(triangle.c));
  const auto found = device.decide(of, {weights.t_first, weights.det_first, weights.t_last, weights.det_last});
  if (found.verdict == device.is_open) return found.verdict;
  SCOPED_TRACE(hex_text(path) + hex_text(triangle));
  const RationalDeterminants exact = rational_determinants(path, triangle);
  if (exact.det == 0) {
    ADD_FAILURE() << "the path is parallel";
    return found.verdict;
  }
  const mpq_class t = exact.height / exact.det;
  const bool is_in_range = (std::isinf(range.first) || t >= mpq_class(double{range.first})) &&
                           (std::isinf(range.last) || t <= mpq_class(double{range.last}));
  const bool is_hit = is_in_range && exact.u / exact.det >= 0 && exact.v / exact.det >= 0 && exact.w / exact.det >= 0;
  EXPECT_EQ(is_hit, found.verdict == device.is_hit);
  EXPECT_EQ(found.is_front, exact.det > 0);
  if (found.verdict == device.is_hit) {
    EXPECT_LE(mpq_class(double{found.lower.value()}), t);
    EXPECT_GE(mpq_class(double{found.upper.value()}), t);
  }
  return found.verdict;
}

TEST(GpuPairKernel, is_never_wrong_on_any_family) {
  constexpr float infinity = PathRange<float>::infinity;
  on_every_device([] {
    for (const PairFamily family : all_pair_families) {
      SCOPED_TRACE(name_of(family));
      Random random(51);
      for (std::size_t i = case_count(50); i > 0; --i) {
        const auto [segment, triangle] = draw_pair<float>(family, random);
        const Path<float> path = path_along(segment, static_cast<PathKind>(i % 3));
        const auto largest = std::max({path.start.cwiseAbs().maxCoeff(), path.toward.cwiseAbs().maxCoeff(),
                                       triangle.a.cwiseAbs().maxCoeff(), triangle.b.cwiseAbs().maxCoeff(),
                                       triangle.c.cwiseAbs().maxCoeff()});
        if (!(largest <= 0x1p33F)) continue;  // It never comes so far (G2).
        decided(path, triangle, {0, 1});
        decided(path, triangle, {-infinity, infinity});
        const RationalDeterminants of = rational_determinants(path, triangle);
        if (of.det == 0) continue;
        const auto t = static_cast<float>(mpq_class(of.height / of.det).get_d());
        if (!(std::fabs(t) <= detail::KernelBound<float>::largest_limit)) continue;
        for (const int steps : {-2, -1, 0, 1, 2}) {
          decided(path, triangle, {neighbour(t, steps), infinity});
          decided(path, triangle, {-infinity, neighbour(t, steps)});
        }
      }
    }
  });
}

/// The start is a point of the triangle, rounded to floats. So it is a few ulps in front of it or behind it.
TEST(GpuPairKernel, decides_nearly_all_paths_that_begin_at_a_surface) {
  on_every_device([] {
    Arithmetic device;
    Random random(52);
    std::size_t open = 0;
    std::size_t hits = 0;
    const std::size_t count = case_count(300);
    for (std::size_t i = 0; i < count; ++i) {
      const auto draw = [&]() -> Vector3f {
        return Vector3f::NullaryExpr([&] { return 10 * random.symmetric<float>(); });
      };
      const Triangle<float> triangle{draw(), draw(), draw()};
      const float u = 0.1F + 0.3F * random.unit<float>();
      const float v = 0.1F + 0.3F * random.unit<float>();
      const Vector3f start = triangle.a * (1 - u - v) + triangle.b * u + triangle.c * v;
      const std::uint32_t verdict = decided(Segment<float>{start, draw()}, triangle, {0, 1});
      open += verdict == device.is_open ? 1 : 0;
      hits += verdict == device.is_hit ? 1 : 0;
    }
    EXPECT_LE(open, count / 50);
    if (runs_all_cases()) {
      EXPECT_GT(hits, count / 5);
      EXPECT_LT(hits, count * 4 / 5);
    }
  });
}

}  // namespace
}  // namespace surehit::test::gpu_pair_kernel_test
