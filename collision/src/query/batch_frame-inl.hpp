// Chooses the frame of the grid in which the paths of a batch begin. Highway compiles this file for each instruction
// set.

#if defined(SUREHIT_BATCH_FRAME_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_BATCH_FRAME_INL
#undef SUREHIT_BATCH_FRAME_INL
#else
#define SUREHIT_BATCH_FRAME_INL
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "query/path_clipper-inl.hpp"
#include "surehit/path_span.hpp"
#include "walk/far_lanes-inl.hpp"
#include "walk/lane_clip-inl.hpp"
#include "walk/main_grid_path.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Returns those of `count` paths from path `first` on that may meet what is not in the main grid.
template <typename Scalar, typename Queries>
HWY_INLINE std::uint32_t paths_beside(const MainGrid& main, const Queries& queries, const PathSpan<Scalar>& paths,
                                      std::size_t first, std::size_t count) {
  const auto taken = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
  if constexpr (std::is_same_v<Scalar, float>) {
    std::array<float, 6 * max_lanes> numbers = {};
    for (std::size_t i = 0; i < count; ++i) paths.copy(first + i, &numbers[6 * i]);
    const auto ends = queries.ends(first, count);
    const PathLanes some(numbers.data(), paths.kind() == PathKind::segment, ends.first, ends.last);
    return lanes_beside(main, some) & taken;
  } else {
    LaneClip::DoublePaths copies = {};
    const std::uint32_t counting = copy_in_double(queries, paths, first, taken, copies);
    return lanes_beside(main, copies, paths.kind(), counting);
  }
}

/// Returns true if there is a main grid, and only few paths of a batch may meet what is not in it. It looks at the
/// first paths. No answer depends on this.
template <typename Scalar, typename Queries>
bool is_mostly_in_main_grid(const Queries& queries, const PathSpan<Scalar>& paths) {
  constexpr std::size_t samples = 64;
  constexpr std::size_t few_share = 16;
  const MainGrid& main = queries.of_batch().grid.main_grid();
  if (!(std::is_same_v<Scalar, float> ? main.takes_floats() : main.exists())) return false;
  const std::size_t lanes = hn::Lanes(FloatTag());
  std::size_t asked = 0;
  std::size_t others = 0;
  for (; asked < std::min(samples, paths.size()); asked += lanes) {
    const std::size_t count = std::min(lanes, paths.size() - asked);
    others += static_cast<std::size_t>(std::popcount(paths_beside(main, queries, paths, asked, count)));
  }
  return others * few_share <= asked;
}

/// Returns the frame in which the paths of a batch begin: that of the main grid, or the outermost one.
template <typename Scalar, typename Queries>
HWY_NOINLINE const GridFrame& frame_of_batch(const Queries& queries, const PathSpan<Scalar>& paths) {
  const Grid& grid = queries.of_batch().grid;
  return is_mostly_in_main_grid(queries, paths) ? grid.main_frame() : grid.frame();
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
