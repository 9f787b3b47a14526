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
#if HWY_TARGET != HWY_SCALAR  // This target has no lanes.
#include "scene/mesh_batch-inl.hpp"
#include "scene/one_instance-inl.hpp"
#endif
#include "scene/scene_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Answers the paths of a batch, several of them at a time. They take turns: while one path waits for a node of the
/// tree, the others step. Paths that have come to an instance are placed side by side. In a scene of floats, they then
/// search the meshes side by side too. In one of doubles, they do so one by one.
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
      if (has_lane(slot)) idle_[idle_count_++] = slot;
    }
    for (;;) {
      if ((walking_count_ + idle_count_) * idle_share >= slots || !are_searching()) {
        find_instances();
        search_instances();
        if (walking_count_ == 0 && !are_searching() && !has_more()) return;
      }
      if constexpr (has_lanes) {
        if (are_searching()) step();
      }
    }
  }

 private:
  /// Takes the place of `MeshBatch` where meshes are searched one by one.
  struct OneByOne {
    static constexpr std::size_t slots = 16;
  };
#if HWY_TARGET != HWY_SCALAR
  static constexpr bool has_lanes = std::is_same_v<Scalar, float>;
  using Meshes = std::conditional_t<has_lanes, MeshBatch<Keep>, OneByOne>;
#else
  static constexpr bool has_lanes = false;
  using Meshes = OneByOne;
