#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "exact_matrix.hpp"
#include "support/capsule_oracle.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/rational_turn.hpp"
#include "support/scalars.hpp"
#include "surehit/intersect.hpp"
#include "surehit/scene.hpp"

namespace surehit::test::turned_contacts_test {
namespace {

/// Where shapes touch triangles that are turned by rational angles, so that their images are known exactly.
template <typename Scalar>
class TurnedContacts : public testing::Test {
 protected:
  /// What `contact_normal` promises.
  static constexpr double allowed = sizeof(Scalar) == 4 ? 0x1p-23 : 0x1p-49;
};
TYPED_TEST_SUITE(TurnedContacts, Scalars, ScalarNames);

mpq_class ratio(std::int64_t numerator, std::int64_t denominator) {
  return mpq_class(numerator) / mpq_class(denominator);
}

/// A triangle that a rational turn places far away, so that its image has more digits than a Scalar. Balls and capsules
/// graze its edge from a to b: they touch it in one point, and at no distance below.
template <typename Scalar>
struct GrazedEdge {
  explicit GrazedEdge(Random& random) : turn(draw_turn(random)) {
    const int far = sizeof(Scalar) == 4 ? 10 : 30;
    for (Eigen::Index i = 0; i < 3; ++i) {
      place[i] = std::ldexp(static_cast<Scalar>(random.between(-1000, 1000)), far);
      motion[i] = random.one_in(2) ? 0 : static_cast<Scalar>(random.between(-20, 20));
      for (Eigen::Index k = 0; k < 3; ++k)
        linear(i, k) = static_cast<Scalar>(turn.rows[static_cast<std::size_t>(i)][k]);
    }
    const Scalar low = 3 + random.unit<Scalar>();
    const Scalar high = 3 + random.unit<Scalar>();
    const Scalar depth = 1 + 5 * random.unit<Scalar>();
    local = {{-low, 0, 0}, {high, 0, 0}, {0, -depth, 0}};
    touched = random.between(-2, 2);
    const std::int64_t size = random.between(1, 3);
    before = random.between(1, 4);
    after = random.between(0, 4);
    radius = static_cast<Scalar>(5 * size * turn.scale);
    start = at({touched, 3 * size - 4 * before, 4 * size + 3 * before});
    end = at({touched, 3 * size + 4 * after, 4 * size - 3 * after}) + motion;
    half_axis = static_cast<Scalar>(random.between(0, 2)) * linear.col(0);
  }

  /// Returns the place of whole numbers of the mesh in the scene, which is a Scalar.
  [[nodiscard]] Vector3<Scalar> at(const IntegerVector& x) const { return place + turn(x).template cast<Scalar>(); }

