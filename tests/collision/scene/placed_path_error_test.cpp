// How close the errors of a placed path come to the bounds of POSES.md.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "collision/rational_determinants.hpp"
#include "placed_path_climb.hpp"
#include "placed_path_shares.hpp"
#include "support/exact_oracle.hpp"
#include "support/hill_climb.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"

namespace surehit::test::placed_path_error_test {
namespace {

constexpr double eps = 0x1p-53;

/// Returns the share that an error takes up of a rounding of x to double and a bound together.
double share_of_rounded(const ExactVector& error, const ExactVector& x, const mpq_class& bound) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class whole = mpq_class(eps) * abs(x[i]) + bound;
    if (error[i] != 0) largest = std::max(largest, mpq_class(abs(error[i]) / whole).get_d());
  }
  return largest;
}

/// Returns `middle_error` of an instance that is only translated. Its start is `middle`, and `start_error` is 11 eps of
/// that and twice `middle_error` (I7).
template <typename Scalar>
mpq_class middle_error_of(const Placed<Scalar>& placed) {
  const mpq_class size = largest_of(exact(placed.path().moved.start));
  return (mpq_class(placed.path().start_error) - mpq_class(11 * eps) * size) / 2;
}

template <typename Scalar>
class PlacedPathError : public PlacedPathClimb<Scalar> {};
TYPED_TEST_SUITE(PlacedPathError, Scalars, ScalarNames);

/// I4. `direction_error` of an instance that is only translated is 8 eps of the way and twice `way_error`.
TYPED_TEST(PlacedPathError, of_a_way_against_a_motion_stays_within_its_bound_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto draw = [&] {
    Drawn drawn = this->draw_translated();
    drawn.placement.motion = this->vector(std::exp2(real(this->random_, -30, 30)));
    drawn.placement.moves = true;
    // In half of all cases, the path moves with the instance. So its way is hardly more than what roundings leave.
    drawn.path.kind = PathKind::segment;
    drawn.path.start = drawn.placement.pose.translation;
    const Vector3<TypeParam> way = drawn.share * drawn.placement.motion;
    drawn.path.toward = drawn.path.start + (this->random_.one_in(2) ? way : this->vector(1));
    drawn.range = {0, 1};
    drawn.set_exact();
    return drawn;
  };
  const auto share = [](const Drawn& drawn) {
    const Placed<TypeParam> placed(drawn);
    if (!placed.is_near) return 0.0;
    const ExactVector way = exact(placed.path().moved.direction);
    const mpq_class way_error = (mpq_class(placed.path().direction_error) - mpq_class(8 * eps) * largest_of(way)) / 2;
    return share_of_rounded(drawn.direction - way, way, way_error);
  };
  this->climb("way", share, draw);
}

/// I6.
TYPED_TEST(PlacedPathError, of_a_start_that_was_moved_stays_within_its_bound_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto share_on = [](Way way) {
    return [way](const Drawn& drawn) {
      const Placed<TypeParam> placed(drawn, way);
      if (!placed.is_near) return 0.0;
      const ExactVector middle = exact(placed.path().moved.start);
      // If the errors were too large for the usual way, the path was placed carefully.
      if (way == Way::usual && middle_error_of(placed) < mpq_class(3 * eps) * largest_of(middle)) return 0.0;
      return share_of_rounded(drawn.local_at(mpq_class(placed.path().moved.moved_t)) - middle, middle,
                              middle_error_of(placed));
    };
  };
  // With a motion, segments are placed carefully anyway.
  const auto draw_still = [&] { return this->still(this->draw_translated()); };
  this->climb("middle", share_on(Way::usual), draw_still);
  this->climb("middle_carefully", share_on(Way::carefully), [&] { return this->draw_translated(); });
  this->climb_side_by_side("middle", share_on(Way::side_by_side), draw_still);
}

/// A segment that moves against an instance, and comes so close to the anchor at t that hardly anything is left of its
/// middle. The motion is what is nearest to this.
template <typename Scalar>
struct PathThroughAnchor {
  PathAndInstance<Scalar> drawn;
  mpq_class t;

