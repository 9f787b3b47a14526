// Brings the paths of a batch into the frame of one mesh. Highway compiles this file for each instruction set.

#if defined(SUREHIT_PATH_PLACER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_PATH_PLACER_INL
#undef SUREHIT_PATH_PLACER_INL
#else
#define SUREHIT_PATH_PLACER_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "filter/kernel_bound.hpp"
#include "filter/kernel_lanes-inl.hpp"
#include "query/batch_queries-inl.hpp"
#include "scene/instance_frame.hpp"
#include "scene/place_lanes-inl.hpp"
#include "scene/placed_lanes.hpp"
#include "support/lane_bits-inl.hpp"
#include "walk/far_lanes-inl.hpp"
#include "walk/lane_clip-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Places segments of floats side by side, all of them for one instance, which has no motion.
class SegmentPlacer {
 public:
  static constexpr std::size_t max_segments = max_lanes;  ///< The number that is placed at once.
  static constexpr std::size_t max_parts = (max_segments + PlaceLanes::max_lanes - 1) / PlaceLanes::max_lanes;

  HWY_INLINE explicit SegmentPlacer(const InstanceFrame& frame) {
    for (std::size_t lane = 0; lane < PlaceLanes::max_lanes; ++lane) place_.set_frame(lane, frame, true);
  }

  /// Places `count` segments. Each has six floats, which must be readable for all lanes of a vector.
  HWY_INLINE void place(const float* segments, std::size_t count) {
    const FloatTag d;
    const PathLanes paths(segments, true, 0.0F, 1.0F);
    // There may be fewer lanes than are placed at once.
    std::array<std::array<float, PlaceLanes::max_lanes * max_parts>, 6> numbers = {};
    for (std::size_t k = 0; k < 3; ++k) {
      hn::StoreU(paths.start[k], d, numbers[k].data());
      hn::StoreU(paths.toward[k], d, numbers[k + 3].data());
    }
    for (std::size_t part = 0; part * PlaceLanes::max_lanes < count; ++part) {
      const std::size_t from = part * PlaceLanes::max_lanes;
      place_.set_segments({&numbers[0][from], &numbers[1][from], &numbers[2][from], &numbers[3][from],
                           &numbers[4][from], &numbers[5][from]});
      place_.place(std::min(count - from, PlaceLanes::max_lanes), true, parts_[part]);
    }
  }

  /// Returns the placed segments of a part, one in each lane. A part has `PlaceLanes::max_lanes` segments.
  [[nodiscard]] const PlacedLanes& part(std::size_t which) const { return parts_[which]; }

 private:
  PlaceLanes place_;
  std::array<PlacedLanes, max_parts> parts_ = {};  ///< Lanes without a path are read too, and left out.
};

/// The paths of the kernel for placed paths, one in each lane.
class PlacedKernelPaths {
 public:
  static constexpr std::size_t lanes = SegmentPlacer::max_parts * PlaceLanes::max_lanes;  ///< There may be fewer paths.

