#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_families.hpp"
#include "support/path_drawer.hpp"
#include "support/random.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"
#include "surehit/scene.hpp"

namespace surehit::test::sizeless_shapes_test {
namespace {

template <typename Scalar>
class SizelessShapes : public testing::Test {};
TYPED_TEST_SUITE(SizelessShapes, Scalars, ScalarNames);

template <typename Scalar>
void set_no_size(SweptSphere<Scalar>& sphere, Scalar zero) {
  sphere.radius = zero;
}
template <typename Scalar>
void set_no_size(SweptBox<Scalar>& box, Scalar zero) {
  box.half_extents = {zero, 0, zero};
}
template <typename Scalar>
void set_no_size(SweptCapsule<Scalar>& capsule, Scalar zero) {
  capsule.half_axis = {0, zero, zero};
  capsule.radius = zero;
}

/// Returns a shape that moves as a segment does. Its zeros have any sign.
template <typename Shape, typename Scalar>
Shape without_size(const Segment<Scalar>& segment, Random& random) {
  Shape shape;
  shape.start = segment.start;
  shape.end = segment.end;
  set_no_size(shape, random.one_in(2) ? Scalar{0} : -Scalar{0});
  return shape;
}

/// `Hit` is that of a segment, and `ShapeHit` that of a shape.
template <typename Hit, typename ShapeHit>
bool has_bits_of(const Hit& hit, const ShapeHit& of_shape) {
  if (hit.triangle == no_triangle || of_shape.triangle == no_triangle) return hit.triangle == of_shape.triangle;
  return same_bits(hit.t, of_shape.t) && same_bits(hit.u, of_shape.u) && same_bits(hit.v, of_shape.v) &&
         hit.triangle == of_shape.triangle;
}
template <typename Scalar>
bool has_bits_of(const SceneHit<Scalar>& hit, const SceneShapeHit<Scalar>& of_shape) {
  return has_bits_of<Hit<Scalar>, ShapeHit<Scalar>>(hit, of_shape) &&
         (hit.triangle == no_triangle || hit.instance == of_shape.instance);
}

template <typename Shape, typename Scalar>
std::string difference_in_pairs(PairFamily family, std::size_t count) {
  Random random(11 + static_cast<std::uint64_t>(family));
  for (std::size_t i = 0; i < count; ++i) {
    const auto [segment, triangle] = draw_pair<Scalar>(family, random);
    const auto expected = intersect(segment, triangle);
    const auto hit = intersect(without_size<Shape>(segment, random), triangle);
    const std::string which = name_of(family) + ", case " + std::to_string(i);
    if (!has_bits_of(expected.value_or(Hit<Scalar>{}), hit.value_or(ShapeHit<Scalar>{}))) return which;
    if (!hit) continue;
    const bool starts_on_it = intersect(Segment<Scalar>{segment.start, segment.start}, triangle).has_value();
    if (hit->started_touching != starts_on_it) return which + ": begins with a contact or not";
  }
  return "";
}

/// `Asked` is a collider or a scene.
template <typename Shape, typename Asked, typename Scalar>
std::string difference_of_answers(const Asked& asked, const std::vector<Segment<Scalar>>& segments, Random& random) {
  using FirstHit = typename decltype(asked.first_hit(segments.front()))::value_type;
  using FirstShapeHit = typename decltype(asked.first_hit(Shape()))::value_type;
  std::vector<Shape> shapes;
  for (const Segment<Scalar>& segment : segments) shapes.push_back(without_size<Shape>(segment, random));
  std::vector<FirstShapeHit> hits(shapes.size());
  std::vector<std::uint8_t> blocked(shapes.size());
  asked.first_hits(shapes, hits);
  asked.any_hits(shapes, blocked);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const FirstHit expected = asked.first_hit(segments[i]).value_or(FirstHit{});
    const std::string which = "case " + std::to_string(i);
    if (!has_bits_of(expected, asked.first_hit(shapes[i]).value_or(FirstShapeHit{}))) return "first_hit, " + which;
    if (!has_bits_of(expected, hits[i])) return "first_hits, " + which;
    if ((blocked[i] != 0) != (expected.triangle != no_triangle)) return "any_hits, " + which;
  }
  return "";
}

template <typename Asked, typename Scalar>
void compare_answers(const Asked& asked, const std::vector<Segment<Scalar>>& segments, const std::string& of_what) {
  Random random(3);
  ASSERT_EQ(difference_of_answers<SweptSphere<Scalar>>(asked, segments, random), "") << "balls, " << of_what;
  ASSERT_EQ(difference_of_answers<SweptBox<Scalar>>(asked, segments, random), "") << "boxes, " << of_what;
  ASSERT_EQ(difference_of_answers<SweptCapsule<Scalar>>(asked, segments, random), "") << "capsules, " << of_what;
}

/// Returns segments along the paths that `draw` returns.
template <typename Scalar, typename Draw>
std::vector<Segment<Scalar>> draw_segments(std::size_t count, const Draw& draw) {
  std::vector<Segment<Scalar>> segments;
  while (segments.size() < count) {
    const Path<Scalar> path = draw();
    const bool is_segment = path.kind == PathKind::segment;
    const Vector3<Scalar> end = is_segment ? path.toward : Vector3<Scalar>(path.start + path.toward);
    if (end.allFinite()) segments.push_back({path.start, end});
  }
  return segments;
}

TYPED_TEST(SizelessShapes, meet_triangles_where_segments_do) {
  using Scalar = TypeParam;
  const std::size_t count = case_count(1000);
  for (const PairFamily family : all_pair_families) {
    ASSERT_EQ((difference_in_pairs<SweptSphere<Scalar>, Scalar>(family, count)), "") << "balls";
    ASSERT_EQ((difference_in_pairs<SweptBox<Scalar>, Scalar>(family, count)), "") << "boxes";
    ASSERT_EQ((difference_in_pairs<SweptCapsule<Scalar>, Scalar>(family, count / 4 + 1)), "") << "capsules";
  }
}

TYPED_TEST(SizelessShapes, meet_meshes_where_segments_do) {
  using Scalar = TypeParam;
  Random random(13);
  const std::array meshes = {bumpy_octahedron<Scalar>(12, random), lattice_cube<Scalar>(4),
                             with_small_copy(rough_ground<Scalar>(12, Scalar(0.2), random), Vector3<Scalar>(0, 0, 0)),
                             line_of_needles<Scalar>(200, random)};
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    PathDrawer<Scalar> drawer(meshes[i].view(), i);
    const auto segments = draw_segments<Scalar>(case_count(1000), [&] { return drawer.draw(); });
    compare_answers(Collider<Scalar>(meshes[i].view()), segments, "mesh " + std::to_string(i));
  }
}

TYPED_TEST(SizelessShapes, meet_scenes_where_segments_do) {
  using Scalar = TypeParam;
  for (const SceneFamily family : all_scene_families) {
    Random random(17 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(4); ++i) {
      const DrawnScene<Scalar> drawn = draw_scene<Scalar>(family, random);
      const JudgedScene<Scalar> judged(drawn);
      ScenePathDrawer<Scalar> drawer(drawn, judged.oracle, judged.ids, random);
      const auto segments = draw_segments<Scalar>(20, [&] { return drawer.draw(); });
      compare_answers(judged.scene, segments, name_of(family));
    }
  }
}

}  // namespace
}  // namespace surehit::test::sizeless_shapes_test
