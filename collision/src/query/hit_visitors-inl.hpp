// The visitors of queries. They keep what the query needs of the triangles that its path may meet. Highway compiles
// this file for each instruction set.

#if defined(SUREHIT_HIT_VISITORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_HIT_VISITORS_INL
#undef SUREHIT_HIT_VISITORS_INL
#else
#define SUREHIT_HIT_VISITORS_INL
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "filter/block_boxes-inl.hpp"
#include "filter/block_kernel-inl.hpp"
#include "filter/classify_in_double-inl.hpp"
#include "filter/kernel_path.hpp"
#include "filter/path_box.hpp"
#include "filter/plane_lanes-inl.hpp"
#include "narrowphase.hpp"
#include "path_range.hpp"
#include "query/query.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Returns true if every hit that the kernel is certain of counts. Then no option, mask or filter can leave it out. The
/// options for contacts at the ends do not matter, because a certain hit is inside the range.
template <typename Scalar>
bool counts_every_hit(const Query<Scalar>& query) {
  const QueryOptions<Scalar>& options = query.options;
  return query.filter == nullptr && query.masks.empty() && options.mask != 0 &&
         options.ignored_triangle == no_triangle && options.culling == Culling::none;
}

/// The triangles of one vector that a path may meet. `AnyPath` is a Path, or a type that becomes one where needed.
template <typename Scalar, typename AnyPath>
struct CandidateBlock {
  const Query<Scalar>& query;        ///< The query of the path.
  const PathRange<Scalar>& range;    ///< The range of the path.
  const AnyPath& path;               ///< The path.
  const TriangleList<Scalar>& list;  ///< The list that has the triangles.
  Scalar reach;                      ///< The reach of the path in the frame of the list (P1).
  std::size_t from;                  ///< The index in the list of the triangle in lane 0.
  Verdicts verdicts;                 ///< The verdicts of the kernel.
  const FirstLanes<Scalar>& first;   ///< The hits that may be first. It is set only if the visitor wants an order.

  /// Returns the index of a lane's triangle among the grid's entries.
  [[nodiscard]] std::size_t entry(std::size_t lane) const { return list.first_entry + from + lane; }
  /// Returns the triangle of a lane.
  [[nodiscard]] Triangle<Scalar> triangle(std::size_t lane) const {
    return MeshBlocks<Scalar>::triangle(list.corners, list.count, from + lane);
  }
};

/// Some lanes of a block that the visitor has not decided.
struct OpenLanes {
  std::uint64_t lanes;  ///< The mask of these lanes.
  std::uint64_t close;  ///< Those that `Closeness::close` describes.
};

/// Classifies some lanes of a block of floats in double. The visitor takes what is certain now. Returns the lanes that
/// are still to be decided. Sets `shorter` if the path is shorter now.
template <typename AnyPath, typename Visitor>
HWY_INLINE OpenLanes look_again(const CandidateBlock<float, AnyPath>& block, const Path<float>& path,
                                std::uint64_t lanes, Visitor& visitor, bool& shorter) {
  // Where the order matters, double also tells which of two hits is first.
  const std::uint64_t again = Visitor::wants_order ? lanes : lanes & ~block.verdicts.certain;
  double limit = std::numeric_limits<double>::infinity();
  if constexpr (Visitor::wants_order) limit = visitor.limit();  // `t_upper` may be rounded down.
  const Path<double> in_double(path.kind, path.start.template cast<double>(), path.toward.template cast<double>());
  const KernelPath<double> kernel_path(in_double, double{block.reach});
  FirstLanes<float> first;
  const Verdicts verdicts = classify_in_double(kernel_path, block.range, block.list, block.from, again, limit, first);
  const CandidateBlock<float, AnyPath> now = {block.query, block.range, block.path, block.list,
                                              block.reach, block.from,  verdicts,   first};
  // Without a bound of the list, each pair may still be decided by its own sizes.
  const std::uint64_t close = std::isfinite(block.list.edge_size) ? verdicts.possible & ~verdicts.certain : 0;
  bool is_nearer = false;
  const std::uint64_t left = visitor.take_certain(now, is_nearer);
  shorter |= is_nearer;
  return {(lanes & ~again) | left, close};
}

