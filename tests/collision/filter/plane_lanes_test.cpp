#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <surehit/intersect.hpp>
#include <vector>

#include "collision/family_cases.hpp"
#include "filter/plane_lanes-inl.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/scalars.hpp"

namespace surehit::test::plane_lanes_test {
namespace {

namespace in_lanes = detail::HWY_NAMESPACE;

/// Up to a vector of triangles, in the layout of a list.
template <typename Scalar>
class PlaneList {
 public:
  explicit PlaneList(std::vector<Triangle<Scalar>> triangles) : triangles_(std::move(triangles)) {
    triangles_.resize(
        std::min(triangles_.size(), hwy::HWY_NAMESPACE::Lanes(hwy::HWY_NAMESPACE::ScalableTag<Scalar>())));
    constexpr std::size_t widest_load = 64;
    corners_.resize(9 * triangles_.size() + widest_load, Scalar{0});
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      std::size_t k = 0;
      for (const auto* const corner : {&triangles_[i].a, &triangles_[i].b, &triangles_[i].c}) {
        for (Eigen::Index axis = 0; axis < 3; ++axis) corners_[k++ * triangles_.size() + i] = (*corner)[axis];
      }
    }
  }

  [[nodiscard]] const std::vector<Triangle<Scalar>>& triangles() const { return triangles_; }
  [[nodiscard]] in_lanes::SeenLanes seen(std::size_t axis, const Path<Scalar>& path) const {
    const std::uint64_t all = (std::uint64_t{1} << triangles_.size()) - 1;
    return in_lanes::lanes_seen_along<Scalar>(axis, path, list(), 0, all);
  }
  [[nodiscard]] in_lanes::SharingLanes sharing(const Path<Scalar>& path) const {
    return in_lanes::lanes_that_share<Scalar>(path, list(), 0);
  }

 private:
  [[nodiscard]] in_lanes::TriangleList<Scalar> list() const {
    return {corners_.data(), triangles_.size(), 0, Scalar{0}};
  }

  std::vector<Triangle<Scalar>> triangles_;
  std::vector<Scalar> corners_;
};

bool has(std::uint64_t lanes, std::size_t lane) { return (lanes >> lane & 1) != 0; }

/// What is certain of the lanes is true.
template <typename Scalar>
void expect_true(std::size_t axis, const Segment<Scalar>& segment, const PlaneList<Scalar>& list) {
  const in_lanes::SeenLanes seen = list.seen(axis, segment);
  const in_lanes::SharingLanes sharing = list.sharing(segment);
  for (std::size_t i = 0; i < list.triangles().size(); ++i) {
    const Triangle<Scalar>& triangle = list.triangles()[i];
    SCOPED_TRACE(hex_text(Path<Scalar>(segment)) + hex_text(triangle));
    const auto hit = intersect<Scalar>(segment, triangle);
    const auto on = static_cast<Eigen::Index>(axis);
    const Scalar height = segment.start[on];
    const bool is_in_plane = triangle.a[on] == height && triangle.b[on] == height && triangle.c[on] == height;
    const bool is_at_corner = triangle.a == segment.start || triangle.b == segment.start || triangle.c == segment.start;
    EXPECT_EQ(has(sharing.plane[axis], i), is_in_plane);
    EXPECT_EQ(has(sharing.corner, i), is_at_corner);
    if (has(seen.misses, i)) {
      EXPECT_FALSE(hit);
    }
    if (has(seen.around, i) && is_in_plane) {
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->t, 0);
    }
  }
}

/// The drawn segments and triangles are moved into a plane: all points, or all but the triangles' last corners.
class PlaneLanesOfFamily : public testing::TestWithParam<PairFamily> {
 protected:
  template <typename Scalar>
  void check() {
    Random random(81);
    for (std::size_t i = case_count(80); i > 0 && !HasFailure(); --i) {
      FamilyList<Scalar> drawn(GetParam(), random);
      const std::size_t axis = random.below(3);
      const auto on = static_cast<Eigen::Index>(axis);
      const Scalar height = drawn.triangles.front().a[on];
      const bool stand = random.one_in(3);
      for (Triangle<Scalar>& triangle : drawn.triangles) {
        triangle.a[on] = triangle.b[on] = height;
        if (!stand) triangle.c[on] = height;
      }
      const PlaneList<Scalar> list(drawn.triangles);
      for (std::size_t k = 0; k < list.triangles().size(); ++k) {
        Segment<Scalar> segment = drawn.segments[k];
        segment.start[on] = segment.end[on] = height;
        expect_true(axis, segment, list);
      }
    }
  }
};

TEST_P(PlaneLanesOfFamily, are_never_wrong_for_float) { check<float>(); }
TEST_P(PlaneLanesOfFamily, are_never_wrong_for_double) { check<double>(); }

INSTANTIATE_TEST_SUITE_P(Families, PlaneLanesOfFamily, testing::ValuesIn(all_pair_families),
                         [](const auto& family) { return name_of(family.param); });

template <typename Scalar>
class PlaneLanes : public testing::Test {};
TYPED_TEST_SUITE(PlaneLanes, Scalars, ScalarNames);

TYPED_TEST(PlaneLanes, decide_nearly_all_random_misses_and_starts_in_a_plane) {
  using Scalar = TypeParam;
  Random random(82);
  const auto point = [&]() -> Vector3<Scalar> { return {random.symmetric<Scalar>(), random.symmetric<Scalar>(), 0}; };
  const std::size_t pairs = case_count(10'000);
  std::size_t misses = 0;
  std::size_t starts = 0;
  std::size_t undecided = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    const PlaneList<Scalar> list({{point(), point(), point()}});
    const Segment<Scalar> segment{point(), point()};
    const in_lanes::SeenLanes seen = list.seen(2, segment);
    const auto hit = intersect<Scalar>(segment, list.triangles().front());
    const bool is_start = hit && hit->t == 0;
    misses += !hit;
    starts += is_start;
    undecided += (!hit && seen.misses == 0) || (is_start && seen.around == 0);
  }
  EXPECT_GT(misses, pairs / 4);
  EXPECT_GT(starts, pairs / 50);
  EXPECT_LE(undecided, pairs / 1000);
}

/// Either way round, a corner may be as far on this side as the segment.
TYPED_TEST(PlaneLanes, leave_what_only_touches_undecided) {
  using Scalar = TypeParam;
  const Vector3<Scalar> a{0, 0, 0};
  const Vector3<Scalar> b{4, 0, 0};
  const Vector3<Scalar> c{0, 4, 0};
  const PlaneList<Scalar> one({{a, b, c}});
  const PlaneList<Scalar> other({{a, c, b}});
  for (const Segment<Scalar>& segment :
       {Segment<Scalar>{{-1, 5, 0}, {1, 3, 0}}, Segment<Scalar>{{-1, -1, 0}, {0, 0, 0}},
        Segment<Scalar>{{-2, 4, 0}, {2, 4, 0}}, Segment<Scalar>{{5, 0, 0}, {4, 0, 0}}}) {
    EXPECT_EQ(one.seen(2, segment).misses, 0u);
    EXPECT_EQ(other.seen(2, segment).misses, 0u);
    EXPECT_EQ(one.seen(2, segment).around, 0u);
  }
}

}  // namespace
}  // namespace surehit::test::plane_lanes_test
