// Answers batches in scenes with one instance. Highway compiles this file for each instruction set.

#if defined(SUREHIT_ONE_INSTANCE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_ONE_INSTANCE_INL
#undef SUREHIT_ONE_INSTANCE_INL
#else
#define SUREHIT_ONE_INSTANCE_INL
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "query/batch-inl.hpp"
#include "scene/path_placer-inl.hpp"
#include "scene/placed_rounding-inl.hpp"
#include "scene/scene_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Keeps the first hit in the mesh, as long as the kernel is certain of all that matters.
class CertainFirst {
 public:
  using Kernel = BlockKernel<float>;
  static constexpr bool wants_order = true;
  static constexpr bool shortens = true;

  explicit CertainFirst(const Query<float>& query) : first_(query) {}
  void reset() {
    first_.reset();
    is_doubtful_ = false;
  }

  template <typename AnyPath>
  HWY_INLINE std::uint64_t take_certain(const CandidateBlock<float, AnyPath>& block, bool& is_nearer) {
    if (first_.take_certain(block, is_nearer) == 0) return 0;
    is_doubtful_ = is_nearer = true;  // The walk ends.
    return 0;
  }
  [[nodiscard]] float t_upper() const { return first_.t_upper(); }
  [[nodiscard]] double limit() const { return is_doubtful_ ? -1 : first_.limit(); }
  [[nodiscard]] bool is_done() const { return false; }

  /// Returns true if the kernel is not certain of something that may matter.
  [[nodiscard]] bool is_doubtful() const { return is_doubtful_; }
  [[nodiscard]] const FirstHit<float>& first() const { return first_; }

 private:
  FirstHit<float> first_;
  bool is_doubtful_ = false;
};

/// Notes whether there is a hit in the mesh of which the kernel is certain.
class CertainAny {
 public:
  using Kernel = BlockKernel<float>;
  static constexpr bool wants_order = false;
  static constexpr bool shortens = false;

  explicit CertainAny(const Query<float>&) {}
  void reset() { is_done_ = is_doubtful_ = false; }

  template <typename AnyPath>
  HWY_INLINE std::uint64_t take_certain(const CandidateBlock<float, AnyPath>& block, bool& /*is_nearer*/) {
    is_done_ |= block.verdicts.certain != 0;
    is_doubtful_ |= block.verdicts.possible != block.verdicts.certain;
    return 0;
  }
  [[nodiscard]] bool is_done() const { return is_done_; }
  /// Returns true if the kernel is not certain that there is none.
  [[nodiscard]] bool is_doubtful() const { return !is_done_ && is_doubtful_; }

 private:
  bool is_done_ = false;
  bool is_doubtful_ = false;
};

/// A batch of segments in a scene with one instance. The segments are placed side by side, and walk through the mesh as
/// those of its collider do. A path is asked alone if it cannot be placed here, or if the kernel is not certain.
class OneInstance {
 public:
  /// Returns true if a batch can be answered here, and if it is of a usual kind: no option leaves any hit out.
  static bool takes(const SceneQuery<float>& batch, const PathSpan<float>& paths,
                    std::span<const SceneQueryOptions<float>> own_options) {
    const std::uint32_t index = batch.tree.only_instance();
    if (index == InstanceTree::no_child || paths.size() < min_paths_in_lanes) return false;
    if (paths.kind() != PathKind::segment) return false;
    const PathRange<float> range(paths.kind(), batch.options);
    if (range.first != 0 || range.last != 1 || !own_options.empty() || batch.filter != nullptr) return false;
    const CommittedInstance<float>& instance = batch.instances[index];
    const Grid& grid = instance.mesh.own->grid;
    const InstanceFrame& frame = instance.placed.frame;
    return frame.is_usable && !frame.moves && !grid.is_one_list() && grid.inner_frames().empty() &&
           batch.options.culling == Culling::none && batch.options.mask != 0 && instance.mesh.own->masks.empty() &&
           (instance.mask & batch.options.instance_mask) != 0 && !batch.is_ignored(index);
  }

  OneInstance(const SceneQuery<float>& batch, const PathSpan<float>& paths)
      : batch_(batch),
        paths_(paths),
        index_(batch.tree.only_instance()),
        mesh_(*batch.instances[index_].mesh.own),
        query_{mesh_.grid, mesh_.mesh, mesh_.masks, options_, nullptr, batch.statistics, 0} {}

