// The boxes of a list's triangles, against the box of a path. Highway compiles this for each instruction set.

#if defined(SUREHIT_BLOCK_BOXES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_BLOCK_BOXES_INL
#undef SUREHIT_BLOCK_BOXES_INL
#else
#define SUREHIT_BLOCK_BOXES_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "filter/block_kernel-inl.hpp"
#include "filter/path_box.hpp"
#include "support/lane_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Returns the lanes whose triangle has a box that meets the box of the path. Lane 0 has triangle `from`. All
/// comparisons are exact. Lanes after the last triangle have no meaning.
template <typename Scalar>
HWY_INLINE std::uint64_t lanes_that_meet(const PathBox<Scalar>& box, const TriangleList<Scalar>& list,
                                         std::size_t from) {
  const hn::ScalableTag<Scalar> d;
  auto beside = hn::FirstN(d, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto load = [&](std::size_t coordinate) {
      return hn::LoadU(d, list.corners + (coordinate * list.count + from));
    };
    const auto a = load(axis), b = load(3 + axis), c = load(6 + axis);
    const auto low = hn::Min(hn::Min(a, b), c), high = hn::Max(hn::Max(a, b), c);
    beside = hn::Or(beside, hn::Or(hn::Lt(high, hn::Set(d, box.low[axis])), hn::Gt(low, hn::Set(d, box.high[axis]))));
  }
  return bits_of(d, hn::Not(beside));
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
