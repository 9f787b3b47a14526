#include <gtest/gtest.h>

#include "support/scalars.hpp"
#include "walk_error.hpp"

namespace surehit::test::grid_traversal_error_test {
namespace {

/// Beside the 16 eps R that WALK.md (L8) says the path stays within.
template <typename Scalar>
class GridTraversalError : public WalkError<Scalar> {
 protected:
  [[nodiscard]] double worst_share(const Path<Scalar>& path) const override {
    const ClippedPath clipped(this->grid_, path, 0, 1);
    const auto course = this->course(path, clipped.octant);
    if (course.first > course.last) return 0;
    if (clipped.status != ClippedPath::Status::clipped) {
      ADD_FAILURE() << hex_text(path) << " is not walked";
      return 0;
    }
    return this->share_for(this->visited_boxes(clipped), course, 16);
  }
};
TYPED_TEST_SUITE(GridTraversalError, Scalars, ScalarNames);

TYPED_TEST(GridTraversalError, stays_below_its_bound_on_random_paths) {
  this->expect_below_one(this->draw_worst(20, 300));
}

/// A path of doubles is clipped in doubles, which takes up a few of the 16 roundings less.
TYPED_TEST(GridTraversalError, stays_below_its_bound_where_hill_climbing_makes_it_worst) {
  const double worst = this->climb(24, 1'000);
  this->expect_below_one(worst);
  if (runs_all_cases()) {
    EXPECT_GT(worst, sizeof(TypeParam) == sizeof(float) ? 0.1 : 0.04) << "room to waste";
  }
}

}  // namespace
}  // namespace surehit::test::grid_traversal_error_test
