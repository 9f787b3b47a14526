#include "scene/placed_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "collision/filter/coordinate_changes.hpp"
#include "exact_matrix.hpp"
#include "support/case_count.hpp"
#include "support/hill_climb.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"

namespace surehit::test::placed_shape_test {
namespace {

using detail::InstanceFrame;
using detail::PlacedShape;

/// A ball, an instance and a triangle of its mesh. All of their numbers are exact. The box and the capsule go the same
/// way.
template <typename Scalar>
struct Case {
  detail::Placement<Scalar> placement;
  SweptSphere<Scalar> sphere;
  Vector3<Scalar> half;  ///< The half axis of the capsule. Without its signs, the half extents of the box.
  std::array<Vector3<Scalar>, 3> corners;
  Scalar share = 1;  ///< The share of the motion that the shape sees.
  InstanceFrame frame;

  ExactMatrix matrix;
  ExactVector origin;  ///< Where the anchor is.

  void set_exact() {
    Box<double> box;
    for (const auto& corner : corners) box.extend(corner.template cast<double>());
    frame = InstanceFrame::of(placement, box);
    for (Eigen::Index i = 0; i < 3; ++i) matrix[static_cast<std::size_t>(i)] = exact(placement.pose.linear.row(i));
    origin = matrix * exact(frame.anchor) + exact(placement.pose.translation);
  }
  /// Returns the centre at an end of the step, as the instance sees it, less the placed anchor.
  [[nodiscard]] ExactVector start() const { return exact(sphere.start) - origin; }
  [[nodiscard]] SweptBox<Scalar> box() const { return {sphere.start, sphere.end, half.cwiseAbs()}; }
  [[nodiscard]] SweptCapsule<Scalar> capsule() const { return {sphere.start, sphere.end, half, sphere.radius}; }
  [[nodiscard]] ExactVector end() const {
    return exact(sphere.end) - mpq_class(double{share}) * exact(placement.motion) - origin;
  }
};

/// Draws an instance near the origin or far away, and a ball that comes near it.
template <typename Scalar>
Case<Scalar> draw_case(Random& random) {
  const auto real = [&](double low, double high) { return low + (high - low) * random.unit<double>(); };
  const auto number = [&](double size) { return static_cast<Scalar>(real(-size, size)); };
  const auto vector = [&](double size) { return Vector3<Scalar>(number(size), number(size), number(size)); };
  const double far = random.one_in(3) ? std::exp2(real(0, std::is_same_v<Scalar, float> ? 20 : 40)) : 0;
  Case<Scalar> drawn;
  drawn.placement.pose = draw_pose<Scalar>(all_scene_families[random.below(all_scene_families.size() - 1)], random);
  drawn.placement.pose.translation += vector(far);
  if (random.one_in(2)) {
    drawn.placement.motion = vector(random.one_in(2) ? 1 : 1 + far);
    drawn.placement.moves = true;
    if (random.one_in(2)) drawn.share = static_cast<Scalar>(std::exp2(real(random.one_in(2) ? -64 : -2, 0)));
  }
  const double size = std::exp2(real(-10, 10));
  const Vector3<Scalar> middle = vector(random.one_in(2) ? 0 : 100 * size);
  for (auto& corner : drawn.corners) corner = middle + vector(size);
  const Vector3<Scalar> image = drawn.placement.pose.linear * middle + drawn.placement.pose.translation;
  const double reach = size * std::exp2(real(-5, 25));
  drawn.sphere.start = image + vector(reach);
  drawn.sphere.end = drawn.sphere.start + vector(reach);
  drawn.sphere.radius = random.one_in(2) ? Scalar{0} : static_cast<Scalar>(size * std::exp2(real(-60, 20)));
  drawn.half = random.one_in(4) ? Vector3<Scalar>::Zero() : vector(size * std::exp2(real(-40, 10)));
  drawn.set_exact();
  return drawn;
}

double length(const ExactVector& x) { return std::sqrt(mpq_class(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).get_d()); }

template <typename Scalar>
class PlacedShapeOf : public testing::Test {};
TYPED_TEST_SUITE(PlacedShapeOf, Scalars, ScalarNames);

/// The ball near the anchor is larger by what the centre and the corners are off (I12).
template <typename Scalar>
double share_near_anchor(const Case<Scalar>& drawn, const PlacedShape& placed) {
  std::array<Scalar, 9> coordinates;
  std::array<double, 9> out;
  for (std::size_t k = 0; k < 9; ++k) coordinates[k] = drawn.corners[k / 3][static_cast<Eigen::Index>(k % 3)];
  placed.place(coordinates.data(), 1, 1, 1, out.data());
  double corners_off = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactVector from_anchor = exact(drawn.corners[k]) - exact(drawn.frame.anchor);
    const ExactVector computed = {mpq_class(out[3 * k]), mpq_class(out[3 * k + 1]), mpq_class(out[3 * k + 2])};
    corners_off = std::max(corners_off, length(drawn.matrix * from_anchor - computed));
  }
  const double centre_off = std::max(length(drawn.start() - exact(placed.near_anchor(drawn.sphere).start)),
                                     length(drawn.end() - exact(placed.near_anchor(drawn.sphere).end)));
  const mpq_class slack = mpq_class(placed.near_anchor(drawn.sphere).radius) - mpq_class(double{drawn.sphere.radius});
  EXPECT_GT(slack, 0);
  return (centre_off + corners_off) / slack.get_d();
}

/// What a shape without a radius reaches along a row of the inverse.
template <typename Scalar>
mpq_class core_reach(const SweptSphere<Scalar>&, const ExactVector&) {
  return 0;
}
template <typename Scalar>
mpq_class core_reach(const SweptBox<Scalar>& box, const ExactVector& row) {
  const ExactVector half = exact(box.half_extents);
  return abs(row[0]) * half[0] + abs(row[1]) * half[1] + abs(row[2]) * half[2];
}
template <typename Scalar>
mpq_class core_reach(const SweptCapsule<Scalar>& capsule, const ExactVector& row) {
  const ExactVector half = exact(capsule.half_axis);
  return abs(row[0] * half[0] + row[1] * half[1] + row[2] * half[2]);
}

/// The box in the mesh holds the image of the shape at both ends of the step, and so between them (I13). Returns the
/// largest share that an error takes up of what is there for it, if this is all that there is.
template <typename Scalar, typename Shape>
double share_in_mesh(const Case<Scalar>& drawn, const Shape& shape, const mpq_class& radius) {
  const PlacedShape placed(shape, drawn.placement, drawn.frame, drawn.share);
  EXPECT_TRUE(placed.is_usable());
  const ExactMatrix inverse_matrix = inverse(drawn.matrix);
  const ExactVector anchor = exact(drawn.frame.anchor);
  const ExactVector start = anchor + inverse_matrix * drawn.start();
  const ExactVector end = anchor + inverse_matrix * drawn.end();
  double share = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ExactVector& row = inverse_matrix[i];
    const mpq_class square = radius * radius * (row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    const mpq_class core = core_reach(shape, row);
    const mpq_class off = std::max(mpq_class(abs(start[i] - mpq_class(placed.in_mesh().start[i]))),
                                   mpq_class(abs(end[i] - mpq_class(placed.in_mesh().end[i]))));
    const mpq_class left = mpq_class(placed.in_mesh().half_extents[i]) - off - core;
    EXPECT_TRUE(left >= 0 && left * left >= square);
    if (radius == 0 && core == 0) share = std::max(share, share_of(off, placed.in_mesh().half_extents[i]));
  }
  return share;
}

TYPED_TEST(PlacedShapeOf, HoldsTheExactShape) {
  Random random(20261126);
  double near_anchor = 0;
  double in_mesh = 0;
  for (std::size_t i = case_count(8000); i > 0; --i) {
    const Case<TypeParam> drawn = draw_case<TypeParam>(random);
    const PlacedShape placed(drawn.sphere, drawn.placement, drawn.frame, drawn.share);
    ASSERT_TRUE(placed.is_usable());
    near_anchor = std::max(near_anchor, share_near_anchor(drawn, placed));
    const mpq_class radius(double{drawn.sphere.radius});
    in_mesh = std::max({in_mesh, share_in_mesh(drawn, drawn.sphere, radius), share_in_mesh(drawn, drawn.box(), 0),
                        share_in_mesh(drawn, drawn.capsule(), radius)});
    // Near the anchor, all shapes are larger by the same.
    const double slack = placed.near_anchor(SweptSphere<TypeParam>{{0, 0, 0}, {0, 0, 0}, 0}).radius;
    EXPECT_GE(placed.near_anchor(drawn.capsule()).radius, placed.near_anchor(drawn.sphere).radius);
    const SweptBox<double> grown = placed.near_anchor(drawn.box());
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(mpq_class(grown.half_extents[i]), mpq_class(std::fabs(double{drawn.half[i]})) + mpq_class(slack) / 2);
    }
    if (testing::Test::HasFailure()) FAIL() << "case " << i;
  }
  EXPECT_LE(near_anchor, 1);
  // A bound that is far too large would hide a mistake in its derivation.
  EXPECT_GT(near_anchor, 0.01);
  EXPECT_GT(in_mesh, 0.01);
  testing::Test::RecordProperty("shares", testing::PrintToString(std::array{near_anchor, in_mesh}));
}