  Turn turn;
  Vector3<Scalar> place, motion;
  Eigen::Matrix<Scalar, 3, 3> linear;
  Triangle<Scalar> local;
  std::int64_t touched, before, after;
  Scalar radius;
  Vector3<Scalar> start, end, half_axis;
};

TYPED_TEST(TurnedContacts, of_what_grazes_an_edge_are_right) {
  using Scalar = TypeParam;
  Random random(53);
  const std::size_t cases = std::max<std::size_t>(case_count(150), 50);  // A few might all touch the rounded triangle.
  std::size_t lost = 0;
  for (std::size_t i = 0; i < cases; ++i) {
    const GrazedEdge<Scalar> edge(random);
    GeneratedMesh<Scalar> mesh;
    mesh.add(edge.local);
    Scene<Scalar> scene;
    const InstanceId id =
        scene.add(std::make_shared<Collider<Scalar>>(mesh.view()), Pose<Scalar>{edge.linear, edge.place});
    scene.set_motion(id, edge.motion);
    scene.commit();
    const SweptSphere<Scalar> ball{edge.start, edge.end, edge.radius};
    const SweptCapsule<Scalar> capsule{edge.start, edge.end, edge.half_axis, edge.radius};
    const mpq_class t = ratio(edge.before, edge.before + edge.after);
    for (const SweptShape<Scalar>& shape : {SweptShape<Scalar>(ball), SweptShape<Scalar>(capsule)}) {
      const auto hit = scene.first_hit(shape);
      ASSERT_TRUE(hit) << i;
      ASSERT_EQ(hit->feature, Feature::edge_ab) << i;
      ASSERT_EQ(hit->t, static_cast<Scalar>(edge.before) / static_cast<Scalar>(edge.before + edge.after)) << i;
      const auto normal = scene.contact_normal(shape, *hit);
      const auto point = scene.contact_point(*hit);
      // In the mesh, the normal is (0, 3, 4) / 5.
      const IntegerVector along = edge.turn({0, 3, 4});
      const ExactVector touched = exact(edge.at({edge.touched, 0, 0})) + t * exact(edge.motion);
      const ExactVector sides = exact<Vector3<Scalar>>(edge.linear * (edge.local.b - edge.local.a));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto row = static_cast<Eigen::Index>(axis);
        const mpq_class expected = ratio(along[row], 5 * edge.turn.scale);
        ASSERT_LE(abs(mpq_class(expected - mpq_class(double{normal[row]}))), mpq_class(this->allowed)) << i;
        // Half an ulp of 1 times the edge and the motion, and half an ulp of the point.
        const mpq_class half_ulp(double{std::numeric_limits<Scalar>::epsilon()} / 2);
        const Scalar size = std::fabs(point[row]);
        const mpq_class bound = half_ulp * (abs(sides[axis]) * mpq_class(1.0001) + abs(exact(edge.motion)[axis])) +
                                mpq_class(double{std::nextafter(size, 2 * size + 1) - size}) / 2;
        ASSERT_LE(abs(mpq_class(touched[axis] - mpq_class(double{point[row]}))), bound) << i;
      }
      // The rounded triangle is not always touched.
      SweptShape<Scalar> seen = shape;
      std::visit([&](auto& any) { any.end -= edge.motion; }, seen);
      lost += contact_normal<Scalar>(seen, scene.triangle(id, 0)).isZero(0) ? 1 : 0;
    }
  }
  EXPECT_GT(lost, cases / 4);
}

/// Returns a shape in double.
SweptShape<double> in_double(const SweptShape<double>& shape) { return shape; }
SweptShape<double> in_double(const SweptShape<float>& shape) {
  const auto wide = [](const Vector3f& x) { return Vector3d(x.cast<double>()); };
  if (const auto* const ball = std::get_if<SweptSpheref>(&shape)) {
    return SweptSphered{wide(ball->start), wide(ball->end), ball->radius};
  }
  if (const auto* const box = std::get_if<SweptBoxf>(&shape)) {
    return SweptBoxd{wide(box->start), wide(box->end), wide(box->half_extents)};
  }
  const auto& capsule = std::get<SweptCapsulef>(shape);
  return SweptCapsuled{wide(capsule.start), wide(capsule.end), wide(capsule.half_axis), capsule.radius};
}

// All images are exact in double, but most of them have more digits than a float.
TYPED_TEST(TurnedContacts, normal_of_any_shape_is_that_of_the_image_in_double) {
  using Scalar = TypeParam;
  using Point = Vector3<Scalar>;
  Random random(54);
  const auto whole = [&](int reach) { return static_cast<Scalar>(random.between(-reach, reach)); };
  const auto point = [&](int reach) {
    const Scalar x = whole(reach);
    const Scalar y = whole(reach);
    return Point(x, y, whole(reach));
  };
  std::array<std::size_t, 3> touched = {};
  for (std::size_t i = case_count(60); i > 0; --i) {
    GeneratedMesh<Scalar> mesh;
    for (int k = 0; k < 6; ++k) {
      const auto corner = [&] {
        return Point(point(4) + (random.one_in(2) ? Point(point(999) / 1024) : Point(0, 0, 0)));
      };
      const Point a = corner();
      const Point b = corner();
      mesh.add({a, b, corner()});
    }
    const auto collider = std::make_shared<Collider<Scalar>>(mesh.view());
    Scene<Scalar> scene;
    const Point place = 1024 * point(900);
    for (int k = 0; k < 3; ++k) {
      const Turn turn = draw_turn(random);
      Pose<Scalar> pose;
      for (Eigen::Index row = 0; row < 3; ++row) {
        pose.linear.row(row) = turn.rows[static_cast<std::size_t>(row)].template cast<Scalar>().transpose();
      }
      pose.linear *= std::ldexp(Scalar{1}, static_cast<int>(random.between(-4, 0)));
      if (random.one_in(2)) pose.linear.col(0) *= -1;
      pose.translation = place + point(4);
      scene.set_motion(scene.add(collider, pose), random.one_in(2) ? Point(0, 0, 0) : point(6));
    }
    scene.commit();
    for (int k = 0; k < 12; ++k) {
      const Point start = place + point(12);
      const Point end = place + point(12);
      const auto size = [&] { return static_cast<Scalar>(random.between(0, 3)); };
      const Scalar x = size();
      const Scalar y = size();
      const std::array<SweptShape<Scalar>, 3> kinds = {SweptSphere<Scalar>{start, end, x},
                                                       SweptBox<Scalar>{start, end, {x, y, size()}},
                                                       SweptCapsule<Scalar>{start, end, point(2), x}};
      for (const SweptShape<Scalar>& shape : kinds) {
        std::vector<SceneShapeHit<Scalar>> hits;
        scene.all_hits(shape, hits);
        hits.resize(std::min<std::size_t>(hits.size(), 3));
        for (const auto& hit : hits) {
          const Pose<Scalar>& pose = scene.pose(hit.instance);
          const auto image = [&](const Point& corner) {
            return Vector3d(pose.linear.template cast<double>() * corner.template cast<double>() +
                            pose.translation.template cast<double>());
          };
          const Triangle<Scalar> local = mesh.view().triangle(hit.triangle);
          const Triangled placed = {image(local.a), image(local.b), image(local.c)};
          SweptShape<double> seen = in_double(shape);
          const Vector3d motion = scene.motion(hit.instance).template cast<double>();
          std::visit([&](auto& any) { any.end -= motion; }, seen);
          const Vector3d normal = scene.contact_normal(shape, hit).template cast<double>();
          ASSERT_LE((normal - contact_normal<double>(seen, placed)).cwiseAbs().maxCoeff(), this->allowed + 0x1p-49)
              << "kind " << shape.index() << ", scene " << i;
          ++touched[shape.index()];
          const auto* const capsule = std::get_if<SweptCapsuled>(&seen);
          if (capsule == nullptr || k % 3 != 0) continue;
          const auto alone = intersect(*capsule, placed);
          ASSERT_TRUE(alone);
          ASSERT_EQ(find_error_of_normal(*capsule, placed, *alone, normal, this->allowed), std::nullopt) << i;
        }
      }
    }
  }
  for (const std::size_t count : touched) EXPECT_GT(count, case_count(100));
}

}  // namespace
}  // namespace surehit::test::turned_contacts_test
