// Lets paths of a scene search the meshes of instances side by side. Highway compiles this file for each instruction
// set.

#if defined(SUREHIT_MESH_BATCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_MESH_BATCH_INL
#undef SUREHIT_MESH_BATCH_INL
#else
#define SUREHIT_MESH_BATCH_INL
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <type_traits>

#include "query/list_jobs-inl.hpp"
#include "scene/mesh_lanes-inl.hpp"
#include "scene/scene_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Paths that search the meshes of instances. Each is in the slot that it has in the batch, and has come to an instance
/// of its own. They walk side by side, and the kernel runs over the lists of all of them.
template <typename Keep>
class MeshBatch {
 public:
  static constexpr std::size_t slots = 24;  ///< The number of paths. More would take stack.

  MeshBatch() = default;
  MeshBatch(const MeshBatch&) = delete;  // `jobs_` keeps the addresses of weights.
  MeshBatch& operator=(const MeshBatch&) = delete;

  /// Returns true if there is a lane for a slot.
  static bool has_lane(std::size_t slot) { return slot % max_lanes < hn::Lanes(FloatTag()); }
  /// Returns the slots whose paths search a mesh.
  [[nodiscard]] std::uint64_t searching() const { return walking_ | in_only_list_; }

  /// Lets the path of a slot search the mesh of an instance. Returns false if it has searched at once.
  HWY_INLINE bool begin(std::size_t slot, const SceneQuery<float>& query, std::uint32_t instance,
                        const PlacedPath<float>& placed, const SceneNarrowphase<float>& narrowphase, Keep& keep) {
    if (placed.status == PlacedPath<float>::Status::beside) return false;
    ++query.statistics.instances;
    Visit& visit = *new (&visits_[slot]) Visit(query, instance, placed, narrowphase, keep);
    const Grid& grid = visit.search.query.grid;
    if (placed.status == PlacedPath<float>::Status::near) {
      if (grid.is_one_list()) {
        words_[slot] = grid.top()[0].bits();
        in_only_list_ |= std::uint64_t{1} << slot;
        return true;
      }
      ClippedPath clipped = clipped_to(grid.frame(), placed, any_range);
      if (clipped.status == ClippedPath::Status::miss) return false;
      const std::array<double, 3> one = {1, 1, 1};
      if (clipped.status == ClippedPath::Status::clipped && clipped.tau.unit == one) return walk(slot, clipped);
    }
    search_alone(visit);
    return false;
  }

  /// Takes one step with all paths. Returns the slots whose paths are through with their mesh.
  HWY_INLINE std::uint64_t step(QueryStatistics& statistics) {
    statistics.cells += static_cast<std::uint64_t>(std::popcount(searching()));
    std::uint64_t arriving = in_only_list_;
    for (std::size_t i = 0; i < vectors; ++i) {
      if (lanes_of(i, walking_) != 0) cells_[i] = lanes_[i].look(lanes_of(i, walking_));
    }
    for (std::size_t i = 0; i < vectors; ++i) {
      const std::uint32_t walking = lanes_of(i, walking_);
      if (walking == 0) continue;
      arriving |= slots_of(i, lanes_[i].meet_lists(cells_[i], LaneWalk::in_lists(cells_[i], walking)));
      store_words(i, walking);
    }
    const std::uint64_t searched = searching();
    walking_ &= ~visit_lists(arriving);
    in_only_list_ = 0;
    for (std::size_t i = 0; i < vectors; ++i) {
      const std::uint32_t walking = lanes_of(i, walking_);
      if (walking != 0) walking_ &= ~slots_of(i, walking) | slots_of(i, lanes_[i].advance(cells_[i], walking));
    }
    return searched & ~walking_;
  }

 private:
  using Visitor = InstanceVisitor<float, float, Keep>;
  using Jobs = ListJobs<float, Visitor, slots>;
  static constexpr std::size_t vectors = (slots + max_lanes - 1) / max_lanes;
  /// The placed path has the range that counts.
  inline static const PathRange<float> any_range{-std::numeric_limits<float>::infinity(),
                                                 std::numeric_limits<float>::infinity()};

