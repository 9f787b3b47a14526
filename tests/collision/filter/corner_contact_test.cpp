#include "filter/corner_contact.hpp"

#include <gtest/gtest.h>

#include <cstddef>

#include "collision/contact_oracle.hpp"
#include "support/case_count.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"

namespace surehit::test::corner_contact_test {
namespace {

using detail::CornerContact;
using detail::PathRange;
using detail::Verdict;

template <typename Scalar>
CornerContact<Scalar> contact_of(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                 const QueryOptions<Scalar>& options = {}) {
  return detail::corner_contact(path, triangle, PathRange<Scalar>(path, options));
}

template <typename Scalar>
const Vector3<Scalar>& corner(const Triangle<Scalar>& triangle, std::size_t index) {
  return index == 0 ? triangle.a : index == 1 ? triangle.b : triangle.c;
}

/// What is decided is true.
template <typename Scalar>
void expect_true(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const QueryOptions<Scalar>& options) {
  if (PathRange<Scalar>(path, options).is_empty()) return;
  SCOPED_TRACE(hex_text(path) + hex_text(triangle) + hex_text(options));
  const CornerContact<Scalar> found = contact_of(path, triangle, options);
  if (found.verdict == Verdict::undecided) return;
  const auto truth = exact_contact(path, triangle, options);
  ASSERT_EQ(found.verdict == Verdict::hit, truth.has_value());
  if (!truth) return;
  expect_contact_of(*truth, found.contact, path, triangle, options);
  EXPECT_EQ(mpq_class(found.contact.t_lower), truth->t);
  EXPECT_EQ(mpq_class(found.contact.t_upper), truth->t);
  EXPECT_EQ(mpq_class(double{found.u}), truth->u);
  EXPECT_EQ(mpq_class(double{found.v}), truth->v);
}

class CornerContactOfFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  void check() {
    Random random(71);
    for (std::size_t i = case_count(3'000); i > 0 && !HasFailure(); --i) {
      auto [segment, triangle] = draw_pair<Scalar>(GetParam(), random);
      const std::size_t moved = random.below(3);
      if (moved != 1) segment.start = corner(triangle, random.below(3));
      if (moved != 0) segment.end = corner(triangle, random.below(3));
      for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
        const Path<Scalar> path = path_along(segment, kind);
        expect_true(path, triangle, {});
        QueryOptions<Scalar> options = draw_options(random, random.one_in(2) ? Scalar{0} : Scalar{1});
        keep_limits_alone(options);
        expect_true(path, triangle, options);
      }
    }
  }
};

TEST_P(CornerContactOfFamily, is_never_wrong_for_float) { check<float>(); }
TEST_P(CornerContactOfFamily, is_never_wrong_for_double) { check<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, CornerContactOfFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
class CornerContactOf : public testing::Test {
 protected:
  const Triangle<Scalar> triangle_ = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
};
TYPED_TEST_SUITE(CornerContactOf, Scalars, ScalarNames);

TYPED_TEST(CornerContactOf, start_is_at_its_weights) {
  for (const std::size_t index : {0U, 1U, 2U}) {
    const Vector3<TypeParam> at = corner(this->triangle_, index);
    const auto found = contact_of<TypeParam>(Segment<TypeParam>{at, {1, 1, 3}}, this->triangle_);
    ASSERT_EQ(found.verdict, Verdict::hit);
    EXPECT_EQ(found.contact.t_upper, 0);
    EXPECT_EQ(found.contact.side, Side::back);
    EXPECT_TRUE(found.contact.at_start && !found.contact.at_end);
    EXPECT_EQ(found.u, index == 1);
    EXPECT_EQ(found.v, index == 2);
  }
}

TYPED_TEST(CornerContactOf, end_is_the_only_one_across_the_plane) {
  const auto found = contact_of<TypeParam>(Segment<TypeParam>{{1, 1, 3}, {4, 0, 0}}, this->triangle_);
  ASSERT_EQ(found.verdict, Verdict::hit);
  EXPECT_EQ(found.contact.t_lower, 1);
  EXPECT_EQ(found.contact.side, Side::front);
  EXPECT_TRUE(!found.contact.at_start && found.contact.at_end);
}

TYPED_TEST(CornerContactOf, edge_begins_at_the_start) {
  const auto found = contact_of<TypeParam>(Segment<TypeParam>{{0, 4, 0}, {4, 0, 0}}, this->triangle_);
  ASSERT_EQ(found.verdict, Verdict::hit);
  EXPECT_EQ(found.contact.t_upper, 0);
  EXPECT_EQ(found.contact.side, Side::edge_on);
  EXPECT_TRUE(found.contact.at_start && found.contact.at_end);
  EXPECT_EQ(found.v, 1);
}

TYPED_TEST(CornerContactOf, t_out_of_range_is_a_miss) {
  QueryOptions<TypeParam> options;
  options.min_t = TypeParam(0.25);
  options.max_t = TypeParam(0.75);
  const Segment<TypeParam> up{{0, 0, 0}, {1, 1, 3}};
  const Segment<TypeParam> down{{1, 1, 3}, {0, 0, 0}};
  EXPECT_EQ(contact_of<TypeParam>(up, this->triangle_, options).verdict, Verdict::miss);
  EXPECT_EQ(contact_of<TypeParam>(down, this->triangle_, options).verdict, Verdict::miss);
}

TYPED_TEST(CornerContactOf, other_paths_stay_undecided) {
  const auto is_undecided = [&](const Path<TypeParam>& path, const Triangle<TypeParam>& triangle) {
    return contact_of(path, triangle).verdict == Verdict::undecided;
  };
  const Triangle<TypeParam> flat{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
  EXPECT_TRUE(is_undecided(Segment<TypeParam>{{1, 1, 3}, {1, 1, -3}}, this->triangle_)) << "no corner";
  EXPECT_TRUE(is_undecided(Segment<TypeParam>{{8, 1, 0}, {4, 0, 0}}, this->triangle_)) << "in the plane";
  EXPECT_TRUE(is_undecided(Ray<TypeParam>{{1, 1, 3}, {4, 0, 0}}, this->triangle_)) << "a direction is no corner";
  EXPECT_TRUE(is_undecided(Segment<TypeParam>{{4, 0, 0}, {4, 0, 0}}, this->triangle_)) << "a point";
  EXPECT_TRUE(is_undecided(Segment<TypeParam>{{0, 0, 0}, {2, 2, 0}}, flat)) << "no plane";
  EXPECT_TRUE(is_undecided(Segment<TypeParam>{{0, 0, 0}, {2, 2, 5}}, flat)) << "no plane";
}

/// Paths between corners of a mesh are decided without integers, unless they lie in a plane of a triangle at one end.
TYPED_TEST(CornerContactOf, random_triangle_is_nearly_always_decided) {
  Random random(72);
  const auto point = [&]() -> Vector3<TypeParam> {
    return Vector3<TypeParam>::NullaryExpr([&] { return random.symmetric<TypeParam>(); });
  };
  std::size_t undecided = 0;
  const std::size_t pairs = case_count(10'000);
  for (std::size_t i = 0; i < pairs; ++i) {
    const Triangle<TypeParam> triangle{point(), point(), point()};
    undecided += contact_of<TypeParam>(Segment<TypeParam>{triangle.b, point()}, triangle).verdict == Verdict::undecided;
    undecided +=
        contact_of<TypeParam>(Segment<TypeParam>{triangle.c, triangle.a}, triangle).verdict == Verdict::undecided;
  }
  EXPECT_EQ(undecided, 0u);
}

}  // namespace
}  // namespace surehit::test::corner_contact_test
