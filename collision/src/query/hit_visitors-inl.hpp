// What queries keep of the triangles that their paths may meet, for the instruction set that Highway compiles this for.

#if defined(SUREHIT_HIT_VISITORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_HIT_VISITORS_INL
#undef SUREHIT_HIT_VISITORS_INL
#else
#define SUREHIT_HIT_VISITORS_INL
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "filter/block_kernel-inl.hpp"
#include "narrowphase.hpp"
#include "query/path_range.hpp"
#include "query/query.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Whether no option, mask or filter can leave out a hit that the kernel is certain of. It lies inside the range, so
/// off the path's ends, whose contacts an option may ignore.
template <typename Scalar>
bool counts_every_hit(const Query<Scalar>& query) {
  const QueryOptions<Scalar>& options = query.options;
  return query.filter == nullptr && query.masks.empty() && options.mask != 0 &&
         options.ignored_triangle == no_triangle && options.culling == Culling::none;
}

/// Triangles of a list that the kernel does not say the path misses. `AnyPath` is what a Path is made of.
template <typename Scalar, typename AnyPath>
struct Meeting {
  const Query<Scalar>& query;
  const PathRange<Scalar>& range;
  const AnyPath& path;
  const TriangleList<Scalar>& list;
  std::size_t from;  ///< the triangle of lane 0
  Lanes lanes;
  const FirstLanes<Scalar>& first;  ///< of the certain ones, where the visitor asks for it

  [[nodiscard]] std::size_t entry(std::size_t lane) const { return list.first_entry + from + lane; }
  [[nodiscard]] Triangle<Scalar> triangle(std::size_t lane) const {
    return MeshBlocks<Scalar>::triangle(list.corners, list.count, from + lane);
  }
  /// Returns whether the path is shorter now.
  template <typename Visitor>
  HWY_NOINLINE bool show(std::uint64_t shown, Visitor& visitor) const {
    bool shorter = false;
    if constexpr (Visitor::wants_order) {
      if (visitor.settles_tie(*this, shown, shorter)) return shorter;
    }
    const auto& shown_path = as_path(path);
    const Narrowphase<Scalar> narrowphase(shown_path, query.options, range, query.statistics);
    for (; shown != 0 && !visitor.is_done(); shown &= shown - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(shown));
      Candidate<Scalar> candidate{query.grid.entries()[entry(lane)], triangle(lane), {}};
      shorter |= visitor.meet(query, narrowphase, candidate);
    }
    return shorter;
  }

 private:
  static const Path<Scalar>& as_path(const Path<Scalar>& path) { return path; }
  template <typename Other>
  static Path<Scalar> as_path(const Other& path) {
    return path;
  }
};

/// Keeps the first of the hits that it is shown. Where the kernel is certain of a hit and of its place among the
/// others, that is all it takes; the narrowphase sees the rest.
template <typename Scalar>
class FirstHit {
 public:
  using Kernel = BlockKernel<Scalar>;
  static constexpr bool wants_order = true;  ///< `Meeting::first`

  explicit FirstHit(const Query<Scalar>& query) : trusts_kernel_(counts_every_hit(query)) {}
  /// Begins anew with another query.
  void begin(const Query<Scalar>& query) {
    trusts_kernel_ = counts_every_hit(query);
    reset();
  }
  void reset() {
    state_ = State::none;
    t_lower_ = t_upper_ = std::numeric_limits<Scalar>::infinity();
  }

  /// Whether the path is of interest up to `limit()` only now.
  template <typename AnyPath>
  HWY_INLINE bool meet(const Meeting<Scalar, AnyPath>& meeting) {
    const FirstLanes<Scalar>& first = meeting.first;
    std::uint64_t open = meeting.lanes.possible;
    bool is_nearer = false;
    if (trusts_kernel_) {
      open &= ~meeting.lanes.certain;
      const bool is_alone = std::has_single_bit(first.lanes);
      const auto lane = static_cast<std::size_t>(std::countr_zero(first.lanes));
      is_nearer = is_alone && first.t_upper < t_lower_;
      if (is_nearer) {
        locate(meeting, lane);
        hwy::Prefetch(meeting.query.grid.entries().data() + entry_);  // wanted when the path ends
      } else if (first.t_lower <= t_upper_ && !(is_alone && is_best(meeting.query, meeting.entry(lane)))) {
        open |= first.lanes;
      }
    }
    if (open == 0) return is_nearer;
    // A copy, so that it alone has to be in memory, and only when it is shown.
    return is_nearer | Meeting<Scalar, AnyPath>(meeting).show(open, *this);
  }

