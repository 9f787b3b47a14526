#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "support/scalars.hpp"
#include "surehit/surehit.hpp"

namespace surehit::test::public_surface_test {
namespace {

// What would dangle, or read other memory than was meant, does not compile.

template <typename T>
concept MakesCollider = requires {
  typename Collider<T>;
};
static_assert(MakesCollider<float> && MakesCollider<double>);
static_assert(!MakesCollider<int> && !MakesCollider<long double> && !MakesCollider<const float>);

template <typename View, typename... From>
inline constexpr bool takes = std::is_constructible_v<View, From...>;

using Points = std::vector<Vector3f>;
using Triples = std::vector<std::array<float, 3>>;
using Numbers = std::vector<float>;
using Columns = Eigen::Matrix<float, 3, Eigen::Dynamic>;
struct Xyz {
  float x, y, z;
};
struct PaddedXyz {
  float x, y, z, w;
};
struct Zyx {
  float z, y, x;
};
static_assert(takes<VertexViewf, Points&> && takes<VertexViewf, const Triples&> && takes<VertexViewf, Numbers&>);
static_assert(takes<VertexViewf, float (&)[12]> && takes<VertexViewf, const float (&)[4][3]>);
static_assert(takes<VertexViewf, std::span<const Vector3f>> && takes<VertexViewf, std::span<float>>);
static_assert(takes<VertexViewf, Columns&> && takes<VertexViewf, Eigen::Map<const Columns>>);
static_assert(takes<VertexViewf, decltype(std::declval<Columns&>().leftCols(2))>);
static_assert(!takes<VertexViewf, Eigen::Ref<const Columns>>);  // it may own a copy
static_assert(takes<VertexViewf, std::vector<Xyz>&> && takes<VertexViewf, std::vector<PaddedXyz>&>);
static_assert(!takes<VertexViewf, std::vector<Zyx>&> && !takes<VertexViewf, std::vector<std::array<float, 4>>&>);
static_assert(!takes<VertexViewf, Points> && !takes<VertexViewf, Numbers> && !takes<VertexViewf, Columns>);
static_assert(!takes<VertexViewf, std::vector<double>&> && !takes<VertexViewd, Points&>);
static_assert(!takes<VertexViewf, const float*, int> && !takes<VertexViewf, const float*, int, int>);

static_assert(takes<TriangleIndexView, std::vector<int>&> && takes<TriangleIndexView, std::vector<std::uint16_t>&>);
static_assert(takes<TriangleIndexView, std::vector<std::array<int, 3>>&> &&
              takes<TriangleIndexView, const std::uint32_t (&)[2][3]>);
static_assert(takes<TriangleIndexView, Eigen::Matrix3Xi&> && !takes<TriangleIndexView, Eigen::Matrix3Xi>);
static_assert(!takes<TriangleIndexView, std::vector<std::uint32_t>> && !takes<TriangleIndexView, std::vector<float>&>);
static_assert(!takes<TriangleIndexView, std::vector<std::uint64_t>&> && !takes<TriangleIndexView, std::vector<short>&>);

static_assert(takes<TriangleMeshViewf, Points&, std::vector<int>&>);
static_assert(!takes<TriangleMeshViewf, const float*, int, const std::uint32_t*, int>);
static_assert(!takes<TriangleMeshViewf, Points, std::vector<int>&>);

static_assert(takes<PathSpanf, std::vector<Segmentf>&> && takes<PathSpanf, std::span<const Rayf>>);
static_assert(!takes<PathSpanf, std::vector<Segmentf>> && !takes<PathSpanf, std::vector<Segmentd>&>);

// A small temporary is copied in; another one must have a name.
using Small = decltype([](const Hitf&) { return true; });
struct Large {
  bool operator()(const Hitf&) const { return true; }
  std::array<char, 256> captured;
};
static_assert(std::is_convertible_v<Small, HitFilterf> && std::is_convertible_v<Large&, HitFilterf>);
static_assert(!std::is_convertible_v<Large, HitFilterf>);
static_assert(!std::is_convertible_v<std::function<bool(const Hitf&)>, HitFilterf>);
static_assert(std::is_convertible_v<std::function<bool(std::size_t, const Hitf&)>&, HitFilterf>);
static_assert(!std::is_convertible_v<std::function<void(std::size_t, const Executor::Task&)>, Executor>);
static_assert(std::is_trivially_copyable_v<HitFilterf> && std::is_trivially_copyable_v<Executor>);

// Success is true.
static_assert(std::is_constructible_v<bool, BuildResult> && !std::is_convertible_v<BuildResult, bool>);

static_assert(sizeof(Colliderf) == sizeof(void*) && sizeof(Colliderd) == sizeof(void*));
static_assert(SUREHIT_VERSION_MAJOR == 0 && SUREHIT_VERSION_MINOR == 2);

template <typename Scalar>
class PublicSurface : public testing::Test {
 protected:
  const std::vector<Vector3<Scalar>> points_ = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  const std::vector<std::array<std::uint32_t, 3>> triangles_ = {{0, 1, 2}, {0, 1, 3}};
  const Segment<Scalar> through_ = {{1, 1, 1}, {1, 1, -1}};
};
TYPED_TEST_SUITE(PublicSurface, Scalars, ScalarNames);

TYPED_TEST(PublicSurface, reads_meshes_however_they_are_kept) {
  const std::vector<std::array<TypeParam, 3>> triples = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  const std::vector<TypeParam> numbers = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4};
  const TypeParam array[4][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  struct Corner {
    TypeParam x, y, z;
    float u, v;
  };
  const std::vector<Corner> corners = {{0, 0, 0, 9, 9}, {4, 0, 0, 9, 9}, {0, 4, 0, 9, 9}, {0, 0, 4, 9, 9}};
  const std::vector<int> indices = {0, 1, 2, 0, 1, 3};
  const std::uint16_t short_indices[] = {0, 1, 2, 0, 1, 3};
  const VertexView<TypeParam> views[] = {this->points_, triples, numbers, array, corners};
  for (const VertexView<TypeParam>& vertices : views) {
    for (const TriangleIndexView& triangles :
         {TriangleIndexView(this->triangles_), TriangleIndexView(indices), TriangleIndexView(short_indices)}) {
      const Collider<TypeParam> collider(TriangleMeshView<TypeParam>(vertices, triangles));
      EXPECT_EQ(collider.triangle(1).c, this->points_[3]);
      EXPECT_EQ(collider.first_hit(this->through_)->triangle, 0U);
    }
  }
}

TYPED_TEST(PublicSurface, refuses_arrays_that_are_not_whole) {
  using Reason = InvalidMesh::Reason;
  const std::vector<TypeParam> seven(7);
  const std::vector<int> four = {0, 1, 2, 0};
  Collider<TypeParam> collider;
  const auto reason = [&](const VertexView<TypeParam>& vertices, const TriangleIndexView& triangles) {
    const BuildResult built = collider.try_build({vertices, triangles});
    EXPECT_FALSE(built);
    return built.error().reason;
  };
  EXPECT_EQ(reason(seven, this->triangles_), Reason::incomplete_vertex);
  EXPECT_EQ(collider.try_build({seven, this->triangles_}).error().element, 2U);
  EXPECT_EQ(reason(this->points_, four), Reason::incomplete_triangle);
  const auto strided = [&](std::size_t stride) {
    return VertexView<TypeParam>::strided(this->points_[0].data(), 4, stride);
  };
  EXPECT_EQ(reason(strided(3), this->triangles_), Reason::vertex_stride_too_small);
  EXPECT_EQ(reason(this->points_, TriangleIndexView::strided(this->triangles_[0].data(), 2, 3)),
            Reason::triangle_stride_too_small);
  EXPECT_EQ(reason(VertexView<TypeParam>::strided(nullptr, 4, 0), this->triangles_), Reason::missing_array);
  const std::uint32_t* const no_indices = nullptr;
  EXPECT_EQ(reason(this->points_, TriangleIndexView::strided(no_indices, 2, 0)), Reason::missing_array);
  EXPECT_TRUE(collider.try_build({strided(0), this->triangles_}));
  EXPECT_FALSE(collider.try_rebuild(seven));
  EXPECT_EQ(collider.try_rebuild(seven).error().reason, Reason::incomplete_vertex);
}

TYPED_TEST(PublicSurface, keeps_a_filter_that_was_a_temporary) {
  const Collider<TypeParam> collider({this->points_, this->triangles_});
  std::uint32_t refused = 0;
  const HitFilter<TypeParam> filter = [&refused](const Hit<TypeParam>& hit) { return hit.triangle != refused; };
  EXPECT_FALSE(collider.first_hit(this->through_, filter));
  refused = 1;
  EXPECT_TRUE(collider.first_hit(this->through_, filter));
  const Executor executor = [](std::size_t count, const Executor::Task& task) {
    for (std::size_t i = 0; i < count; ++i) task(i);
  };
  const std::vector<Segment<TypeParam>> segments(3, this->through_);
  std::vector<std::uint8_t> blocked(3);
  collider.any_hits(segments, blocked, {.executor = executor});
  EXPECT_EQ(blocked, (std::vector<std::uint8_t>{1, 1, 1}));
}

TYPED_TEST(PublicSurface, changes_masks_without_a_build) {
  Collider<TypeParam> collider({this->points_, this->triangles_});
  EXPECT_EQ(collider.mask(0), ~std::uint32_t{0});
  collider.set_mask(0, 2);
  EXPECT_EQ(collider.mask(0), 2U);
  EXPECT_EQ(collider.mask(1), ~std::uint32_t{0});
  EXPECT_TRUE(collider.any_hit(this->through_, {.mask = 2}));
  EXPECT_FALSE(collider.any_hit(this->through_, {.mask = 1}));
  const std::vector<std::uint32_t> masks = {1, 1};
  EXPECT_TRUE(collider.try_set_masks(masks));
  EXPECT_TRUE(collider.any_hit(this->through_, {.mask = 1}));
  EXPECT_FALSE(collider.try_set_masks(std::span(masks).first(1)));
  EXPECT_EQ(collider.mask(1), 1U);
  EXPECT_TRUE(collider.try_set_masks({}));
  EXPECT_EQ(collider.mask(1), ~std::uint32_t{0});
}

TYPED_TEST(PublicSurface, rebuilds_to_another_topology) {
  const std::vector<std::uint32_t> masks = {4};
  const std::vector<std::array<std::uint32_t, 3>> other = {{0, 2, 3}};
  Collider<TypeParam> collider({this->points_, this->triangles_});
  for (int i = 0; i < 3; ++i) {
    collider.rebuild({this->points_, other}, {.masks = masks});
    EXPECT_EQ(collider.triangle_count(), 1U);
    EXPECT_EQ(collider.mask(0), 4U);
    EXPECT_FALSE(collider.any_hit(this->through_));
    EXPECT_TRUE(collider.any_hit(Segment<TypeParam>{{-1, 1, 1}, {1, 1, 1}}));
    EXPECT_FALSE(collider.try_rebuild({this->points_, this->triangles_}, {.masks = masks}));
    EXPECT_EQ(collider.triangle_count(), 1U);
    collider.rebuild({this->points_, this->triangles_});
    EXPECT_TRUE(collider.any_hit(this->through_));
    EXPECT_EQ(collider.mask(0), ~std::uint32_t{0});
  }
}

TYPED_TEST(PublicSurface, gives_a_normal_and_a_distance) {
  const Collider<TypeParam> collider({this->points_, this->triangles_});
  EXPECT_EQ(collider.normal(0), (Vector3<TypeParam>{0, 0, 1}));
  EXPECT_EQ(collider.normal(1), normal(collider.triangle(1)));
  const auto hit = collider.first_hit(this->through_);
  ASSERT_TRUE(hit);
  EXPECT_EQ(distance(this->through_, *hit), 1);
  EXPECT_EQ(point(Path<TypeParam>(this->through_), *hit), (Vector3<TypeParam>{1, 1, 0}));
  const Ray<TypeParam> ray{{1, 1, 1}, {0, 3, -4}};
  EXPECT_EQ(distance(ray, Hit<TypeParam>{.t = TypeParam{0.5}}), TypeParam{2.5});
  const Line<TypeParam> line{{1, 1, 1}, {0, 3, -4}};
  EXPECT_EQ(distance(line, Hit<TypeParam>{.t = -2}), 10);
  constexpr TypeParam large = std::numeric_limits<TypeParam>::max();
  const Segment<TypeParam> longest{{-large, 0, 0}, {large, 0, 0}};
  EXPECT_EQ(distance(longest, Hit<TypeParam>{.t = TypeParam{0.25}}), large / 2);
}

TYPED_TEST(PublicSurface, keeps_a_hit_by_the_limit_that_it_gives) {
  const Collider<TypeParam> collider({this->points_, this->triangles_});
  std::size_t lost = 0;
  for (int i = 1; i < 200; ++i) {
    const Segment<TypeParam> segment{{1, 1, TypeParam(i)}, {1, 1, TypeParam(-7)}};
    const auto hit = collider.first_hit(segment);
    ASSERT_TRUE(hit);
    lost += collider.any_hit(segment, {.max_t = hit->t}) ? 0 : 1;
    const TypeParam limit = collider.max_t_keeping(segment, *hit);
    const auto kept = collider.first_hit(segment, {.max_t = limit});
    ASSERT_TRUE(kept) << i;
    EXPECT_EQ(*kept, *hit);
    // None that is less keeps it.
    EXPECT_FALSE(collider.any_hit(segment, {.max_t = std::nextafter(limit, TypeParam{-1})})) << i;
  }
  EXPECT_GT(lost, 50U);
  // t beyond the range of the Scalar.
  constexpr TypeParam large = std::numeric_limits<TypeParam>::max();
  const Line<TypeParam> slow{{1, 1, large / 4}, {0, 0, -std::numeric_limits<TypeParam>::min()}};
  const auto far = collider.first_hit(slow);
  ASSERT_TRUE(far);
  EXPECT_EQ(collider.max_t_keeping(slow, *far), std::numeric_limits<TypeParam>::infinity());
}

TYPED_TEST(PublicSurface, says_where_shapes_touch) {
  const auto collider =
      std::make_shared<const Collider<TypeParam>>(TriangleMeshView<TypeParam>(this->points_, this->triangles_));
  Scene<TypeParam> scene;
  scene.add(collider, Pose<TypeParam>::translated({0, 0, 1}));
  scene.commit();
  const SceneSnapshot<TypeParam> snapshot = scene.snapshot();
  const SweptSphere<TypeParam> ball{{1, 1, 4}, {1, 1, 0}, TypeParam{0.5}};
  const auto hit = scene.first_hit(ball);
  ASSERT_TRUE(hit);
  EXPECT_EQ(scene.contact_point(*hit), (Vector3<TypeParam>{1, 1, 1}));
  EXPECT_EQ(snapshot.contact_point(*hit), scene.contact_point(*hit));
  EXPECT_EQ(scene.contact_normal(ball, *hit), (Vector3<TypeParam>{0, 0, 1}));
  EXPECT_EQ(snapshot.contact_normal(ball, *hit), scene.contact_normal(ball, *hit));
  const SweptBox<TypeParam> resting{{1, 1, 1}, {1, 1, 9}, {1, 1, 1}};
  const std::function<bool(const SceneShapeHit<TypeParam>&)> is_floor = [](const auto& touch) {
    return touch.triangle == 0;
  };
  EXPECT_TRUE(scene.overlaps(resting, is_floor));
  EXPECT_FALSE(snapshot.overlaps(resting, is_floor, {.ignored_instance = hit->instance}));
  EXPECT_TRUE(collider->overlaps(resting, [](const ShapeHit<TypeParam>& touch) { return touch.triangle == 0; }));
  EXPECT_FALSE(collider->overlaps(resting, [](const ShapeHit<TypeParam>& touch) { return touch.triangle > 1; }));
}

}  // namespace
}  // namespace surehit::test::public_surface_test
