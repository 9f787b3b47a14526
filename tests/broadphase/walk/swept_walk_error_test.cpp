#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "swept_error.hpp"

namespace surehit::test::swept_walk_error_test {
namespace {

/// Looks for the list of one cell.
class ListSeeker final : public SweptVisitor {
 public:
  ListSeeker(CellWord word, double limit) : word_(word.bits()), limit_(limit) {}

  double visit_list(CellWord word) override {
    is_found_ |= word.bits() == word_;
    return is_found_ ? -1 : limit_;
  }
  [[nodiscard]] bool is_found() const { return is_found_; }

 private:
  std::uint32_t word_;
  double limit_;
  bool is_found_ = false;
};

/// Beside the 2^-48 S by which the walk makes a box larger (W1, W2). The box visits a list from some size or t on. Both
/// are those at which it is just so near, but for roundings.
class SweptWalkError : public SweptError {
 protected:
  [[nodiscard]] bool visits_list(const BoxAtCell& box) const {
    ListSeeker seeker(leaves_[box.leaf].word, box.limit);
    std::uint64_t cells = 0;
    return SweptWalk{grid_, box.swept, nullptr, box.limit, seeker, cells}.walk() && seeker.is_found();
  }

  /// Returns how many times the box must be made larger by 2^-48 S to come to its list. It is about 1.
  [[nodiscard]] mpq_class growth_to_list(const BoxAtCell& box) const {
    const GridFrame& frame = grid_.frame();
    const auto [start, way, half] = exact(box.swept);
    ExactPoint padding;
    ExactPoint margin;
    for (std::size_t i = 0; i < 3; ++i) {
      padding[i] = double{frame.padding(i)};
      const mpq_class end = start[i] + way[i];
      margin[i] = (abs(start[i]) + abs(end) + half[i] + frame.resolution(i)) * 0x1p-48;
    }
    return growth_to_meet(gaps_to_list(box, padding, margin), mpq_class(box.limit));
  }
};

TEST_F(SweptWalkError, of_boxes_in_cells_stays_below_its_bound_where_hill_climbing_makes_it_worst) {
  const auto share_of = [&](BoxAtCell box) {
    double& half = box.swept.half_extents[box.axis];
    const double most = half_of(box.axis, 8);
    const auto visits_with = [&](double x) {
      half = x;
      return visits_list(box);
    };
    if (visits_with(0) || !visits_with(most)) return 0.0;
    half = last_before(0, most, visits_with);
    return mpq_class(1 - growth_to_list(box)).get_d();
  };
  expect_within_bound("W1", worst(181, 600, 8, 4, share_of));
}

TEST_F(SweptWalkError, of_times_stays_below_its_bound_where_hill_climbing_makes_it_worst) {
  const auto share_of = [&](BoxAtCell box) {
    const auto visits_until = [&](double t) {
      box.limit = t;
      return visits_list(box);
    };
    if (visits_until(0) || !visits_until(1)) return 0.0;
    box.limit = last_before(0, 1, visits_until);
    return std::fabs(mpq_class(1 - growth_to_list(box)).get_d());
  };
  expect_within_bound("W2", worst(191, 700, 8, 4, share_of));
}

}  // namespace
}  // namespace surehit::test::swept_walk_error_test
