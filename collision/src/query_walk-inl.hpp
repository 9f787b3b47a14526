// Single paths, for the instruction set that Highway compiles this for.

#if defined(SUREHIT_QUERY_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_QUERY_WALK_INL
#undef SUREHIT_QUERY_WALK_INL
#else
#define SUREHIT_QUERY_WALK_INL
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <optional>

#include "block_kernel-inl.hpp"
#include "kernel_path.hpp"
#include "narrowphase.hpp"
#include "query.hpp"
#include "surehit/grid_traversal.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Keeps the first of the hits that it is shown.
template <typename Scalar>
class FirstHit {
 public:
  FirstHit(const Query<Scalar>& query, const Narrowphase<Scalar>& narrowphase)
      : query_(query), narrowphase_(narrowphase) {}

  /// Of a triangle that the kernel does not say the path misses: whether the path is of interest up to `limit()` only
  /// now. `triangle()` fetches it.
  HWY_NOINLINE bool meet(std::uint32_t id, bool /*certain*/, const auto& triangle) {
    if (id == best_.id || !query_.takes_part(id)) return false;
    Candidate<Scalar> candidate{id, triangle(), {}};
    if (!narrowphase_.find_contact(candidate.triangle, candidate.bounded)) return false;
    if (is_found() && !narrowphase_.comes_before(candidate, best_)) return false;
    if (query_.filter != nullptr && !(*query_.filter)(narrowphase_.hit(candidate))) return false;
    best_ = candidate;
    return true;
  }
  [[nodiscard]] double limit() const { return best_.contact().t_upper; }
  [[nodiscard]] bool is_done() const { return false; }

  [[nodiscard]] bool is_found() const { return best_.id != no_triangle; }
  [[nodiscard]] Hit<Scalar> hit() const { return narrowphase_.hit(best_); }

 private:
  const Query<Scalar>& query_;
  const Narrowphase<Scalar>& narrowphase_;
  Candidate<Scalar> best_;
};

/// Is content with any hit.
template <typename Scalar>
class AnyHit {
 public:
  AnyHit(const Query<Scalar>& query, const Narrowphase<Scalar>& narrowphase)
      : query_(query), narrowphase_(narrowphase), counts_certain_(counts_every_hit(query)) {}

  HWY_NOINLINE bool meet(std::uint32_t id, bool certain, const auto& triangle) {
    if (certain && counts_certain_) return is_done_ = true;
    if (!query_.takes_part(id)) return false;
    Candidate<Scalar> candidate{id, triangle(), {}};
    if (!narrowphase_.find_contact(candidate.triangle, candidate.bounded)) return false;
    return is_done_ = query_.filter == nullptr || (*query_.filter)(narrowphase_.hit(candidate));
  }
  [[nodiscard]] double limit() const { return 0; }
  [[nodiscard]] bool is_done() const { return is_done_; }

 private:
  /// Whether no option, mask or filter can leave out a hit that the kernel is certain of.
  static bool counts_every_hit(const Query<Scalar>& query) {
    const QueryOptions<Scalar>& options = query.options;
    return query.filter == nullptr && query.masks.empty() && options.mask != 0 &&
           options.ignored_triangle == no_triangle && options.culling == Culling::none &&
           !options.ignore_start_contact && !options.ignore_end_contact;
  }

  const Query<Scalar>& query_;
  const Narrowphase<Scalar>& narrowphase_;
  bool counts_certain_;
  bool is_done_ = false;
};

/// Keeps all hits.
template <typename Scalar>
class AllHits {
 public:
  AllHits(const Query<Scalar>& query, const Narrowphase<Scalar>& narrowphase)
      : query_(query), narrowphase_(narrowphase) {}

  HWY_NOINLINE bool meet(std::uint32_t id, bool /*certain*/, const auto& triangle) {
    if (!query_.takes_part(id)) return false;
    Candidate<Scalar> candidate{id, triangle(), {}};
    if (narrowphase_.find_contact(candidate.triangle, candidate.bounded)) found_.push_back(candidate);
    return false;
  }
  [[nodiscard]] double limit() const { return 0; }
  [[nodiscard]] bool is_done() const { return false; }

  /// Those that the filter accepts, in order, each once.
  void append_to(std::vector<Hit<Scalar>>& hits) {
    const auto same_id = [](const Candidate<Scalar>& x, const Candidate<Scalar>& y) { return x.id == y.id; };
    const auto by_id = [](const Candidate<Scalar>& x, const Candidate<Scalar>& y) { return x.id < y.id; };
    // A triangle is found once in every cell that lists it.
    std::sort(found_.begin(), found_.end(), by_id);
    found_.erase(std::unique(found_.begin(), found_.end(), same_id), found_.end());
    std::sort(found_.begin(), found_.end(),
              [&](const Candidate<Scalar>& x, const Candidate<Scalar>& y) { return narrowphase_.comes_before(x, y); });
    for (const Candidate<Scalar>& candidate : found_) {
      const Hit<Scalar> hit = narrowphase_.hit(candidate);
      if (query_.filter == nullptr || (*query_.filter)(hit)) hits.push_back(hit);
    }
  }

