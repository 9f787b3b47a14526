// What a device computes of a path in the frame of an instance, with roundings that Vulkan allows it. No device is
// asked.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "collision/scene/exact_matrix.hpp"
#include "device_arithmetic.hpp"
#include "gpu/scene_tree.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/pair_text.hpp"
#include "support/scene_drawer.hpp"

namespace surehit::test::gpu_placed_path_test {
namespace {

using Arithmetic = DeviceArithmetic;
using detail::DeviceInstance;
using test::exact;

Arithmetic::vec3 vector(const Vector3f& x) { return {x[0], x[1], x[2]}; }
ExactVector exact(const Arithmetic::vec3& x) {
  return {mpq_class(double{x.x.value()}), mpq_class(double{x.y.value()}), mpq_class(double{x.z.value()})};
}
mpq_class exact(const Arithmetic::FloatPair& x) {
  return mpq_class(double{x.high.value()}) + mpq_class(double{x.low.value()});
}
ExactVector exact(const Arithmetic::PairVector& x) { return {exact(x.x), exact(x.y), exact(x.z)}; }
ExactVector cross(const ExactVector& x, const ExactVector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
mpq_class dot(const ExactVector& x, const ExactVector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

/// An instance, a triangle of its mesh, and a path that comes near.
struct Case {
  explicit Case(Random& random) {
    constexpr std::array families = {SceneFamily::identity, SceneFamily::translations, SceneFamily::rotations,
                                     SceneFamily::mirrored, SceneFamily::sheared,      SceneFamily::nearly_singular};
    placed.placement.pose = draw_pose<float>(families[random.below(families.size())], random);
    const auto point = [&](int exponent) -> Vector3f {
      return Vector3f::NullaryExpr([&] { return std::ldexp(random.symmetric<float>(), exponent); });
    };
    if (random.one_in(2)) placed.placement.pose.translation = point(static_cast<int>(random.between(-10, 20)));
    placed.placement.moves = random.one_in(2);
    if (placed.placement.moves) placed.placement.motion = point(static_cast<int>(random.between(-10, 10)));
    const auto exponent = static_cast<int>(random.between(-4, 4));
    local = {point(exponent), point(exponent), point(exponent)};
    // A mesh may be far from its own origin. A start at this origin is nearly exact, so the error comes from the
    // direction, on a long way to the mesh. A start near the mesh is off by much more than its distance from it says.
    const std::uint64_t kind = random.below(6);
    const bool starts_at_origin = kind == 0;
    const bool starts_near_mesh = kind == 1;
    if (starts_at_origin || starts_near_mesh) {
      const Vector3f offset = point(exponent + (starts_at_origin ? 6 : 10));
      local = {local.a + offset, local.b + offset, local.c + offset};
    }
    box.low = local.a.cwiseMin(local.b).cwiseMin(local.c);
    box.high = local.a.cwiseMax(local.b).cwiseMax(local.c);
    placed.frame = detail::InstanceFrame::of(placed.placement, {box.low.cast<double>(), box.high.cast<double>()});
    const DeviceInstance uploaded = detail::device_instance(placed, box);
    is_on_device = (uploaded.flags & DeviceInstance::is_left_to_host) == 0;
    for (std::size_t i = 0; i < 9; ++i) {
      on_device.inverse[i] = DeviceFloat::of(uploaded.inverse[i]);
      on_device.linear[i] = DeviceFloat::of(uploaded.linear[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      on_device.translation[i] = DeviceFloat::of(uploaded.translation[i]);
      on_device.motion[i] = DeviceFloat::of(uploaded.motion[i]);
      matrix[i] = exact(placed.placement.pose.linear.row(static_cast<Eigen::Index>(i)));
    }
    on_device.share = DeviceFloat::of(uploaded.share);
    on_device.reach = DeviceFloat::of(uploaded.reach);

    // The path passes near a point of the triangle, as it is at some t.
    const bool is_segment = random.one_in(2);
    const auto weight = random.unit<float>();
    const Vector3f target =
        placed.placement.pose.linear * (local.a * weight + local.b * (1 - weight)) + placed.placement.pose.translation;
    Vector3f way = point(starts_near_mesh ? exponent : static_cast<int>(random.between(-4, 12)));
    Vector3f start = target - way * random.unit<float>();
    if (starts_at_origin) {
      start = placed.placement.pose.translation + point(-20);
      way = (target - start) * std::ldexp(1 + random.unit<float>(), static_cast<int>(random.between(-8, 0)));
    }
    path = is_segment ? Path<float>(Segment<float>{start, start + way}) : Path<float>(PathKind::line, start, way);
    inverse_matrix = inverse(matrix);
    direction = is_segment ? exact(path.toward) - exact(path.start) - exact(motion()) : exact(path.toward);
  }

  [[nodiscard]] Vector3f motion() const {
    return placed.placement.moves ? placed.placement.motion : Vector3f::Zero().eval();
  }
  [[nodiscard]] bool is_segment() const { return path.kind == PathKind::segment; }
  /// The path as the device places it, in a range of this size.
  [[nodiscard]] Arithmetic::PlacedPath on(Arithmetic& device, double max_t) const {
    const Arithmetic::vec3 start = vector(path.start);
    Arithmetic::vec3 way = vector(path.toward);
    if (is_segment()) way = device.rounded_difference_of(way, start.x, start.y, start.z);
    return device.place(on_device, start, way, is_segment(), max_t);
  }
  [[nodiscard]] ExactVector offset_of(const Vector3f& corner) const {
    return exact(path.start) - exact(placed.placement.pose.translation) - matrix * exact(corner);
  }

  detail::PlacedInstance<float> placed;
  Triangle<float> local;
  Box<float> box;
  bool is_on_device = false;
  Arithmetic::Instance on_device = {};
  Path<float> path = Line<float>{Vector3f::Zero(), Vector3f::Zero()};
  ExactMatrix matrix = {};
  ExactMatrix inverse_matrix = {};
  ExactVector direction = {};  ///< D in the frame of the scene.
};

TEST(GpuPlacedPath, is_off_by_no_more_than_its_errors) {
  double worst_start = 0;
  double worst_way = 0;
  double worst_position = 0;
  std::size_t placed_count = 0;
  on_every_device([&] {
    Arithmetic device;
    Random random(41);
    for (std::size_t i = case_count(2000); i > 0; --i) {
      const Case drawn(random);
      const double max_t = drawn.is_segment() ? 1 : 0x1p100;
      const Arithmetic::PlacedPath placed = drawn.on(device, max_t);
      if (!drawn.is_on_device || !placed.is_placed) continue;
      ++placed_count;
      const ExactVector start =
          drawn.inverse_matrix * (exact(drawn.path.start) - exact(drawn.placed.placement.pose.translation));
      const ExactVector way = drawn.inverse_matrix * drawn.direction;
      worst_start =
          std::max(worst_start, largest_share(start - exact(placed.start), double{placed.start_error.value()}));  // G15
      worst_way = std::max(worst_way, largest_share(way - exact(placed.way), double{placed.way_error.value()}));
      // Where the path comes into the box on one axis, and where it leaves it (G17).
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0) continue;
        for (const float side : {-drawn.on_device.reach.value(), drawn.on_device.reach.value()}) {
          const mpq_class t = (mpq_class(double{side}) - start[axis]) / way[axis];
          if (drawn.is_segment() && (t < 0 || t > 1)) continue;
          const ExactVector there = start + t * way;
          const mpq_class reach(double{drawn.on_device.reach.value()});
          if (abs(there[0]) > reach || abs(there[1]) > reach || abs(there[2]) > reach) continue;
          const ExactVector computed = exact(placed.start) + t * exact(placed.way);
          worst_position = std::max(worst_position, largest_share(there - computed, double{placed.padding.value()}));
        }
      }
    }
  });
  RecordProperty("worst_start", std::to_string(worst_start));
  RecordProperty("worst_way", std::to_string(worst_way));
  RecordProperty("worst_position", std::to_string(worst_position));
  EXPECT_LT(worst_start, 1);
  EXPECT_LT(worst_way, 1);
  EXPECT_LT(worst_position, 0.89);  // An eighth is for the roundings of boxes.
  if (runs_all_cases()) {
    EXPECT_GT(placed_count, 5000U);
    EXPECT_GT(worst_start, 0.3) << "room to waste";
    EXPECT_GT(worst_way, 0.25) << "room to waste";
    EXPECT_GT(worst_position, 0.15) << "room to waste";
  }
}

TEST(GpuPlacedVectors, are_off_by_no_more_than_their_errors) {
  double worst = 0;
  double worst_det = 0;
  on_every_device([&] {
    Arithmetic device;
    Random random(42);
    for (std::size_t i = case_count(1000); i > 0; --i) {
      const Case drawn(random);
      if (!drawn.is_on_device) continue;
      const Arithmetic::vec3 a = vector(drawn.local.a);
      const auto e = device.placed_edge(drawn.on_device, a, vector(drawn.local.b));
      const auto f = device.placed_edge(drawn.on_device, a, vector(drawn.local.c));
      const auto s = device.placed_offset(drawn.on_device, vector(drawn.path.start), a);
      const auto d =
          device.placed_way(drawn.on_device, vector(drawn.path.start), vector(drawn.path.toward), drawn.is_segment());
      const ExactVector exact_e = drawn.matrix * (exact(drawn.local.b) - exact(drawn.local.a));
      const ExactVector exact_f = drawn.matrix * (exact(drawn.local.c) - exact(drawn.local.a));
      const ExactVector exact_s = drawn.offset_of(drawn.local.a);
      const auto share = [&](const Arithmetic::OffVector& computed, const ExactVector& truth) {
        return largest_share(truth - exact(computed.pairs), double{computed.error.value()});
      };
      worst = std::max({worst, share(e, exact_e), share(f, exact_f), share(s, exact_s)});
      if (drawn.is_segment()) worst = std::max(worst, share(d, drawn.direction));
      const auto det_share = [&](const auto& p, const auto& q, const auto& r, const mpq_class& truth) {
        const auto computed = device.dot_of_pairs(p.pairs, device.cross_of_pairs(q.pairs, r.pairs));
        return share_of(exact(computed) - truth, double{device.off_bound_of(p, q, r).value()});
      };
      worst_det = std::max({worst_det, det_share(e, d, f, dot(exact_e, cross(drawn.direction, exact_f))),
                            det_share(f, s, e, dot(exact_f, cross(exact_s, exact_e)))});
    }
  });
  RecordProperty("worst", std::to_string(worst));
  RecordProperty("worst_det", std::to_string(worst_det));
  EXPECT_LT(worst, 1);
  EXPECT_LT(worst_det, 1);
  if (runs_all_cases()) {
    EXPECT_GT(worst, 0.05) << "room to waste";
  }
}

TEST(GpuPlacedHit, is_rounded_once_where_it_is_rounded) {
  std::size_t rounded = 0;
  on_every_device([&] {
    Arithmetic device;
    Random random(43);
    for (std::size_t i = case_count(1500); i > 0; --i) {
      const Case drawn(random);
      const ExactVector e = drawn.matrix * (exact(drawn.local.b) - exact(drawn.local.a));
      const ExactVector f = drawn.matrix * (exact(drawn.local.c) - exact(drawn.local.a));
      const ExactVector s = drawn.offset_of(drawn.local.a);
      const ExactVector p = cross(drawn.direction, f);
      const ExactVector q = cross(s, e);
      const mpq_class det = dot(e, p);
      if (!drawn.is_on_device || det == 0) continue;
      const auto hit = device.round_placed_hit(drawn.on_device, vector(drawn.path.start), vector(drawn.path.toward),
                                               drawn.is_segment(), vector(drawn.local.a), vector(drawn.local.b),
                                               vector(drawn.local.c));
      if (!hit.is_rounded) continue;
      ++rounded;
      SCOPED_TRACE(hex_text(drawn.path));
      EXPECT_EQ(hit.t.value(), nearest<float>(dot(f, q) / det));
      EXPECT_EQ(hit.u.value(), nearest<float>(dot(s, p) / det));
      EXPECT_EQ(hit.v.value(), nearest<float>(dot(drawn.direction, q) / det));
      EXPECT_EQ(hit.is_front, det > 0);
    }
  });
  if (runs_all_cases()) {
    EXPECT_GT(rounded, 2000U);
  }
}

}  // namespace
}  // namespace surehit::test::gpu_placed_path_test