/// Returns the lanes of `lanes` whose triangle has a box that meets the box of the path up to `limit`. The list has the
/// triangle of lane 0 at index `from`. It is not inlined, so that its frame is gone when the exact stage needs the
/// stack.
template <typename Scalar>
HWY_NOINLINE std::uint64_t lanes_near(const TriangleList<Scalar>& list, std::size_t from, const Path<Scalar>& path,
                                      double limit, std::uint64_t lanes) {
  return lanes & lanes_that_meet(PathBox<Scalar>(path, limit), list, from);
}

/// Removes from `lanes` those that a path in the plane of a wall certainly misses. Returns those of the others that
/// contain the start of the path.
template <typename Scalar>
HWY_NOINLINE std::uint64_t look_at_start(const TriangleList<Scalar>& list, std::size_t from, const Path<Scalar>& path,
                                         std::uint64_t& lanes) {
  // A triangle alone is decided as fast without this.
  if (!path.has_start() || std::has_single_bit(lanes)) return 0;
  const SharingLanes sharing = lanes_that_share(path, list, from);
  std::uint64_t at_start = sharing.corner;
  for (std::size_t axis = 0; axis < 3 && path.has_end(); ++axis) {
    const auto on = static_cast<Eigen::Index>(axis);
    if (path.start[on] != path.toward[on] || (sharing.plane[axis] & lanes) == 0) continue;
    const SeenLanes seen = lanes_seen_along(axis, path, list, from, lanes);
    lanes &= ~seen.misses;
    at_start |= seen.around & sharing.plane[axis];
  }
  return at_start & lanes;
}

/// Gives the candidates of some lanes to the visitor one by one, with a narrowphase that can decide them. A triangle
/// that contains the start comes first, because then few others count. Lanes of floats are classified in double before.
/// Returns true if the path is shorter now.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_NOINLINE bool visit_one_by_one(const CandidateBlock<Scalar, AnyPath>& block, std::uint64_t lanes,
                                   Visitor& visitor) {
  // The ids are needed soon.
  hwy::Prefetch(block.query.grid.entries().address(block.entry(static_cast<std::size_t>(std::countr_zero(lanes)))));
  bool shorter = false;
  if constexpr (Visitor::wants_order) {
    if (visitor.take_tie(block, lanes, shorter)) return shorter;
  }
  // A Path that is made here lives as long as this reference.
  const typename Visitor::AnyPath& path = block.path;
  std::uint64_t at_start = 0;
  if constexpr (std::is_same_v<typename Visitor::AnyPath, Path<Scalar>>) {
    double limit = double{block.range.last};
    if constexpr (Visitor::shortens) {
      limit = std::min(limit, visitor.limit());
      lanes = visitor.lanes_that_may_come_first(block, lanes);
    }
    if constexpr (std::is_same_v<Scalar, float>) {
      lanes &= lanes_that_meet(PathBox<Scalar>(path, limit), block.list, block.from);
    } else {
      lanes = lanes_near(block.list, block.from, path, limit, lanes);  // Stack is scarce in double.
    }
    if (lanes == 0) return shorter;
    at_start = look_at_start(block.list, block.from, path, lanes);
  }
  const typename Visitor::Narrowphase narrowphase(path, block.query.options, block.range, block.query.statistics);
  OpenLanes open = {lanes, 0};
  bool has_looked = !std::is_same_v<typename Visitor::AnyPath, Path<float>>;
  while (open.lanes != 0 && !visitor.is_done()) {
    if constexpr (std::is_same_v<typename Visitor::AnyPath, Path<float>>) {
      if (at_start == 0 && !has_looked) {
        open = look_again(block, path, open.lanes, visitor, shorter);
        has_looked = true;
        continue;
      }
    }
    const auto lane = static_cast<std::size_t>(std::countr_zero(at_start != 0 ? at_start : open.lanes));
    const bool is_close = at_start != 0 || (open.close >> lane & 1) != 0;
    Candidate<Scalar> candidate{block.query.grid.entries()[block.entry(lane)], block.triangle(lane), {}};
    shorter |= visitor.take(block.query, narrowphase, candidate, is_close ? Closeness::close : Closeness::unknown);
    open.lanes &= ~(std::uint64_t{1} << lane);
    if (at_start == 0) continue;
    at_start = 0;
    if constexpr (Visitor::shortens && std::is_same_v<typename Visitor::AnyPath, Path<Scalar>>) {
      open.lanes = visitor.lanes_that_may_come_first(block, open.lanes);
      if (open.lanes != 0) open.lanes = lanes_near(block.list, block.from, path, visitor.limit(), open.lanes);
    }
  }
  return shorter;
}

