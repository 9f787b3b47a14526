#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <variant>
#include <vector>

#include "c_functions.hpp"
#include "c_scene_of.hpp"
#include "c_values.hpp"
#include "support/case_count.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"
#include "surehit/scene.hpp"

namespace surehit::test::c_scene_shapes_test {
namespace {

template <typename Scalar>
class CSceneShapes : public testing::Test {
 protected:
  using C = CFunctions<Scalar>;
  using Options = SceneShapeQueryOptions<Scalar>;

  /// Returns a shape that moves along a path.
  static SweptShape<Scalar> shape_along(const Path<Scalar>& path, std::size_t kind, Random& random) {
    const Scalar size = (path.toward - path.start).cwiseAbs().maxCoeff() * random.unit<Scalar>() / 16;
    const Scalar radius = random.one_in(6) ? 0 : size;
    const Vector3<Scalar> half(size, size / 2, 0);
    const Vector3<Scalar> end = random.one_in(6) ? path.start : path.toward;
    if (kind == SUREHIT_SWEPT_SPHERE) return SweptSphere<Scalar>{path.start, end, radius};
    if (kind == SUREHIT_SWEPT_BOX) return SweptBox<Scalar>{path.start, end, half};
    return SweptCapsule<Scalar>{path.start, end, half, radius};
  }

  /// Returns options that are hard for a hit.
  static Options options_for(const SceneShapeHit<Scalar>& hit, Random& random) {
    Options options;
    if (random.one_in(3)) options.max_t = hit.t;
    if (random.one_in(3)) options.culling = static_cast<Culling>(random.below(3));
    if (random.one_in(3)) options.mask = static_cast<std::uint32_t>(random.below(8));
    if (random.one_in(3)) options.instance_mask = static_cast<std::uint32_t>(random.below(8));
    if (random.one_in(2)) options.ignored_instance = hit.instance;
    if (random.one_in(2)) options.ignored_triangle = hit.triangle;
    options.ignore_start_contact = random.one_in(3);
    return options;
  }

  static std::int32_t accept(void* user, std::size_t shape, const typename C::SceneShapeHit* hit) {
    const auto modulus = *static_cast<const std::uint32_t*>(user);
    return (hit->triangle + hit->instance.index + shape) % modulus != 0 ? SUREHIT_ACCEPT : SUREHIT_REJECT;
  }
  static auto filter_of(std::uint32_t modulus) {
    return [modulus](std::size_t shape, const SceneShapeHit<Scalar>& hit) {
      return (hit.triangle + hit.instance.index + shape) % modulus != 0;
    };
  }

  void expect_same(const CSceneOf<Scalar>& c, const Scene<Scalar>& cpp, const SweptShape<Scalar>& shape,
                   const Options& options, std::uint32_t modulus) {
    const auto filter = filter_of(modulus);
    const typename C::SceneShapeFilter c_filter = {accept, &modulus};
    const auto c_shape = std::visit([](const auto& any) { return in_c(any); }, shape);
    const auto c_options = in_c(options);
    surehit_statistics work = {};
    work.size = sizeof work;
    QueryStatistics cpp_work;
    typename C::SceneShapeHit c_hit;
    ASSERT_EQ(C::scene_shape_first_hit(c.handle, &c_shape, &c_options, &c_filter, &work, &c_hit), SUREHIT_OK);
    const auto hit = cpp.first_hit(shape, filter, options, &cpp_work);
    EXPECT_EQ(in_cpp(c_hit), hit.value_or(SceneShapeHit<Scalar>{}));
    EXPECT_EQ(work.instances, cpp_work.instances);

    std::uint8_t answer = 2;
    ASSERT_EQ(C::scene_shape_any_hit(c.handle, &c_shape, &c_options, &c_filter, nullptr, &answer), SUREHIT_OK);
    EXPECT_EQ(answer, hit ? 1 : 0);
    ASSERT_EQ(C::scene_shape_overlaps(c.handle, &c_shape, &c_options, &c_filter, nullptr, &answer), SUREHIT_OK);
    EXPECT_EQ(answer, cpp.overlaps(shape, filter, options) ? 1 : 0);
    touching += answer;

    std::vector<SceneShapeHit<Scalar>> hits;
    cpp.all_hits(shape, hits, filter, options);
    std::vector<typename C::SceneShapeHit> c_hits(hits.size());
    std::size_t count = 0;
    ASSERT_EQ(C::scene_shape_all_hits(c.handle, &c_shape, &c_options, &c_filter, nullptr, c_hits.data(), c_hits.size(),
                                      &count),
              SUREHIT_OK);
    ASSERT_EQ(count, hits.size());
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(in_cpp(c_hits[i]), hits[i]);
    if (!hit) return;
    ++found;
    Scalar t = -1;
    ASSERT_EQ(C::scene_shape_last_free_t(c.handle, &c_shape, &c_hit, &t), SUREHIT_OK);
    EXPECT_TRUE(same_bits(t, cpp.last_free_t(shape, *hit)));
    typename C::Vector point;
    ASSERT_EQ(C::scene_shape_last_free_point(c.handle, &c_shape, &c_hit, &c_options, &c_filter, &point), SUREHIT_OK);
    EXPECT_EQ(in_cpp(point), cpp.last_free_point(shape, *hit, filter, options));
    ASSERT_EQ(C::scene_contact_point(c.handle, &c_hit, &point), SUREHIT_OK);
    EXPECT_EQ(in_cpp(point), cpp.contact_point(*hit));
    ASSERT_EQ(C::scene_contact_normal(c.handle, &c_shape, &c_hit, &point), SUREHIT_OK);
    EXPECT_EQ(in_cpp(point), cpp.contact_normal(shape, *hit));
  }

