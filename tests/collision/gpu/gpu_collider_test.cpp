#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "determinism/answers.hpp"
#include "determinism/hard_questions.hpp"
#include "from_two_threads.hpp"
#include "gpu_answers.hpp"
#include "level/level.hpp"
#include "mesh_io/read_mesh.hpp"
#include "small_dispatches.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_families.hpp"
#include "support/path_drawer.hpp"
#include "support/random.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::gpu_collider_test {
namespace {

class GpuColliderTest : public testing::Test {
 protected:
  void SetUp() override { SUREHIT_SKIP_WITHOUT(device); }

  /// Draws hard paths of all kinds and compares them, with options of their own for some.
  std::size_t expect_same(const TriangleMeshViewf& mesh, std::size_t paths, std::span<const std::uint32_t> masks = {}) {
    const Colliderf collider(mesh, {.masks = masks});
    const GpuCollider on_gpu(device, collider);
    PathDrawer<float> drawer(mesh, 5);
    PathsOfKinds<> drawn;
    for (std::size_t i = 0; i < paths; ++i) {
      Pathf path = i % 4 == 3 ? drawer.draw_axis_parallel() : drawer.draw();
      if (i % 7 == 6) path = drawer.draw_from_afar(std::ldexp(1.0F, static_cast<int>(i % 50)));
      QueryOptionsf options;
      if (i % 3 == 0) options = draw_options(drawer.random(), 0.5F);
      if (i % 5 == 0) options.mask = 1;
      if (i % 11 == 10) {  // So slow that limits of t beside the hit are too large for the kernel to weigh.
        path = Pathf(PathKind::ray, path.start, Vector3f((path.toward - path.start) * 0x1p-20F));
        const auto hit = collider.first_hit(path);
        options = draw_options(drawer.random(), hit ? hit->t : 0x1p20F);
      }
      drawn.add(path, options);
    }
    return drawn.expect_same_as_host(on_gpu, collider, &statistics);
  }

  GpuDevice device = any_gpu();
  GpuStatistics statistics;
};

TEST_F(GpuColliderTest, one_triangle_and_one_path_of_each_family) {
  for (const PairFamily family : all_pair_families) {
    SCOPED_TRACE(name_of(family));
    Random random(11);
    for (std::size_t i = case_count(200); i > 0; --i) {
      const auto [segment, triangle] = draw_pair<float>(family, random);
      GeneratedMesh<float> mesh;
      mesh.add(triangle);
      const Colliderf collider(mesh.view());
      const GpuCollider on_gpu(device, collider);
      PathsOfKinds<> paths;
      for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
        const Pathf path = path_along(segment, kind);
        const auto hit = intersect(path, triangle);
        paths.add(path);
        for (int draw = 0; draw < 6; ++draw) paths.add(path, draw_options(random, hit ? hit->t : 0.5F));
      }
      paths.expect_same_as_host(on_gpu, collider, &statistics);
    }
  }
  EXPECT_GT(statistics.hits, statistics.paths / 100);
}

TEST_F(GpuColliderTest, many_paths_and_many_triangles_of_each_family) {
  for (const PairFamily family : all_pair_families) {
    if (family == PairFamily::mixed_magnitudes) continue;  // One of them is too large for the device.
    SCOPED_TRACE(name_of(family));
    Random random(12);
    GeneratedMesh<float> mesh;
    PathsOfKinds<> paths;
    for (std::size_t i = 0; i < 400; ++i) {
      const auto [segment, triangle] = draw_pair<float>(family, random);
      mesh.add(triangle);
      for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line})
        paths.add(path_along(segment, kind));
    }
    const Colliderf collider(mesh.view());
    paths.expect_same_as_host(GpuCollider(device, collider), collider, &statistics);
  }
}

