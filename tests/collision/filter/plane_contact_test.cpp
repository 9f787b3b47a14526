#include "filter/plane_contact.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "collision/contact_oracle.hpp"
#include "collision/family_cases.hpp"
#include "support/case_count.hpp"
#include "support/neighbour.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"

namespace surehit::test::plane_contact_test {
namespace {

using detail::BoundedContact;
using detail::PathRange;
using detail::Verdict;

/// Returns the pair, moved into the plane through the triangle's first corner that is perpendicular to the axis.
template <typename Scalar>
Pair<Scalar> flattened(Pair<Scalar> pair, Eigen::Index axis) {
  const Scalar height = pair.triangle.a[axis];
  for (auto* const point : {&pair.segment.start, &pair.segment.end, &pair.triangle.b, &pair.triangle.c}) {
    (*point)[axis] = height;
  }
  return pair;
}

/// What is decided is true.
template <typename Scalar>
void expect_true(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const QueryOptions<Scalar>& options) {
  const PathRange<Scalar> range(path, options);
  if (range.is_empty()) return;
  const BoundedContact bounded = detail::plane_contact(path, triangle, range);
  SCOPED_TRACE(hex_text(path) + hex_text(triangle) + hex_text(options));
  const auto truth = expect_decided(bounded, path, triangle, options);
  if (!truth) return;
  const auto expect_holds = [](const std::array<double, 2>& interval, const mpq_class& exact) {
    if (!std::isfinite(interval[0]) || !std::isfinite(interval[1])) return;
    EXPECT_LE(mpq_class(interval[0]), exact);
    EXPECT_GE(mpq_class(interval[1]), exact);
  };
  expect_holds(bounded.by_det.of(bounded.u_scaled), truth->u);
  expect_holds(bounded.by_det.of(bounded.v_scaled), truth->v);
}

class PlaneContactOfFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  void check() {
    Random random(61);
    for (std::size_t i = case_count(3'000); i > 0 && !HasFailure(); --i) {
      const auto drawn = draw_pair<Scalar>(GetParam(), random);
      const auto [segment, triangle] = flattened(drawn, static_cast<Eigen::Index>(random.below(3)));
      for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
        const Path<Scalar> path = path_along(segment, kind);
        expect_true(path, triangle, {});
        QueryOptions<Scalar> options = draw_options(random, random.unit<Scalar>());
        keep_limits_alone(options);
        expect_true(path, triangle, options);
      }
    }
  }
};

TEST_P(PlaneContactOfFamily, is_never_wrong_for_float) { check<float>(); }
TEST_P(PlaneContactOfFamily, is_never_wrong_for_double) { check<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, PlaneContactOfFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

/// The bound of the product of the normal and a weight may be larger than the product itself.
TEST(PlaneContactOfSlivers, is_never_wrong) {
  const Triangle<double> found{
      {0, 0, 0}, {0x1.a79ecba41310fp+0, 0x1.93147a4a41c40p-3, 0}, {0x1.6b8378508c323p+0, 0x1.59e33ee520223p-3, 0}};
  const Vector3<double> from(0x1.567b9f781f8e2p+0, 0x1.45e072b6e0762p-3, 0);
  const Vector3<double> to(0x1.3c161b48babd1p+0, 0x1.2cc29649d9872p-3, 0);
  expect_true(Path<double>(Line<double>{from, to - from}), found, {});
  expect_true(Path<double>(Ray<double>{from, to - from}), found, {});
  Random random(63);
  for (std::size_t i = case_count(20'000); i > 0 && !testing::Test::HasFailure(); --i) {
    const auto draw = [&]() -> Vector3<double> { return {random.symmetric<double>(), random.symmetric<double>(), 0}; };
    const Vector3<double> a = random.one_in(2) ? draw() : Vector3<double>::Zero();
    const Vector3<double> edge = draw();
    const double thickness = std::ldexp(1.0, -static_cast<int>(random.between(44, 53)));
    const Triangle<double> sliver{a, a + edge, a + random.unit<double>() * edge + thickness * draw()};
    const Vector3<double> start = a + random.unit<double>() * edge + thickness * draw();
    const Vector3<double> way = random.one_in(2) ? draw() : Vector3<double>(edge + thickness * draw());
    for (const Path<double>& path :
         {Path<double>(Line<double>{start, way}), Path<double>(Ray<double>{start - way, way}),
          Path<double>(Segment<double>{start - way, start + way})}) {
      expect_true(path, sliver, {});
    }
  }
}

template <typename Scalar>
class PlaneContact : public testing::Test {
 protected:
  static BoundedContact contact_of(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                   const QueryOptions<Scalar>& options = {}) {
    return detail::plane_contact(path, triangle, PathRange<Scalar>(path, options));
  }

  const Triangle<Scalar> triangle_ = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
};
TYPED_TEST_SUITE(PlaneContact, Scalars, ScalarNames);

TYPED_TEST(PlaneContact, decides_nearly_all_random_pairs_in_a_plane) {
  using Scalar = TypeParam;
  Random random(62);
  const auto point = [&]() -> Vector3<Scalar> {
    return Vector3<Scalar>::NullaryExpr([&] { return random.symmetric<Scalar>(); });
  };
  const std::size_t pairs = case_count(10'000);
  std::size_t undecided = 0;
  std::size_t hits = 0;
  std::size_t unknown = 0;  // The hits with weights that are not known.
  for (std::size_t i = 0; i < pairs; ++i) {
    const auto axis = static_cast<Eigen::Index>(random.below(3));
    const auto [segment, triangle] = flattened<Scalar>({{point(), point()}, {point(), point(), point()}}, axis);
    const BoundedContact contact = this->contact_of(segment, triangle);
    undecided += contact.verdict == Verdict::undecided;
    if (contact.verdict != Verdict::hit) continue;
    ++hits;
    unknown += !std::isfinite(contact.by_det.of(contact.u_scaled)[0]);
    EXPECT_LT(contact.contact.t_upper - contact.contact.t_lower, 1e-9);
  }
  EXPECT_LE(undecided, pairs / 1000);
  EXPECT_LE(unknown, pairs / 1000);
  EXPECT_GT(hits, pairs / 10);
}

TYPED_TEST(PlaneContact, of_a_start_inside_is_at_the_begin) {
  const BoundedContact contact = this->contact_of(Segment<TypeParam>{{1, 1, 0}, {9, 3, 0}}, this->triangle_);
  EXPECT_EQ(contact.verdict, Verdict::hit);
  EXPECT_EQ(contact.contact.t_lower, 0);
  EXPECT_EQ(contact.contact.t_upper, 0);
  EXPECT_EQ(contact.contact.side, Side::edge_on);
  EXPECT_TRUE(contact.contact.at_start && !contact.contact.at_end);
}

TYPED_TEST(PlaneContact, of_an_end_inside_knows_the_end) {
  const BoundedContact contact = this->contact_of(Segment<TypeParam>{{9, 3, 0}, {1, 1, 0}}, this->triangle_);
  EXPECT_EQ(contact.verdict, Verdict::hit);
  EXPECT_TRUE(!contact.contact.at_start && contact.contact.at_end);
}

TYPED_TEST(PlaneContact, along_an_edge_on_an_axis_is_certain) {
  const BoundedContact inside = this->contact_of(Segment<TypeParam>{{1, 0, 0}, {3, 0, 0}}, this->triangle_);
  EXPECT_EQ(inside.verdict, Verdict::hit);
  const BoundedContact beside = this->contact_of(Segment<TypeParam>{{-3, 0, 0}, {-1, 0, 0}}, this->triangle_);
  EXPECT_EQ(beside.verdict, Verdict::miss);
}

TYPED_TEST(PlaneContact, at_a_corner_of_any_size_is_certain) {
  using Scalar = TypeParam;
  const Vector3<Scalar> corner(Scalar(0.1), Scalar(0.7), 0);
  const Vector3<Scalar> b(Scalar(4.3), Scalar(0.9), 0);
  const Vector3<Scalar> c(Scalar(1.1), Scalar(3.7), 0);
  const Vector3<Scalar> behind(Scalar(-1.3), Scalar(0.1), 0);
  const Vector3<Scalar> beyond(Scalar(5.9), Scalar(4.7), 0);
  for (const Triangle<Scalar>& triangle :
       {Triangle<Scalar>{corner, b, c}, Triangle<Scalar>{corner, c, b}, Triangle<Scalar>{b, c, corner}}) {
    const BoundedContact touched = this->contact_of(Segment<Scalar>{behind, corner}, triangle);
    EXPECT_EQ(touched.verdict, Verdict::hit);
    EXPECT_EQ(touched.contact.t_lower, 1);
    EXPECT_EQ(touched.contact.t_upper, 1);
    EXPECT_TRUE(!touched.contact.at_start && touched.contact.at_end);
    const BoundedContact left = this->contact_of(Segment<Scalar>{corner, behind}, triangle);
    EXPECT_EQ(left.verdict, Verdict::hit);
    EXPECT_EQ(left.contact.t_upper, 0);
    EXPECT_TRUE(left.contact.at_start && !left.contact.at_end);
    const BoundedContact crossed = this->contact_of(Segment<Scalar>{beyond, corner}, triangle);
    EXPECT_EQ(crossed.verdict, Verdict::hit);
    EXPECT_GT(crossed.contact.t_lower, 0.2);
    EXPECT_LT(crossed.contact.t_upper, 0.8);
    EXPECT_TRUE(!crossed.contact.at_start && crossed.contact.at_end);
  }
}

TYPED_TEST(PlaneContact, leaves_a_path_through_a_corner_alone_undecided) {
  const Segment<TypeParam> through_corner{{3, -1, 0}, {5, 1, 0}};
  EXPECT_EQ(this->contact_of(through_corner, this->triangle_).verdict, Verdict::undecided);
}

TYPED_TEST(PlaneContact, leaves_other_planes_undecided) {
  const Segment<TypeParam> in_plane{{-1, 1, 0}, {5, 1, 0}};
  ASSERT_EQ(this->contact_of(in_plane, this->triangle_).verdict, Verdict::hit);
  const TypeParam above = neighbour(TypeParam{0}, 1);
  for (const std::size_t moved : {0U, 1U, 2U, 3U, 4U}) {
    Segment<TypeParam> segment = in_plane;
    Triangle<TypeParam> triangle = this->triangle_;
    (moved == 0   ? segment.start
     : moved == 1 ? segment.end
     : moved == 2 ? triangle.a
     : moved == 3 ? triangle.b
                  : triangle.c)[2] = above;
    EXPECT_EQ(this->contact_of(segment, triangle).verdict, Verdict::undecided) << moved;
  }
  const Ray<TypeParam> leaving{{-1, 1, 0}, {6, 0, above}};
  EXPECT_EQ(this->contact_of(leaving, this->triangle_).verdict, Verdict::undecided);
}

TYPED_TEST(PlaneContact, leaves_segments_and_points_undecided) {
  const Segment<TypeParam> in_plane{{-1, 1, 0}, {5, 1, 0}};
  const Triangle<TypeParam> flat{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
  EXPECT_EQ(this->contact_of(in_plane, flat).verdict, Verdict::undecided);
  EXPECT_EQ(this->contact_of(Segment<TypeParam>{{1, 1, 0}, {1, 1, 0}}, this->triangle_).verdict, Verdict::undecided);
}

}  // namespace
}  // namespace surehit::test::plane_contact_test
