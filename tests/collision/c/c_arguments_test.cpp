#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "c/arguments.hpp"
#include "c_functions.hpp"
#include "support/scalars.hpp"

namespace surehit::test::c_arguments_test {
namespace {

/// A struct that has grown by its last member.
struct Grown {
  std::size_t size;
  std::uint64_t old;
  std::uint64_t added;
};

}  // namespace
}  // namespace surehit::test::c_arguments_test

template <>
inline constexpr std::size_t surehit::c::first_size<surehit::test::c_arguments_test::Grown> =
    offsetof(surehit::test::c_arguments_test::Grown, added);

namespace surehit::test::c_arguments_test {
namespace {

/// A collider of one triangle, and arguments that are all right. Each test spoils one of them.
template <typename Scalar>
class CArguments : public testing::Test {
 protected:
  using C = CFunctions<Scalar>;
  static constexpr Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();

  CArguments() { EXPECT_EQ(C::create(&mesh, nullptr, &collider), SUREHIT_OK); }
  ~CArguments() override { EXPECT_EQ(C::destroy(collider), SUREHIT_OK); }

  [[nodiscard]] surehit_status first_hit() {
    return C::first_hit(collider, &path, &options, &filter, &statistics, &hit);
  }
  [[nodiscard]] surehit_status first_hits() { return C::first_hits(collider, &paths, &batch, hits.data()); }

  /// Expects a failure whose message names what is wrong.
  static void expect_refused(surehit_status status, surehit_status expected, const char* named) {
    EXPECT_EQ(status, expected) << surehit_last_error();
    EXPECT_EQ(surehit_last_error_status(), expected);
    EXPECT_NE(std::strstr(surehit_last_error(), named), nullptr) << surehit_last_error();
    EXPECT_EQ(std::string(surehit_last_error()).rfind("surehit_", 0), 0U) << surehit_last_error();
  }

  static std::int32_t accept(void* user, std::size_t /*path*/, const typename C::Hit* /*hit*/) {
    return *static_cast<const std::int32_t*>(user);
  }

  /// Returns a pointer that is no multiple of the size of what it points to.
  template <typename T>
  static T* misaligned(T* pointer) {
    return reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(pointer) + 1);
  }

