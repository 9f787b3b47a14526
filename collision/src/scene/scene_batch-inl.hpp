// Answers batches of paths of a scene. Highway compiles this file for each instruction set.

#if defined(SUREHIT_SCENE_BATCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_SCENE_BATCH_INL
#undef SUREHIT_SCENE_BATCH_INL
#else
#define SUREHIT_SCENE_BATCH_INL
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>

#include "scene/place_lanes-inl.hpp"
#include "scene/scene_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Answers the paths of a batch, several of them at a time. They take turns: while one path waits for a node of the
/// tree, the others step. Paths that have come to an instance are placed side by side, and then search its mesh one by
/// one.
///
/// When a path ends, the batch calls `finish(index, keep)`. It calls `alone(index)` for a path that leaves too many
/// children of the tree for later.
template <typename Keep, typename Scalar, typename Finish, typename Alone>
class SceneBatch {
 public:
  SceneBatch(const SceneQuery<Scalar>& batch, const PathSpan<Scalar>& paths,
             std::span<const SceneQueryOptions<Scalar>> own_options, const Finish& finish, const Alone& alone)
      : batch_(batch), paths_(paths), own_options_(own_options), finish_(finish), alone_(alone) {}

  /// Answers all paths.
  HWY_INLINE void run() {
    for (std::size_t slot = 0; slot < slots; ++slot) {
      if (begin_next(slot)) walking_[walking_count_++] = slot;
    }
    while (walking_count_ > 0) {
      find_instances();
      search_instances();
    }
  }

 private:
  static constexpr std::size_t slots = 16;     ///< The number of paths that are on their way.
  static constexpr std::size_t max_open = 32;  ///< The room of a path for children that it leaves for later.
  static constexpr std::size_t lanes = PlaceLanes::max_lanes;

  /// A path on its way.
  struct Slot {
    HWY_INLINE Slot(const SceneQuery<Scalar>& batch, const SceneQueryOptions<Scalar>& options,
                    const Path<Scalar>& any_path, std::size_t index)
        : path(any_path),
          query{batch.instances, batch.tree, options, batch.filter, batch.statistics, batch.path + index, batch.share},
          search(query, path),
          keep(query, search.narrowphase()),
          walk(batch.tree, search.path()) {}
    const Path<Scalar> path;
    const SceneQuery<Scalar> query;
    const SceneSearch<Scalar> search;
    Keep keep;
    TreeWalk<max_open> walk;
  };
  static_assert(std::is_trivially_destructible_v<Slot>);
  /// A path and an instance to which it has come.
  struct Pair {
    std::size_t slot;
    std::uint32_t instance;
  };

  struct SlotMemory {
    alignas(Slot) std::array<std::byte, sizeof(Slot)> bytes;
  };
  /// Returns the path in a slot.
  Slot& slot_at(std::size_t slot) { return *std::launder(reinterpret_cast<Slot*>(&memory_[slot])); }

  /// Lets the next path begin in a slot. Returns false if there is none.
  HWY_INLINE bool begin_next(std::size_t slot) {
    while (next_ < paths_.size()) {
      const std::size_t index = next_++;
      ++batch_.statistics.paths;
      const SceneQueryOptions<Scalar>& options = own_options_.empty() ? batch_.options : own_options_[index];
      Slot& of = *new (&memory_[slot]) Slot(batch_, options, paths_[index], index);
      if (of.search.is_in_vain()) {
        finish_(index, of.keep);
        continue;
      }
      index_[slot] = index;
      return true;
    }
    return false;
  }

  /// Ends the path of a slot, and lets the next one begin. Returns false if there is none.
  HWY_INLINE bool replace(std::size_t slot) {
    Slot& of = slot_at(slot);
    if (of.walk.has_overflown()) {
      --batch_.statistics.paths;  // It is counted again. The work that was in vain counts too.
      alone_(index_[slot]);
    } else {
      finish_(index_[slot], of.keep);
    }
    return begin_next(slot);
  }

  /// Lets each path go through the tree until it comes to an instance.
  HWY_INLINE void find_instances() {
    const auto prefetch = [&](std::uint32_t index) { hwy::Prefetch(&batch_.instances[index]); };
    pair_count_ = 0;
    for (std::size_t i = 0; i < walking_count_; ++i) {
      const std::size_t slot = walking_[i];
      for (bool walks = true; walks;) {
        Slot& of = slot_at(slot);
        if (of.walk.at_end()) {
          walks = replace(slot);
          continue;
        }
        const std::uint32_t instance = of.walk.template advance<Keep::shortens>(batch_.tree, prefetch);
        if (instance == no_instance || !of.query.takes_part(instance)) continue;
        pairs_[pair_count_++] = {slot, instance};
        const auto* const bytes = reinterpret_cast<const std::byte*>(&batch_.instances[instance]);
        for (std::size_t line = 1; line < CommittedInstance<Scalar>::hot_lines; ++line)
          hwy::Prefetch(bytes + line * 64);
        walks = false;
      }
    }
    walking_count_ = 0;
  }