  /// Shapes of one kind, with the options of each.
  void expect_same_batch(const CSceneOf<Scalar>& c, const Scene<Scalar>& cpp,
                         const std::vector<SweptShape<Scalar>>& shapes, const std::vector<Options>& options) {
    std::vector<Scalar> numbers;
    std::vector<typename C::SceneShapeOptions> own;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const auto append = [&](const auto& shape) {
        const auto* const first = reinterpret_cast<const Scalar*>(&shape);
        numbers.insert(numbers.end(), first, first + sizeof shape / sizeof(Scalar));
      };
      std::visit(append, shapes[i]);
      own.push_back(in_c(options[i]));
    }
    const typename C::Shapes given = {numbers.data(), shapes.size(), static_cast<std::uint32_t>(shapes[0].index())};
    std::uint32_t modulus = 4;
    const typename C::SceneShapeFilter filter = {accept, &modulus};
    const typename C::SceneShapeBatchOptions batch = {sizeof batch, nullptr, own.data(), &filter, nullptr, nullptr};
    std::vector<typename C::SceneShapeHit> hits(shapes.size());
    std::vector<std::uint8_t> blocked(shapes.size(), 2);
    ASSERT_EQ(C::scene_shape_first_hits(c.handle, &given, &batch, hits.data()), SUREHIT_OK) << surehit_last_error();
    ASSERT_EQ(C::scene_shape_any_hits(c.handle, &given, &batch, blocked.data()), SUREHIT_OK);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const auto accepts = [&](const SceneShapeHit<Scalar>& hit) { return filter_of(modulus)(i, hit); };
      const auto expected = cpp.first_hit(shapes[i], accepts, options[i]).value_or(SceneShapeHit<Scalar>{});
      ASSERT_EQ(in_cpp(hits[i]), expected) << i;
      ASSERT_EQ(blocked[i], expected.triangle != no_triangle ? 1 : 0);
    }
  }

  /// Expects a failure whose message names what is wrong.
  static void expect_refused(surehit_status status, surehit_status expected, const char* named) {
    EXPECT_EQ(status, expected) << surehit_last_error();
    EXPECT_NE(std::strstr(surehit_last_error(), named), nullptr) << surehit_last_error();
  }

  std::size_t found = 0;
  std::size_t touching = 0;
};
TYPED_TEST_SUITE(CSceneShapes, Scalars, ScalarNames);

TYPED_TEST(CSceneShapes, have_the_bits_of_cpp) {
  constexpr std::array families = {SceneFamily::translations, SceneFamily::integer_matrices, SceneFamily::rotations,
                                   SceneFamily::mirrored, SceneFamily::pieces};
  for (const SceneFamily family : families) {
    Random random(static_cast<std::uint64_t>(family));
    for (std::size_t i = case_count(2); i > 0; --i) {
      const auto drawn = draw_scene<TypeParam>(family, random);
      const JudgedScene<TypeParam> judged(drawn);
      const CSceneOf<TypeParam> c(drawn);
      ScenePathDrawer<TypeParam> drawer(drawn, judged.oracle, judged.ids, random);
      for (std::size_t kind = 0; kind < 3; ++kind) {
        std::vector<SweptShape<TypeParam>> shapes;
        std::vector<SceneShapeQueryOptions<TypeParam>> options;
        for (int k = 0; k < 4; ++k) {
          shapes.push_back(this->shape_along(drawer.draw(), kind, random));
          const auto hit = judged.scene.first_hit(shapes.back()).value_or(SceneShapeHit<TypeParam>{});
          options.push_back(this->options_for(hit, random));
          ASSERT_NO_FATAL_FAILURE(this->expect_same(c, judged.scene, shapes.back(), {}, 5));
          ASSERT_NO_FATAL_FAILURE(this->expect_same(c, judged.scene, shapes.back(), options.back(), 3));
        }
        ASSERT_NO_FATAL_FAILURE(this->expect_same_batch(c, judged.scene, shapes, options));
        ASSERT_FALSE(testing::Test::HasFailure()) << name_of(family);
      }
    }
  }
  EXPECT_GT(this->found, 20U);
  EXPECT_GT(this->touching, 5U);
}