  std::array<Scalar, 9> vertices = {0, 0, 0, 4, 0, 0, 0, 4, 0};
  std::array<std::uint32_t, 3> triangles = {0, 1, 2};
  typename C::Mesh mesh = {vertices.data(), 3, 0, triangles.data(), 1, 0, 4};
  typename C::ColliderHandle* collider = nullptr;
  typename C::Path path = {{1, 1, 1}, {1, 1, -1}, SUREHIT_SEGMENT};
  typename C::Options options = C::default_options();
  std::int32_t verdict = SUREHIT_ACCEPT;
  typename C::Filter filter = {accept, &verdict};
  surehit_statistics statistics = {sizeof statistics, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  typename C::Hit hit = {};
  std::array<Scalar, 12> numbers = {1, 1, 1, 1, 1, -1, 9, 9, 1, 9, 9, -1};
  typename C::Paths paths = {numbers.data(), nullptr, 2, 0, 0, SUREHIT_SEGMENT};
  std::array<typename C::Options, 2> own = {C::default_options(), C::default_options()};
  surehit_executor executor = {[](void*, std::size_t count, surehit_task task, void* work) {
                                 while (count > 0) task(work, --count);
                               },
                               nullptr};
  typename C::BatchOptions batch = {sizeof batch, nullptr, own.data(), &filter, &executor, &statistics};
  std::array<typename C::Hit, 2> hits = {};
};
TYPED_TEST_SUITE(CArguments, Scalars, ScalarNames);

TYPED_TEST(CArguments, are_all_right_to_begin_with) {
  EXPECT_EQ(this->first_hit(), SUREHIT_OK);
  EXPECT_EQ(this->hit.triangle, 0U);
  EXPECT_EQ(this->first_hits(), SUREHIT_OK);
  EXPECT_EQ(this->hits[0].triangle, 0U);
  EXPECT_EQ(this->hits[1].triangle, SUREHIT_NO_TRIANGLE);
  EXPECT_EQ(this->statistics.paths, 3U);
}

TYPED_TEST(CArguments, that_are_null_are_named) {
  using C = CFunctions<TypeParam>;
  const auto refused = [&](surehit_status status, const char* named) {
    this->expect_refused(status, SUREHIT_NULL_POINTER, named);
  };
  refused(C::first_hit(nullptr, &this->path, nullptr, nullptr, nullptr, &this->hit), ": collider is null");
  refused(C::first_hit(this->collider, nullptr, nullptr, nullptr, nullptr, &this->hit), ": path is null");
  refused(C::first_hit(this->collider, &this->path, nullptr, nullptr, nullptr, nullptr), ": hit is null");
  refused(C::any_hit(this->collider, &this->path, nullptr, nullptr, nullptr, nullptr), ": blocked is null");
  std::size_t count = 0;
  refused(C::all_hits(this->collider, &this->path, nullptr, nullptr, nullptr, nullptr, 1, &count), ": hits is null");
  refused(C::all_hits(this->collider, &this->path, nullptr, nullptr, nullptr, &this->hit, 1, nullptr),
          ": hit_count is");
  refused(C::first_hits(this->collider, nullptr, nullptr, this->hits.data()), ": paths is null");
  refused(C::first_hits(this->collider, &this->paths, nullptr, nullptr), ": hits is null");
  refused(C::any_hits(this->collider, &this->paths, nullptr, nullptr), ": blocked is null");
  this->paths.starts = nullptr;
  refused(this->first_hits(), ": paths.starts is null");
  this->filter.accept = nullptr;
  refused(this->first_hit(), ": filter.accept is null");
  this->paths.starts = this->numbers.data();
  refused(this->first_hits(), ": filter.accept is null");
  this->batch.filter = nullptr;
  this->executor.run = nullptr;
  refused(this->first_hits(), ": executor.run is null");
  refused(C::create(&this->mesh, nullptr, nullptr), ": collider is null");
  refused(C::build(this->collider, nullptr, nullptr), ": mesh is null");
  refused(C::set_masks(this->collider, nullptr, 1), ": masks is null");
  surehit_build_options build = {};
  build.size = sizeof build;
  build.mask_count = 1;
  refused(C::build(this->collider, &this->mesh, &build), ": options.masks is null");
  refused(C::max_t_keeping(this->collider, &this->path, nullptr, nullptr), ": hit is null");
  refused(C::max_t_keeping(this->collider, &this->path, &this->hit, nullptr), ": max_t is null");
  refused(C::last_free_point(this->collider, &this->path, nullptr, nullptr, nullptr, nullptr), ": hit is null");
  refused(C::box(this->collider, nullptr), ": box is null");
  refused(C::grid_summary(this->collider, nullptr), ": summary is null");
  refused(C::copy(this->collider, nullptr), ": copy is null");
}

TYPED_TEST(CArguments, that_lie_askew_are_named) {
  using C = CFunctions<TypeParam>;
  const auto refused = [&](surehit_status status, const char* named) {
    this->expect_refused(status, SUREHIT_MISALIGNED, named);
  };
  refused(C::first_hit(this->collider, this->misaligned(&this->path), nullptr, nullptr, nullptr, &this->hit), "path");
  refused(C::first_hit(this->collider, &this->path, this->misaligned(&this->options), nullptr, nullptr, &this->hit),
          "options");
  refused(C::first_hits(this->collider, &this->paths, nullptr, this->misaligned(this->hits.data())), "hits");
  this->paths.starts = this->misaligned(this->paths.starts);
  refused(this->first_hits(), "paths.starts");
  this->mesh.vertices = this->misaligned(this->mesh.vertices);
  refused(C::build(this->collider, &this->mesh, nullptr), "vertices");
  this->mesh.vertices = this->vertices.data();
  this->mesh.triangles = this->misaligned(this->triangles.data());
  refused(C::build(this->collider, &this->mesh, nullptr), "triangles");
  refused(C::triangle_count(this->misaligned(this->collider), nullptr), "collider");
}

TYPED_TEST(CArguments, of_unknown_value_are_refused) {
  using C = CFunctions<TypeParam>;
  const auto refused = [&](surehit_status status, std::size_t element, const char* named) {
    this->expect_refused(status, SUREHIT_INVALID_VALUE, named);
    EXPECT_EQ(surehit_last_error_element(), element);
  };
  this->path.kind = 3;
  refused(this->first_hit(), 0, "the kind of the path is 3, and must be below 3");
  this->path.kind = SUREHIT_RAY;
  refused(C::last_free_point(this->collider, &this->path, &this->hit, nullptr, nullptr, nullptr), 0, "a segment is 1");
  this->options.culling = 3;
  refused(this->first_hit(), 0, "options.culling is 3, and must be below 3");
  this->options = C::default_options();
  this->options.ignore_start_contact = 2;
  refused(this->first_hit(), 0, "options.ignore_start_contact is 2, and must be below 2");
  this->options.ignore_start_contact = 1;
  this->options.ignore_end_contact = 255;
  refused(this->first_hit(), 0, "options.ignore_end_contact is 255");
  this->own[1].culling = 200;
  refused(this->first_hits(), 1, "options.culling is 200");
  this->own[1].culling = 0;
  this->paths.kind = 4;
  refused(this->first_hits(), 0, "paths.kind is 4");
  this->paths.kind = SUREHIT_SEGMENT;
  this->paths.start_stride = 3 * sizeof(TypeParam) - 1;
  refused(this->first_hits(), 0, "paths.starts");
  this->paths.start_stride = 0;
  this->paths.towards = this->numbers.data();
  this->paths.toward_stride = 1;
  refused(this->first_hits(), 0, "paths.towards");
  this->mesh.index_size = 8;
  refused(C::build(this->collider, &this->mesh, nullptr), 0, "mesh.index_size is 8");
  this->mesh.index_size = 0;
  surehit_build_options build = {};
  build.size = sizeof build;
  for (const double cells : {-1.0, double{this->nan}, std::numeric_limits<double>::infinity()}) {
    build.cells_per_triangle = cells;
    refused(C::build(this->collider, &this->mesh, &build), 0, "options.cells_per_triangle");
  }
  typename C::Triangle triangle = {{0, 0, 0}, {1, 0, 0}, {0, this->nan, 0}};
  typename C::Vector normal;
  refused(C::normal_of_triangle(&triangle, &normal), 0, "not finite");
}

TYPED_TEST(CArguments, count_no_triangle_that_is_not_there) {
  using C = CFunctions<TypeParam>;
  const auto refused = [&](surehit_status status) {
    this->expect_refused(status, SUREHIT_OUT_OF_RANGE, "there is no triangle 1, because there are 1");
    EXPECT_EQ(surehit_last_error_element(), 1U);
  };
  std::uint32_t mask = 0;
  typename C::Triangle triangle;
  typename C::Vector normal;
  TypeParam max_t = 0;
  refused(C::set_mask(this->collider, 1, 1));
  refused(C::mask(this->collider, 1, &mask));
  refused(C::triangle(this->collider, 1, &triangle));
  refused(C::normal(this->collider, 1, &normal));
  this->hit.triangle = 1;
  refused(C::max_t_keeping(this->collider, &this->path, &this->hit, &max_t));
}

TYPED_TEST(CArguments, whose_counts_overflow_are_refused) {
  using C = CFunctions<TypeParam>;
  const auto refused = [&](surehit_status status, std::size_t count, const char* named) {
    this->expect_refused(status, SUREHIT_TOO_LARGE, named);
    EXPECT_EQ(surehit_last_error_element(), count);
  };
  // The bytes of each are a small number after an overflow, or no size that memory can have.
  for (const std::size_t count : {SIZE_MAX / 4 + 1, SIZE_MAX, SIZE_MAX / 2}) {
    this->paths.count = count;
    refused(this->first_hits(), count, "paths.starts");
    refused(C::set_masks(this->collider, this->triangles.data(), count), count, "masks");
    std::size_t found = 0;
    refused(C::all_hits(this->collider, &this->path, nullptr, nullptr, nullptr, &this->hit, count, &found), count,
            "hits");
    this->mesh.vertex_count = count;
    refused(C::check_mesh(&this->mesh), count, "vertices");
    refused(C::rebuild_vertices(this->collider, this->vertices.data(), count, 0, nullptr), count, "vertices");
    this->mesh.vertex_count = 3;
    this->mesh.triangle_count = count;
    refused(C::create(&this->mesh, nullptr, &this->collider), count, "triangles");
    this->mesh.triangle_count = 1;
  }
  this->paths.count = 2;
  this->paths.start_stride = SIZE_MAX / 4 * 3;
  refused(this->first_hits(), 2, "paths.starts");
}

TYPED_TEST(CArguments, of_another_version_are_understood_or_refused) {
  using C = CFunctions<TypeParam>;
  const auto refused = [&](surehit_status status, std::size_t size, const char* named) {
    this->expect_refused(status, SUREHIT_INVALID_SIZE, named);
    EXPECT_EQ(surehit_last_error_element(), size);
  };
  for (const std::size_t size : {std::size_t{0}, sizeof this->batch - 1, std::size_t{4097}, SIZE_MAX}) {
    this->batch.size = size;
    refused(this->first_hits(), size, "options.size is ");
    this->statistics.size = size < 4097 ? size : sizeof this->statistics - 1;
    refused(this->first_hit(), this->statistics.size, "statistics.size is ");
    this->statistics.size = sizeof this->statistics;
  }
  // A later version has more members. 0 is the default of each of them.
  struct Later {
    typename C::BatchOptions known;
    std::array<std::uint64_t, 2> more;
  } later = {this->batch, {0, 0}};
  later.known.size = sizeof later;
  EXPECT_EQ(C::first_hits(this->collider, &this->paths, &later.known, this->hits.data()), SUREHIT_OK);
  later.more[1] = std::uint64_t{1} << 63;
  refused(C::first_hits(this->collider, &this->paths, &later.known, this->hits.data()), sizeof later,
          "a later version");

  struct LaterStatistics {
    surehit_statistics known;
    std::uint64_t more;
  } later_statistics = {this->statistics, 42};
  later_statistics.known.size = sizeof later_statistics;
  EXPECT_EQ(C::first_hit(this->collider, &this->path, nullptr, nullptr, &later_statistics.known, &this->hit),
            SUREHIT_OK);
  EXPECT_EQ(later_statistics.more, 42U);
}

TYPED_TEST(CArguments, that_are_not_finite_hit_nothing) {
  this->path.start.x = this->nan;
  EXPECT_EQ(this->first_hit(), SUREHIT_OK);
  EXPECT_EQ(this->hit.triangle, SUREHIT_NO_TRIANGLE);
  this->path.start.x = 1;
  this->options.max_t = this->nan;
  EXPECT_EQ(this->first_hit(), SUREHIT_OK);
  EXPECT_EQ(this->hit.triangle, SUREHIT_NO_TRIANGLE);
}

TYPED_TEST(CArguments, that_say_stop_end_a_query) {
  using C = CFunctions<TypeParam>;
  const auto stopped = [&](surehit_status status) { this->expect_refused(status, SUREHIT_STOPPED, "said stop"); };
  this->verdict = SUREHIT_STOP;
  this->hit.triangle = 7;
  stopped(this->first_hit());
  EXPECT_EQ(this->hit.triangle, SUREHIT_NO_TRIANGLE);
  std::uint8_t blocked = 2;
  stopped(C::any_hit(this->collider, &this->path, nullptr, &this->filter, nullptr, &blocked));
  EXPECT_EQ(blocked, 0);
  std::size_t count = 7;
  stopped(C::all_hits(this->collider, &this->path, nullptr, &this->filter, nullptr, &this->hit, 1, &count));
  EXPECT_EQ(count, 0U);
  stopped(this->first_hits());
  typename C::Vector point;
  EXPECT_EQ(C::first_hit(this->collider, &this->path, nullptr, nullptr, nullptr, &this->hit), SUREHIT_OK);
  this->hit.t = 1;  // A later candidate is behind the triangle, so the filter is asked.
  stopped(C::last_free_point(this->collider, &this->path, &this->hit, nullptr, &this->filter, &point));
  EXPECT_EQ(point.z, 1);
}

/// Counts how often it is asked.
template <typename Hit>
std::int32_t stop_and_count(void* user, std::size_t /*path*/, const Hit* /*hit*/) {
  ++*static_cast<std::size_t*>(user);
  return -5;
}

TYPED_TEST(CArguments, that_say_stop_are_not_asked_again) {
  using C = CFunctions<TypeParam>;
  std::vector<TypeParam> many;
  for (int i = 0; i < 100; ++i) many.insert(many.end(), this->numbers.begin(), this->numbers.end());
  this->paths = {many.data(), nullptr, 200, 0, 0, SUREHIT_SEGMENT};
  std::vector<std::uint8_t> blocked(200);
  std::size_t asked = 0;
  this->filter = {stop_and_count<typename C::Hit>, &asked};
  this->batch = {sizeof this->batch, nullptr, nullptr, &this->filter, nullptr, nullptr};
  EXPECT_EQ(C::any_hits(this->collider, &this->paths, &this->batch, blocked.data()), SUREHIT_STOPPED);
  EXPECT_EQ(asked, 1U);
}

TYPED_TEST(CArguments, that_are_refused_change_nothing) {
  using C = CFunctions<TypeParam>;
  this->hit.triangle = 5;
  this->path.kind = 9;
  EXPECT_NE(this->first_hit(), SUREHIT_OK);
  EXPECT_EQ(this->hit.triangle, 5U);
  EXPECT_EQ(this->statistics.paths, 0U);
  this->path.kind = 0;
  this->triangles[1] = 3;
  this->expect_refused(C::rebuild(this->collider, &this->mesh, nullptr), SUREHIT_INDEX_OUT_OF_RANGE,
                       "triangle 0: corner b");
  this->triangles[1] = 1;
  this->vertices[4] = this->nan;
  this->expect_refused(C::build(this->collider, &this->mesh, nullptr), SUREHIT_NON_FINITE_VERTEX, "vertex 1: y");
  EXPECT_EQ(surehit_last_error_element(), 1U);
  this->expect_refused(C::set_masks(this->collider, this->triangles.data(), 2), SUREHIT_MASKS_DO_NOT_MATCH, "2 masks");
  auto* handle = this->collider;
  EXPECT_NE(C::create(&this->mesh, nullptr, &handle), SUREHIT_OK);
  EXPECT_EQ(handle, this->collider);
  EXPECT_EQ(this->first_hit(), SUREHIT_OK);
  EXPECT_EQ(this->hit.triangle, 0U);
}

TYPED_TEST(CArguments, of_a_mesh_are_refused_as_by_cpp) {
  using C = CFunctions<TypeParam>;
  this->mesh.vertex_stride = 3;
  this->expect_refused(C::check_mesh(&this->mesh), SUREHIT_VERTEX_STRIDE_TOO_SMALL, "3 bytes apart");
  this->mesh.vertex_stride = 0;
  this->mesh.triangle_stride = 5;
  this->expect_refused(C::check_mesh(&this->mesh), SUREHIT_TRIANGLE_STRIDE_TOO_SMALL, "5 bytes apart");
  this->mesh.triangle_stride = 0;
  this->mesh.triangles = nullptr;
  this->expect_refused(C::check_mesh(&this->mesh), SUREHIT_MISSING_ARRAY, "1 triangles is null");
  typename C::Box box;
  this->expect_refused(C::box_of_mesh(&this->mesh, &box), SUREHIT_MISSING_ARRAY, "1 triangles is null");
  this->expect_refused(C::rebuild_vertices(this->collider, this->vertices.data(), 2, 0, nullptr),
                       SUREHIT_VERTICES_DO_NOT_MATCH, "2 vertices for a mesh of 3");
}

TEST(CGrownStruct, is_read_from_programs_of_each_version) {
  const Grown given = {2 * sizeof(std::uint64_t), 5, 6};
  c::Arguments before("f");
  const Grown read = before.read_sized(&given, "options");
  EXPECT_TRUE(before.are_valid());
  EXPECT_EQ(read.old, 5U);
  EXPECT_EQ(read.added, 0U);
  const Grown grown = {sizeof grown, 5, 6};
  EXPECT_EQ(c::Arguments("f").read_sized(&grown, "options").added, 6U);
  const Grown small = {2 * sizeof(std::uint64_t) - 1, 5, 6};
  c::Arguments too_small("f");
  EXPECT_EQ(too_small.read_sized(&small, "options").old, 0U);
  EXPECT_EQ(too_small.status(), SUREHIT_INVALID_SIZE);
}

TEST(CLastError, is_that_of_its_thread) {
  EXPECT_EQ(surehit_check_abi(SUREHIT_C_ABI + 1), SUREHIT_WRONG_ABI);
  EXPECT_EQ(surehit_last_error_element(), std::size_t{SUREHIT_C_ABI});
  std::thread([] {
    EXPECT_STREQ(surehit_last_error(), "");
    EXPECT_EQ(surehit_last_error_status(), SUREHIT_OK);
  }).join();
  EXPECT_STREQ(surehit_last_error(), "surehit_check_abi: the program has ABI 2, and the library has ABI 1");
}

TEST(CLastError, is_cut_where_it_is_long) {
  const std::string long_name(400, 'x');
  c::Arguments(long_name.c_str()).refuse(SUREHIT_INVALID_VALUE, 0, "%s", "y");
  EXPECT_EQ(std::string(surehit_last_error()), std::string(255, 'x'));
  c::Arguments("f").refuse(SUREHIT_INVALID_VALUE, 0, "%s", long_name.c_str());
  EXPECT_EQ(std::string(surehit_last_error()), "f: " + std::string(252, 'x'));
}

TEST(CLastError, tells_of_exceptions) {
  c::Arguments memory("f");
  EXPECT_EQ(memory.then([] { throw std::bad_alloc(); }), SUREHIT_OUT_OF_MEMORY);
  EXPECT_STREQ(surehit_last_error(), "f: memory ran out");
  EXPECT_EQ(c::Arguments("f").then([] { throw std::length_error("too long"); }), SUREHIT_OUT_OF_MEMORY);
  EXPECT_EQ(c::Arguments("f").then([] { throw std::runtime_error("broken"); }), SUREHIT_INTERNAL_ERROR);
  EXPECT_STREQ(surehit_last_error(), "f: broken");
  EXPECT_EQ(c::Arguments("f").then([] { throw 7; }), SUREHIT_INTERNAL_ERROR);
  // The first failure counts, and nothing is done after it.
  EXPECT_EQ(memory.then([] { FAIL(); }), SUREHIT_OUT_OF_MEMORY);
}

}  // namespace
}  // namespace surehit::test::c_arguments_test