  /// Sets the paths for one part, as `PlacedPath::kernel_path` does (I8). The first one gets lane `at`. Returns the
  /// paths of the part that the kernel can take, and that need not be scaled.
  HWY_INLINE std::uint32_t set(const PlacedLanes& placed, std::size_t at) {
    const Tag d;
    const hn::Rebind<float, Tag> df;
    constexpr double eps = 0x1p-24;
    const auto number = [&](double x) { return hn::Set(d, x); };
    std::uint32_t usable = 0;
    for (std::size_t from = 0; from < PlaceLanes::max_lanes; from += hn::Lanes(d)) {
      const auto load = [&](const PlacedLanes::Lanes& of) { return hn::LoadU(d, &of[from]); };
      const auto keep = [&](Numbers& to, auto x) { hn::StoreU(hn::DemoteTo(df, x), df, &to[at + from]); };
      const auto direction_size = load(placed.direction_size);
      const auto start_size = load(placed.start_size);
      for (std::size_t k = 0; k < 3; ++k) {
        keep(start_[k], load(placed.start[k]));
        keep(d_[k], load(placed.direction[k]));
      }
      // What rounding to float adds to the errors.
      const auto with_rounding = [&](const PlacedLanes::Lanes& error, auto size) {
        return hn::Add(load(error), hn::Add(hn::Mul(number(eps), size), number(0x1p-149)));
      };
      const auto start_off = with_rounding(placed.start_error, start_size);
      const auto d_off = with_rounding(placed.direction_error, direction_size);
      const auto grown = [&](auto size, auto off) {
        return hn::Mul(hn::Add(size, hn::Mul(off, number(1 / (8 * eps)))), number(1 + 0x1p-20));
      };
      const auto reach = grown(hn::Add(load(placed.reach), start_off), start_off);
      const auto d_size = grown(direction_size, d_off);
      keep(start_size_, start_size);
      keep(d_size_, d_size);
      keep(reach_, reach);
      const auto largest = hn::Max(hn::Max(start_size, reach), d_size);
      auto is_usable = hn::Le(largest, number(double{KernelBound<float>::largest_size} / 4));
      is_usable = hn::And(is_usable, hn::Ge(direction_size, number(0x1p-30)));
      is_usable = hn::And(is_usable, hn::Le(direction_size, number(0x1p30)));
      usable |= static_cast<std::uint32_t>(bits_of(d, is_usable)) << from;
    }
    return usable;
  }

  /// Copies as many paths as a vector has lanes.
  HWY_INLINE void copy_to(KernelLanes& paths) const {
    const FloatTag d;
    for (std::size_t k = 0; k < 3; ++k) paths.set_axis(k, hn::LoadU(d, start_[k].data()), hn::LoadU(d, d_[k].data()));
    paths.set_sizes(hn::LoadU(d, start_size_.data()), hn::LoadU(d, d_size_.data()), hn::LoadU(d, reach_.data()));
  }

 private:
  using Tag = hn::CappedTag<double, PlaceLanes::max_lanes>;
  using Numbers = std::array<float, lanes>;

  std::array<Numbers, 3> start_ = {};
  std::array<Numbers, 3> d_ = {};
  Numbers start_size_ = {};
  Numbers d_size_ = {};
  Numbers reach_ = {};
};

/// Returns the placed paths of a part whose errors are so small that the walk through a frame misses nothing (L15).
HWY_INLINE std::uint32_t lanes_precise_in(const GridFrame& frame, const PlacedLanes& placed) {
  const hn::CappedTag<double, PlaceLanes::max_lanes> d;
  std::uint32_t precise = 0;
  for (std::size_t from = 0; from < PlaceLanes::max_lanes; from += hn::Lanes(d)) {
    auto is_precise = hn::Eq(hn::Zero(d), hn::Zero(d));
    for (std::size_t k = 0; k < 3; ++k) {
      auto error = hn::LoadU(d, &placed.position_error[k][from]);
      for (const double factor : {frame.unit[0], frame.unit[1], frame.scale[k]}) {
        error = hn::Mul(error, hn::Set(d, factor));
      }
      is_precise = hn::And(is_precise, hn::Le(error, hn::Set(d, 0x1p-23 * frame.resolution(k))));
    }
    precise |= static_cast<std::uint32_t>(bits_of(d, is_precise)) << from;
  }
  return precise;
}

/// Segments of floats in the frame of the mesh of one instance, as a batch needs them.
class PlacedSegments : public SharedQuery<float> {
 public:
  static constexpr bool is_placed = true;

  PlacedSegments(const Query<float>& batch, const InstanceFrame& frame)
      : SharedQuery(batch, PathKind::segment), frame_(frame) {}

