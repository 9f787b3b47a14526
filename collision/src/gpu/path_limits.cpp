#include "gpu/path_limits.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "filter/kernel_bound.hpp"
#include "path_range.hpp"

namespace surehit::detail {
namespace {

/// The device takes 2^100 for infinity. No t of a certain hit is as large (G5, G21).
constexpr float beyond = 0x1p100F;

/// Returns true if a device could take the limit for zero (G2).
bool may_be_flushed(float limit) {
  const std::uint32_t size = std::bit_cast<std::uint32_t>(limit) & 0x7fffffffU;
  return size != 0 && size < std::bit_cast<std::uint32_t>(std::numeric_limits<float>::min());
}

/// Returns what the options of meshes and scenes have in common.
template <typename Options>
PathLimits common_limits(PathKind kind, const Options& options) {
  PathLimits limits = {};
  limits.mask = options.mask;
  limits.ignored = options.ignored_triangle;
  limits.instance_mask = ~std::uint32_t{0};
  limits.ignored_instance = no_instance;
  if (options.culling == Culling::back) limits.flags |= PathLimits::keeps_front;
  if (options.culling == Culling::front) limits.flags |= PathLimits::keeps_back;
  if (options.ignore_start_contact && kind != PathKind::line) limits.flags |= PathLimits::ignores_start;
  if (options.ignore_end_contact && kind == PathKind::segment) limits.flags |= PathLimits::ignores_end;
  const PathRange<float> range(kind, options);
  if (range.is_empty()) limits.flags |= PathLimits::hits_nothing;
  const RangeWeights<float> weights(range);
  if (!weights.decides || may_be_flushed(range.first) || may_be_flushed(range.last)) {
    limits.flags |= PathLimits::is_for_host;
  }
  if (weights.is_whole) limits.flags |= PathLimits::is_whole;
  limits.t_first = weights.t_first;
  limits.det_first = weights.det_first;
  limits.t_last = weights.t_last;
  limits.det_last = weights.det_last;
  limits.first = std::max(range.first, -beyond);
  limits.last = std::min(range.last, beyond);
  return limits;
}

}  // namespace

PathLimits path_limits(PathKind kind, const QueryOptionsf& options) { return common_limits(kind, options); }

PathLimits path_limits(PathKind kind, const SceneQueryOptionsf& options, const CommittedScene<float>& scene) {
  PathLimits limits = common_limits(kind, options);
  limits.instance_mask = options.instance_mask;
  if (scene.find(options.ignored_instance) != nullptr) limits.ignored_instance = options.ignored_instance.index;
  return limits;
}

}  // namespace surehit::detail
