#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "support/random.hpp"

namespace surehit::test {

/// Judges triangulations of an outline as it is seen along one axis, by what they have to cover.
///
/// It counts how often the outline winds round points: its corners, points on its edges and beside them, and random
/// ones. Everything is exact: coordinates are whole numbers, in a unit in which the points are whole as well.
class OutlineJudge {
 public:
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;

  template <typename Scalar>
  OutlineJudge(const std::vector<std::array<Scalar, 3>>& outline, std::size_t axis, Random& random);

  /// Twice the area, positive where the outline winds to the left.
  [[nodiscard]] const mpz_class& doubled_area() const { return doubled_area_; }

  /// Whether the outline winds once round some points and not round all others, as far as it was looked. Otherwise it
  /// crosses itself for certain.
  [[nodiscard]] bool winds_once() const {
    return winds_left_ <= 1 && winds_right_ <= 1 && (winds_left_ == 0 || winds_right_ == 0);
  }

  /// What is wrong with the triangles by themselves: their number, how they are joined, how they turn, and their area.
  /// Nothing where that is right. They hold positions in the outline. `is_reversed`: it is walked backwards.
  [[nodiscard]] std::string complaint(const Triangles& triangles, bool is_reversed) const;

  /// What is wrong with what they cover. Looks at many points.
  [[nodiscard]] std::string complaint_about_cover(const Triangles& triangles) const;

 private:
  struct Point {
    mpz_class x, y;
  };
  struct Sample {
    Point point;
    bool is_on_outline;
    int winding;
  };

  void look_at(const Point& point);
  [[nodiscard]] std::string complaint_about_rim(const Triangles& triangles, bool is_reversed) const;

  std::vector<Point> corners_;
  std::vector<Sample> samples_;
  mpz_class doubled_area_;
  int winds_left_ = 0;
  int winds_right_ = 0;
};

/// Returns judges that look along the axes from which the outline is seen from far enough out of its plane.
template <typename Scalar>
[[nodiscard]] std::vector<OutlineJudge> judges_of(const std::vector<std::array<Scalar, 3>>& outline, Random& random);

}  // namespace surehit::test