/// A needle's long edge takes part in six products that nearly cancel, each of them about as large as the bound of G3
/// takes it to be. Each path meets the edge exactly, in whole numbers, so it is no miss. Each needle has a mesh of its
/// own, because it would be undecided for the paths of others.
TEST_F(GpuColliderTest, paths_through_the_long_edges_of_needles) {
  Random random(21);
  for (std::size_t i = case_count(60); i > 0; --i) {
    const auto draw = [&](int bits) {
      const std::int64_t size = random.between((std::int64_t{3} << bits) / 4, std::int64_t{1} << bits);
      return random.one_in(2) ? -size : size;
    };
    const auto rounded = [](const std::array<std::int64_t, 3>& x) {
      return Vector3f(static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2]));
    };
    std::array<std::int64_t, 3> near;
    std::array<std::int64_t, 3> part;  // An eighth of the edge.
    std::array<std::int64_t, 3> far;
    std::array<std::int64_t, 3> side;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      part[axis] = draw(20);
      near[axis] = random.between(-1000, 1000) - 4 * part[axis];
      far[axis] = near[axis] + 8 * part[axis];
      side[axis] = near[axis] + random.between(-1000, 1000);
    }
    std::array<Vector3f, 3> corners = {rounded(near), rounded(side), rounded(far)};
    std::rotate(corners.begin(), corners.begin() + random.between(0, 2), corners.end());
    GeneratedMesh<float> mesh;
    mesh.add({corners[0], corners[1], corners[2]});
    std::vector<Segmentf> segments;
    while (segments.size() < 200) {
      const std::int64_t share = random.between(2, 6);
      std::array<std::int64_t, 3> start;
      std::array<std::int64_t, 3> end;
      bool is_exact = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        start[axis] = draw(24);
        end[axis] = 2 * (near[axis] + share * part[axis]) - start[axis];
        is_exact &= std::abs(end[axis]) <= std::int64_t{1} << 24;
      }
      if (is_exact) segments.push_back({rounded(start), rounded(end)});
    }
    const Colliderf collider(mesh.view());
    EXPECT_EQ(expect_same_as_host(GpuCollider(device, collider), collider, segments, {}, &statistics), segments.size());
  }
}

TEST_F(GpuColliderTest, meshes_that_break_grids) {
  Random random(3);
  const std::size_t paths = case_count(1000);
  const auto ground = rough_ground<float>(40, 0.1F, random);
  const std::vector<std::uint32_t> masks = asked_masks(ground.triangles.size());
  EXPECT_GT(expect_same(ground.view(), paths, masks), paths / 10);
  expect_same(scattered_triangles<float>(1000, 0.2F, random).view(), paths);
  expect_same(smooth_bowl<float>(30).view(), paths);
  expect_same(line_of_needles<float>(500, random).view(), paths);
  expect_same(dust_in_square<float>(1000, random).view(), paths);
  expect_same(lattice_cube<float>(6).view(), paths);
  expect_same(double_fan<float>(100).view(), paths);
  expect_same(with_small_copy(ground, Vector3f(0.25F, 0.5F, 0.125F)).view(), paths);
  expect_same(joined(ground, placed(scattered_triangles<float>(1, 0.5F, random), 1.0F, Vector3f(1e8F, 0, 0))).view(),
              paths);
  expect_same(placed(ground, 1e-13F, Vector3f(0, 0, 0)).view(), paths);
  expect_same(placed(ground, 1e-40F, Vector3f(0, 0, 0)).view(), paths);
  expect_same(placed(ground, 1e9F, Vector3f(0, 0, 0)).view(), paths);
  expect_same(placed(ground, 1e30F, Vector3f(0, 0, 0)).view(), paths);
  expect_same(flattened(ground, 2, 0.5F).view(), paths);
}

TEST_F(GpuColliderTest, the_level_and_most_of_it_on_the_device) {
  const example::Level level = example::build_level();
  const std::size_t paths = case_count(4000);
  EXPECT_GT(expect_same(level.mesh.view(), paths, asked_masks(level.mesh.triangles.size())), paths / 10);

  // Paths in general position are left to the host rarely.
  const Colliderf collider(level.mesh.view());
  const GpuCollider on_gpu(device, collider);
  PathDrawer<float> drawer(level.mesh.view(), 9);
  std::vector<Segmentf> segments;
  for (std::size_t i = 0; i < 4000; ++i) segments.push_back({drawer.point_around_mesh(), drawer.point_around_mesh()});
  GpuStatistics general;
  expect_same_as_host(on_gpu, collider, segments, {}, &general);
  EXPECT_EQ(general.paths, 8000U);
  EXPECT_EQ(general.paths, general.misses + general.hits + general.undecided);
  EXPECT_LT(general.undecided + general.rounded_by_host, general.paths / 100) << general.undecided;
  EXPECT_GT(general.rounded, general.hits / 3);  // Half of the batches ask for any hit.
}

