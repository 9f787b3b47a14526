#pragma once

#include <algorithm>
#include <vector>

namespace surehit::test {

/// How far apart two things are along some axis at t: `first` + t `rate`. What computes this may be wrong by `margin`.
template <typename Number>
struct MovingGap {
  Number first;
  Number rate;
  Number margin;  ///< It is above 0.
};

/// Returns the least g for which there is a t in [0, until] where each gap is at most g times its margin. Two things
/// meet if it is at most 0.
template <typename Number>
[[nodiscard]] Number growth_to_meet(const std::vector<MovingGap<Number>>& gaps, const Number& until) {
  const auto least_of = [&](const MovingGap<Number>& gap) {
    return Number((gap.rate < 0 ? Number(gap.first + gap.rate * until) : gap.first) / gap.margin);
  };
  Number least = least_of(gaps.front());
  for (const MovingGap<Number>& gap : gaps) {
    least = std::max(least, least_of(gap));
    if (gap.rate >= 0) continue;
    // Another gap must not open before this one closes.
    for (const MovingGap<Number>& other : gaps) {
      if (other.rate <= 0) continue;
      const Number sum = gap.first * other.rate - other.first * gap.rate;
      const Number margin = gap.margin * other.rate - other.margin * gap.rate;
      least = std::max(least, Number(sum / margin));
    }
  }
  return least;
}

}  // namespace surehit::test
