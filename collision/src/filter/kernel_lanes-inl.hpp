// Paths for the kernel, one in each lane. Highway compiles this for each instruction set.

#if defined(SUREHIT_KERNEL_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_KERNEL_LANES_INL
#undef SUREHIT_KERNEL_LANES_INL
#else
#define SUREHIT_KERNEL_LANES_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "filter/kernel_bound.hpp"
#include "filter/kernel_path.hpp"
#include "grid/grid_frame.hpp"
#include "support/lane_bits-inl.hpp"
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

  /// Lets the paths of some lanes begin at points to which their starts were moved. `FarPath::kernel_path` does the
  /// same for a single path, with the proof of the reach (P2, P3). The points of `is_end` are exact.
  HWY_INLINE void move_starts(const GridFrame& frame, const std::array<LaneFloats, 3>& points,
                              hn::Mask<FloatTag> is_end, hn::Mask<FloatTag> lanes) {
    const FloatTag d;
    const Floats zero = hn::Zero(d);
    Floats point_size = zero;
    Floats way_size = zero;
    Floats far = zero;
    Floats all = zero;
    for (std::size_t k = 0; k < 3; ++k) {
      const Floats start = hn::Load(d, start_[k].data());
      const Floats point = hn::Load(d, points[k].data());
      point_size = hn::Max(point_size, hn::Abs(point));
      way_size = hn::Max(way_size, hn::Abs(hn::Load(d, d_[k].data())));
      far = hn::Max(far, hn::Abs(hn::Sub(point, hn::Set(d, frame.float_box_low[k]))));
      far = hn::Max(far, hn::Abs(hn::Sub(point, hn::Set(d, frame.float_box_high[k]))));
      const Floats low_size = hn::Set(d, std::fabs(frame.float_low[k]));
      all = hn::Max(all, hn::Add(hn::Add(hn::Abs(start), low_size), hn::Abs(point)));
      store_where(lanes, point, d, start_[k].data());
    }
    const Floats of_double = hn::MulAdd(all, hn::Set(d, 0x1p-28F), hn::Set(d, std::numeric_limits<float>::min()));
    const Floats error = hn::MulAdd(point_size, hn::Set(d, 0.125F), of_double);  // P2, P3
    const Floats reach = hn::Add(far, hn::IfThenElse(is_end, zero, error));
    const Floats largest = hn::Set(d, KernelBound<float>::largest_size);
    const Floats half = hn::Set(d, KernelBound<float>::largest_size / 2);
    const auto are_small = hn::And(hn::And(hn::Le(reach, half), hn::Le(point_size, half)), hn::Le(way_size, largest));
    hn::Store(hn::Load(d, reach_.data()), d, reach_from_start_.data());
    store_where(lanes, reach, d, reach_.data());
    store_where(lanes, hn::IfThenElse(are_small, way_size, hn::Inf(d)), d, d_size_.data());
  }
  /// Returns the reach of the path of a lane whose start was moved, from its own start.
  [[nodiscard]] float reach_from_start(std::size_t lane) const { return reach_from_start_[lane]; }

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
  LaneFloats reach_from_start_;
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
