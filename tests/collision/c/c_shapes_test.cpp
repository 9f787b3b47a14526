#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "c_functions.hpp"
#include "c_values.hpp"
#include "support/box_families.hpp"
#include "support/capsule_families.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/sphere_families.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::c_shapes_test {
namespace {

/// Shapes and a mesh in which each has a triangle of its own, as a collider in C and one in C++.
template <typename Scalar>
class CShapes : public testing::Test {
 protected:
  using C = CFunctions<Scalar>;
  static constexpr std::size_t shape_count = 12;

  /// Draws shapes by `draw()`, which returns one and a triangle that it comes close to.
  template <typename Draw>
  void build(const Draw& draw, Random& random) {
    GeneratedMesh<Scalar> mesh;
    shapes.clear();
    masks.clear();
    while (shapes.size() < shape_count) {
      const auto [shape, triangle] = draw();
      mesh.add(triangle);
      shapes.push_back(shape);
      masks.push_back(static_cast<std::uint32_t>(random.below(4)));
    }
    cpp = Collider<Scalar>(mesh.view(), {.masks = masks});
    const typename C::Mesh given = {
        mesh.vertices[0].data(), mesh.vertices.size(), 0, mesh.triangles.data(), mesh.triangles.size(), 0, 4};
    surehit_build_options options = {};
    options.size = sizeof options;
    options.masks = masks.data();
    options.mask_count = masks.size();
    typename C::ColliderHandle* handle = nullptr;
    ASSERT_EQ(C::create(&given, &options, &handle), SUREHIT_OK) << surehit_last_error();
    c.reset(handle);
  }

  [[nodiscard]] ShapeQueryOptions<Scalar> draw_options(Random& random) const {
    ShapeQueryOptions<Scalar> options;
    if (random.one_in(2)) options.max_t = random.unit<Scalar>();
    if (random.one_in(3)) options.culling = static_cast<Culling>(random.below(3));
    if (random.one_in(2)) options.mask = static_cast<std::uint32_t>(random.below(4));
    if (random.one_in(3)) options.ignored_triangle = static_cast<std::uint32_t>(random.below(shape_count));
    options.ignore_start_contact = random.one_in(3);
    return options;
  }

  /// A filter that gets what decides from its user pointer.
  static std::int32_t accept(void* user, std::size_t shape, const typename C::ShapeHit* hit) {
    return (hit->triangle + shape) % *static_cast<const std::uint32_t*>(user) != 0 ? SUREHIT_ACCEPT : SUREHIT_REJECT;
  }

  void expect_same(const SweptShape<Scalar>& shape, const ShapeQueryOptions<Scalar>& options, std::uint32_t* modulus) {
    const auto filter = [&](const ShapeHit<Scalar>& hit) { return modulus == nullptr || hit.triangle % *modulus != 0; };
    const auto given = std::visit([](const auto& any) { return in_c(any); }, shape);
    const auto given_options = in_c(options);
    const typename C::ShapeFilter given_filter = {accept, modulus};
    const auto* const c_filter = modulus != nullptr ? &given_filter : nullptr;
    surehit_statistics work = {};
    work.size = sizeof work;
    QueryStatistics cpp_work;

    typename C::ShapeHit c_hit;
    ASSERT_EQ(C::shape_first_hit(c.get(), &given, &given_options, c_filter, &work, &c_hit), SUREHIT_OK);
    const auto hit = cpp.first_hit(shape, filter, options, &cpp_work).value_or(ShapeHit<Scalar>{});
    EXPECT_EQ(in_cpp(c_hit), hit);
    EXPECT_EQ(work.paths, cpp_work.paths);
    found += hit.triangle != no_triangle ? 1 : 0;

    std::uint8_t answer = 2;
    ASSERT_EQ(C::shape_any_hit(c.get(), &given, &given_options, c_filter, nullptr, &answer), SUREHIT_OK);
    EXPECT_EQ(answer, hit.triangle != no_triangle ? 1 : 0);
    ASSERT_EQ(C::shape_overlaps(c.get(), &given, &given_options, c_filter, &work, &answer), SUREHIT_OK);
    EXPECT_EQ(answer, cpp.overlaps(shape, filter, options) ? 1 : 0);
    touching += answer;

    std::vector<ShapeHit<Scalar>> hits;
    cpp.all_hits(shape, hits, filter, options);
    std::array<typename C::ShapeHit, shape_count> c_hits;
    std::size_t count = 0;
    ASSERT_EQ(C::shape_all_hits(c.get(), &given, &given_options, c_filter, nullptr, c_hits.data(), shape_count, &count),
              SUREHIT_OK);
    ASSERT_EQ(count, hits.size());
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(in_cpp(c_hits[i]), hits[i]);
    if (hit.triangle == no_triangle) return;

    Scalar t = -1;
    ASSERT_EQ(C::shape_last_free_t(c.get(), &given, &c_hit, &t), SUREHIT_OK);
    EXPECT_TRUE(same_bits(t, cpp.last_free_t(shape, hit)));
    typename C::Vector vector;
    ASSERT_EQ(C::shape_last_free_point(c.get(), &given, &c_hit, &given_options, c_filter, &vector), SUREHIT_OK);
    EXPECT_EQ(in_cpp(vector), cpp.last_free_point(shape, hit, filter, options));
    const auto triangle = in_c(cpp.triangle(hit.triangle));
    ASSERT_EQ(C::shape_intersect(&triangle, &given, &given_options, &c_hit), SUREHIT_OK);
    EXPECT_EQ(in_cpp(c_hit), intersect(shape, cpp.triangle(hit.triangle), options).value_or(ShapeHit<Scalar>{}));
    ASSERT_EQ(C::contact_point(&triangle, &c_hit, &vector), SUREHIT_OK);
    EXPECT_EQ(in_cpp(vector), contact_point(cpp.triangle(hit.triangle), in_cpp(c_hit)));
    ASSERT_EQ(C::contact_normal(&triangle, &given, &vector), SUREHIT_OK);
    EXPECT_EQ(in_cpp(vector), contact_normal(shape, cpp.triangle(hit.triangle)));
  }

