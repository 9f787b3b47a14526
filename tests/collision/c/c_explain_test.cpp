#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "c_functions.hpp"
#include "c_values.hpp"
#include "support/random.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/small_meshes.hpp"
#include "surehit/collider.hpp"
#include "surehit/explain.hpp"

namespace surehit::test::c_explain_test {
namespace {

/// What an explainer of C was told.
template <typename Scalar>
struct Told {
  using C = CFunctions<Scalar>;

  std::vector<surehit_explained_cell> cells;
  std::vector<surehit_explained_candidate> candidates;
  std::vector<typename C::ExplainedHit> hits;

  static void add_cell(void* user, std::size_t index, const surehit_explained_cell* cell) {
    EXPECT_EQ(index, static_cast<Told*>(user)->cells.size());
    static_cast<Told*>(user)->cells.push_back(*cell);
  }
  static void add_candidate(void* user, std::size_t index, const surehit_explained_candidate* candidate) {
    EXPECT_EQ(index, static_cast<Told*>(user)->candidates.size());
    static_cast<Told*>(user)->candidates.push_back(*candidate);
  }
  static void add_hit(void* user, std::size_t index, const typename C::ExplainedHit* hit) {
    EXPECT_EQ(index, static_cast<Told*>(user)->hits.size());
    static_cast<Told*>(user)->hits.push_back(*hit);
  }
};

template <typename Scalar>
class CExplain : public testing::Test {
 protected:
  static void expect_same(const surehit_explained_cell& cell, const ExplainedCell& expected) {
    EXPECT_EQ(in_cpp(cell.box.low), expected.box.low);
    EXPECT_EQ(in_cpp(cell.box.high), expected.box.high);
    EXPECT_TRUE(same_bits(cell.enters, expected.enters) && same_bits(cell.leaves, expected.leaves));
    EXPECT_EQ(cell.finding, static_cast<std::uint8_t>(expected.finding));
    EXPECT_EQ(cell.is_inner != 0, expected.is_inner);
    EXPECT_EQ(cell.first_candidate, expected.first_candidate);
    EXPECT_EQ(cell.candidate_count, expected.candidate_count);
  }

  static void expect_same(const surehit_explained_candidate& candidate, const ExplainedCandidate& expected) {
    EXPECT_EQ(candidate.triangle, expected.triangle);
    EXPECT_EQ(candidate.has_numbers != 0, expected.numbers.has_value());
    EXPECT_EQ(candidate.filter_verdict, static_cast<std::uint8_t>(expected.filter_verdict));
    EXPECT_EQ(candidate.decided_by, static_cast<std::uint8_t>(expected.decided_by));
    EXPECT_EQ(candidate.outcome, static_cast<std::uint8_t>(expected.outcome));
    const FilterNumbers numbers = expected.numbers.value_or(FilterNumbers{});
    const auto expect_number = [](const surehit_filter_number& number, const FilterNumber& of) {
      EXPECT_TRUE(same_bits(number.value, of.value) && same_bits(number.bound, of.bound));
    };
    expect_number(candidate.det, numbers.det);
    expect_number(candidate.t_det, numbers.t_det);
    expect_number(candidate.u_det, numbers.u_det);
    expect_number(candidate.v_det, numbers.v_det);
    expect_number(candidate.w_det, numbers.w_det);
  }
};
TYPED_TEST_SUITE(CExplain, Scalars, ScalarNames);

TYPED_TEST(CExplain, tells_what_cpp_tells) {
  using C = CFunctions<TypeParam>;
  Random random(41);
  std::size_t cells = 0;
  std::size_t hits = 0;
  for (std::size_t kind = 0; kind < small_mesh_kind_count; ++kind) {
    const auto mesh = draw_small_mesh<TypeParam>(kind, random);
    const Collider<TypeParam> cpp(mesh.view());
    const typename C::Mesh given = {
        mesh.vertices[0].data(), mesh.vertices.size(), 0, mesh.triangles.data(), mesh.triangles.size(), 0, 4};
    typename C::ColliderHandle* c = nullptr;
    ASSERT_EQ(C::create(&given, nullptr, &c), SUREHIT_OK);
    for (const Path<TypeParam>& path : mesh.paths) {
      QueryOptions<TypeParam> options;
      if (random.one_in(2)) options.ignored_triangle = static_cast<std::uint32_t>(random.below(4));
      if (random.one_in(4)) options.max_t = random.unit<TypeParam>();
      const auto expected = explain(cpp, path, options);
      const auto c_path = in_c(path);
      const auto c_options = in_c(options);
      Told<TypeParam> told;
      const typename C::Explainer explainer = {sizeof explainer, told.add_cell, told.add_candidate, told.add_hit,
                                               &told};
      std::uint32_t walk = 9;
      ASSERT_EQ(C::explain(c, &c_path, &c_options, &explainer, &walk), SUREHIT_OK) << surehit_last_error();
      EXPECT_EQ(walk, static_cast<std::uint32_t>(expected.walk));
      ASSERT_EQ(told.cells.size(), expected.cells.size());
      ASSERT_EQ(told.candidates.size(), expected.candidates.size());
      ASSERT_EQ(told.hits.size(), expected.hits.size());
      for (std::size_t i = 0; i < told.cells.size(); ++i) this->expect_same(told.cells[i], expected.cells[i]);
      for (std::size_t i = 0; i < told.candidates.size(); ++i) {
        this->expect_same(told.candidates[i], expected.candidates[i]);
      }
      for (std::size_t i = 0; i < told.hits.size(); ++i) {
        EXPECT_TRUE(same_bits(in_cpp(told.hits[i].hit), expected.hits[i].hit));
        EXPECT_EQ(told.hits[i].t_lower, expected.hits[i].t_lower);
        EXPECT_EQ(told.hits[i].t_upper, expected.hits[i].t_upper);
        EXPECT_EQ(told.hits[i].ordered_by, static_cast<std::uint8_t>(expected.hits[i].ordered_by));
        EXPECT_EQ(told.hits[i].is_rounded_by_integers != 0, expected.hits[i].is_rounded_by_integers);
      }
      cells += told.cells.size();
      hits += told.hits.size();
    }
    EXPECT_EQ(C::destroy(c), SUREHIT_OK);
  }
  EXPECT_GT(cells, 0U);
  EXPECT_GT(hits, 0U);
}

}  // namespace
}  // namespace surehit::test::c_explain_test