  HWY_NOINLINE bool meet(const Query<Scalar>& query, const Narrowphase<Scalar>& narrowphase,
                         Candidate<Scalar>& candidate) {
    if (!query.takes_part(candidate.id) || (is_found() && candidate.id == id(query))) return false;
    if (!narrowphase.find_contact(candidate.triangle, candidate.contact)) return false;
    if (is_found() && !narrowphase.comes_before(candidate, best(query, narrowphase))) return false;
    if (query.filter != nullptr && !query.accepts(narrowphase.hit(candidate))) return false;
    state_ = State::weighed;
    best_ = candidate;
    // To the nearest, eps |t| off at most: what the kernel compares with them has 3 eps |t| to spare
    // (`BlockKernel::interval_of_t`).
    t_lower_ = static_cast<Scalar>(best_.contact.t_lower);
    t_upper_ = static_cast<Scalar>(best_.contact.t_upper);
    return true;
  }

  /// The usual tie in a level, without the narrowphase: where all that is open are certain hits that may come first, in
  /// one plane that is square to an axis, the path crosses that plane, and meets whatever lies in it at the same t.
  template <typename AnyPath>
  HWY_NOINLINE bool settles_tie(const Meeting<Scalar, AnyPath>& meeting, std::uint64_t open, bool& is_nearer) {
    const FirstLanes<Scalar>& first = meeting.first;
    if (!trusts_kernel_ || open != first.lanes) return false;
    const auto lane = static_cast<std::size_t>(std::countr_zero(first.lanes));  // ids ascend
    const Triangle<Scalar> triangle = meeting.triangle(lane);
    for (std::uint64_t others = first.lanes & (first.lanes - 1); others != 0; others &= others - 1) {
      const auto other = static_cast<std::size_t>(std::countr_zero(others));
      if (!share_axis_plane(triangle, meeting.triangle(other))) return false;
    }
    const bool comes_first = first.t_upper < t_lower_;
    if (!comes_first) {
      if (!is_found() || !share_axis_plane(triangle, best_.triangle)) return false;
      if (meeting.query.grid.entries()[meeting.entry(lane)] >= id(meeting.query)) return true;
    }
    is_nearer = comes_first;
    locate(meeting, lane);
    return true;
  }

  /// Nothing that begins after this t is of interest.
  [[nodiscard]] Scalar t_upper() const { return t_upper_; }
  [[nodiscard]] double limit() const { return state_ == State::weighed ? best_.contact.t_upper : double{t_upper_}; }
  [[nodiscard]] bool is_done() const { return false; }

  [[nodiscard]] bool is_found() const { return state_ != State::none; }
  /// Whether only the kernel has judged the best one.
  [[nodiscard]] bool is_located_only() const { return state_ == State::located; }
  [[nodiscard]] bool is_weighed() const { return state_ == State::weighed; }
  [[nodiscard]] std::uint32_t id(const Query<Scalar>& query) const {
    return state_ == State::weighed ? best_.id : query.grid.entries()[entry_];
  }
  [[nodiscard]] const Triangle<Scalar>& triangle() const { return best_.triangle; }
  [[nodiscard]] std::size_t entry() const { return entry_; }
  /// No less than |t|.
  [[nodiscard]] Scalar t_size() const { return std::max(-t_lower_, t_upper_); }
  /// Of a located one `TriangleList::edge_size`.
  [[nodiscard]] Scalar edge_size() const { return edge_size_; }
  [[nodiscard]] Hit<Scalar> hit(const Query<Scalar>& query, const Narrowphase<Scalar>& narrowphase) {
    return narrowphase.hit(best(query, narrowphase));
  }

 private:
  enum class State : std::uint8_t {
    none,
    located,  ///< by the kernel alone
    weighed,  ///< by the narrowphase
  };

