// Paths that walk, one in each lane. Highway compiles this for each instruction set.

#if defined(SUREHIT_WALKING_PATHS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_WALKING_PATHS_INL
#undef SUREHIT_WALKING_PATHS_INL
#else
#define SUREHIT_WALKING_PATHS_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "support/lane_bits-inl.hpp"
#include "walk/grid_traversal.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The tag of the walk's vectors. They have at most 16 floats, as the widest vectors of today.
using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<FloatTag>;
using BitsTag = hn::RebindToUnsigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using Words = hn::Vec<BitsTag>;

/// The maximum number of lanes. On some instruction sets, only the machine knows the number itself.
constexpr std::size_t max_lanes = hn::MaxLanes(FloatTag());

/// Returns a vector that has this number in all lanes.
HWY_INLINE Floats in_all_lanes(float one_for_all) { return hn::Set(FloatTag(), one_for_all); }
/// Returns the vector itself.
HWY_INLINE Floats in_all_lanes(Floats one_each) { return one_each; }

/// Rounds toward zero. The numbers must fit an integer. On x86, Highway's own function needs four more operations for
/// numbers that do not fit.
HWY_INLINE Ints to_ints(Floats x) {
#if defined(SUREHIT_HAS_GNU_VECTORS) && HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR
  // Vectors are no arguments here: Clang takes none of this target in a function that is compiled without it.
  using Lanes = VectorOf<std::int32_t, sizeof(x.raw) / sizeof(float)>;
  return Ints{reinterpret_cast<decltype(Ints::raw)>(__builtin_convertvector(x.raw, Lanes))};
#else
  return hn::ConvertTo(IntTag(), x);
#endif
}

// These arrays have a number for each lane. They are in memory, and a step loads what it needs. All lanes are stored
// together, because a load of all lanes has to wait for a store of one.
using LaneFloats = std::array<float, max_lanes>;
using LaneIndices = std::array<std::int32_t, max_lanes>;

/// Paths as `GridTraversal` walks them, one in each lane. Members with the names of `ClippedPath` mean the same.
struct alignas(max_lanes * sizeof(float)) WalkingPaths {
  std::array<LaneFloats, 3> start;              ///< The position where tau is 0.
  std::array<LaneFloats, 3> rate;               ///< The number of finest cells per unit of tau.
  std::array<LaneFloats, 3> inverse_rate;       ///< 1 / rate, or `ClippedPath::max_inverse` where the rate is 0.
  std::array<LaneFloats, 3> finest;             ///< The finest cell that the walk is in.
  std::array<LaneFloats, 3> pitch;              ///< The pitch of the `GridFrame::TopOrder` of the octant.
  std::array<LaneFloats, 3> stop;               ///< The resolution of the frame that the path walks through.
  LaneFloats first_cell;                        ///< The index of mirrored top cell (0, 0, 0).
  LaneFloats enters;                            ///< The float nearest to the t where tau is 0.
  LaneFloats end;                               ///< Nothing counts beyond this tau.
  std::array<std::uint32_t, max_lanes> octant;  ///< Bit k is set if the path is mirrored on axis k.

  /// Ends the walk of a lane at parameter t, because the caller does not need what the path meets beyond it. Tau must
  /// be t - `enters` - `rest`. Both floats together are off by less than 2^-48 of their sum.
  void shorten(std::size_t lane, double t, float rest) {
    const double sum = double{enters[lane]} + double{rest};
    end[lane] = std::min(end[lane], ClippedPath::beyond(t, sum - std::fabs(sum) * 0x1p-48));
  }
  /// Does the same for a path that `ClippedPath` has clipped.
  void shorten(std::size_t lane, double t, const WalkParameter& tau) { end[lane] = std::min(end[lane], tau.beyond(t)); }

  /// Copies other paths into some lanes. If bit i of `lanes` is set, lane i becomes lane `from_lane[i]` of `from`. It
  /// does not copy `stop`, because paths are clipped to the frame in which all lanes begin.
  HWY_INLINE void copy(std::uint32_t lanes, const WalkingPaths& from, const LaneIndices& from_lane) {
    const auto indices = hn::Load(IntTag(), from_lane.data());
    const auto copy_all = [&](auto d, auto& to, const auto& of) {
      const auto taken = hn::TableLookupLanes(hn::Load(d, of.data()), hn::IndicesFromVec(d, indices));
      hn::Store(hn::IfThenElse(mask_of(d, lanes), taken, hn::Load(d, to.data())), d, to.data());
    };
    const FloatTag d;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      copy_all(d, start[axis], from.start[axis]);
      copy_all(d, rate[axis], from.rate[axis]);
      copy_all(d, inverse_rate[axis], from.inverse_rate[axis]);
      copy_all(d, finest[axis], from.finest[axis]);
      copy_all(d, pitch[axis], from.pitch[axis]);
    }
    copy_all(d, first_cell, from.first_cell);
    copy_all(d, enters, from.enters);
    copy_all(d, end, from.end);
    copy_all(BitsTag(), octant, from.octant);
  }
};

/// What a lane of `WalkingPaths` holds, except for what the frame and the octant tell.
struct WalkingPath {
  std::array<float, 3> start, rate, inverse_rate, finest;
  float enters, end;
  std::uint32_t octant;

  WalkingPath() = default;
  /// Copies a lane.
  WalkingPath(const WalkingPaths& paths, std::size_t lane)
      : enters(paths.enters[lane]), end(paths.end[lane]), octant(paths.octant[lane]) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      start[axis] = paths.start[axis][lane];
      rate[axis] = paths.rate[axis][lane];
      inverse_rate[axis] = paths.inverse_rate[axis][lane];
      finest[axis] = paths.finest[axis][lane];
    }
  }
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