/// Gives a block to a visitor. The visitor first takes what the kernel is certain of, and then the rest one by one. A
/// visitor without a narrowphase takes only what is certain. Returns true if the path is shorter now.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_INLINE bool visit(const CandidateBlock<Scalar, AnyPath>& block, Visitor& visitor) {
  bool shorter = false;
  const std::uint64_t left = visitor.take_certain(block, shorter);
  // The block is copied here. So it need not be in memory in the usual case, where nothing is left.
  if constexpr (requires { typename Visitor::Narrowphase; }) {
    if (left != 0) shorter |= visit_one_by_one(CandidateBlock<Scalar, AnyPath>(block), left, visitor);
  }
  return shorter;
}

/// Keeps the first hit. If the kernel is certain of a hit and of its order, it does not need the narrowphase. The
/// narrowphase decides all others.
template <typename Scalar>
class FirstHit {
 public:
  using Kernel = BlockKernel<Scalar>;
  using Narrowphase = detail::Narrowphase<Scalar>;
  using AnyPath = Path<Scalar>;                     ///< The paths that the narrowphase takes.
  static constexpr bool wants_order = true;         ///< It needs `CandidateBlock::first`.
  static constexpr bool shortens = true;            ///< Nothing beyond `limit()` counts.
  static constexpr bool passes_over_octets = true;  ///< It needs no triangle of an octet whose box is missed.

  explicit FirstHit(const Query<Scalar>& query) : trusts_kernel_(counts_every_hit(query)) {}
  /// Forgets the hit, and begins with another query.
  void begin(const Query<Scalar>& query) {
    trusts_kernel_ = counts_every_hit(query);
    reset();
  }
  /// Forgets the hit.
  void reset() {
    state_ = State::none;
    t_lower_ = t_upper_ = std::numeric_limits<Scalar>::infinity();
  }

  /// Takes a hit that the kernel is certain of. It must be the only one of the block that may be first, and it must
  /// certainly come before the best one. If the visitor takes it, `is_nearer` is true, and the path counts only up to
  /// `limit()`. Returns the lanes that are still to be decided.
  template <typename AnyPath>
  HWY_INLINE std::uint64_t take_certain(const CandidateBlock<Scalar, AnyPath>& block, bool& is_nearer) {
    if (!trusts_kernel_) return block.verdicts.possible;
    const FirstLanes<Scalar>& first = block.first;
    const std::uint64_t undecided = block.verdicts.possible & ~block.verdicts.certain;
    const bool is_alone = std::has_single_bit(first.lanes);
    const auto lane = static_cast<std::size_t>(std::countr_zero(first.lanes));
    is_nearer = is_alone && first.t_upper < t_lower_;
    if (is_nearer) {
      keep(block, lane);
      hwy::Prefetch(grid_->entries().address(entry_));  // The id is needed when the path ends.
      return undecided;
    }
    const bool may_come_first = first.t_lower <= t_upper_ && !(is_alone && is_best(block, lane));
    return may_come_first ? undecided | first.lanes : undecided;
  }