/// Shadow rays begin at the last free point in front of a hit, a few ulps from the surface.
TEST_F(GpuColliderTest, most_paths_that_begin_at_surfaces_are_decided_on_the_device) {
  const example::Level level = example::build_level();
  const Colliderf collider(level.mesh.view());
  PathDrawer<float> drawer(level.mesh.view(), 10);
  std::vector<Segmentf> segments;
  while (segments.size() < 4000) {
    const Segmentf seen{drawer.point_around_mesh(), drawer.point_around_mesh()};
    if (const auto hit = collider.first_hit(seen)) {
      segments.push_back({collider.last_free_point(seen, *hit), drawer.point_around_mesh()});
    }
  }
  expect_same_as_host(GpuCollider(device, collider), collider, segments, {}, &statistics);
  EXPECT_LT(statistics.undecided, statistics.paths / 8) << statistics.undecided;
}

/// These t are certain in pairs, and beyond the 2^100 that the device takes for infinity. The second line hits five
/// triangles there, and the one with the first id last.
TEST_F(GpuColliderTest, hits_at_times_that_no_walk_knows) {
  constexpr float far = 0x1p33F;
  constexpr float slow = 0x1.222048p-67F;
  GeneratedMesh<float> mesh;
  const auto add = [&](float x, float y) { mesh.add({Vector3f(x, x, y), Vector3f(x, y, x), Vector3f(y, x, x)}); };
  const Vector3f start(-far, -far, -far);
  const Vector3f way(slow, slow, slow);
  PathsOfKinds<> paths;
  paths.add({PathKind::ray, start, way});
  paths.add({PathKind::line, start, -way});
  const auto expect_hits = [&] {
    const Colliderf collider(mesh.view());
    EXPECT_EQ(paths.expect_same_as_host(GpuCollider(device, collider), collider), 2U);
  };
  add(far, -far);
  expect_hits();
  for (const float share : {0.5F, 0.48F, 0.46F, 0.44F}) add(far, share * far);
  expect_hits();
}

/// The boxes of 12,000 slivers lie on each path, and the slivers beside it. The walk ends before it comes to the
/// triangle that is hit.
TEST_F(GpuColliderTest, walks_that_take_too_many_steps_are_left_to_the_host) {
  GeneratedMesh<float> mesh;
  for (int i = 0; i < 12'000; ++i) {
    const float z = static_cast<float>(i) * 0x1p-14F;
    mesh.add({{-1, -1, z}, {1, 1, z}, {1, 0.875F, z}});
  }
  mesh.add({{-1, -1, -1}, {-1, 1, -1}, {1, 1, -1}});
  const auto collider = std::make_shared<Colliderf>(mesh.view());
  Scenef scene;
  scene.add(collider, Posef::translated({0, 0, 0.5F}));
  scene.commit();
  std::vector<Segmentf> paths;
  for (int i = 0; i < 16; ++i) {
    const float x = -0.5F - static_cast<float>(i) * 0x1p-10F;
    paths.push_back({{x, 0.5F, 3}, {x, 0.5F, -3}});
  }
  EXPECT_EQ(expect_same_as_host(GpuCollider(device, *collider), *collider, paths, {}, &statistics), paths.size());
  EXPECT_EQ(expect_same_as_host(GpuScene(device, scene.snapshot()), scene, paths, {}, &statistics), paths.size());
  EXPECT_EQ(statistics.undecided, statistics.paths);
}

