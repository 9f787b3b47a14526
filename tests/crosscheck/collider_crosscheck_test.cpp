#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "support/case_count.hpp"
#include "support/exact_mesh_oracle.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/small_meshes.hpp"
#include "surehit/collider.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
std::string text_of(const std::vector<Hit<Scalar>>& hits) {
  std::string text;
  for (const Hit<Scalar>& hit : hits) text.append("  ").append(hex_text(hit)).append("\n");
  return hits.empty() ? "  none\n" : text;
}

template <typename Scalar>
bool same_hits(const std::vector<Hit<Scalar>>& left, const std::vector<Hit<Scalar>>& right) {
  return std::equal(left.begin(), left.end(), right.begin(), right.end(),
                    [](const Hit<Scalar>& a, const Hit<Scalar>& b) { return same_bits(a, b); });
}

/// The batch calls, for the one kind of path that this one is.
template <typename Scalar>
void ask_batch(const Collider<Scalar>& collider, const Path<Scalar>& path, const QueryOptions<Scalar>& options,
               Hit<Scalar>& hit, std::uint8_t& blocked) {
  const auto ask = [&](const auto& paths) {
    collider.first_hits(paths, std::span(&hit, 1), options);
    collider.any_hits(paths, std::span(&blocked, 1), options);
  };
  const Segment<Scalar> segment{path.start, path.toward};
  const Ray<Scalar> ray{path.start, path.toward};
  const Line<Scalar> line{path.start, path.toward};
  if (path.kind == PathKind::segment) ask(std::span(&segment, 1));
  if (path.kind == PathKind::ray) ask(std::span(&ray, 1));
  if (path.kind == PathKind::line) ask(std::span(&line, 1));
}

template <typename Scalar>
void check_path(const Collider<Scalar>& collider, const ExactMeshOracle<Scalar>& oracle, const Path<Scalar>& path,
                const QueryOptions<Scalar>& options) {
  const std::vector<Hit<Scalar>> expected = oracle.all_hits(path, options);
  std::vector<Hit<Scalar>> all(3);
  collider.all_hits(path, all, options);
  EXPECT_TRUE(same_hits(all, expected)) << "expected:\n" << text_of(expected) << "answered:\n" << text_of(all);

  const std::vector<Hit<Scalar>> expected_first(expected.begin(), expected.begin() + !expected.empty());
  const auto first = collider.first_hit(path, options);
  EXPECT_TRUE(same_hits(first ? std::vector{*first} : std::vector<Hit<Scalar>>{}, expected_first))
      << "expected:\n"
      << text_of(expected_first) << "answered: " << (first ? hex_text(*first) : "a miss");
  EXPECT_EQ(collider.any_hit(path, options), !expected.empty());

  Hit<Scalar> batch_hit;
  std::uint8_t batch_blocked = 2;
  ask_batch(collider, path, options, batch_hit, batch_blocked);
  EXPECT_TRUE(same_bits(batch_hit, expected.empty() ? Hit<Scalar>{} : expected.front())) << hex_text(batch_hit);
  EXPECT_EQ(batch_blocked, expected.empty() ? 0 : 1);

  const auto is_odd = [](const Hit<Scalar>& hit) { return hit.triangle % 2 == 1; };
  std::vector<Hit<Scalar>> expected_odd;
  std::copy_if(expected.begin(), expected.end(), std::back_inserter(expected_odd), is_odd);
  collider.all_hits(path, all, is_odd, options);
  EXPECT_TRUE(same_hits(all, expected_odd)) << "expected:\n" << text_of(expected_odd) << "answered:\n" << text_of(all);
  const auto first_odd = collider.first_hit(path, is_odd, options);
  ASSERT_EQ(first_odd.has_value(), !expected_odd.empty());
  if (first_odd) {
    EXPECT_TRUE(same_bits(*first_odd, expected_odd.front())) << hex_text(*first_odd);
  }
  EXPECT_EQ(collider.any_hit(path, is_odd, options), !expected_odd.empty());

  if (path.kind == PathKind::segment && first) {
    const Segment<Scalar> segment{path.start, path.toward};
    EXPECT_EQ(hex_text(collider.last_free_point(segment, *first, options)),
              hex_text(oracle.last_free_point(segment, *first, options)));
  }
}

/// Built at several resolutions, for none may change an answer.
template <typename Scalar>
std::vector<Collider<Scalar>> colliders_of(const SmallMesh<Scalar>& mesh, const std::vector<std::uint32_t>& masks) {
  std::vector<Collider<Scalar>> colliders;
  for (const std::array<std::uint32_t, 3> resolution : {std::array<std::uint32_t, 3>{0, 0, 0}, {1, 1, 1}, {13, 2, 7}}) {
    BuildOptions options;
    options.grid.resolution = resolution;
    options.masks = masks;
    colliders.emplace_back(mesh.view(), options);
  }
  return colliders;
}

template <typename Scalar>
QueryOptions<Scalar> draw_query(Random& random, const ExactMeshOracle<Scalar>& oracle, const Path<Scalar>& path) {
  const std::vector<Hit<Scalar>> hits = oracle.all_hits(path, {});
  if (hits.empty() || random.one_in(3)) return {};
  const Hit<Scalar>& hit = hits[random.below(hits.size())];
  QueryOptions<Scalar> options = draw_options(random, hit.t);
  if (random.one_in(3)) options.ignored_triangle = hit.triangle;
  if (random.one_in(2)) options.mask = static_cast<std::uint32_t>(random.below(4));
  return options;
}

class ColliderCrosscheck : public testing::TestWithParam<std::size_t> {};

template <typename Scalar>
void check(std::size_t kind) {
  Random random(5);
  for (std::size_t i = case_count(300); i > 0; --i) {
    const SmallMesh<Scalar> mesh = draw_small_mesh<Scalar>(kind, random);
    std::vector<std::uint32_t> masks;
    if (random.one_in(2)) {
      for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
        masks.push_back(static_cast<std::uint32_t>(random.below(4)));
      }
    }
    const ExactMeshOracle<Scalar> oracle(mesh.view(), masks);
    const std::vector<Collider<Scalar>> colliders = colliders_of(mesh, masks);
    for (const Path<Scalar>& path : mesh.paths) {
      const QueryOptions<Scalar> options = draw_query(random, oracle, path);
      const Collider<Scalar>& collider = colliders[random.below(colliders.size())];
      SCOPED_TRACE(testing::Message() << "mesh " << i << ", " << hex_text(path) << '\n' << hex_text(options));
      check_path(collider, oracle, path, options);
    }
  }
}

TEST_P(ColliderCrosscheck, of_float_meshes) { check<float>(GetParam()); }
TEST_P(ColliderCrosscheck, of_double_meshes) { check<double>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Meshes, ColliderCrosscheck, testing::Range(std::size_t{0}, small_mesh_kind_count),
                         [](const auto& test) { return name_of_small_mesh(test.param); });

}  // namespace
}  // namespace surehit::test
