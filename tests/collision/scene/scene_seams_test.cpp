#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "support/case_count.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"

namespace surehit::test::scene_seams_test {
namespace {

/// Pieces of ground on a grid, each an instance. What comes from above must not leave below.
template <typename Scalar>
class SceneSeams : public testing::Test {
 protected:
  using Point = Vector3<Scalar>;
  static constexpr int pieces = 8;  ///< In each direction.
  static constexpr std::uint32_t side = 2;

  /// The matrix and the offset have so few digits that all translations are exact. So the images of all rims are the
  /// same points, though most of these are no numbers.
  void place_pieces(const typename Pose<Scalar>::Matrix3& linear, const Point& offset, const Point& motion,
                    std::size_t kinds = 1) {
    scene_ = {};
    linear_ = linear;
    offset_ = offset;
    motion_ = motion;
    const DrawnMesh piece = ground_piece(side, std::is_same_v<Scalar, float>, random_);
    rim_ = piece.vertices;
    std::vector colliders = {collider_of<Scalar>(piece)};
    while (colliders.size() < kinds) colliders.push_back(collider_of<Scalar>(redrawn_inside(piece)));
    for (int y = 0; y < pieces; ++y) {
      for (int x = 0; x < pieces; ++x) {
        const auto id = scene_.add(colliders[random_.below(kinds)],
                                   {linear, image(side * Point(static_cast<Scalar>(x), static_cast<Scalar>(y), 0))});
        scene_.set_motion(id, motion);
      }
    }
    scene_.commit();
  }

  /// A piece with the same rim. Inside it, heights and diagonals are others.
  DrawnMesh redrawn_inside(DrawnMesh piece) {
    const auto is_inside = [](double x) { return x > 0 && x < side; };
    for (Vector3<double>& vertex : piece.vertices) {
      if (is_inside(vertex[0]) && is_inside(vertex[1])) vertex[2] = double{random_.template symmetric<Scalar>()};
    }
    for (std::size_t i = 0; i + 1 < piece.triangles.size(); i += 2) {
      if (random_.one_in(2)) continue;
      const auto [a, b, c] = piece.triangles[i];
      const std::uint32_t d = piece.triangles[i + 1][1];
      piece.triangles[i] = {a, b, d};
      piece.triangles[i + 1] = {a, d, c};
    }
    return piece;
  }

  [[nodiscard]] Point image(const Point& point) const { return linear_ * point + offset_; }

  /// A point of the ground in the middle of the grid: a corner, a point of an edge between pieces, or any other. It is
  /// rounded, except for corners and for edges along an axis in the best case.
  Point point_of_ground() {
    Point point = rim_[random_.below(rim_.size())].template cast<Scalar>();
    if (random_.one_in(2)) point[random_.below(2) == 0 ? 0 : 1] = side * random_.unit<Scalar>();
    if (random_.one_in(4)) point[0] = side * random_.unit<Scalar>();
    for (int axis = 0; axis < 2; ++axis) point[axis] += static_cast<Scalar>(side * random_.between(2, pieces - 3));
    return point;
  }

  /// From above the ground to below it, through a point on it or near it, as the moving ground sees it.
  Segment<Scalar> draw_segment() {
    const Point aim = point_of_ground();
    const Scalar x = random_.symmetric<Scalar>();
    const Scalar y = random_.symmetric<Scalar>();
    // So long that roundings leave the ends above and below.
    const Point way = random_.one_in(2) ? Point(x, y, 8) : Point(0, 0, 8);
    const Segment<Scalar> segment{image(aim + way), image(aim - way) + motion_};
    return random_.one_in(2) ? segment : Segment<Scalar>{segment.end - motion_, segment.start + motion_};
  }

  void expect_no_leak(std::size_t count) {
    std::vector<Segment<Scalar>> segments;
    for (std::size_t i = case_count(count); i > 0; --i) segments.push_back(draw_segment());
    std::vector<SceneHit<Scalar>> hits(segments.size());
    std::vector<std::uint8_t> blocked(segments.size());
    scene_.first_hits(segments, hits);
    scene_.any_hits(segments, blocked);
    std::size_t leaks = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const bool is_single = i % 8 != 0 || scene_.first_hit(segments[i]).has_value();
      if (hits[i].triangle != no_triangle && blocked[i] == 1 && is_single) continue;
      if (++leaks == 1) ADD_FAILURE() << "first leak: " << hex_text(Path<Scalar>(segments[i]));
    }
    EXPECT_EQ(leaks, 0U);
  }

  Random random_{20261125};
  Scene<Scalar> scene_;
  std::vector<Vector3<double>> rim_;
  typename Pose<Scalar>::Matrix3 linear_;
  Point offset_;
  Point motion_;
};
TYPED_TEST_SUITE(SceneSeams, Scalars, ScalarNames);

TYPED_TEST(SceneSeams, pieces_side_by_side_do_not_leak) {
  this->place_pieces(Pose<TypeParam>::Matrix3::Identity(), {0, 0, 0}, {0, 0, 0});
  this->expect_no_leak(100'000);
}

TYPED_TEST(SceneSeams, pieces_of_a_kit_do_not_leak) {
  for (int i = 0; i < 10; ++i) {
    this->place_pieces(matrix_of_eighths<TypeParam>(this->random_), {static_cast<TypeParam>(i * 64), 0, 64}, {0, 0, 0},
                       5);
    this->expect_no_leak(10'000);
  }
}

TYPED_TEST(SceneSeams, pieces_far_from_the_origin_do_not_leak) {
  for (const TypeParam distance : {TypeParam(1e5), TypeParam(1e7)}) {
    this->place_pieces(Pose<TypeParam>::Matrix3::Identity(), {distance, -distance, distance / 2}, {0, 0, 0});
    this->expect_no_leak(30'000);
  }
}

/// A float so far away is 64 wide.
TYPED_TEST(SceneSeams, large_pieces_at_the_end_of_the_world_do_not_leak) {
  const TypeParam far{0x1p30F};
  this->place_pieces(1024 * Pose<TypeParam>::Matrix3::Identity(), {far, -far, far / 2}, {0, 0, 0});
  this->expect_no_leak(30'000);
}

TYPED_TEST(SceneSeams, turned_and_sheared_pieces_do_not_leak) {
  for (int i = 0; i < 10; ++i) {
    this->place_pieces(matrix_of_eighths<TypeParam>(this->random_), {static_cast<TypeParam>(i * 64), 0, 64}, {0, 0, 0});
    this->expect_no_leak(10'000);
  }
}

TYPED_TEST(SceneSeams, pieces_that_move_together_do_not_leak) {
  for (int i = 0; i < 4; ++i) {
    this->place_pieces(matrix_of_eighths<TypeParam>(this->random_), {0, 0, static_cast<TypeParam>(i * 64)},
                       {TypeParam(0.3), TypeParam(0.7), static_cast<TypeParam>(i)});
    this->expect_no_leak(10'000);
  }
}

}  // namespace
}  // namespace surehit::test::scene_seams_test
