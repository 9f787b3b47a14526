#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test {

/// What `all_hits` has to find, by asking every triangle. Hits with the same rounded t are in the exact order, which
/// `comes_before(shape, x, y)` of the shape's judge knows.
template <typename Shape, typename Scalar, typename ComesBefore>
std::vector<ShapeHit<Scalar>> brute_force(const TriangleMeshView<Scalar>& mesh, const Shape& shape,
                                          const ComesBefore& comes_before,
                                          const ShapeQueryOptions<Scalar>& options = {}) {
  std::vector<ShapeHit<Scalar>> hits;
  for (std::uint32_t id = 0; id < mesh.triangle_count(); ++id) {
    if (id == options.ignored_triangle) continue;
    if (auto hit = intersect(shape, mesh.triangle(id), options)) {
      hit->triangle = id;
      hits.push_back(*hit);
    }
  }
  std::stable_sort(hits.begin(), hits.end(), [&](const auto& x, const auto& y) {
    if (x.t != y.t) return x.t < y.t;
    if (x.started_touching || y.started_touching) return x.started_touching && !y.started_touching;
    return comes_before(shape, mesh.triangle(x.triangle), mesh.triangle(y.triangle));
  });
  return hits;
}

/// Asks a collider of the mesh about shapes in every way, and compares with brute force.
template <typename Shape, typename Scalar, typename ComesBefore>
void compare_with_brute_force(const TriangleMeshView<Scalar>& mesh, const std::vector<Shape>& shapes,
                              const ComesBefore& comes_before, const std::string& what, const GridOptions& grid = {}) {
  const Collider<Scalar> collider(mesh, {.grid = grid});
  std::vector<ShapeHit<Scalar>> firsts(shapes.size());
  std::vector<std::uint8_t> blocked(shapes.size());
  collider.first_hits(shapes, firsts);
  collider.any_hits(shapes, blocked);
  std::vector<ShapeHit<Scalar>> all;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Shape& shape = shapes[i];
    const std::vector<ShapeHit<Scalar>> expected = brute_force(mesh, shape, comes_before);
    collider.all_hits(shape, all);
    ASSERT_EQ(all.size(), expected.size()) << what << ", shape " << i;
    for (std::size_t k = 0; k < all.size(); ++k) ASSERT_TRUE(all[k] == expected[k]) << what << ", shape " << i;
    const ShapeHit<Scalar> first = expected.empty() ? ShapeHit<Scalar>{} : expected.front();
    ASSERT_TRUE(collider.first_hit(shape).value_or(ShapeHit<Scalar>{}) == first) << what << ", shape " << i;
    ASSERT_TRUE(firsts[i] == first) << what << ", shape " << i;
    ASSERT_EQ(collider.any_hit(shape), !expected.empty()) << what << ", shape " << i;
    ASSERT_EQ(blocked[i] != 0, !expected.empty()) << what << ", shape " << i;
    ASSERT_EQ(collider.overlaps(shape), first.started_touching) << what << ", shape " << i;
    const auto is_even = [](const ShapeHit<Scalar>& hit) { return hit.triangle % 2 == 0; };
    ASSERT_EQ(collider.overlaps(shape, is_even),
              std::any_of(expected.begin(), expected.end(),
                          [&](const auto& hit) { return hit.started_touching && is_even(hit); }))
        << what << ", shape " << i;
  }
}

}  // namespace surehit::test