  void set_motion() {
    const auto& path = drawn.path;
    const ExactVector middle =
        exact(path.start) - exact(drawn.placement.pose.translation) + t * (exact(path.toward) - exact(path.start));
    for (std::size_t i = 0; i < 3; ++i) {
      drawn.placement.motion[static_cast<Eigen::Index>(i)] =
          nearest<Scalar>(middle[i] / (t * mpq_class(double{drawn.share})));
    }
    drawn.set_exact();
  }
};

/// I6 where the errors are all that there is. Only what is beyond the last rounding counts.
TEST(PlacedPathThroughItsAnchor, stays_within_its_bound_where_hill_climbing_makes_the_error_worst) {
  Random random(5);
  const auto vector = [&](double size) {
    const double x = size * random.symmetric<double>();
    const double y = size * random.symmetric<double>();
    return Vector3<double>(x, y, size * random.symmetric<double>());
  };
  const auto draw = [&] {
    PathThroughAnchor<double> through;
    PathAndInstance<double>& drawn = through.drawn;
    drawn.placement.pose.translation = vector(std::exp2(real(random, -60, 0)));
    drawn.placement.moves = true;
    drawn.box = {{-1, -1, -1}, {1, 1, 1}};
    drawn.share = random.one_in(4) ? 1 : random.unit<double>();
    // For a segment, t is a multiple of 2^-20.
    const double t = std::ldexp(static_cast<double>(random.between(1, 1 << 20)), -20);
    through.t = t;
    const Vector3<double> start = vector(1);
    const Vector3<double> motion = vector(std::exp2(real(random, -60, 0)));
    drawn.path = Segment<double>{start, start + (drawn.placement.pose.translation - start) / t + drawn.share * motion};
    through.set_motion();
    return through;
  };
  const auto changed_case = [&](PathThroughAnchor<double> through) {
    PathAndInstance<double>& drawn = through.drawn;
    const std::size_t which = random.below(10);
    const auto axis = static_cast<Eigen::Index>(which % 3);
    double& number = which == 9  ? drawn.share
                     : which > 5 ? drawn.placement.pose.translation[axis]
                     : which > 2 ? drawn.path.start[axis]
                                 : drawn.path.toward[axis];
    number += number * std::ldexp(random.symmetric<double>(), -static_cast<int>(random.between(0, 53)));
    drawn.share = std::clamp(drawn.share, 0x1p-60, 1.0);
    through.set_motion();
    return through;
  };
  const auto share = [](const PathThroughAnchor<double>& through) {
    const Placed<double> placed(through.drawn);
    const mpq_class middle_error = middle_error_of(placed);
    if (!placed.is_near || middle_error < mpq_class(16 * eps) * largest_of(exact(placed.path().moved.start)))
      return 0.0;
    const ExactVector middle = exact(placed.path().moved.start);
    const ExactVector off = through.drawn.local_at(mpq_class(placed.path().moved.moved_t)) - middle;
    mpq_class beyond;
    for (std::size_t i = 0; i < 3; ++i)
      beyond = std::max(beyond, mpq_class(abs(off[i]) - mpq_class(eps) * abs(middle[i])));
    return mpq_class(beyond / middle_error).get_d();
  };
  expect_within_bound("middle_carefully_before_rounding", climb_to_worst(20, 400, draw, changed_case, share));
}

/// I7.
TYPED_TEST(PlacedPathError, in_the_mesh_stays_within_its_bounds_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  for (const auto& [name, share] : {std::pair("start", &PathShares::start),
                                    {"direction", &PathShares::direction},
                                    {"position", &PathShares::position},
                                    {"reach", &PathShares::reach}}) {
    const auto share_on = [share = share](Way way) {
      return [=](const Drawn& drawn) {
        const Placed<TypeParam> placed(drawn, way);
        return placed.is_near ? PathShares(drawn, placed.path()).*share : 0;
      };
    };
    const auto draw = [&] { return this->draw(); };
    this->climb(name, share_on(Way::usual), draw, 6, 150);
    this->climb(name + std::string("_carefully"), share_on(Way::carefully), draw, 6, 150);
    this->climb_side_by_side(name, share_on(Way::side_by_side), [&] { return this->still(draw()); });
  }
}