/// The edge of each sliver is so near to the paths that it is decided in pairs. A walk takes so many decisions, and no
/// more.
TEST_F(GpuColliderTest, walks_with_too_many_decisions_in_pairs_are_left_to_the_host) {
  for (const int slivers : {64, 300}) {
    GeneratedMesh<float> mesh;
    for (int i = 0; i < slivers; ++i) {
      const float z = static_cast<float>(i) * 0x1p-10F;
      mesh.add({{-1, -1, z}, {1, 1, z}, {1, 0.875F, z}});
    }
    mesh.add({{-4, -4, -1}, {-4, 4, -1}, {4, 0, -1}});
    const Colliderf collider(mesh.view());
    std::vector<Segmentf> paths;
    for (int i = 0; i < 16; ++i) {
      const float x = -0.5F - static_cast<float>(i) * 0x1p-10F;
      paths.push_back({{x, x + 0x1p-20F, 3}, {x, x + 0x1p-20F, -3}});
    }
    GpuStatistics of_slivers;
    EXPECT_EQ(expect_same_as_host(GpuCollider(device, collider), collider, paths, {}, &of_slivers), paths.size());
    EXPECT_EQ(of_slivers.undecided, slivers == 64 ? 0U : paths.size());  // Any hit is certain in floats.
  }
}

/// The slivers lie in one plane with the paths, and beside them. Only whole numbers show that they are missed. A walk
/// takes so many decisions in whole numbers, and no more.
TEST_F(GpuColliderTest, walks_with_too_many_exact_decisions_are_left_to_the_host) {
  for (const int slivers : {20, 80}) {
    GeneratedMesh<float> mesh;
    for (int i = 1; i <= slivers; ++i) {
      const float beside = static_cast<float>(i) * 0x1p-10F;
      mesh.add({{-1, -1 + beside, 0}, {1, 1 + beside, 0}, {1, 1 + 2 * beside, 0}});
    }
    mesh.add({{1.5F, -4, -4}, {1.5F, 8, -4}, {1.5F, 0, 8}});
    const Colliderf collider(mesh.view());
    std::vector<Segmentf> paths;
    for (int i = 0; i < 16; ++i) {
      const float x = -2 - static_cast<float>(i) * 0x1p-10F;
      paths.push_back({{x, x, 0}, {2, 2, 0}});
    }
    GpuStatistics of_slivers;
    EXPECT_EQ(expect_same_as_host(GpuCollider(device, collider), collider, paths, {}, &of_slivers), paths.size());
    EXPECT_EQ(of_slivers.undecided, slivers == 20 ? 0U : paths.size());  // Any hit is certain in floats.
  }
}

TEST_F(GpuColliderTest, meshes_of_others) {
  const std::filesystem::path folder = SUREHIT_MESH_FOLDER;
  if (!std::filesystem::exists(folder / "dungeon.obj")) GTEST_SKIP() << "no meshes in " << folder;
  for (const char* name : {"am_galmevish2.obj", "czest2ctf.obj", "dungeon.obj", "nav_test.obj", "ogre.obj",
                           "pul1ctf.obj", "stanford-bunny.obj"}) {
    SCOPED_TRACE(name);
    const auto mesh = example::read_mesh<float>((folder / name).string());
    expect_same(mesh.view(), case_count(600), asked_masks(mesh.triangles.size()));
  }
}

/// The answers of the device take part in the hash that all platforms share.
TEST_F(GpuColliderTest, answers_are_the_published_ones) {
  const HardQuestions<float> hard;
  const Colliderf collider = hard.collider();
  const GpuCollider on_gpu(device, collider);
  const Questions<float>& questions = hard.questions;
  PathsOfKinds<> paths;
  for (std::size_t id = 0; id < questions.all.size(); ++id) paths.add(questions.all[id].path, questions.options_of(id));
  std::vector<Hitf> first[3];
  std::vector<std::uint8_t> any[3];
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const PathSpanf of_kind = paths.of(static_cast<PathKind>(kind));
    first[kind].resize(of_kind.size());
    any[kind].resize(of_kind.size());
    ASSERT_TRUE(on_gpu.first_hits(of_kind, first[kind], {.path_options = paths.options[kind]}));
    ASSERT_TRUE(on_gpu.any_hits(of_kind, any[kind], {.path_options = paths.options[kind]}));
  }
  const Answers<float> answers(collider, questions);
  ASSERT_EQ(answers.hash(), published_hash<float>);
  AnswerHash of_host;
  AnswerHash of_device;
  std::size_t next[3] = {};
  for (std::size_t id = 0; id < questions.all.size(); ++id) {
    const auto kind = static_cast<std::size_t>(questions.all[id].path.kind);
    of_host.take(answers.all()[id].first_of_batch);
    of_host.take(std::uint32_t{answers.all()[id].any_of_batch});
    of_device.take(first[kind][next[kind]]);
    of_device.take(std::uint32_t{any[kind][next[kind]++]});
  }
  EXPECT_EQ(of_device.value(), of_host.value());
}