  /// Sets each answer to the first hit of the path. `alone(index)` sets that of one path.
  template <typename Alone>
  HWY_NOINLINE void find_first(std::span<SceneHit<float>> hits, const Alone& alone) {
    std::fill_n(hits.begin(), paths_.size(), SceneHit<float>{});
    Waiting waiting(*this, hits);
    const auto finish = [&](std::size_t index, const CertainFirst& visitor) {
      if (visitor.is_doubtful()) {
        ask_again(index, alone);
      } else if (visitor.first().is_found()) {
        waiting.add(index, visitor.first());
      }
    };
    search<CertainFirst>(finish, alone);
    waiting.flush();
  }

  /// Sets each answer to 1 if the path has a hit, else to 0. `alone(index)` sets that of one path.
  template <typename Alone>
  HWY_NOINLINE void find_any(std::span<std::uint8_t> blocked, const Alone& alone) {
    std::fill_n(blocked.begin(), paths_.size(), std::uint8_t{0});
    const auto finish = [&](std::size_t index, const CertainAny& visitor) {
      if (visitor.is_doubtful()) {
        ask_again(index, alone);
      } else {
        blocked[index] = visitor.is_done() ? 1 : 0;
      }
    };
    search<CertainAny>(finish, alone);
  }

 private:
  template <typename Visitor, typename Finish, typename Alone>
  HWY_INLINE void search(const Finish& finish, const Alone& alone) {
    PlacedSegments segments(query_, batch_.instances[index_].placed.frame);
    Batch<float, Visitor, PlacedSegments, const Finish, Alone>(segments, mesh_.grid.frame(), paths_, finish, alone)
        .run();
  }

  /// Lets one path be answered alone that has walked in vain.
  template <typename Alone>
  HWY_NOINLINE void ask_again(std::size_t index, const Alone& alone) {
    --batch_.statistics.paths;  // It is counted again. The work that was in vain counts too.
    --batch_.statistics.instances;
    alone(index);
  }

  /// Hits that wait to be rounded, as many as a vector has doubles.
  class Waiting {
   public:
    Waiting(OneInstance& of, std::span<SceneHit<float>> hits)
        : of_(of), hits_(hits), placer_(of.batch_.instances[of.index_].placed.frame) {}

    HWY_INLINE void add(std::size_t index, const FirstHit<float>& first) {
      of_.paths_.copy(index, &segments_[6 * count_]);
      index_[count_] = index;
      entry_[count_] = first.entry();
      triangle_[count_] = first.triangle();
      if (++count_ == std::min(max_hits, hn::Lanes(Tag()))) flush();
    }

    /// Rounds the hits. The segments are placed again, because few of those that walk have a hit to be rounded.
    HWY_NOINLINE void flush() {
      if (count_ == 0) return;
      placer_.place(segments_.data(), count_);
      const PlacedLanes& placed = placer_.part(0);
      for (std::size_t i = 0; i < count_; ++i) {
        const CertainPath path = {{placed.start[0][i], placed.start[1][i], placed.start[2][i]},
                                  {placed.direction[0][i], placed.direction[1][i], placed.direction[2][i]},
                                  placed.start_error[i],
                                  placed.direction_error[i],
                                  placed.moved_t[i]};
        waiting_.set(i, path, triangle_[i]);
      }
      const auto rounded = waiting_.round();
      const CommittedInstance<float>& instance = of_.batch_.instances[of_.index_];
      for (std::size_t i = 0; i < count_; ++i) {
        PlacedCandidate<float> hit = {
            of_.index_, of_.mesh_.grid.entries()[entry_[i]], triangle_[i], &instance.placed, {}};
        SceneHit<float>& answer = hits_[index_[i]];
        if (!set_rounded(rounded, i, hit, instance.generation, answer)) {
          round_alone(of_.batch_, of_.paths_[index_[i]], hit, answer);
        }
      }
      count_ = 0;
    }

   private:
    using Tag = hn::CappedTag<double, PlaceLanes::max_lanes>;
    static constexpr std::size_t max_hits = std::min(PlacedHits<Tag>::max_lanes, max_lanes);

    OneInstance& of_;
    std::span<SceneHit<float>> hits_;
    SegmentPlacer placer_;
    PlacedHits<Tag> waiting_;
    std::size_t count_ = 0;
    std::array<float, 6 * max_lanes> segments_ = {};
    std::array<std::size_t, max_hits> index_;
    std::array<std::size_t, max_hits> entry_;
    std::array<Triangle<float>, max_hits> triangle_;
  };

  const SceneQuery<float>& batch_;
  const PathSpan<float>& paths_;
  const std::uint32_t index_;  ///< The index of the instance.
  const ColliderState<float>& mesh_;
  const QueryOptions<float> options_ = {};
  const Query<float> query_;  ///< The query of the mesh.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