  /// Expects a failure whose message names what is wrong.
  static void expect_refused(surehit_status status, surehit_status expected, const char* named) {
    EXPECT_EQ(status, expected) << surehit_last_error();
    EXPECT_NE(std::strstr(surehit_last_error(), named), nullptr) << surehit_last_error();
  }

  struct Destroy {
    void operator()(typename C::ColliderHandle* handle) const { EXPECT_EQ(C::destroy(handle), SUREHIT_OK); }
  };
  std::unique_ptr<typename C::ColliderHandle, Destroy> c;
  Collider<Scalar> cpp;
  std::vector<SweptShape<Scalar>> shapes;
  std::vector<std::uint32_t> masks;
  std::size_t found = 0;
  std::size_t touching = 0;
};
TYPED_TEST_SUITE(CShapes, Scalars, ScalarNames);

TYPED_TEST(CShapes, have_the_bits_of_cpp) {
  Random random(37);
  const auto compare = [&](const auto& draw, const std::string& family) {
    ASSERT_NO_FATAL_FAILURE(this->build(draw, random));
    for (std::size_t i = 0; i < this->shape_count; ++i) {
      std::uint32_t modulus = 2;
      const auto& shape = this->shapes[i];
      ASSERT_NO_FATAL_FAILURE(this->expect_same(shape, {}, nullptr)) << family;
      ASSERT_NO_FATAL_FAILURE(this->expect_same(shape, this->draw_options(random), i % 2 == 0 ? nullptr : &modulus));
    }
  };
  for (const auto family : {SphereFamily::general, SphereFamily::tangent, SphereFamily::starts_at_distance}) {
    ASSERT_NO_FATAL_FAILURE(compare([&] { return draw_sphere_pair<TypeParam>(family, random); }, name_of(family)));
  }
  for (const auto family : {BoxFamily::general, BoxFamily::grazing, BoxFamily::starts_grazing}) {
    ASSERT_NO_FATAL_FAILURE(compare([&] { return draw_box_pair<TypeParam>(family, random); }, name_of(family)));
  }
  for (const auto family : {CapsuleFamily::general, CapsuleFamily::small_integers}) {
    ASSERT_NO_FATAL_FAILURE(compare([&] { return draw_capsule_pair<TypeParam>(family, random); }, name_of(family)));
  }
  EXPECT_GT(this->found, 50U);
  EXPECT_GT(this->touching, 20U);
}

TYPED_TEST(CShapes, have_the_same_bits_in_batches) {
  using C = CFunctions<TypeParam>;
  Random random(38);
  const auto compare = [&](const auto& draw, std::uint32_t kind) {
    ASSERT_NO_FATAL_FAILURE(this->build(draw, random));
    // More than one task of an executor.
    constexpr std::size_t count = 600;
    std::vector<TypeParam> numbers;
    std::vector<ShapeQueryOptions<TypeParam>> own;
    std::vector<typename C::ShapeOptions> c_own;
    while (own.size() < count) {
      const auto append = [&](const auto& shape) {
        const auto* const first = reinterpret_cast<const TypeParam*>(&shape);
        numbers.insert(numbers.end(), first, first + sizeof shape / sizeof(TypeParam));
      };
      std::visit(append, this->shapes[own.size() % this->shape_count]);
      own.push_back(this->draw_options(random));
      c_own.push_back(in_c(own.back()));
    }
    const typename C::Shapes shapes = {numbers.data(), count, kind};
    std::uint32_t modulus = 3;
    std::size_t tasks = 0;
    const typename C::ShapeFilter filter = {this->accept, &modulus};
    const surehit_executor executor = {[](void* user, std::size_t task_count, surehit_task task, void* work) {
                                         *static_cast<std::size_t*>(user) += task_count;
                                         while (task_count > 0) task(work, --task_count);
                                       },
                                       &tasks};
    surehit_statistics work = {};
    work.size = sizeof work;
    const typename C::ShapeBatchOptions options = {sizeof options, nullptr, c_own.data(), &filter, &executor, &work};
    std::vector<typename C::ShapeHit> hits(count);
    std::vector<std::uint8_t> blocked(count, 2);
    ASSERT_EQ(C::shape_first_hits(this->c.get(), &shapes, &options, hits.data()), SUREHIT_OK) << surehit_last_error();
    ASSERT_EQ(C::shape_any_hits(this->c.get(), &shapes, &options, blocked.data()), SUREHIT_OK);
    EXPECT_GT(tasks, 2U);
    EXPECT_EQ(work.paths, 2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto accepts = [&](const ShapeHit<TypeParam>& hit) { return (hit.triangle + i) % modulus != 0; };
      const auto& shape = this->shapes[i % this->shape_count];
      const auto expected = this->cpp.first_hit(shape, accepts, own[i]).value_or(ShapeHit<TypeParam>{});
      ASSERT_EQ(in_cpp(hits[i]), expected) << "kind " << kind << ", shape " << i;
      ASSERT_EQ(blocked[i], expected.triangle != no_triangle ? 1 : 0);
    }
  };
  ASSERT_NO_FATAL_FAILURE(
      compare([&] { return draw_sphere_pair<TypeParam>(SphereFamily::small_integers, random); }, SUREHIT_SWEPT_SPHERE));
  ASSERT_NO_FATAL_FAILURE(
      compare([&] { return draw_box_pair<TypeParam>(BoxFamily::small_integers, random); }, SUREHIT_SWEPT_BOX));
  ASSERT_NO_FATAL_FAILURE(compare([&] { return draw_capsule_pair<TypeParam>(CapsuleFamily::small_integers, random); },
                                  SUREHIT_SWEPT_CAPSULE));
}

TYPED_TEST(CShapes, that_are_wrong_are_refused) {
  using C = CFunctions<TypeParam>;
  Random random(39);
  const auto draw = [&] { return draw_sphere_pair<TypeParam>(SphereFamily::starts_touching, random); };
  ASSERT_NO_FATAL_FAILURE(this->build(draw, random));
  auto* const collider = this->c.get();
  const auto hits = [&](const auto& any) { return this->cpp.first_hit(any).has_value(); };
  const auto hitting = std::ranges::find_if(this->shapes, hits);
  ASSERT_NE(hitting, this->shapes.end());
  auto shape = in_c(std::get<SweptSphere<TypeParam>>(*hitting));
  auto options = C::default_shape_options();
  typename C::Sphere ball = {};
  typename C::Shapes shapes = {&ball.start.x, 1, SUREHIT_SWEPT_SPHERE};
  typename C::ShapeHit hit;
  typename C::Vector vector = {7, 7, 7};
  std::uint8_t blocked = 7;
  TypeParam t = 0;
  const auto refused = this->expect_refused;
  ASSERT_EQ(C::shape_first_hit(collider, &shape, nullptr, nullptr, nullptr, &hit), SUREHIT_OK);
  ASSERT_NE(hit.triangle, SUREHIT_NO_TRIANGLE);

  refused(C::shape_first_hit(nullptr, &shape, nullptr, nullptr, nullptr, &hit), SUREHIT_NULL_POINTER, "collider is");
  refused(C::shape_first_hit(collider, nullptr, nullptr, nullptr, nullptr, &hit), SUREHIT_NULL_POINTER, "shape is");
  refused(C::shape_any_hit(collider, &shape, nullptr, nullptr, nullptr, nullptr), SUREHIT_NULL_POINTER, "blocked is");
  refused(C::shape_overlaps(collider, &shape, nullptr, nullptr, nullptr, nullptr), SUREHIT_NULL_POINTER, "touches is");
  refused(C::shape_last_free_t(collider, &shape, &hit, nullptr), SUREHIT_NULL_POINTER, "t is");
  refused(C::shape_last_free_point(collider, &shape, nullptr, nullptr, nullptr, &vector), SUREHIT_NULL_POINTER,
          "hit is");
  refused(C::shape_last_free_point(collider, &shape, &hit, nullptr, nullptr, nullptr), SUREHIT_NULL_POINTER,
          "point is");
  refused(C::shape_intersect(nullptr, &shape, nullptr, &hit), SUREHIT_NULL_POINTER, "triangle is");
  typename C::Triangle triangle = {{0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<TypeParam>::infinity(), 0}};
  refused(C::contact_point(&triangle, nullptr, &vector), SUREHIT_NULL_POINTER, "hit is");
  refused(C::contact_point(&triangle, &hit, &vector), SUREHIT_INVALID_VALUE, "a corner of the triangle");
  refused(C::contact_normal(&triangle, nullptr, &vector), SUREHIT_NULL_POINTER, "shape is");
  refused(C::contact_normal(&triangle, &shape, nullptr), SUREHIT_NULL_POINTER, "normal is");
  const typename C::ShapeFilter no_filter = {nullptr, nullptr};
  refused(C::shape_any_hit(collider, &shape, nullptr, &no_filter, nullptr, &blocked), SUREHIT_NULL_POINTER, "accept");
  refused(C::shape_overlaps(collider, &shape, nullptr, &no_filter, nullptr, &blocked), SUREHIT_NULL_POINTER, "accept");

  const typename C::ShapeFilter stops = {
      [](void*, std::size_t, const typename C::ShapeHit*) -> std::int32_t { return SUREHIT_STOP; }, nullptr};
  refused(C::shape_any_hit(collider, &shape, nullptr, &stops, nullptr, &blocked), SUREHIT_STOPPED, "said stop");
  EXPECT_EQ(blocked, 0);
  blocked = 7;
  refused(C::shape_overlaps(collider, &shape, nullptr, &stops, nullptr, &blocked), SUREHIT_STOPPED, "said stop");
  EXPECT_EQ(blocked, 0);
  hit.t = 1;
  refused(C::shape_last_free_point(collider, &shape, &hit, nullptr, &stops, &vector), SUREHIT_STOPPED, "said stop");
  EXPECT_EQ(in_cpp(vector), in_cpp(shape.start));

  hit.triangle = this->shape_count;
  refused(C::shape_last_free_t(collider, &shape, &hit, &t), SUREHIT_OUT_OF_RANGE, "no triangle 12");
  options.culling = 3;
  refused(C::shape_any_hit(collider, &shape, &options, nullptr, nullptr, &blocked), SUREHIT_INVALID_VALUE, "culling");
  options.culling = 0;
  options.ignore_start_contact = 2;
  refused(C::shape_any_hit(collider, &shape, &options, nullptr, nullptr, &blocked), SUREHIT_INVALID_VALUE, "contact");
  shape.kind = 1000;
  refused(C::shape_first_hit(collider, &shape, nullptr, nullptr, nullptr, &hit), SUREHIT_INVALID_VALUE,
          "the kind of the shape is 1000");

  shapes.kind = 1000;
  refused(C::shape_any_hits(collider, &shapes, nullptr, &blocked), SUREHIT_INVALID_VALUE, "shapes.kind is 1000");
  shapes = {nullptr, 1, SUREHIT_SWEPT_SPHERE};
  refused(C::shape_any_hits(collider, &shapes, nullptr, &blocked), SUREHIT_NULL_POINTER, "shapes.numbers is");
  shapes = {&ball.start.x, SIZE_MAX / 4, SUREHIT_SWEPT_SPHERE};
  refused(C::shape_any_hits(collider, &shapes, nullptr, &blocked), SUREHIT_TOO_LARGE, "shapes.numbers");
  shapes.count = 1;
  typename C::ShapeBatchOptions batch = {};
  refused(C::shape_any_hits(collider, &shapes, &batch, &blocked), SUREHIT_INVALID_SIZE, "options.size is 0");
}

}  // namespace
}  // namespace surehit::test::c_shapes_test