/// I7 where only the direction counts.
TYPED_TEST(PlacedPathError, from_the_anchor_stays_within_its_bound_where_hill_climbing_makes_it_worst) {
  using Drawn = PathAndInstance<TypeParam>;
  const auto share_on = [](Way way) {
    return [way](const Drawn& drawn) {
      const Placed<TypeParam> placed(drawn, way);
      return placed.is_near ? PathShares(drawn, placed.path()).position : 0;
    };
  };
  const auto draw = [&] { return this->draw_from_anchor(); };
  this->climb("position", share_on(Way::usual), draw);
  this->climb("position_carefully", share_on(Way::carefully), draw);
  this->climb_side_by_side("position", share_on(Way::side_by_side), draw);
}

/// Returns the largest share that the errors of a path take up of what its sizes grow by for them (I8).
template <typename MeshScalar, typename Scalar>
double share_of_growth(const PathAndInstance<Scalar>& drawn) {
  const Placed<Scalar> placed(drawn);
  if (!placed.is_near) return 0;
  const auto kernel = placed.path().template kernel_path<MeshScalar>();
  if (std::isinf(kernel.d_size)) return 0;
  const ExactVector start = exact(kernel.start);
  const ExactVector d = exact(kernel.d);
  const ExactVector exact_start = drawn.local_at(mpq_class(placed.path().moved.moved_t));
  const ExactVector exact_d = mpq_class(placed.path().kernel_scale()) * (drawn.inverse_matrix * drawn.direction);
  const mpq_class grown_s(double{kernel.reach});
  const mpq_class grown_d(double{kernel.d_size});
  double largest = 0;
  for (const std::array<unsigned, 3>& corners : {std::array{0u, 3u, 5u}, {7u, 4u, 2u}, {6u, 1u, 0u}, {1u, 7u, 4u}}) {
    const auto corner = [&](unsigned which) {
      Vector3<double> point;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        point[axis] = (which >> axis & 1) != 0 ? drawn.box.high[axis] : drawn.box.low[axis];
      }
      return point;
    };
    const Triangle<double> triangle{corner(corners[0]), corner(corners[1]), corner(corners[2])};
    const RationalDeterminants computed = rational_determinants(start, d, triangle);
    const RationalDeterminants exactly = rational_determinants(exact_start, exact_d, triangle);
    const mpq_class e = largest_of(exact(triangle.b) - exact(triangle.a));
    const mpq_class f = largest_of(exact(triangle.c) - exact(triangle.a));
    const mpq_class s = largest_of(start - exact(triangle.a));
    const mpq_class grown_by = grown_s * grown_d - s * largest_of(d);
    // K2 has 48 eps times each product of sizes.
    const mpq_class relative(24 * double{std::numeric_limits<MeshScalar>::epsilon()});
    const auto include = [&](const mpq_class& error, const mpq_class& sizes) {
      if (sizes > 0) largest = std::max(largest, mpq_class(abs(error) / (relative * sizes)).get_d());
    };
    include(exactly.det - computed.det, (grown_d - largest_of(d)) * e * f);
    include(exactly.height - computed.height, (grown_s - s) * e * f);
    include(exactly.u - computed.u, grown_by * f);
    include(exactly.v - computed.v, grown_by * e);
  }
  return largest;
}

TYPED_TEST(PlacedPathError, of_determinants_stays_within_what_sizes_grow_by_where_hill_climbing_makes_it_worst) {
  this->climb("kernel_of_floats", [](const auto& drawn) { return share_of_growth<float>(drawn); });
  this->climb("kernel_of_doubles", [](const auto& drawn) { return share_of_growth<double>(drawn); });
}

}  // namespace
}  // namespace surehit::test::placed_path_error_test