  /// The search of a path in a mesh.
  struct Visit {
    HWY_INLINE Visit(const SceneQuery<float>& query, std::uint32_t instance, const PlacedPath<float>& placed,
                     const SceneNarrowphase<float>& narrowphase, Keep& keep)
        : path(placed), search(query, *query.instances[instance].mesh.own, instance, narrowphase, keep) {}
    const PlacedPath<float> path;
    MeshSearch<float, float, Keep> search;
    bool has_kernel_path = false;  ///< True if the path and its weights are set for the kernel.
    double enters;                 ///< The t where tau is 0.
  };

  static_assert(std::is_trivially_destructible_v<Visit>);
  struct VisitMemory {
    alignas(Visit) std::array<std::byte, sizeof(Visit)> bytes;
  };
  /// Returns the search of a slot.
  [[nodiscard]] Visit& visit_at(std::size_t slot) { return *std::launder(reinterpret_cast<Visit*>(&visits_[slot])); }
  [[nodiscard]] const Visit& visit_at(std::size_t slot) const {
    return *std::launder(reinterpret_cast<const Visit*>(&visits_[slot]));
  }

  // What `ListJobs` asks for.
  using Weights = std::array<RangeWeights<float>, slots>;
  struct WeightsOfSlots {
    const Weights& weights;
    [[nodiscard]] const RangeWeights<float>& weights_in(std::size_t slot) const { return weights[slot]; }
  };
  struct LimitsOfSlots {
    const MeshBatch& batch;
    [[nodiscard]] const Visitor& operator[](std::size_t slot) const { return batch.visit_at(slot).search.visitor; }
  };

  /// Lets a clipped path walk in its lane. Returns false if it has nothing to walk through.
  HWY_INLINE bool walk(std::size_t slot, ClippedPath& clipped) {
    Visit& visit = visit_at(slot);
    const Query<float>& query = visit.search.query;
    visit.enters = clipped.tau.origin[0] + clipped.tau.origin[2];
    if constexpr (Keep::shortens) {
      clipped.end = std::min(clipped.end, ClippedPath::beyond(visit.search.visitor.limit(), visit.enters));
    }
    if (clipped.stays_in_empty_space(query.grid, query.grid.frame())) {
      ++query.statistics.cells;
      return false;
    }
    if constexpr (!Keep::shortens) {
      if (!is_long(min_cells, query.grid, clipped, 0)) {
        walk_alone(visit, clipped);
        return false;
      }
    }
    float enters = 0;
    if (!enter_cover(query.grid, clipped, enters)) return false;
    lanes_[slot / max_lanes].put(slot % max_lanes, query.grid, query.mesh.slabs(), clipped, enters);
    walking_ |= std::uint64_t{1} << slot;
    return true;
  }

  /// A path for which any hit is enough walks in a lane if it is this many cells long. A shorter one is faster alone.
  static constexpr float min_cells = 4;

  /// Lets a clipped path walk alone.
  HWY_NOINLINE static void walk_alone(Visit& visit, const ClippedPath& clipped) {
    const Query<float>& query = visit.search.query;
    OnDemand<float> when(visit.path, any_range, query.grid.frame());
    walk_frame(query.grid.frame(), 0, query, visit.path, any_range, clipped, when, visit.search.visitor);
  }
  /// Lets a path search its mesh that cannot walk in a lane.
  HWY_NOINLINE static void search_alone(Visit& visit) {
    walk_mesh(visit.search.query, visit.path, visit.search.visitor);
  }

  static std::uint32_t lanes_of(std::size_t vector, std::uint64_t set) {
    constexpr std::uint64_t all = (std::uint64_t{1} << max_lanes) - 1;
    return static_cast<std::uint32_t>(set >> vector * max_lanes & all);
  }
  static std::uint64_t slots_of(std::size_t vector, std::uint32_t lanes) {
    return std::uint64_t{lanes} << vector * max_lanes;
  }

  /// Keeps the words of the cells that some lanes are in.
  HWY_INLINE void store_words(std::size_t vector, std::uint32_t walking) {
    const BitsTag du;
    std::uint32_t* const words = &words_[vector * max_lanes];
    hn::Store(hn::IfThenElse(mask_of(du, walking), cells_[vector].word, hn::Load(du, words)), du, words);
  }