/// Returns a case with another number. Its matrix has an inverse.
template <typename Scalar>
Case<Scalar> changed(const Case<Scalar>& drawn, Random& random) {
  for (;;) {
    Case<Scalar> next = drawn;
    std::vector<Scalar*> numbers;
    const auto add = [&](auto& matrix) {
      for (Eigen::Index i = 0; i < matrix.size(); ++i) numbers.push_back(matrix.data() + i);
    };
    add(next.placement.pose.linear);
    add(next.placement.pose.translation);
    if (next.placement.moves) add(next.placement.motion);
    add(next.sphere.start);
    add(next.sphere.end);
    for (auto& corner : next.corners) add(corner);
    Scalar& number = *numbers[random.below(numbers.size())];
    number = changed_coordinate(random, number);
    // No entry of a pose may be smaller.
    if (number != 0 && std::fabs(number) < Scalar(0x1p-60F)) continue;
    if (exact_determinant(Pose<Scalar>(next.placement.pose)) == 0) continue;
    next.set_exact();
    if (PlacedShape(next.sphere, next.placement, next.frame, next.share).is_usable()) return next;
  }
}

// A ball without a radius has nothing but what is there for errors.
TYPED_TEST(PlacedShapeOf, HoldsTheExactShapeWhereHillClimbingMakesTheErrorsWorst) {
  Random random(8);
  const auto near_anchor = [](const Case<TypeParam>& drawn) {
    return share_near_anchor(drawn, PlacedShape(drawn.sphere, drawn.placement, drawn.frame, drawn.share));
  };
  const auto in_mesh = [](const Case<TypeParam>& drawn) { return share_in_mesh(drawn, drawn.sphere, 0); };
  const auto climb = [&](const char* name, const auto& share_of_case) {
    const auto draw = [&] {
      auto drawn = draw_case<TypeParam>(random);
      drawn.sphere.radius = 0;
      return drawn;
    };
    const auto changed_case = [&](const Case<TypeParam>& drawn) { return changed(drawn, random); };
    expect_within_bound(name, climb_to_worst(10, 300, draw, changed_case, share_of_case));
  };
  climb("near_anchor", near_anchor);
  climb("in_mesh", in_mesh);
}

