// Clips any path to a frame of a grid. Highway compiles this file for each instruction set.

#if defined(SUREHIT_CLIPPED_TO_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_CLIPPED_TO_INL
#undef SUREHIT_CLIPPED_TO_INL
#else
#define SUREHIT_CLIPPED_TO_INL
#endif

#include <hwy/highway.h>

#include "grid/grid_frame.hpp"
#include "path_range.hpp"
#include "scene/placed_path.hpp"
#include "surehit/path.hpp"
#include "walk/far_clip.hpp"
#include "walk/grid_traversal.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Clips a path to a frame.
HWY_INLINE ClippedPath clipped_to(const GridFrame& frame, const Path<double>& path, const PathRange<double>& range) {
  return {frame, path, range.first, range.last};
}
/// Clips a path of floats that does not begin near a frame, or is very slow or fast. `clipped` is as `clip_in_float`
/// has left it.
inline HWY_NOINLINE void clip_from_afar(const GridFrame& frame, const Path<float>& path, const PathRange<float>& range,
                                        ClippedPath::InFloat in_float, ClippedPath& clipped) {
  (void)FarClip(frame, path, range.first, range.last, in_float, clipped);
}
HWY_INLINE ClippedPath clipped_to(const GridFrame& frame, const Path<float>& path, const PathRange<float>& range) {
  ClippedPath clipped;
  const auto in_float = clipped.clip_in_float(frame, path, range.first, range.last);
  if (in_float != ClippedPath::InFloat::done) clip_from_afar(frame, path, range, in_float, clipped);
  return clipped;
}
/// Does the same for a placed path, which has a range of its own.
template <typename Scalar, typename SceneScalar>
HWY_INLINE ClippedPath clipped_to(const GridFrame& frame, const PlacedPath<SceneScalar>& path,
                                  const PathRange<Scalar>&) {
  const PathRange<SceneScalar>& range = path.scene_path.range;
  return {frame, path.moved, range.first, range.last};
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
