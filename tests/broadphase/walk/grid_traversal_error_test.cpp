#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/scalars.hpp"
#include "walk_error.hpp"

namespace surehit::test {
namespace {

/// Beside the 16 eps R that WALK.md (L8) says the path stays within.
template <typename Scalar>
class GridTraversalError : public WalkError<Scalar> {
 protected:
  using typename WalkError<Scalar>::VisitedBox;

  [[nodiscard]] double worst_share(const Path<Scalar>& path) const override {
    const ClippedPath clipped(this->grid_, path, 0, 1);
    const auto course = this->course(path, clipped.octant);
    if (course.first > course.last) return 0;
    if (clipped.status != ClippedPath::Status::clipped) {
      ADD_FAILURE() << hex_text(path) << " is not walked";
      return 0;
    }
    std::vector<VisitedBox> boxes;
    for (GridTraversal traversal(this->grid_, clipped); !traversal.at_end(); traversal.advance()) {
      const CellWord word = traversal.word();
      const bool is_far = boxes.empty() || word.distance(clipped.octant) >= GridTraversal::min_leap ||
                          static_cast<std::uint32_t>(traversal.size()) != this->grid_.frame().division;
      const auto leap = static_cast<std::int32_t>(word.is_empty() && is_far ? word.distance(clipped.octant) : 1);
      VisitedBox box;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = traversal.low()[axis];
        box.high[axis] = box.low[axis] + leap * traversal.size();
      }
      boxes.push_back(box);
    }
    return this->share_for(boxes, course, 16);
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
}  // namespace surehit::test