TYPED_TEST(PlacedShapeOf, HoldsAShapeThatGoesAPartOfTheWayWithItsInstance) {
  Random random(6);
  const auto vector = [&](TypeParam size) {
    const auto x = random.symmetric<TypeParam>();
    const auto y = random.symmetric<TypeParam>();
    return Vector3<TypeParam>(size * x, size * y, size * random.symmetric<TypeParam>());
  };
  double off = 0;
  for (std::size_t i = case_count(500); i > 0; --i) {
    Case<TypeParam> drawn = draw_case<TypeParam>(random);
    drawn.placement = {{}, vector(0x1p30F), true};
    drawn.share = random.unit<TypeParam>() / 2 + TypeParam{0.25};
    for (auto& corner : drawn.corners) corner = vector(1);
    drawn.sphere.start = vector(1);
    // Against the instance, the shape hardly moves. So the motion alone is large.
    drawn.sphere.end = drawn.share * drawn.placement.motion;
    drawn.set_exact();
    off = std::max(off, share_near_anchor(drawn, PlacedShape(drawn.sphere, drawn.placement, drawn.frame, drawn.share)));
  }
  EXPECT_LE(off, 1);
}

TYPED_TEST(PlacedShapeOf, HasABoxThatIsHardlyLargerThanABall) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    Case<TypeParam> drawn = draw_case<TypeParam>(random);
    drawn.placement = {draw_pose<TypeParam>(SceneFamily::rotations, random)};
    drawn.sphere.radius = 1;
    drawn.sphere.start = drawn.sphere.end = {1, 2, 3};
    drawn.set_exact();
    const PlacedShape placed(drawn.sphere, drawn.placement, drawn.frame);
    for (const double half : placed.in_mesh().half_extents) {
      EXPECT_GT(half, 0.999);
      EXPECT_LT(half, 1.001);
    }
    EXPECT_LT(placed.near_anchor(drawn.sphere).radius, 1.001);
  }
}

}  // namespace
}  // namespace surehit::test::placed_shape_test
