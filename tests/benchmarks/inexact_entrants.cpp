#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <limits>
#include <surehit/collider.hpp>

#include "collider_state.hpp"
#include "entrants.hpp"
#include "support/floating_point_environment.hpp"

#ifndef SUREHIT_INEXACTNESS
#define SUREHIT_INEXACTNESS
namespace surehit::detail {

/// What a batch is without, unlike the shipped one.
enum class Inexactness : std::uint8_t {
  has_no_exact_stage,  ///< what its kernel leaves undecided is missed
  has_no_filter,       ///< what its kernel computes is taken for true
};

}  // namespace surehit::detail
#endif

// Compiled once for each instruction set, and chosen with those of the library.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "inexact_entrants.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.h.
#include "query/batch-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The determinants taken at their word: a hit where all that must be of one sign is as computed. Zero is of either
/// sign, but a det of zero is a miss, as is usual in inexact tests.
class Unfiltered : BlockDeterminants<float> {
 public:
  struct Bounds {};
  HWY_INLINE static Bounds bounds(const KernelPath<float>& /*path*/, const RangeWeights<float>& /*range*/,
                                  const TriangleList<float>& /*list*/) {
    return {};
  }

  HWY_INLINE Unfiltered(const KernelPath<float>& path, const TriangleList<float>& list, std::size_t from)
      : BlockDeterminants(path, list, from) {}

  [[nodiscard]] HWY_INLINE Verdicts classify(const RangeWeights<float>& range, const Bounds& /*bounds*/) const {
    const V zero = hn::Zero(d_);
    const V w = hn::Sub(hn::Sub(det_, u_), v_);
    const V first = hn::MulAdd(height_, all(range.t_first), hn::Mul(det_, all(range.det_first)));
    const V last = hn::MulAdd(height_, all(range.t_last), hn::Mul(det_, all(range.det_last)));
    const V least = hn::Min(hn::Min(hn::Min(u_, v_), w), hn::Min(first, last));
    const V greatest = hn::Max(hn::Max(hn::Max(u_, v_), w), hn::Max(first, last));
    const auto one_sign = hn::Or(hn::Ge(least, zero), hn::Le(greatest, zero));
    const auto counts = hn::And(hn::Ne(det_, zero), hn::FirstN(d_, left_));
    const std::uint64_t hits = bits_of(d_, hn::And(one_sign, counts));
    return {hits, hits};
  }

  struct Crossing {
    V height, det;
  };
  [[nodiscard]] HWY_INLINE Crossing crossing() const { return {height_, det_}; }

  [[nodiscard]] HWY_INLINE static FirstLanes<float> first_of(const Bounds& /*bounds*/, const Crossing& crossing,
                                                             std::uint64_t hits, float /*limit*/) {
    const Tag d;
    const auto taken = mask_of(d, hits);
    const V t =
        hn::IfThenElse(taken, hn::Div(crossing.height, crossing.det), all(std::numeric_limits<float>::infinity()));
    const float least = min_of_lanes(d, t);
    return {bits_of(d, hn::And(taken, hn::Eq(t, all(least)))), least, least};
  }
  [[nodiscard]] HWY_INLINE FirstLanes<float> first_of(const Bounds& bounds, std::uint64_t hits, float limit) const {
    return first_of(bounds, crossing(), hits, limit);
  }

  [[nodiscard]] HWY_INLINE static FirstLanes<float> first_of_one(const Bounds& /*bounds*/, float height, float det,
                                                                 std::uint64_t hits) {
    const float t = height / det;
    return {hits, t, t};
  }
};

/// The shipped kernel with its bounds of a list, but that lanes which these leave undecided are misses and t is as
/// computed.
class WithoutExactStage : public BlockKernel<float> {
 public:
  HWY_INLINE WithoutExactStage(const KernelPath<float>& path, const TriangleList<float>& list, std::size_t from)
      : BlockKernel(path, list, from) {}