  /// Lets the paths that have come to an instance search its mesh. All of them walk on then.
  HWY_INLINE void search_instances() {
    for (std::size_t from = 0; from < pair_count_; from += lanes) {
      const std::size_t count = std::min(pair_count_ - from, lanes);
      for (std::size_t lane = 0; lane < count; ++lane) {
        const auto& [slot, instance] = pairs_[from + lane];
        place_.set(lane, slot_at(slot).search.path(), batch_.instances[instance].placed.frame);
      }
      place_.place(count, paths_.kind() == PathKind::segment, placed_);
      for (std::size_t lane = 0; lane < count; ++lane) {
        if ((placed_.beside >> lane & 1) == 0) search(pairs_[from + lane], lane);
        const std::size_t slot = pairs_[from + lane].slot;
        if (!slot_at(slot).keep.is_done() || replace(slot)) walking_[walking_count_++] = slot;
      }
    }
  }

  /// Lets a path search the mesh of an instance.
  HWY_INLINE void search(const Pair& pair, std::size_t lane) {
    Slot& of = slot_at(pair.slot);
    const PlacedInstance<Scalar>& instance = batch_.instances[pair.instance].placed;
    if ((placed_.near >> lane & 1) != 0) {
      const PlacedPath<Scalar> placed(of.search.path(), instance.placement, instance.frame, placed_, lane);
      of.search.search_instance(placed, pair.instance, of.keep);
    } else {
      search_alone(of, pair.instance);
    }
    if constexpr (Keep::shortens) of.walk.shorten(of.keep.limit());
  }

  /// Does the same for a path that was not placed side by side with others.
  HWY_NOINLINE void search_alone(Slot& of, std::uint32_t instance) {
    const PlacedInstance<Scalar>& at = batch_.instances[instance].placed;
    of.search.search_instance(PlacedPath<Scalar>(of.search.path(), at.placement, at.frame), instance, of.keep);
  }

  const SceneQuery<Scalar>& batch_;  ///< The query of the whole batch.
  const PathSpan<Scalar>& paths_;
  std::span<const SceneQueryOptions<Scalar>> own_options_;  ///< The options of each path, or none.
  const Finish& finish_;
  const Alone& alone_;
  std::size_t next_ = 0;                    ///< The index of the first path that has not begun.
  std::array<SlotMemory, slots> memory_;    ///< The slots. A slot is made when a path takes it.
  std::array<std::size_t, slots> index_;    ///< The index of the path of each slot.
  std::array<std::size_t, slots> walking_;  ///< The slots whose paths go through the tree.
  std::size_t walking_count_ = 0;
  std::array<Pair, slots> pairs_;  ///< The paths that have come to an instance.
  std::size_t pair_count_ = 0;
  PlaceLanes place_;
  PlacedLanes placed_;
};

/// Answers all paths of a batch.
template <typename Keep, typename Scalar, typename Finish, typename Alone>
HWY_NOINLINE void search_scene_batch(const SceneQuery<Scalar>& batch, const PathSpan<Scalar>& paths,
                                     std::span<const SceneQueryOptions<Scalar>> own_options, const Finish& finish,
                                     const Alone& alone) {
  SceneBatch<Keep, Scalar, Finish, Alone>(batch, paths, own_options, finish, alone).run();
}

/// Returns the query of one path of a batch.
template <typename Scalar>
SceneQuery<Scalar> query_of_path(const SceneQuery<Scalar>& batch,
                                 std::span<const SceneQueryOptions<Scalar>> own_options, std::size_t index) {
  return {batch.instances, batch.tree,       own_options.empty() ? batch.options : own_options[index],
          batch.filter,    batch.statistics, batch.path + index,
          batch.share};
}

/// Sets `hits[i]` to the first hit of path i.
template <typename Scalar>
void search_scene_each_first(const SceneQuery<Scalar>& batch, const PathSpan<Scalar>& paths,
                             std::span<const SceneQueryOptions<Scalar>> own_options,
                             std::span<SceneHit<Scalar>> hits) noexcept {
  const auto finish = [&](std::size_t index, KeepFirst<Scalar>& keep) {
    hits[index] = keep.hit().value_or(SceneHit<Scalar>{});
  };
  const auto alone = [&](std::size_t index) {
    hits[index] =
        search_scene_first(query_of_path(batch, own_options, index), paths[index]).value_or(SceneHit<Scalar>{});
  };
  search_scene_batch<KeepFirst<Scalar>>(batch, paths, own_options, finish, alone);
}

/// Sets `blocked[i]` to 1 if path i has a hit, else to 0.
template <typename Scalar>
void search_scene_each_any(const SceneQuery<Scalar>& batch, const PathSpan<Scalar>& paths,
                           std::span<const SceneQueryOptions<Scalar>> own_options,
                           std::span<std::uint8_t> blocked) noexcept {
  const auto finish = [&](std::size_t index, const KeepAny<Scalar>& keep) { blocked[index] = keep.is_done() ? 1 : 0; };
  const auto alone = [&](std::size_t index) {
    blocked[index] = search_scene_any(query_of_path(batch, own_options, index), paths[index]) ? 1 : 0;
  };
  search_scene_batch<KeepAny<Scalar>>(batch, paths, own_options, finish, alone);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
