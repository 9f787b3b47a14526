#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "grid/grid_frame.hpp"
#include "support/double4.hpp"
#include "support/float4.hpp"
#include "support/inlining.hpp"
#include "surehit/path.hpp"
#include "walk/direction.hpp"
#include "walk/grid_traversal.hpp"

namespace surehit {

/// A path of floats that does not begin near a frame, clipped to this frame. Its start is moved along it to a point
/// near the frame, in double, so that the rest can be done in float (L16). This takes less time than to clip it in
/// double. What looks at triangles may begin at this point too.
struct FarClip {
  /// What became of the path.
  enum class Status : std::uint8_t {
    miss,     ///< The path misses the frame.
    clipped,  ///< The path can be walked.
    unknown,  ///< The path must be clipped in another way.
  };

  Status status = Status::unknown;  ///< The result.
  /// True if no triangle of the frame is met where the range begins or before. The same holds for the end of the range,
  /// unless `is_end`.
  bool is_free = false;
  bool is_end = false;          ///< True if the path is a segment that counts up to its end, which is `point`.
  double moved_t = 0;           ///< The t by which the start is moved.
  std::array<double, 4> point;  ///< The point at `moved_t`, in mesh units. The fourth number is 0.

  /// Clips a path to a frame. [first_t, last_t] is the range. `clipped` must be as `ClippedPath::clip_in_float` leaves
  /// a far path, and it gets the result.
  SUREHIT_ALWAYS_INLINE FarClip(const GridFrame& frame, const Path<float>& path, float first_t, float last_t,
                                ClippedPath::InFloat in_float, ClippedPath& clipped) noexcept {
    if (in_float == ClippedPath::InFloat::far) [[likely]]
      status = clip(frame, path, first_t, last_t, clipped);
    if (status == Status::unknown) [[unlikely]]
      clipped = ClippedPath(frame, path, first_t, last_t);
  }

 private:
  SUREHIT_ALWAYS_INLINE Status clip(const GridFrame& frame, const Path<float>& path, float first_t, float last_t,
                                    ClippedPath& clipped) noexcept {
    using namespace detail;
    const Float4 stop = frame.float_stop;
    const Float4 far = clipped.start;
    const Float4 rate = clipped.rate;
    const Float4 inverse = clipped.inverse_rate;
    const Int4 is_mirrored = clipped.is_mirrored();
    const Float4 turned = masked(is_mirrored, stop);
    const Float4 size = absolute(far);
    // A comparison with NaN is false.
    if (any_lane(~((size <= 0x1p20F * stop) & (rate <= all_lanes(max_rate))))) return Status::unknown;
    const Float4 margin = 0x1p-10F * (size + stop);
    const float may_enter = std::max(max_lane((-margin - far) * inverse)[0], first_t);
    const float may_leave = std::min(min_lane((stop + margin - far) * inverse)[0], last_t);
    if (may_enter > may_leave) return Status::miss;  // L13

    // The fourth lanes stay at position 1, as in every frame.
    const Float4 path_start = {path.start[0], path.start[1], path.start[2], 0};
    const Float4 path_toward = {path.toward[0], path.toward[1], path.toward[2], 0};
    const Double4 low = to_double(frame.float_low);
    const Double4 scale = to_double(frame.float_scale);
    const Double4 cells_low = to_double(frame.float_margin);
    const Double4 start = to_double(path_start);
    const Double4 toward = to_double(path_toward);
    const Double4 way = path.has_end() ? toward - start : toward;
    const Double4 to_end = toward - low;
    const Float4 end = negated_where(to_float(to_end * scale + cells_low), is_mirrored) + turned;
    // No branch depends on where the path ends, because a processor could not predict it.
    const bool may_end = path.has_end() && last_t == 1;
    is_end = !any_lane((all_lanes(may_end ? 0 : -1)) | (end < -stop) | (end > stop + stop));
    const std::int64_t all_if_end = -std::int64_t{is_end};
    const Long4 ends = {all_if_end, all_if_end, all_if_end, all_if_end};
    moved_t = is_end ? 1 : 0.5 * (double{may_enter} + double{may_leave});
    const Double4 to_point = choose(ends, to_end, (start - low) + moved_t * way);
    const Double4 place = choose(ends, toward, low + to_point);
    for (std::size_t axis = 0; axis < 4; ++axis) point[axis] = place[axis];
    const Float4 from = negated_where(to_float(to_point * scale + cells_low), is_mirrored) + turned;
    if (any_lane(~((-stop <= from) & (from <= stop + stop)))) return Status::unknown;

    // From here on, the parameter is t - moved_t.
    const double first = first_t - moved_t;
    const double last = last_t - moved_t;
    const float enters_grid = max_lane(-from * inverse)[0];
    const float leaves_grid = min_lane((stop - from) * inverse)[0];
    const float enters = std::max(enters_grid, static_cast<float>(first - std::fabs(first) * 0x1p-23));
    const float leaves = std::min(leaves_grid, static_cast<float>(last + std::fabs(last) * 0x1p-23));
    if (!(enters <= leaves)) return Status::miss;
    const bool enters_later = first <= double{enters_grid} - std::fabs(double{enters_grid}) * 0x1p-22;
    const bool leaves_before = double{leaves_grid} + std::fabs(double{leaves_grid}) * 0x1p-22 <= last;
    is_free = enters_later && (is_end || leaves_before);
    clipped.status = ClippedPath::Status::clipped;
    clipped.is_clipped_in_float = true;
    clipped.start = min(max(from + enters * rate, all_lanes(0.0F)), stop * (1 - 0x1p-24F));
    clipped.tau.origin[2] = moved_t + double{enters};
    clipped.end = ClippedPath::beyond(last_t, clipped.tau.origin[2]);
    clipped.exit = leaves - enters;
    return Status::clipped;
  }

  static constexpr float max_rate = 0x1p60F;
};

}  // namespace surehit
