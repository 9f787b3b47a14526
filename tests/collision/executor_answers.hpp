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
    collider.first_hits(paths, hits, {.options = options, .statistics = &of_first});
    collider.any_hits(paths, blocked, {.options = options, .statistics = &of_any});
  }
  template <typename AnyPath>
  BatchAnswers(const Collider<Scalar>& collider, std::span<const AnyPath> paths, Executor executor,
               const QueryOptions<Scalar>& options)
      : hits(paths.size()), blocked(paths.size(), 9) {
    collider.first_hits(paths, hits, {.options = options, .executor = executor, .statistics = &of_first});
    collider.any_hits(paths, blocked, {.options = options, .executor = executor, .statistics = &of_any});
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

/// What the first `count` paths of each kind are answered without an executor, to be compared with any executor's.
template <typename Scalar>
class AnswersWithoutExecutor {
 public:
  explicit AnswersWithoutExecutor(const ManyPaths<Scalar>& many, std::size_t count,
                                  const QueryOptions<Scalar>& options = {})
      : collider_(many.collider),
        options_(options),
        segments_(std::span(many.segments).first(count)),
        rays_(std::span(many.rays).first(count)),
        lines_(std::span(many.lines).first(count)),
        of_segments_(collider_, segments_, options),
        of_rays_(collider_, rays_, options),
        of_lines_(collider_, lines_, options) {
    EXPECT_EQ(of_segments_.of_first.paths, count);
    EXPECT_EQ(of_rays_.of_first.paths, count);
    EXPECT_EQ(of_lines_.of_first.paths, count);
  }

  void expect_same_with(Executor executor) const {
    BatchAnswers<Scalar>(collider_, segments_, executor, options_).expect_same_as(of_segments_);
    BatchAnswers<Scalar>(collider_, rays_, executor, options_).expect_same_as(of_rays_);
    BatchAnswers<Scalar>(collider_, lines_, executor, options_).expect_same_as(of_lines_);
  }

 private:
  const Collider<Scalar>& collider_;
  QueryOptions<Scalar> options_;
  std::span<const Segment<Scalar>> segments_;
  std::span<const Ray<Scalar>> rays_;
  std::span<const Line<Scalar>> lines_;
  BatchAnswers<Scalar> of_segments_;
  BatchAnswers<Scalar> of_rays_;
  BatchAnswers<Scalar> of_lines_;
};

}  // namespace surehit::test