#endif
  static constexpr std::size_t slots = Meshes::slots;  ///< The number of paths that are on their way.
  /// Paths are brought to the next instances if at least one slot in this many waits.
  static constexpr std::size_t idle_share = 4;
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

  /// Returns true if there are paths that have not begun.
  [[nodiscard]] bool has_more() const { return next_ < paths_.size(); }

  /// Lets the next paths begin in the idle slots. They begin together, so that none of them waits for another one.
  HWY_INLINE void begin_paths() {
    while (idle_count_ != 0 && has_more()) {
      const std::size_t slot = idle_[--idle_count_];
      const std::size_t index = next_++;
      ++batch_.statistics.paths;
      const SceneQueryOptions<Scalar>& options = own_options_.empty() ? batch_.options : own_options_[index];
      Slot& of = *new (&memory_[slot]) Slot(batch_, options, paths_[index], index);
      index_[slot] = index;
      walking_[walking_count_++] = slot;
      if (of.search.is_in_vain()) of.walk.end();
    }
  }

  /// Ends the path of a slot.
  HWY_INLINE void end(std::size_t slot) {
    Slot& of = slot_at(slot);
    if (of.walk.has_overflown()) {
      --batch_.statistics.paths;  // It is counted again. The work that was in vain counts too.
      alone_(index_[slot]);
    } else {
      finish_(index_[slot], of.keep);
    }
    idle_[idle_count_++] = slot;
  }

  /// Lets paths go through the tree until enough of them have come to an instance.
  HWY_INLINE void find_instances() {
    pair_count_ = 0;
    for (;;) {
      begin_paths();
      if (walking_count_ == 0 || pair_count_ >= lanes) return;
      step_in_tree();
    }
  }

  /// Takes a step in the tree with all paths that walk there. Those that come to an instance wait for the others.
  HWY_INLINE void step_in_tree() {
    const InstanceTree& tree = batch_.tree;
    std::size_t count = 0;
    for (std::size_t i = 0; i < walking_count_; ++i) {
      const std::size_t slot = walking_[i];
      const std::uint32_t child = slot_at(slot).walk.next();
      if (child == InstanceTree::no_child) {
        end(slot);
      } else if ((child & InstanceTree::instance_bit) != 0) {
        const std::uint32_t instance = child & ~InstanceTree::instance_bit;
        pairs_[pair_count_++] = {slot, instance};
        prefetch_lines<CommittedInstance<Scalar>::hot_lines>(&batch_.instances[instance]);
      } else {
        walking_[count] = slot;
        node_[count++] = child;
        prefetch_lines<(sizeof(InstanceTree::Node) + 63) / 64>(&tree.nodes()[child]);
      }
    }
    walking_count_ = count;
    for (std::size_t i = 0; i < count; ++i) {
      slot_at(walking_[i]).walk.template visit<Keep::shortens>(tree.nodes()[node_[i]]);
    }
  }

  /// Fetches some lines into the cache.
  template <std::size_t lines>
  static HWY_INLINE void prefetch_lines(const void* from) {
    for (std::size_t line = 0; line < lines; ++line) hwy::Prefetch(static_cast<const std::byte*>(from) + line * 64);
  }

  /// Lets the paths that have come to an instance search its mesh. All of them walk on then.
  HWY_INLINE void search_instances() {
    // The instances were not looked at before, because they had to be fetched.
    std::size_t count = 0;
    for (std::size_t i = 0; i < pair_count_; ++i) {
      const Pair pair = pairs_[i];
      if (slot_at(pair.slot).query.takes_part(pair.instance)) {
        pairs_[count++] = pair;
      } else {
        walking_[walking_count_++] = pair.slot;
      }
    }
    for (std::size_t from = 0; from < count; from += lanes) {
      search_some({&pairs_[from], std::min(count - from, lanes)});
    }
  }

  /// Places some pairs side by side.
  HWY_INLINE void search_some(std::span<const Pair> pairs) {
    for (std::size_t lane = 0; lane < pairs.size(); ++lane) {
      const auto& [slot, instance] = pairs[lane];
      place_.set(lane, slot_at(slot).search.path(), batch_.instances[instance].placed.frame);
    }
    place_.place(pairs.size(), paths_.kind() == PathKind::segment, placed_);
    for (std::size_t lane = 0; lane < pairs.size(); ++lane) {
      if ((placed_.beside >> lane & 1) == 0 && search(pairs[lane], lane)) continue;
      walk_on(pairs[lane].slot);
    }
  }

  /// Lets a path walk on through the tree, unless it is done.
  HWY_INLINE void walk_on(std::size_t slot) {
    if (slot_at(slot).keep.is_done()) {
      end(slot);
    } else {
      walking_[walking_count_++] = slot;
    }
  }

  /// Returns true if lanes search meshes.
  [[nodiscard]] bool are_searching() const {
    if constexpr (has_lanes) {
      return meshes_.searching() != 0;
    } else {
      return false;
    }
  }
  /// Returns true if there is a lane for a slot, or if no slot needs one.
  static bool has_lane(std::size_t slot) {
    if constexpr (has_lanes) {
      return Meshes::has_lane(slot);
    } else {
      return true;
    }
  }

  /// Takes a step with all paths that search a mesh. Those that are through with it walk on through the tree.
  HWY_INLINE void step() {
    for (std::uint64_t ended = meshes_.step(batch_.statistics); ended != 0; ended &= ended - 1) {
      const auto slot = static_cast<std::size_t>(std::countr_zero(ended));
      if constexpr (Keep::shortens) slot_at(slot).walk.shorten(slot_at(slot).keep.limit());
      walk_on(slot);
    }
  }

  /// Lets a path search the mesh of an instance. Returns false if it has done so at once.
  HWY_INLINE bool search(const Pair& pair, std::size_t lane) {
    if ((placed_.near >> lane & 1) == 0) return search_alone(pair);
    const PlacedInstance<Scalar>& at = batch_.instances[pair.instance].placed;
    return search_placed(pair,
                         PlacedPath<Scalar>(slot_at(pair.slot).search.path(), at.placement, at.frame, placed_, lane));
  }

  /// Does the same for a path that was not placed side by side with others.
  HWY_NOINLINE bool search_alone(const Pair& pair) {
    const PlacedInstance<Scalar>& at = batch_.instances[pair.instance].placed;
    return search_placed(pair, PlacedPath<Scalar>(slot_at(pair.slot).search.path(), at.placement, at.frame));
  }

  HWY_INLINE bool search_placed(const Pair& pair, const PlacedPath<Scalar>& placed) {
    Slot& of = slot_at(pair.slot);
    if constexpr (has_lanes) {
      if (meshes_.begin(pair.slot, of.query, pair.instance, placed, of.search.narrowphase(), of.keep)) return true;
    } else {
      of.search.search_instance(placed, pair.instance, of.keep);
    }
    if constexpr (Keep::shortens) of.walk.shorten(of.keep.limit());
    return false;
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
  std::array<std::uint32_t, slots> node_;  ///< The nodes that they have come to.
  std::array<std::size_t, slots> idle_;    ///< The slots without a path.
  std::size_t idle_count_ = 0;
  std::array<Pair, slots> pairs_;  ///< The paths that have come to an instance.
  std::size_t pair_count_ = 0;
  PlaceLanes place_;
  PlacedLanes placed_;
  Meshes meshes_;  ///< The paths that search meshes.
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

/// Takes the first hits of the paths of a batch. Those in float that the kernel is certain of are rounded as many at a
/// time as a vector has doubles.
template <typename Scalar>
class SceneRounding {
 public:
  SceneRounding(const SceneQuery<Scalar>& batch, const PathSpan<Scalar>& paths,
                std::span<const SceneQueryOptions<Scalar>> own_options, std::span<SceneHit<Scalar>> hits)
      : batch_(batch), paths_(paths), own_options_(own_options), hits_(hits) {}

  /// Takes what a path has kept. A certain hit is rounded later, but at the latest by `flush`.
  HWY_INLINE void add(std::size_t index, KeepFirst<Scalar>& keep) {
    if constexpr (std::is_same_v<Scalar, float>) {
      if (keep.is_certain()) {
        waiting_.set(count_, keep.path(), keep.best().local);
        index_[count_] = index;
        best_[count_] = keep.best();
        if (++count_ == hn::Lanes(Tag())) flush();
        return;
      }
    }
    hits_[index] = keep.hit().value_or(SceneHit<Scalar>{});
  }

  /// Rounds all hits that were added and not rounded yet.
  HWY_NOINLINE void flush() {
    if constexpr (std::is_same_v<Scalar, float>) {
      const auto rounded = waiting_.round();
      for (std::size_t i = 0; i < count_; ++i) {
        const std::uint32_t generation = batch_.instances[best_[i].instance].generation;
        if (set_rounded(rounded, i, best_[i], generation, hits_[index_[i]])) continue;
        round_alone(query_of_path(batch_, own_options_, index_[i]), paths_[index_[i]], best_[i], hits_[index_[i]]);
      }
      count_ = 0;
    }
  }

 private:
  using Tag = hn::CappedTag<double, 8>;
  /// No hit waits in double.
  static constexpr std::size_t max_hits = std::is_same_v<Scalar, float> ? PlacedHits<Tag>::max_lanes : 0;
  struct None {};

  const SceneQuery<Scalar>& batch_;
  const PathSpan<Scalar>& paths_;
  std::span<const SceneQueryOptions<Scalar>> own_options_;
  std::span<SceneHit<Scalar>> hits_;
  std::size_t count_ = 0;                                             ///< The number of hits that wait.
  std::conditional_t<max_hits != 0, PlacedHits<Tag>, None> waiting_;  ///< Their paths and triangles.
  std::array<PlacedCandidate<Scalar>, max_hits> best_;                ///< The hits themselves.
  std::array<std::size_t, max_hits> index_;                           ///< The index of each path.
};

/// Sets `hits[i]` to the first hit of path i.
template <typename Scalar>
void search_scene_each_first(const SceneQuery<Scalar>& batch, const PathSpan<Scalar>& paths,
                             std::span<const SceneQueryOptions<Scalar>> own_options,
                             std::span<SceneHit<Scalar>> hits) noexcept {
  const auto alone = [&](std::size_t index) {
    hits[index] =
        search_scene_first(query_of_path(batch, own_options, index), paths[index]).value_or(SceneHit<Scalar>{});
  };
#if HWY_TARGET != HWY_SCALAR
  if (are_few(batch, paths)) {
    for (std::size_t i = 0; i < paths.size(); ++i) alone(i);
    return;
  }
  if constexpr (std::is_same_v<Scalar, float>) {
    if (OneInstance::takes(batch, paths, own_options)) {
      OneInstance(batch, paths).find_first(hits, alone);
      return;
    }
  }
#endif
  SceneRounding<Scalar> rounding(batch, paths, own_options, hits);
  const auto finish = [&](std::size_t index, KeepFirst<Scalar>& keep) { rounding.add(index, keep); };
  search_scene_batch<KeepFirst<Scalar>>(batch, paths, own_options, finish, alone);
  rounding.flush();
}

/// Sets `blocked[i]` to 1 if path i has a hit, else to 0.
template <typename Scalar>
void search_scene_each_any(const SceneQuery<Scalar>& batch, const PathSpan<Scalar>& paths,
                           std::span<const SceneQueryOptions<Scalar>> own_options,
                           std::span<std::uint8_t> blocked) noexcept {
  const auto alone = [&](std::size_t index) {
    blocked[index] = search_scene_any(query_of_path(batch, own_options, index), paths[index]) ? 1 : 0;
  };
#if HWY_TARGET != HWY_SCALAR
  if (are_few(batch, paths)) {
    for (std::size_t i = 0; i < paths.size(); ++i) alone(i);
    return;
  }
  if constexpr (std::is_same_v<Scalar, float>) {
    if (OneInstance::takes(batch, paths, own_options)) {
      OneInstance(batch, paths).find_any(blocked, alone);
      return;
    }
  }
#endif
  const auto finish = [&](std::size_t index, const KeepAny<Scalar>& keep) { blocked[index] = keep.is_done() ? 1 : 0; };
  search_scene_batch<KeepAny<Scalar>>(batch, paths, own_options, finish, alone);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
