// The kernel in double, for lists of floats. Highway compiles this for each instruction set.

#if defined(SUREHIT_CLASSIFY_IN_DOUBLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_CLASSIFY_IN_DOUBLE_INL
#undef SUREHIT_CLASSIFY_IN_DOUBLE_INL
#else
#define SUREHIT_CLASSIFY_IN_DOUBLE_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "filter/block_kernel-inl.hpp"
#include "filter/kernel_path.hpp"
#include "path_range.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Returns the largest float that is at most x.
inline float round_down(double x) {
  const auto nearest = static_cast<float>(x);
  return nearest > x ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}

/// Does the same as `classify` in double, for some lanes of a vector of floats. The other lanes are misses here. `path`
/// is a path of floats in double, with its reach in float (K6). Few lanes are undecided after this, even if the path
/// begins far away or passes close to an edge.
inline HWY_NOINLINE Verdicts classify_in_double(const KernelPath<double>& path, const PathRange<float>& range,
                                                const TriangleList<float>& list, std::size_t from, std::uint64_t lanes,
                                                double limit, FirstLanes<float>& first) {
  using Kernel = BlockKernel<double, float>;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const RangeWeights<double> weights(PathRange<double>(range.first, range.last));
  const auto bounds = Kernel::bounds(path, weights, list);
  const std::size_t part = hn::Lanes(hn::ScalableTag<double>());
  const std::uint64_t all = (std::uint64_t{1} << part) - 1;
  Verdicts result = {0, 0};
  double t_lower = infinity;
  double t_upper = infinity;
  first.lanes = 0;
  for (std::size_t at = 0; lanes >> at != 0; at += part) {
    const std::uint64_t some = lanes >> at & all;
    if (some == 0) continue;
    const Kernel kernel(path, list, from + at);
    const Verdicts verdicts = kernel.classify(weights, bounds);
    result.possible |= (verdicts.possible & some) << at;
    const std::uint64_t certain = verdicts.certain & some;
    if (certain == 0) continue;
    result.certain |= certain << at;
    const FirstLanes<double> of_part = kernel.first_of(bounds, certain, std::min(limit, t_upper));
    if (of_part.t_upper < t_lower) first.lanes = 0;
    if (of_part.t_lower <= t_upper) first.lanes |= of_part.lanes << at;
    t_lower = std::min(t_lower, of_part.t_lower);
    t_upper = std::min(t_upper, of_part.t_upper);
  }
  first.t_lower = round_down(t_lower);
  first.t_upper = -round_down(-t_upper);
  return result;
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