 private:
  const Query<Scalar>& query_;
  const Narrowphase<Scalar>& narrowphase_;
  std::vector<Candidate<Scalar>> found_;
};

/// Fetches a cell's list into the cache.
template <typename Scalar>
HWY_INLINE void prefetch_list(const Query<Scalar>& query, CellWord word) {
  constexpr std::size_t line = 64;
  constexpr std::size_t most_lines = 16;
  const std::size_t first = query.grid.first_entry(word);
  const auto* block = reinterpret_cast<const std::uint8_t*>(query.mesh.block(first));
  const std::size_t bytes = MeshBlocks<Scalar>::coordinates * query.grid.listed_entries(word) * sizeof(Scalar);
  for (std::size_t i = 0; i < std::min(bytes, most_lines * line); i += line) hwy::Prefetch(block + i);
  hwy::Prefetch(query.grid.entries().data() + first);
}

/// Shows the visitor the triangles of a cell's list that the path may meet. Returns whether the path is shorter now.
template <typename Scalar, typename Visitor>
HWY_INLINE bool meet_list(const Query<Scalar>& query, const KernelPath<Scalar>& path, CellWord word, Visitor& visitor) {
  const hn::ScalableTag<Scalar> d;
  const std::size_t lane_count = hn::Lanes(d);
  const std::size_t first = query.grid.first_entry(word);
  const std::size_t count = query.grid.entry_count(word);
  const Scalar* block = query.mesh.block(first);
  const Scalar edge_size = query.mesh.edge_size(first);
  bool shorter = false;
  query.statistics.candidates += count;
  for (std::size_t i = 0; i < count; i += lane_count) {
    const std::size_t left = std::min(count - i, lane_count);
    Lanes lanes = classify(path, block + i, count, left, edge_size);
    query.statistics.undecided += static_cast<std::uint64_t>(std::popcount(lanes.possible & ~lanes.certain));
    for (; lanes.possible != 0; lanes.possible &= lanes.possible - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes.possible));
      const bool certain = (lanes.certain >> lane & 1) != 0;
      shorter |= visitor.meet(query.grid.entries()[first + i + lane], certain,
                              [&] { return MeshBlocks<Scalar>::triangle(block, count, i + lane); });
      if (visitor.is_done()) return true;
    }
  }
  return shorter;
}

/// Shows the visitor the triangles that the path may meet, cell by cell, until it is done or the walk ends.
template <typename Scalar, typename Visitor>
HWY_INLINE void walk(const Query<Scalar>& query, const Path<Scalar>& path, const PathRange<Scalar>& range,
                     Visitor& visitor) {
  ++query.statistics.paths;
  if (range.is_empty()) return;
  const PlacedPath placed(query.grid, path, range.first, range.last);
  if (placed.place == PlacedPath::Place::outside) return;
  if (placed.place == PlacedPath::Place::unclipped) {
    ++query.statistics.unclipped;
    query.statistics.candidates += query.mesh.triangle_count();
    for (std::uint32_t id = 0; id < query.mesh.triangle_count() && !visitor.is_done(); ++id) {
      visitor.meet(id, false, [&] { return query.mesh.triangle(id); });
    }
    return;
  }
  const RangeWeights<Scalar> weights(range);
  std::optional<KernelPath<Scalar>> kernel_path;  // most short paths meet no list at all
  for (GridTraversal traversal(query.grid, placed); !traversal.at_end(); traversal.advance()) {
    ++query.statistics.cells;
    if (traversal.word().is_empty()) continue;
    if (!kernel_path) kernel_path.emplace(path, weights);
    if (!meet_list(query, *kernel_path, traversal.word(), visitor)) continue;
    if (visitor.is_done()) return;
    traversal.shorten(visitor.limit());
  }
}

template <typename Scalar>
std::optional<Hit<Scalar>> find_first(const Query<Scalar>& query, const Path<Scalar>& path) {
  const PathRange<Scalar> range(path, query.options);
  const Narrowphase<Scalar> narrowphase(path, query.options, range, query.statistics);
  FirstHit<Scalar> first(query, narrowphase);
  walk(query, path, range, first);
  return first.is_found() ? std::optional(first.hit()) : std::nullopt;
}

template <typename Scalar>
bool find_any(const Query<Scalar>& query, const Path<Scalar>& path) {
  const PathRange<Scalar> range(path, query.options);
  const Narrowphase<Scalar> narrowphase(path, query.options, range, query.statistics);
  AnyHit<Scalar> any(query, narrowphase);
  walk(query, path, range, any);
  return any.is_done();
}

template <typename Scalar>
void find_all(const Query<Scalar>& query, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits) {
  const PathRange<Scalar> range(path, query.options);
  const Narrowphase<Scalar> narrowphase(path, query.options, range, query.statistics);
  AllHits<Scalar> all(query, narrowphase);
  walk(query, path, range, all);
  all.append_to(hits);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
