#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "support/brute_force.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "surehit/collider.hpp"

namespace surehit::test {

/// The grids in which a mesh is compared: one cell, the grid's own, fine, far from cubic, and divided twice.
inline std::vector<GridOptions> compared_grids() {
  return {{.resolution = {1, 1, 1}, .crowded = 0},
          {},
          {.resolution = {61, 64, 67}},
          {.resolution = {1, 7, 200}},
          {.resolution = {900, 1, 2}},
          {.resolution = {3, 2, 4}, .crowded = 3}};
}

/// One mesh in grids of several resolutions. Each grid must answer as asking every triangle does, to the bit.
template <typename Scalar>
class GridComparison {
 public:
  /// The mesh and the masks outlive the comparison.
  explicit GridComparison(const TriangleMeshView<Scalar>& mesh, std::span<const std::uint32_t> masks = {},
                          const std::vector<GridOptions>& grids = compared_grids())
      : mesh_(mesh), masks_(masks) {
    for (const GridOptions& grid : grids) colliders_.emplace_back(mesh, BuildOptions{grid, masks});
  }

  [[nodiscard]] const std::vector<Collider<Scalar>>& colliders() const { return colliders_; }
  /// What all colliders did together.
  [[nodiscard]] const QueryStatistics& statistics() const { return statistics_; }
  /// Paths that met something.
  [[nodiscard]] std::size_t hit_count() const { return hit_count_; }

  /// Compares first, any and all. Returns the hits of the path.
  std::vector<Hit<Scalar>> expect_same(const Path<Scalar>& path, const QueryOptions<Scalar>& options = {}) {
    std::vector<Hit<Scalar>> expected = brute_force_hits(mesh_, path, options, masks_);
    if (!expected.empty()) ++hit_count_;
    for (const Collider<Scalar>& collider : colliders_) {
      const auto description = [&] {
        const auto& [x, y, z] = collider.grid_summary().resolution;
        return hex_text(path) + " under " + hex_text(options) + " in " + std::to_string(x) + " × " + std::to_string(y) +
               " × " + std::to_string(z) + " cells";
      };
      const auto first = collider.first_hit(path, options, &statistics_);
      EXPECT_EQ(first.has_value(), !expected.empty()) << description();
      if (first && !expected.empty()) {
        EXPECT_TRUE(same_bits(*first, expected.front()))
            << hex_text(*first) << ", not " << hex_text(expected.front()) << ": " << description();
      }
      EXPECT_EQ(collider.any_hit(path, options, &statistics_), !expected.empty()) << description();
      collider.all_hits(path, found_, options, &statistics_);
      EXPECT_EQ(found_.size(), expected.size()) << description();
      for (std::size_t i = 0; i < std::min(found_.size(), expected.size()); ++i) {
        EXPECT_TRUE(same_bits(found_[i], expected[i]))
            << "hit " << i << ": " << hex_text(found_[i]) << ", not " << hex_text(expected[i]) << ": " << description();
      }
    }
    return expected;
  }

 private:
  TriangleMeshView<Scalar> mesh_;
  std::span<const std::uint32_t> masks_;
  std::vector<Collider<Scalar>> colliders_;
  std::vector<Hit<Scalar>> found_;
  QueryStatistics statistics_;
  std::size_t hit_count_ = 0;
};

/// A batch answers as single calls do. Each path has options of its own, or `options` is empty.
template <typename Scalar, typename AnyPath>
void expect_batch(const Collider<Scalar>& collider, const std::vector<AnyPath>& paths,
                  const std::vector<QueryOptions<Scalar>>& options = {}) {
  std::vector<Hit<Scalar>> hits(paths.size());
  std::vector<std::uint8_t> blocked(paths.size());
  collider.first_hits(paths, hits, {.path_options = options});
  collider.any_hits(paths, blocked, {.path_options = options});
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const QueryOptions<Scalar> its = options.empty() ? QueryOptions<Scalar>() : options[i];
    const auto single = collider.first_hit(paths[i], its);
    EXPECT_TRUE(same_bits(hits[i], single.value_or(Hit<Scalar>{}))) << hex_text(Path<Scalar>(paths[i]));
    EXPECT_EQ(blocked[i], single ? 1 : 0) << hex_text(Path<Scalar>(paths[i]));
  }
}

}  // namespace surehit::test