  [[nodiscard]] HWY_INLINE Verdicts classify(const RangeWeights<float>& range, const Bounds& bounds) const {
    const Verdicts verdicts = BlockKernel::classify(range, bounds);
    return {verdicts.certain, verdicts.certain};
  }
  [[nodiscard]] HWY_INLINE static FirstLanes<float> first_of(const Bounds& /*bounds*/, const Crossing& crossing,
                                                             std::uint64_t hits, float limit) {
    return Unfiltered::first_of({}, {crossing.height, crossing.det}, hits, limit);
  }
  [[nodiscard]] HWY_INLINE FirstLanes<float> first_of(const Bounds& bounds, std::uint64_t hits, float limit) const {
    return first_of(bounds, crossing(), hits, limit);
  }
  [[nodiscard]] HWY_INLINE static FirstLanes<float> first_of_one(const Bounds& /*bounds*/, float height, float det,
                                                                 std::uint64_t hits) {
    return Unfiltered::first_of_one({}, height, det, hits);
  }
};

/// Keeps the hit of least t as computed; of equal ones the first that it is given.
template <typename AnyKernel>
class FirstAsComputed {
 public:
  using Kernel = AnyKernel;
  static constexpr bool wants_order = true;
  static constexpr bool shortens = true;
  static constexpr bool passes_over_octets = true;

  explicit FirstAsComputed(const Query<float>&) {}
  void begin(const Query<float>&) { reset(); }
  void reset() { t_ = std::numeric_limits<float>::infinity(); }

  template <typename AnyPath>
  HWY_INLINE std::uint64_t take_certain(const CandidateBlock<float, AnyPath>& block, bool& is_nearer) {
    is_nearer = block.first.t_lower < t_;
    if (!is_nearer) return 0;
    const auto lane = static_cast<std::size_t>(std::countr_zero(block.first.lanes));
    t_ = block.first.t_lower;
    entry_ = block.entry(lane);
    triangle_ = block.triangle(lane);
    hwy::Prefetch(block.query.grid.entries().address(entry_));  // The id is needed when the path ends.
    return 0;
  }
  [[nodiscard]] float t_upper() const { return t_; }
  [[nodiscard]] double limit() const { return t_; }
  [[nodiscard]] bool is_done() const { return false; }

  [[nodiscard]] bool is_found() const { return t_ < std::numeric_limits<float>::infinity(); }
  [[nodiscard]] HWY_INLINE Hitf hit(const Query<float>& query, const Segmentf& segment) const {
    const Vector3f direction = segment.end - segment.start;
    const Vector3f ab = triangle_.b - triangle_.a;
    const Vector3f ac = triangle_.c - triangle_.a;
    const Vector3f from_a = segment.start - triangle_.a;
    const Vector3f normal_of_u = direction.cross(ac);
    const float det = ab.dot(normal_of_u);
    return {t_, from_a.dot(normal_of_u) / det, direction.dot(from_a.cross(ab)) / det, query.grid.entries()[entry_],
            det > 0 ? Side::front : Side::back};
  }

 private:
  float t_ = std::numeric_limits<float>::infinity();
  std::size_t entry_ = 0;
  Trianglef triangle_ = {Vector3f::Zero(), Vector3f::Zero(), Vector3f::Zero()};
};

template <typename AnyKernel>
class AnyAsComputed {
 public:
  using Kernel = AnyKernel;
  static constexpr bool wants_order = false;
  static constexpr bool shortens = false;
  static constexpr bool passes_over_octets = true;

  explicit AnyAsComputed(const Query<float>&) {}
  void begin(const Query<float>&) { reset(); }
  void reset() { is_done_ = false; }

  template <typename AnyPath>
  HWY_INLINE std::uint64_t take_certain(const CandidateBlock<float, AnyPath>& block, bool& /*is_nearer*/) {
    is_done_ = block.verdicts.certain != 0;
    return 0;
  }
  [[nodiscard]] double limit() const { return 0; }
  [[nodiscard]] bool is_done() const { return is_done_; }

 private:
  bool is_done_ = false;
};

// Paths that the lanes cannot place are answered as the library does.

template <typename Kernel>
void first_hits_by(const Query<float>& query, std::span<const Segmentf> paths, std::span<Hitf> hits) {
  std::fill(hits.begin(), hits.end(), Hitf{});
  SharedQuery queries(query, PathKind::segment);
  const auto finish = [&](std::size_t index, const FirstAsComputed<Kernel>& first) {
    if (first.is_found()) hits[index] = first.hit(query, paths[index]);
  };
  const auto alone = [&](std::size_t index) {
    hits[index] = search_first<float>(query, paths[index]).value_or(Hitf{});
  };
  search_paths<FirstAsComputed<Kernel>>(queries, PathSpan<float>(paths), finish, alone);
}