  /// Takes the first of several certain hits without the narrowphase. All of them must lie in one plane that is
  /// perpendicular to an axis. The path crosses this plane, so it meets all of them at the same t. In levels, most ties
  /// are of this kind. Returns false if this is another case. Then nothing has changed.
  template <typename AnyPath>
  HWY_NOINLINE bool take_tie(const CandidateBlock<Scalar, AnyPath>& block, std::uint64_t left, bool& is_nearer) {
    const FirstLanes<Scalar>& first = block.first;
    if (!trusts_kernel_ || left != first.lanes) return false;
    const auto lane = static_cast<std::size_t>(std::countr_zero(first.lanes));  // It has the lowest id of these lanes.
    const Triangle<Scalar> triangle = block.triangle(lane);
    for (std::uint64_t others = first.lanes & (first.lanes - 1); others != 0; others &= others - 1) {
      const auto other = static_cast<std::size_t>(std::countr_zero(others));
      if (!share_axis_plane(triangle, block.triangle(other))) return false;
    }
    const bool comes_first = first.t_upper < t_lower_;
    if (!comes_first) {
      if (!is_found() || !share_axis_plane(triangle, best_.triangle)) return false;
      if (block.query.grid.entries()[block.entry(lane)] >= id()) return true;
    }
    is_nearer = comes_first;
    keep(block, lane);
    return true;
  }

  /// Returns the lanes of `lanes` whose triangle may come first. The ids of a list ascend.
  template <typename AnyPath>
  [[nodiscard]] std::uint64_t lanes_that_may_come_first(const CandidateBlock<Scalar, AnyPath>& block,
                                                        std::uint64_t lanes) const {
    if (!is_decided() || !best_.contact.at_start || lanes == 0) return lanes;
    const auto first = static_cast<std::size_t>(std::countr_zero(lanes));
    if (comes_later(block.query.grid.entries()[block.entry(first)])) return 0;
    const auto last = [&] { return static_cast<std::size_t>(std::bit_width(lanes)) - 1; };
    while (lanes != 0 && comes_later(block.query.grid.entries()[block.entry(last())])) {
      lanes &= ~(std::uint64_t{1} << last());
    }
    return lanes;
  }

  /// Lets the narrowphase decide a candidate. Keeps it and returns true if it comes first.
  HWY_NOINLINE bool take(const Query<Scalar>& query, const Narrowphase& narrowphase, Candidate<Scalar>& candidate,
                         Closeness closeness) {
    if (!query.takes_part(candidate.id) || (is_found() && grid_ == &query.grid && candidate.id == id())) return false;
    if (comes_later(candidate.id)) return false;
    if (!narrowphase.find_contact(candidate.triangle, candidate.contact, closeness)) return false;
    if (is_found() && !narrowphase.comes_before(candidate, decide_best(narrowphase))) return false;
    if (query.filter != nullptr && !query.accepts(narrowphase.hit(candidate))) return false;
    state_ = State::decided;
    grid_ = &query.grid;
    best_ = candidate;
    // They are rounded to nearest. A Scalar below such a number is below the exact bound too, and one above it is
    // above.
    t_lower_ = static_cast<Scalar>(best_.contact.t_lower);
    t_upper_ = static_cast<Scalar>(best_.contact.t_upper);
    return true;
  }

  /// Returns `t_upper_`, or infinity if there is no hit. A hit that is certainly beyond it does not count.
  [[nodiscard]] Scalar t_upper() const { return t_upper_; }
  /// Returns the t at which the walk may end.
  [[nodiscard]] double limit() const { return state_ == State::decided ? best_.contact.t_upper : double{t_upper_}; }
  /// Returns false, because a later triangle may have an earlier hit.
  [[nodiscard]] bool is_done() const { return false; }