  /// Gives the lists of these paths' cells to their visitors. Returns the paths that are done.
  HWY_INLINE std::uint64_t visit_lists(std::uint64_t arriving) {
    std::uint64_t done = 0;
    std::uint64_t in_inner = 0;
    for (std::size_t from = 0; arriving != 0; from += Jobs::max_at_once) {
      std::uint64_t longer = 0;
      std::size_t count = 0;
      for (std::uint64_t left = arriving; left != 0; left &= left - 1) {
        const auto slot = static_cast<std::size_t>(std::countr_zero(left));
        if (from == 0) in_inner |= std::uint64_t{find_list(slot)} << slot;
        longer |= std::uint64_t{jobs_.add(slot, from, count)} << slot;
      }
      jobs_.set_count(count);
      if (from == 0) jobs_.load_bounds(arriving);
      for (std::size_t first_job = 0; first_job < jobs_.count(); first_job += Jobs::max_jobs) {
        for (const typename Jobs::Open& open : jobs_.classify(first_job, from, LimitsOfSlots{*this})) {
          done |= visit_job(open);
        }
      }
      arriving = longer & ~done;
    }
    for (in_inner &= ~done; in_inner != 0; in_inner &= in_inner - 1) {
      done |= visit_inner(static_cast<std::size_t>(std::countr_zero(in_inner)));
    }
    return done;
  }

  /// Finds the list of the cell of a slot. Returns true if the cell has an inner grid.
  HWY_INLINE bool find_list(std::size_t slot) {
    Visit& visit = visit_at(slot);
    if (!visit.has_kernel_path) {
      visit.has_kernel_path = true;
      jobs_.path(slot) = visit.path.template kernel_path<float>();
      weights_[slot] = visit.path.template kernel_weights<float>();
    }
    const CellWord word(words_[slot]);
    jobs_.find_list(slot, visit.search.query, word);
    return word.has_inner_grid();
  }

  /// Gives the triangles of an open job to the visitor of their path. Returns the bit of the slot if its path is done.
  HWY_INLINE std::uint64_t visit_job(const typename Jobs::Open& open) {
    const auto& [slot, from, verdicts, first] = open;
    Visit& of = visit_at(slot);
    const Query<float>& query = of.search.query;
    query.statistics.undecided += static_cast<std::uint64_t>(std::popcount(verdicts.possible & ~verdicts.certain));
    const bool shorter = visit(CandidateBlock<float, PlacedPath<float>>{query, any_range, of.path, jobs_.list(slot),
                                                                        jobs_.path(slot).reach, from, verdicts, first},
                               of.search.visitor);
    if constexpr (Keep::shortens) {
      if (shorter) shorten(slot);
    }
    return std::uint64_t{of.search.visitor.is_done()} << slot;
  }

  /// Lets the path of a slot walk through the inner grid of its cell. Returns the bit of the slot if its path is done.
  HWY_NOINLINE std::uint64_t visit_inner(std::size_t slot) {
    Visit& of = visit_at(slot);
    KernelInput<float> input(jobs_.path(slot), any_range);
    input.weights = weights_[slot];
    walk_inner(of.search.query, of.path, any_range, input, CellWord(words_[slot]), of.search.visitor);
    if constexpr (Keep::shortens) shorten(slot);
    return std::uint64_t{of.search.visitor.is_done()} << slot;
  }

  /// Ends the walk of a slot where nothing counts any more.
  HWY_INLINE void shorten(std::size_t slot) {
    const Visit& of = visit_at(slot);
    if ((walking_ >> slot & 1) == 0) return;
    lanes_[slot / max_lanes].shorten(slot % max_lanes, of.search.visitor.limit(), of.enters);
  }

  std::array<MeshLanes, vectors> lanes_;
  std::array<LaneWalk::Cells, vectors> cells_;
  Weights weights_;  ///< The weights of the range of each path.
  Jobs jobs_{WeightsOfSlots{weights_}};
  std::array<VisitMemory, slots> visits_;  ///< A visit is made when a path begins to search.
  std::uint64_t walking_ = 0;              ///< The slots whose paths walk.
  std::uint64_t in_only_list_ = 0;         ///< The slots whose mesh has only one list.
  alignas(max_lanes * sizeof(float)) std::array<std::uint32_t, vectors* max_lanes> words_ = {};  ///< The cells.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