template <typename Kernel>
void any_hits_by(const Query<float>& query, std::span<const Segmentf> paths, std::span<std::uint8_t> blocked) {
  std::fill(blocked.begin(), blocked.end(), std::uint8_t{0});
  SharedQuery queries(query, PathKind::segment);
  const auto finish = [&](std::size_t index, const AnyAsComputed<Kernel>& any) {
    blocked[index] = any.is_done() ? 1 : 0;
  };
  const auto alone = [&](std::size_t index) { blocked[index] = search_any<float>(query, paths[index]) ? 1 : 0; };
  search_paths<AnyAsComputed<Kernel>>(queries, PathSpan<float>(paths), finish, alone);
}

// Highway exports plain functions.

void inexact_first_hits(Inexactness inexactness, const Query<float>& query, std::span<const Segmentf> paths,
                        std::span<Hitf> hits) {
  const bool filters = inexactness == Inexactness::has_no_exact_stage;
  filters ? first_hits_by<WithoutExactStage>(query, paths, hits) : first_hits_by<Unfiltered>(query, paths, hits);
}

void inexact_any_hits(Inexactness inexactness, const Query<float>& query, std::span<const Segmentf> paths,
                      std::span<std::uint8_t> blocked) {
  const bool filters = inexactness == Inexactness::has_no_exact_stage;
  filters ? any_hits_by<WithoutExactStage>(query, paths, blocked) : any_hits_by<Unfiltered>(query, paths, blocked);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(inexact_first_hits);
HWY_EXPORT(inexact_any_hits);

void chosen_first_hits(Inexactness inexactness, const Query<float>& query, std::span<const Segmentf> paths,
                       std::span<Hitf> hits) {
  HWY_DYNAMIC_DISPATCH(inexact_first_hits)(inexactness, query, paths, hits);
}
void chosen_any_hits(Inexactness inexactness, const Query<float>& query, std::span<const Segmentf> paths,
                     std::span<std::uint8_t> blocked) {
  HWY_DYNAMIC_DISPATCH(inexact_any_hits)(inexactness, query, paths, blocked);
}

}  // namespace surehit::detail

namespace surehit::benchmark {
namespace {

/// Works on the grid of a collider and on what the collider makes of its mesh for that grid, so that both lie in memory
/// in the same way.
class InexactBatch : public Contender {
 public:
  explicit InexactBatch(detail::Inexactness inexactness) : inexactness_(inexactness) {}

  void build(const TriangleMeshViewf& mesh) override {
    collider_ = Colliderf(mesh);
    blocks_ = MeshBlocks<float>(mesh, grid());
  }

  [[nodiscard]] std::size_t memory_bytes() const override { return grid().memory_bytes() + blocks_.memory_bytes(); }

  void first(const PathBatch& paths, std::span<Hitf> hits) const override {
    answer([&](const detail::Query<float>& query) {
      detail::chosen_first_hits(inexactness_, query, paths.segments(), hits);
    });
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const override {
    answer([&](const detail::Query<float>& query) {
      detail::chosen_any_hits(inexactness_, query, paths.segments(), blocked);
    });
  }

 private:
  [[nodiscard]] const Grid& grid() const { return detail::ColliderState<float>::of(collider_).grid; }

  template <typename Answer>
  void answer(const Answer& answer) const {
    const FloatingPointEnvironment environment;
    const QueryOptions<float> options;
    QueryStatistics unread;
    answer({grid(), blocks_, {}, options, nullptr, unread, 0});
  }

  detail::Inexactness inexactness_;
  Colliderf collider_;
  MeshBlocks<float> blocks_;
};

}  // namespace

std::vector<Entrant> inexact_entrants() {
  const auto entrant = [](const char* name, detail::Inexactness inexactness) -> Entrant {
    return {name, "", "", [inexactness] { return std::make_unique<InexactBatch>(inexactness); }};
  };
  return {entrant("surehit without its exact stage", detail::Inexactness::has_no_exact_stage),
          entrant("surehit without its filter", detail::Inexactness::has_no_filter)};
}

}  // namespace surehit::benchmark
#endif
