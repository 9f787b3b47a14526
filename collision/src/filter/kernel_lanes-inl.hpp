// Paths for the kernel, one in each lane. Highway compiles this for each instruction set.

#if defined(SUREHIT_KERNEL_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_KERNEL_LANES_INL
#undef SUREHIT_KERNEL_LANES_INL
#else
#define SUREHIT_KERNEL_LANES_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <limits>

#include "filter/kernel_bound.hpp"
#include "filter/kernel_path.hpp"
#include "walk/lane_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Paths in the form that the kernel uses, one in each lane. `LaneClip::clip` sets them.
class alignas(max_lanes * sizeof(float)) KernelLanes {
 public:
  /// Sets component `axis` of the starts and of the computed D.
  HWY_INLINE void set_axis(std::size_t axis, Floats start, Floats d) {
    hn::Store(start, FloatTag(), start_[axis].data());
    hn::Store(d, FloatTag(), d_[axis].data());
  }
  /// Sets what depends on all axes: the largest components of the starts and of D, and the reach.
  HWY_INLINE void set_sizes(Floats start_size, Floats d_size, Floats reach) {
    const FloatTag d;
    const auto are_small = hn::And(hn::Le(start_size, hn::Set(d, KernelBound<float>::largest_size / 2)),
                                   hn::Le(d_size, hn::Set(d, KernelBound<float>::largest_size)));
    const Floats too_large = hn::Set(d, std::numeric_limits<float>::infinity());
    hn::Store(hn::IfThenElse(are_small, d_size, too_large), d, d_size_.data());
    hn::Store(reach, d, reach_.data());
  }

  /// Copies the path of a lane.
  HWY_INLINE void copy(std::size_t lane, KernelPath<float>& path) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      path.start[axis] = start_[axis][lane];
      path.d[axis] = d_[axis][lane];
    }
    path.d_size = d_size_[lane];
    path.reach = reach_[lane];
  }

 private:
  std::array<LaneFloats, 3> start_;
  std::array<LaneFloats, 3> d_;
  LaneFloats d_size_;
  LaneFloats reach_;
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