/// A room with a door, and a path through it.
class GpuRoomTest : public GpuColliderTest {
 protected:
  static constexpr float vertices[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 1, 4, 0, 1, 0, 4, 1};
  static constexpr unsigned triangles[] = {0, 1, 2, 3, 4, 5};
  Colliderf collider{TriangleMeshViewf(vertices, triangles)};
  std::vector<Segmentf> paths{{{1, 1, -1}, {1, 1, 3}}, {{1, 1, 3}, {1, 1, -1}}, {{9, 1, -1}, {9, 1, 3}}};
};

TEST_F(GpuRoomTest, changed_colliders_must_be_uploaded_again) {
  GpuCollider on_gpu(device, collider);
  EXPECT_EQ(expect_same_as_host(on_gpu, collider, paths), 2U);
  std::vector<Hitf> hits(3, Hitf{.t = 7});
  const auto expect_refused = [&] {
    const GpuBatchResult result = on_gpu.first_hits(paths, hits);
    EXPECT_FALSE(result);
    EXPECT_EQ(result.finished, 0U);
    EXPECT_EQ(result.error->reason, GpuError::Reason::not_updated);
    EXPECT_EQ(hits[0].t, 7);
  };
  collider.set_mask(0, 0);
  expect_refused();
  on_gpu.update();
  EXPECT_EQ(expect_same_as_host(on_gpu, collider, paths), 2U);
  const std::vector<std::uint32_t> none = {0, 0};
  ASSERT_TRUE(collider.try_set_masks(none));
  expect_refused();
  on_gpu.update();
  EXPECT_EQ(expect_same_as_host(on_gpu, collider, paths), 0U);
  collider.rebuild(TriangleMeshViewf(vertices, triangles));
  expect_refused();
  on_gpu.update();
  EXPECT_EQ(expect_same_as_host(on_gpu, collider, paths), 2U);
  on_gpu = GpuCollider();
  expect_refused();
}

TEST_F(GpuRoomTest, filters_strides_and_short_spans) {
  const GpuCollider on_gpu(device, collider);
  const auto second = [](const Hitf& hit) { return hit.triangle == 1; };
  expect_same_as_host(on_gpu, collider, paths, {.filter = second});
  const std::vector<float> spread = {1, 1, -1, 0, 1, 1, 3, 0, 2, 1, 5, 0, 2, 1, -5, 0};
  const auto starts = VertexViewf::strided(spread.data(), 2, 8 * sizeof(float));
  const auto ends = VertexViewf::strided(spread.data() + 4, 2, 8 * sizeof(float));
  EXPECT_EQ(expect_same_as_host(on_gpu, collider, PathSpanf::segments(starts, ends)), 2U);
  std::vector<Hitf> hits(2, Hitf{.t = 7});
  EXPECT_TRUE(on_gpu.first_hits(paths, std::span(hits).first(1)));
  EXPECT_NE(hits[0].t, 7);
  EXPECT_EQ(hits[1].t, 7);
  EXPECT_TRUE(on_gpu.first_hits({}, hits));
}

TEST_F(GpuRoomTest, an_empty_mesh_and_a_mesh_that_is_too_large_are_left_to_the_host) {
  const Colliderf empty;
  EXPECT_EQ(expect_same_as_host(GpuCollider(device, empty), empty, paths), 0U);
  const float large[] = {-3e38F, -3e38F, 0, 3e38F, -3e38F, 0, 0, 3e38F, 0};
  const unsigned one[] = {0, 1, 2};
  const Colliderf huge{TriangleMeshViewf(large, one)};
  EXPECT_EQ(expect_same_as_host(GpuCollider(device, huge), huge, paths, {}, &statistics), 3U);
  EXPECT_EQ(statistics.undecided, 6U);
  EXPECT_EQ(statistics.dispatches, 0U);
}