  /// Returns true if there is a hit.
  [[nodiscard]] bool is_found() const { return state_ != State::none; }
  /// Returns true if there is a hit that only the kernel has decided.
  [[nodiscard]] bool is_certain() const { return state_ == State::certain; }
  /// Returns true if there is a hit that the narrowphase has decided.
  [[nodiscard]] bool is_decided() const { return state_ == State::decided; }
  /// Returns the id of the triangle. There must be a hit.
  [[nodiscard]] std::uint32_t id() const { return is_decided() ? best_.id : grid_->entries()[entry_]; }
  /// Returns the triangle. There must be a hit.
  [[nodiscard]] const Triangle<Scalar>& triangle() const { return best_.triangle; }
  /// Returns the index of the triangle among the grid's entries. The hit must be certain.
  [[nodiscard]] std::size_t entry() const { return entry_; }
  /// Returns an upper bound on |t|. The hit must be certain.
  [[nodiscard]] Scalar t_size() const { return std::max(-t_lower_, t_upper_); }
  /// Returns the `TriangleList::edge_size` of the triangle's list. The hit must be certain.
  [[nodiscard]] Scalar edge_size() const { return edge_size_; }
  /// Returns the hit as it is reported. If only the kernel has decided it, the narrowphase decides it first.
  [[nodiscard]] Hit<Scalar> decide_hit(const Narrowphase& narrowphase) {
    return narrowphase.hit(decide_best(narrowphase));
  }

 private:
  /// Returns true if a triangle cannot come first. No contact is before one at the start, so only a lower id comes
  /// before such a hit.
  [[nodiscard]] bool comes_later(std::uint32_t id) const {
    return is_decided() && best_.contact.at_start && id > best_.id;
  }

  enum class State : std::uint8_t {
    none,     ///< There is no hit yet.
    certain,  ///< The kernel is certain of the best hit. Its contact is not set.
    decided,  ///< The narrowphase has decided the best hit.
  };

  /// Keeps a hit that the kernel is certain of.
  template <typename AnyPath>
  HWY_INLINE void keep(const CandidateBlock<Scalar, AnyPath>& block, std::size_t lane) {
    state_ = State::certain;
    grid_ = &block.query.grid;
    entry_ = block.entry(lane);
    edge_size_ = block.list.edge_size;
    best_.triangle = block.triangle(lane);
    t_lower_ = block.first.t_lower;
    t_upper_ = block.first.t_upper;
  }
  /// Returns true if this triangle is the best one already. Most triangles come again in the next cell.
  template <typename AnyPath>
  [[nodiscard]] bool is_best(const CandidateBlock<Scalar, AnyPath>& block, std::size_t lane) const {
    return is_found() && grid_ == &block.query.grid && block.query.grid.entries()[block.entry(lane)] == id();
  }
  /// Returns the best hit. If only the kernel has decided it, the narrowphase decides it first.
  const Candidate<Scalar>& decide_best(const Narrowphase& narrowphase) {
    if (is_certain() && narrowphase.find_contact(best_.triangle, best_.contact)) {
      best_.id = id();
      state_ = State::decided;
    }
    return best_;
  }

  State state_ = State::none;   ///< Who has decided the best hit.
  bool trusts_kernel_;          ///< True if every certain hit counts.
  const Grid* grid_ = nullptr;  ///< The grid of the best hit.
  std::size_t entry_ = 0;       ///< The index of a certain hit among the entries.
  Scalar edge_size_ = 0;        ///< The edge size of the list of a certain hit.
  // The exact t of the best hit lies between these two. Those of a decided hit are rounded to nearest, so they may be
  // off by eps |t|.
  Scalar t_lower_ = std::numeric_limits<Scalar>::infinity();  ///< The lower bound.
  Scalar t_upper_ = std::numeric_limits<Scalar>::infinity();  ///< The upper bound.
  /// The best hit. If it is only certain, only its triangle is set. Before there is a hit, nothing is set. Stores cost
  /// as much as arithmetic here, because a store that waits for its cache line delays all later ones.
  Candidate<Scalar> best_;
};