  [[nodiscard]] const InstanceFrame& frame() const { return frame_; }
  [[nodiscard]] const RangeWeights<float>& weights_in(std::size_t slot) const { return weights_[slot]; }
  /// Sets the weights of the path in a slot, whose start was moved along it.
  void move_start(std::size_t slot, double moved_t) {
    // `moved_t` is a multiple of 2^-20, and so is its distance from 1.
    weights_[slot] = RangeWeights<float>::of_part(static_cast<float>(-moved_t), static_cast<float>(1 - moved_t));
  }

  /// Clips the segments in the frame of the mesh.
  class Placer {
   public:
    HWY_INLINE explicit Placer(const PlacedSegments& queries)
        : grid_frame_(queries.of_batch().grid.frame()),
          statistics_(queries.of_batch().statistics),
          placer_(queries.frame()) {}

    /// Returns the t by which the start of the segment in a lane was moved.
    [[nodiscard]] double moved_t(std::size_t lane) const { return part_of(lane).moved_t[lane_of(lane)]; }

    /// Clips `count` segments. Sets what `LaneClip::clip` sets, and what `WalkingPaths::enters` leaves out. Those that
    /// are `apart` were not placed here.
    HWY_INLINE LaneClip::Clipped clip(const float* segments, std::size_t count, const LaneClip& clip,
                                      WalkingPaths& clipped, KernelLanes& kernel_paths, LaneFloats& enters_rest) {
      placer_.place(segments, count);
      LaneClip::DoublePaths paths = {};
      std::uint32_t near = 0;
      std::uint32_t beside = 0;
      for (std::size_t from = 0; from < count; from += PlaceLanes::max_lanes) {
        const PlacedLanes& placed = part_of(from);
        beside |= placed.beside << from;
        near |= (placed.near & kernel_paths_.set(placed, from) & lanes_precise_in(grid_frame_, placed)) << from;
        const std::size_t lanes = std::min(PlaceLanes::max_lanes, max_lanes - from);
        for (std::size_t k = 0; k < 3; ++k) {
          std::copy_n(placed.start[k].begin(), lanes, paths.start[k].begin() + from);
          std::copy_n(placed.direction[k].begin(), lanes, paths.toward[k].begin() + from);
        }
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          paths.first_t[from + lane] = -placed.moved_t[lane];
          paths.last_t[from + lane] = 1 - placed.moved_t[lane];
        }
      }
      const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
      std::array<double, max_lanes> enters;
      // A placed path is a ray with a range (L15).
      LaneClip::Clipped result = clip.clip_in_double(paths, PathKind::ray, near, clipped, enters);
      statistics_.instances += static_cast<std::uint64_t>(std::popcount(near & ~result.apart));
      result.apart |= all & ~(near | beside);
      set_enters(result.inside, enters, clipped, enters_rest);
      kernel_paths_.copy_to(kernel_paths);
      return result;
    }

   private:
    [[nodiscard]] const PlacedLanes& part_of(std::size_t lane) const {
      return placer_.part(lane / PlaceLanes::max_lanes);
    }
    static std::size_t lane_of(std::size_t lane) { return lane % PlaceLanes::max_lanes; }

    /// Sets the t where tau is 0, somewhat too early. The parameter of the clipped paths is t - `moved_t`.
    HWY_INLINE void set_enters(std::uint32_t lanes, const std::array<double, max_lanes>& enters, WalkingPaths& clipped,
                               LaneFloats& rest) const {
      for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
        // Both are at most 1 in size.
        const double t = moved_t(lane) + enters[lane] - 0x1p-52;
        clipped.enters[lane] = static_cast<float>(t);
        rest[lane] = LaneWalk::rest_of_enters(t);
      }
    }

    const GridFrame& grid_frame_;
    QueryStatistics& statistics_;
    SegmentPlacer placer_;
    PlacedKernelPaths kernel_paths_;
  };

 private:
  const InstanceFrame& frame_;
  std::array<RangeWeights<float>, max_slots<float>> weights_;
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
