// Gives the triangles of a list to the visitor of a single path. Highway compiles this file for each instruction set.

#if defined(SUREHIT_LIST_VISIT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_LIST_VISIT_INL
#undef SUREHIT_LIST_VISIT_INL
#else
#define SUREHIT_LIST_VISIT_INL
#endif

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "filter/block_kernel-inl.hpp"
#include "filter/kernel_path.hpp"
#include "query/far_path.hpp"
#include "query/hit_visitors-inl.hpp"
#include "query/octet_boxes-inl.hpp"
#include "query/query.hpp"
#include "scene/placed_path.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Returns the list of a cell. The cell must have one.
template <typename Scalar>
HWY_INLINE TriangleList<Scalar> list_of(const Query<Scalar>& query, CellWord word) {
  const std::size_t first = query.grid.first_entry(word);
  const Scalar* block = query.mesh.block(word.list(), first);
  const std::size_t count = query.grid.entry_count(word);
  return {MeshBlocks<Scalar>::corners(block), count, first, MeshBlocks<Scalar>::edge_size(block),
          boxes_of(query.mesh, first, count)};
}

/// The path and its range, as the kernel needs them.
template <typename Scalar>
struct KernelInput {
  KernelInput(const Path<Scalar>& any_path, const PathRange<Scalar>& range, const GridFrame& frame)
      : path(any_path, frame), weights(range) {}
  KernelInput(const KernelPath<Scalar>& any_path, const PathRange<Scalar>& range) : path(any_path), weights(range) {}
  /// A placed path has the same form in all frames of a mesh, and a range of its own.
  template <typename SceneScalar>
  KernelInput(const PlacedPath<SceneScalar>& any_path, const PathRange<Scalar>&, const GridFrame&)
      : path(any_path.template kernel_path<Scalar>()), weights(any_path.template kernel_weights<Scalar>()) {}
  KernelInput(const FarPath& any_path, const PathRange<Scalar>&, const GridFrame& frame)
      : path(any_path.kernel_path(frame)), weights(any_path.kernel_range()) {}
  KernelPath<Scalar> path;       ///< The path.
  RangeWeights<Scalar> weights;  ///< The weights of its range.
};

/// Gives the hits that may be first the parameter of the path. Most paths have the kernel's own.
template <typename Scalar, typename AnyPath>
HWY_INLINE void set_parameter(const AnyPath&, FirstLanes<Scalar>&) {}
/// A path whose start was moved has its own parameter.
HWY_INLINE void set_parameter(const FarPath& path, FirstLanes<float>& first) { path.set_parameter(first); }

/// Returns the reach (P1) of the path from its own start, which may be farther away than that of the kernel.
template <typename Scalar, typename AnyPath>
HWY_INLINE Scalar reach_from_start(const AnyPath&, const KernelPath<Scalar>& kernel_path) {
  return kernel_path.reach;
}
/// A path whose start was moved adds the way to it.
HWY_INLINE float reach_from_start(const FarPath& far_path, const KernelPath<float>& kernel_path) {
  return far_path.reach_from_start(kernel_path);
}

/// Returns the last t of the range that a hit may have and still count.
template <typename Scalar, typename Visitor>
HWY_INLINE Scalar last_that_counts(const PathRange<Scalar>& range, const Visitor& visitor) {
  if constexpr (Visitor::shortens) return std::min(range.last, visitor.t_upper());
  return range.last;
}

/// Gives the visitor the triangles of a list that the path may meet. Returns true if the path is shorter now, or if the
/// visitor is done. Here, and where paths are walked, `AnyPath` is a `Path`, a `FarPath` or a `PlacedPath`.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_INLINE bool visit_list(const Query<Scalar>& query, const PathRange<Scalar>& range, const AnyPath& path,
                           const KernelInput<Scalar>& input, const TriangleList<Scalar>& list, Visitor& visitor) {
  using Kernel = typename Visitor::Kernel;
  const std::size_t lanes = hn::Lanes(hn::ScalableTag<Scalar>());
  query.statistics.candidates += list.count;
  bool shorter = false;
  const auto bounds = Kernel::bounds(input.path, input.weights, list);
  [[maybe_unused]] std::uint64_t octets = ~std::uint64_t{0};
  for (std::size_t from = 0; from < list.count; from += lanes) {
    // A path that was moved or placed is not exactly the kernel's.
    if constexpr (std::is_same_v<AnyPath, Path<float>> && requires { Visitor::passes_over_octets; }) {
      constexpr std::size_t octet = MeshBlocks<float>::octet;
      const std::size_t place = from % (octet * max_octets);
      if (place == 0 && list.boxes != nullptr) {
        octets = octets_met(input.path, list, from, range.first, last_that_counts(range, visitor));
      }
      if ((octets >> place / octet & octets_of_lanes(lanes)) == 0) continue;
    }
    FirstLanes<Scalar> first = {};
    Verdicts verdicts;
    if constexpr (Visitor::wants_order) {
      const Scalar limit = kernel_limit(path, visitor.t_upper());
      verdicts = classify<Kernel>(input.path, input.weights, list, bounds, from, limit, first);
      if (verdicts.certain != 0) set_parameter(path, first);
    } else {
      verdicts = classify<Kernel>(input.path, input.weights, list, bounds, from);
    }
    if (verdicts.possible == 0) continue;
    query.statistics.undecided += static_cast<std::uint64_t>(std::popcount(verdicts.possible & ~verdicts.certain));
    const Scalar reach = reach_from_start(path, input.path);
    shorter |= visit(CandidateBlock<Scalar, AnyPath>{query, range, path, list, reach, from, verdicts, first}, visitor);
    if (visitor.is_done()) return true;
  }
  return shorter;
}

// query_walk-inl.hpp has it.
template <typename Scalar, typename AnyPath, typename Visitor>
void walk_inner(const Query<Scalar>& query, const AnyPath& path, const PathRange<Scalar>& range,
                const KernelInput<Scalar>& input, CellWord word, Visitor& visitor);

/// Gives the visitor the triangles that the path may meet in a cell with a list. Returns true if the path is shorter
/// now, or if the visitor is done.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_INLINE bool visit_cell(const Query<Scalar>& query, const PathRange<Scalar>& range, const AnyPath& path,
                           const KernelInput<Scalar>& input, CellWord word, Visitor& visitor) {
  const bool shorter = visit_list(query, range, path, input, list_of(query, word), visitor);
  if (!word.has_inner_grid() || visitor.is_done()) return shorter;
  walk_inner(query, path, range, input, word, visitor);
  return true;
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