  /// Keeps a hit that the kernel is certain of.
  template <typename AnyPath>
  HWY_INLINE void locate(const Meeting<Scalar, AnyPath>& meeting, std::size_t lane) {
    state_ = State::located;
    entry_ = meeting.entry(lane);
    edge_size_ = meeting.list.edge_size;
    best_.triangle = meeting.triangle(lane);
    t_lower_ = meeting.first.t_lower;
    t_upper_ = meeting.first.t_upper;
  }
  /// Most triangles are met again in the next cell.
  [[nodiscard]] bool is_best(const Query<Scalar>& query, std::size_t entry) const {
    return is_found() && query.grid.entries()[entry] == id(query);
  }
  const Candidate<Scalar>& best(const Query<Scalar>& query, const Narrowphase<Scalar>& narrowphase) {
    if (state_ == State::located && narrowphase.find_contact(best_.triangle, best_.contact)) {
      best_.id = query.grid.entries()[entry_];
      state_ = State::weighed;
    }
    return best_;
  }

  State state_ = State::none;
  bool trusts_kernel_;
  std::size_t entry_ = 0;                                     ///< of a located one,
  Scalar edge_size_ = 0;                                      ///< and of its list
  Scalar t_lower_ = std::numeric_limits<Scalar>::infinity();  ///< the best one's t is in [t_lower_, t_upper_]
  Scalar t_upper_ = std::numeric_limits<Scalar>::infinity();  //
  /// Of a located one the triangle alone. Not set before there is one: what a query stores counts as much as what it
  /// computes, for a store that waits for its line holds up all behind it.
  Candidate<Scalar> best_;
};

/// Is content with any hit.
template <typename Scalar>
class AnyHit {
 public:
  using Kernel = BlockKernel<Scalar>;
  static constexpr bool wants_order = false;

  explicit AnyHit(const Query<Scalar>&) {}
  void begin(const Query<Scalar>&) { reset(); }
  void reset() { is_done_ = false; }

  template <typename AnyPath>
  HWY_INLINE bool meet(const Meeting<Scalar, AnyPath>& meeting) {
    if (meeting.lanes.certain != 0 && counts_every_hit(meeting.query)) return is_done_ = true;
    return meeting.show(meeting.lanes.possible, *this);
  }

  HWY_NOINLINE bool meet(const Query<Scalar>& query, const Narrowphase<Scalar>& narrowphase,
                         Candidate<Scalar>& candidate) {
    if (!query.takes_part(candidate.id)) return false;
    if (!narrowphase.find_contact(candidate.triangle, candidate.contact)) return false;
    return is_done_ = query.filter == nullptr || query.accepts(narrowphase.hit(candidate));
  }
  [[nodiscard]] bool is_done() const { return is_done_; }

 private:
  bool is_done_ = false;
};

/// Keeps all hits.
template <typename Scalar>
class AllHits {
 public:
  using Kernel = BlockKernel<Scalar>;
  static constexpr bool wants_order = false;

  template <typename AnyPath>
  HWY_INLINE bool meet(const Meeting<Scalar, AnyPath>& meeting) {
    return meeting.show(meeting.lanes.possible, *this);
  }

  HWY_NOINLINE bool meet(const Query<Scalar>& query, const Narrowphase<Scalar>& narrowphase,
                         Candidate<Scalar>& candidate) {
    if (!query.takes_part(candidate.id)) return false;
    if (narrowphase.find_contact(candidate.triangle, candidate.contact)) found_.push_back(candidate);
    return false;
  }
  [[nodiscard]] bool is_done() const { return false; }

  /// Those that the filter accepts, in order, each once.
  void append_to(std::vector<Hit<Scalar>>& hits, const Query<Scalar>& query, const Narrowphase<Scalar>& narrowphase) {
    narrowphase.sort(found_);
    for (const Candidate<Scalar>& candidate : found_) {
      const Hit<Scalar> hit = narrowphase.hit(candidate);
      if (query.accepts(hit)) hits.push_back(hit);
    }
  }

 private:
  std::vector<Candidate<Scalar>> found_;
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