/// Notes whether there is a hit. It is done with the first one that it finds.
template <typename Scalar>
class AnyHit {
 public:
  using Kernel = BlockKernel<Scalar>;
  using Narrowphase = detail::Narrowphase<Scalar>;
  using AnyPath = Path<Scalar>;  ///< The paths that the narrowphase takes.
  static constexpr bool wants_order = false;
  static constexpr bool shortens = false;
  static constexpr bool passes_over_octets = true;

  explicit AnyHit(const Query<Scalar>&) {}
  /// Begins with another query.
  void begin(const Query<Scalar>&) { reset(); }
  /// Forgets the hit.
  void reset() { is_done_ = false; }

  /// Is done if the kernel is certain of a hit that counts. Returns the lanes that are still to be decided.
  template <typename AnyPath>
  HWY_INLINE std::uint64_t take_certain(const CandidateBlock<Scalar, AnyPath>& block, bool& /*is_nearer*/) {
    is_done_ |= block.verdicts.certain != 0 && counts_every_hit(block.query);
    return is_done_ ? 0 : block.verdicts.possible;
  }
  /// Lets the narrowphase decide a candidate. Returns true if it is a hit that counts.
  HWY_NOINLINE bool take(const Query<Scalar>& query, const Narrowphase& narrowphase, Candidate<Scalar>& candidate,
                         Closeness closeness) {
    if (!query.takes_part(candidate.id)) return false;
    if (!narrowphase.find_contact(candidate.triangle, candidate.contact, closeness)) return false;
    return is_done_ = query.filter == nullptr || query.accepts(narrowphase.hit(candidate));
  }
  /// Returns true if there is a hit.
  [[nodiscard]] bool is_done() const { return is_done_; }

 private:
  bool is_done_ = false;
};

/// Keeps all hits. The narrowphase decides all candidates.
template <typename Scalar>
class AllHits {
 public:
  using Kernel = BlockKernel<Scalar>;
  using Narrowphase = detail::Narrowphase<Scalar>;
  using AnyPath = Path<Scalar>;  ///< The paths that the narrowphase takes.
  static constexpr bool wants_order = false;
  static constexpr bool shortens = false;
  static constexpr bool passes_over_octets = true;

  /// Takes nothing. Returns all lanes that are not certain misses.
  template <typename AnyPath>
  HWY_INLINE std::uint64_t take_certain(const CandidateBlock<Scalar, AnyPath>& block, bool& /*is_nearer*/) {
    return block.verdicts.possible;
  }
  /// Lets the narrowphase decide a candidate, and keeps it if the path meets it. Returns false.
  HWY_NOINLINE bool take(const Query<Scalar>& query, const Narrowphase& narrowphase, Candidate<Scalar>& candidate,
                         Closeness closeness) {
    if (!query.takes_part(candidate.id)) return false;
    if (narrowphase.find_contact(candidate.triangle, candidate.contact, closeness)) {
      found_.push_back(candidate);
    }
    return false;
  }
  /// Returns false, because there may always be more hits.
  [[nodiscard]] bool is_done() const { return false; }

  /// Appends the hits that the filter accepts, in order. Each triangle has at most one hit.
  void append_to(std::vector<Hit<Scalar>>& hits, const Query<Scalar>& query, const Narrowphase& narrowphase) {
    narrowphase.sort(found_);
    for (const Candidate<Scalar>& candidate : found_) {
      const Hit<Scalar> hit = narrowphase.hit(candidate);
      if (query.accepts(hit)) hits.push_back(hit);
    }
  }

 private:
  std::vector<Candidate<Scalar>> found_;  ///< A triangle may be there more than once.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