TEST_F(GpuRoomTest, paths_of_any_size) {
  const GpuCollider on_gpu(device, collider);
  constexpr float largest = std::numeric_limits<float>::max();
  constexpr float least = std::numeric_limits<float>::denorm_min();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  PathsOfKinds<> all;
  for (const float x : {0.0F, least, 1e-30F, 1.0F, 1e10F, 1e20F, 1e30F, largest, infinity, std::nanf("")}) {
    for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
      const bool is_segment = kind == PathKind::segment;
      for (const Vector3f& way : {Vector3f(x, 0, 1), Vector3f(0, x, 2), Vector3f(x, x, x), Vector3f(-x, 1, 3)}) {
        const Vector3f middle(1, 1, 0.25F);
        const Vector3f start = middle - way;
        all.add({kind, start, is_segment ? Vector3f(middle + way) : way});
        all.add({kind, start, is_segment ? Vector3f(middle + way) : way}, {.min_t = 0.5F});
        all.add({kind, middle, is_segment ? Vector3f(middle + way) : way}, {.max_t = x});
        all.add({kind, middle, way}, {.min_t = -x, .max_t = 4 * x});
      }
    }
  }
  EXPECT_GT(all.expect_same_as_host(on_gpu, collider), 100U);
}

#if defined(__SSE2__)

/// Nearly every operation is inexact, and some meet a denormal. So an entry point that does not hold its environment
/// ends the program here.
TEST_F(GpuRoomTest, unmasked_exceptions_do_not_trap) {
  Random random(4);
  const Colliderf ground(rough_ground<float>(20, 0.1F, random).view());
  const BatchOptionsf options = {.options = {.min_t = 1e-40F}};
  std::vector<Hitf> expected(paths.size());
  ground.first_hits(paths, expected, options);
  const GpuChoice choice = {.name = device.name()};
  GpuDevice other;
  GpuCollider on_gpu;
  std::vector<Hitf> hits(paths.size());
  constexpr unsigned all_unmasked = 0;
  const unsigned caller = _mm_getcsr();
  _mm_setcsr(all_unmasked);
  const bool are_answered =
      other.try_open(choice) && on_gpu.try_upload(other, ground) && on_gpu.first_hits(paths, hits, options);
  const unsigned after = _mm_getcsr();
  _mm_setcsr(caller);
  EXPECT_TRUE(are_answered);
  EXPECT_EQ(after, all_unmasked);
  EXPECT_EQ(hits, expected);
}

#endif

/// Several dispatches, of which two are under way at a time, from several threads.
TEST_F(GpuRoomTest, large_batches_of_several_threads) {
  const GpuCollider on_gpu(with_small_dispatches(device), collider);
  std::vector<Segmentf> many;
  Random random(8);
  for (std::size_t i = 0; i < 150'000; ++i) {
    const auto x = 3 * random.unit<float>();
    many.push_back({{x, 1, 4 * random.unit<float>() - 2}, {x, 1, 4 * random.unit<float>() - 2}});
  }
  expect_same_from_two_threads(on_gpu, collider, many, 19);
}

/// Faces of boxes lie on each other. Hits with the same t are no reason to ask the host: the lowest id counts.
TEST(GpuFlatFacesTest, faces_in_one_plane_across_an_axis_are_told_apart) {
  const GpuDevice device = any_gpu();
  SUREHIT_SKIP_WITHOUT(device);
  Random random(1);
  GeneratedMesh<float> mesh;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const auto axis = static_cast<Eigen::Index>(random.below(4));  // One in four lies across none.
    const float height = 0.25F * static_cast<float>(random.below(3));
    for (int corner = 0; corner < 3; ++corner) {
      Vector3f vertex(random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>());
      if (axis < 3) vertex[axis] = height;
      mesh.vertices.push_back(vertex);
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const Colliderf collider(mesh.view());
  std::vector<Segmentf> paths;
  for (int i = 0; i < 5000; ++i) {
    paths.push_back({{random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>()},
                     {random.symmetric<float>(), random.symmetric<float>(), random.symmetric<float>()}});
  }
  GpuStatistics statistics;
  EXPECT_GT(expect_same_as_host(GpuCollider(device, collider), collider, paths, {}, &statistics), 2500U);
  EXPECT_LT(statistics.undecided, paths.size() / 100);
}

}  // namespace
}  // namespace surehit::test::gpu_collider_test