TYPED_TEST(CSceneShapes, that_are_wrong_are_refused) {
  using C = CFunctions<TypeParam>;
  const std::array<TypeParam, 9> vertices = {0, 0, 0, 8, 0, 0, 0, 8, 0};
  const std::array<std::uint32_t, 3> triangles = {0, 1, 2};
  const typename C::Mesh mesh = {vertices.data(), 3, 0, triangles.data(), 1, 0, 4};
  typename C::ColliderHandle* collider = nullptr;
  typename C::SceneHandle* scene = nullptr;
  surehit_instance_id first = {};
  surehit_instance_id second = {};
  ASSERT_EQ(C::create(&mesh, nullptr, &collider), SUREHIT_OK);
  ASSERT_EQ(C::create_scene(&scene), SUREHIT_OK);
  ASSERT_EQ(C::add(scene, collider, nullptr, 1, 0, &first), SUREHIT_OK);
  ASSERT_EQ(C::commit(scene, nullptr), SUREHIT_OK);

  typename C::Shape shape = {{2, 1, 3}, {2, 1, -3}, {0, 0, 0}, 1, SUREHIT_SWEPT_SPHERE};
  auto options = C::default_scene_shape_options();
  typename C::SceneShapeHit hit;
  std::uint8_t answer = 7;
  TypeParam t = 7;
  const auto refused = this->expect_refused;
  ASSERT_EQ(C::scene_shape_first_hit(scene, &shape, &options, nullptr, nullptr, &hit), SUREHIT_OK);
  ASSERT_EQ(hit.triangle, 0U);

  const auto first_hit = [&](auto* of, auto* asked, auto* given, auto* to) {
    return C::scene_shape_first_hit(of, asked, given, nullptr, nullptr, to);
  };
  typename C::SceneHandle* const no_scene = nullptr;
  typename C::Shape* const no_shape = nullptr;
  typename C::SceneShapeHit* const no_hit = nullptr;
  refused(first_hit(no_scene, &shape, &options, &hit), SUREHIT_NULL_POINTER, "scene is");
  refused(first_hit(reinterpret_cast<typename C::SceneHandle*>(collider), &shape, &options, &hit),
          SUREHIT_INVALID_HANDLE, "scene was destroyed, or is of another kind");
  refused(first_hit(scene, no_shape, &options, &hit), SUREHIT_NULL_POINTER, "shape is");
  refused(first_hit(scene, &shape, &options, no_hit), SUREHIT_NULL_POINTER, "hit is");
  refused(C::scene_shape_overlaps(scene, &shape, nullptr, nullptr, nullptr, nullptr), SUREHIT_NULL_POINTER,
          "touches is");
  refused(C::scene_shape_last_free_t(scene, &shape, &hit, nullptr), SUREHIT_NULL_POINTER, "t is");
  refused(C::scene_shape_last_free_t(scene, &shape, nullptr, &t), SUREHIT_NULL_POINTER, "hit is");
  refused(C::scene_shape_last_free_point(scene, &shape, &hit, nullptr, nullptr, nullptr), SUREHIT_NULL_POINTER,
          "point is");
  typename C::Vector vector = {7, 7, 7};
  refused(C::scene_contact_point(nullptr, &hit, &vector), SUREHIT_NULL_POINTER, "scene is");
  refused(C::scene_contact_point(scene, nullptr, &vector), SUREHIT_NULL_POINTER, "hit is");
  refused(C::scene_contact_point(scene, &hit, nullptr), SUREHIT_NULL_POINTER, "point is");
  refused(C::scene_contact_normal(scene, nullptr, &hit, &vector), SUREHIT_NULL_POINTER, "shape is");
  refused(C::scene_contact_normal(scene, &shape, nullptr, &vector), SUREHIT_NULL_POINTER, "hit is");
  refused(C::scene_contact_normal(scene, &shape, &hit, nullptr), SUREHIT_NULL_POINTER, "normal is");
  options.culling = 3;
  refused(first_hit(scene, &shape, &options, &hit), SUREHIT_INVALID_VALUE, "options.culling is 3");
  options.culling = 0;
  options.ignore_start_contact = 2;
  refused(first_hit(scene, &shape, &options, &hit), SUREHIT_INVALID_VALUE, "options.ignore_start_contact is 2");
  shape.kind = 3;
  refused(C::scene_shape_any_hit(scene, &shape, nullptr, nullptr, nullptr, &answer), SUREHIT_INVALID_VALUE, "kind");
  shape.kind = SUREHIT_SWEPT_SPHERE;

  const typename C::SceneShapeFilter stops = {
      [](void*, std::size_t, const typename C::SceneShapeHit*) -> std::int32_t { return SUREHIT_STOP; }, nullptr};
  refused(C::scene_shape_any_hit(scene, &shape, nullptr, &stops, nullptr, &answer), SUREHIT_STOPPED, "said stop");
  EXPECT_EQ(answer, 0);
  answer = 7;
  typename C::Shape rests = shape;
  rests.start.z = 1;
  refused(C::scene_shape_overlaps(scene, &rests, nullptr, &stops, nullptr, &answer), SUREHIT_STOPPED, "said stop");
  EXPECT_EQ(answer, 0);
  typename C::Sphere ball = {};
  const typename C::Shapes shapes = {&ball.start.x, SIZE_MAX / 4, SUREHIT_SWEPT_SPHERE};
  refused(C::scene_shape_first_hits(scene, &shapes, nullptr, &hit), SUREHIT_TOO_LARGE, "shapes.numbers");

  auto other = hit;
  other.triangle = 1;
  refused(C::scene_shape_last_free_t(scene, &shape, &other, &t), SUREHIT_OUT_OF_RANGE, "there is no triangle 1");
  refused(C::scene_contact_point(scene, &other, &vector), SUREHIT_OUT_OF_RANGE, "there is no triangle 1");
  refused(C::scene_contact_normal(scene, &shape, &other, &vector), SUREHIT_OUT_OF_RANGE, "there is no triangle 1");
  other = hit;
  other.instance.generation += 1;
  refused(C::scene_shape_last_free_t(scene, &shape, &other, &t), SUREHIT_STALE_ID, "no instance with index 0");
  other.instance = {7, 0};
  refused(C::scene_shape_last_free_t(scene, &shape, &other, &t), SUREHIT_STALE_ID, "no instance with index 7");
  refused(C::scene_contact_point(scene, &other, &vector), SUREHIT_STALE_ID, "no instance with index 7");
  refused(C::scene_contact_normal(scene, &shape, &other, &vector), SUREHIT_STALE_ID, "no instance with index 7");
  EXPECT_EQ(t, TypeParam{7});
  EXPECT_EQ(vector.x, TypeParam{7});

  // No query sees an instance before the commit.
  ASSERT_EQ(C::add(scene, collider, nullptr, 1, 0, &second), SUREHIT_OK);
  other = hit;
  other.instance = second;
  EXPECT_EQ(C::scene_shape_last_free_t(scene, &shape, &other, &t), SUREHIT_OK);
  EXPECT_EQ(t, TypeParam{0});
  EXPECT_EQ(C::scene_contact_normal(scene, &shape, &other, &vector), SUREHIT_OK);
  EXPECT_EQ(vector.z, TypeParam{0});
  ASSERT_EQ(C::remove(scene, first), SUREHIT_OK);
  refused(C::scene_shape_last_free_t(scene, &shape, &hit, &t), SUREHIT_STALE_ID, "no instance with index 0");
  ASSERT_EQ(C::commit(scene, nullptr), SUREHIT_OK);
  ASSERT_EQ(C::add(scene, collider, nullptr, 1, 0, &other.instance), SUREHIT_OK);
  ASSERT_EQ(other.instance.index, first.index);
  EXPECT_EQ(C::scene_shape_last_free_t(scene, &shape, &other, &t), SUREHIT_OK);
  EXPECT_EQ(t, TypeParam{0});
  ASSERT_EQ(C::destroy(collider), SUREHIT_OK);
  ASSERT_EQ(C::destroy_scene(scene), SUREHIT_OK);
}

}  // namespace
}  // namespace surehit::test::c_scene_shapes_test
