#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "same_answers.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/path_drawer.hpp"
#include "surehit/collider.hpp"

namespace surehit::test {

/// A mesh and many paths, some aimed at its corners and edges, in each kind that batches take.
template <typename Scalar>
struct ManyPaths {
  ManyPaths(const GeneratedMesh<Scalar>& mesh_given, std::size_t count) : mesh(mesh_given), collider(mesh.view()) {
    PathDrawer<Scalar> drawer(mesh.view(), 79);
    for (std::size_t i = 0; i < count; ++i) {
      const Path<Scalar> path = drawer.draw();
      segments.push_back({path.start, path.toward});
      rays.push_back({path.start, path.toward});
      lines.push_back({path.toward, path.start});
    }
  }
  static ManyPaths scattered(std::size_t count) {
    Random random(83);
    return {scattered_triangles<Scalar>(100, Scalar{0.5}, random), count};
  }

  GeneratedMesh<Scalar> mesh;
  Collider<Scalar> collider;
  std::vector<Segment<Scalar>> segments;
  std::vector<Ray<Scalar>> rays;
  std::vector<Line<Scalar>> lines;
};

/// What batches answer, with an executor or without.
template <typename Scalar>
struct BatchAnswers {
  template <typename AnyPath>
  BatchAnswers(const Collider<Scalar>& collider, std::span<const AnyPath> paths, const QueryOptions<Scalar>& options)
      : hits(paths.size()), blocked(paths.size(), 9) {
    collider.first_hits(paths, std::span(hits), options, &of_first);
    collider.any_hits(paths, std::span(blocked), options, &of_any);
  }
  template <typename AnyPath>
  BatchAnswers(const Collider<Scalar>& collider, std::span<const AnyPath> paths, Executor executor,
               const QueryOptions<Scalar>& options)
      : hits(paths.size()), blocked(paths.size(), 9) {
    collider.first_hits(paths, std::span(hits), executor, options, &of_first);
    collider.any_hits(paths, std::span(blocked), executor, options, &of_any);
  }

  void expect_same_as(const BatchAnswers& other) const {
    expect_same<Scalar>(hits, other.hits);
    EXPECT_EQ(blocked, other.blocked);
    expect_same(of_first, other.of_first);
    expect_same(of_any, other.of_any);
  }

  std::vector<Hit<Scalar>> hits;
  std::vector<std::uint8_t> blocked;
  QueryStatistics of_first;
  QueryStatistics of_any;
};

/// The first `count` of the paths have the same answers and statistics with an executor as without.
template <typename Scalar, typename AnyPath>
void expect_same_with_executor(const Collider<Scalar>& collider, const std::vector<AnyPath>& paths, std::size_t count,
                               Executor executor, const QueryOptions<Scalar>& options = {}) {
  const std::span<const AnyPath> some = std::span(paths).first(count);
  const BatchAnswers<Scalar> expected(collider, some, options);
  EXPECT_EQ(expected.of_first.paths, count);
  BatchAnswers<Scalar>(collider, some, executor, options).expect_same_as(expected);
}

/// Those of each kind do.
template <typename Scalar>
void expect_same_with_executor(const ManyPaths<Scalar>& many, std::size_t count, Executor executor,
                               const QueryOptions<Scalar>& options = {}) {
  expect_same_with_executor(many.collider, many.segments, count, executor, options);
  expect_same_with_executor(many.collider, many.rays, count, executor, options);
  expect_same_with_executor(many.collider, many.lines, count, executor, options);
}

}  // namespace surehit::test
