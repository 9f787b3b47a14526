// The queries of the paths of a batch. Highway compiles this file for each instruction set.

#if defined(SUREHIT_BATCH_QUERIES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_BATCH_QUERIES_INL
#undef SUREHIT_BATCH_QUERIES_INL
#else
#define SUREHIT_BATCH_QUERIES_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

#include "filter/kernel_bound.hpp"
#include "path_range.hpp"
#include "query/query.hpp"
#if HWY_TARGET != HWY_SCALAR  // This target has no lanes.
#include "walk/lane_walk-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The number of paths of a batch that walk at the same time, each in its slot. More would gain little and take stack.
template <typename Scalar>
constexpr std::size_t max_slots = std::is_same_v<Scalar, float> ? 48 : 32;

/// Takes the place of what brings paths into the frame of a mesh, where they are in it.
struct NoPlacer {
  template <typename Queries>
  explicit NoPlacer(const Queries&) {}
};

/// The queries of a batch whose paths all have the same options.
template <typename Scalar>
class SharedQuery {
 public:
  static constexpr bool is_shared = true;   ///< All paths share one query.
  static constexpr bool is_placed = false;  ///< No path must be brought into the frame of the mesh.
  using Placer = NoPlacer;                  ///< Brings paths there.

  SharedQuery(const Query<Scalar>& batch, PathKind kind)
      : query_(batch), range_(kind, batch.options), weights_(range_) {}

  /// Returns the query of the whole batch.
  [[nodiscard]] const Query<Scalar>& of_batch() const { return query_; }
  /// Returns the query of path `index`.
  [[nodiscard]] const Query<Scalar>& query(std::size_t /*index*/) const { return query_; }
  /// Returns the range of parameters of path `index`.
  [[nodiscard]] const PathRange<Scalar>& range(std::size_t /*index*/) const { return range_; }
  /// Returns the range weights of the path in a slot.
  [[nodiscard]] const RangeWeights<Scalar>& weights_in(std::size_t /*slot*/) const { return weights_; }
  /// Returns true if no path can have a hit.
  [[nodiscard]] bool admits_nothing() const { return range_.is_empty(); }

  /// The ends of a range.
  struct Ends {
    Scalar first, last;  ///< One number for all paths.
  };
  /// Returns the ends of the ranges of `count` paths. The first of them is path `first`.
  [[nodiscard]] Ends ends(std::size_t /*first*/, std::size_t /*count*/) const { return {range_.first, range_.last}; }

 private:
  const Query<Scalar>& query_;
  PathRange<Scalar> range_;
  RangeWeights<Scalar> weights_;
};

/// The queries of a batch whose paths differ. Each path has its own options, or there is a filter that gets the index
/// of the path.
template <typename Scalar>
class OwnQueries {
 public:
  static constexpr bool is_shared = false;  ///< Each path has its own query.
  static constexpr bool is_placed = false;
  using Placer = NoPlacer;

  /// `options` has one element for each path, or none at all.
  OwnQueries(const Query<Scalar>& batch, std::span<const QueryOptions<Scalar>> options, PathKind kind)
      : batch_(batch), options_(options), kind_(kind) {}

  // These functions return the same as those of `SharedQuery`.

  [[nodiscard]] const Query<Scalar>& of_batch() const { return batch_; }
  [[nodiscard]] Query<Scalar> query(std::size_t index) const { return query_of_path(batch_, options_, index); }
  [[nodiscard]] PathRange<Scalar> range(std::size_t index) const {
    return {kind_, options_.empty() ? batch_.options : options_[index]};
  }
  [[nodiscard]] const RangeWeights<Scalar>& weights_in(std::size_t slot) const { return weights_[slot]; }
  /// Keeps the range weights of path `index` for its slot. It is called when the path takes the slot.
  void set_weights(std::size_t slot, std::size_t index) { weights_[slot] = RangeWeights<Scalar>(range(index)); }
  [[nodiscard]] bool admits_nothing() const { return false; }

#if HWY_TARGET != HWY_SCALAR
  /// The ends of the ranges of several paths.
  struct Ends {
    Floats first, last;  ///< One lane for each path.
  };
  [[nodiscard]] Ends ends(std::size_t first, std::size_t count) const {
    // An empty range gets the ends [infinity, -infinity]. So its path misses the grid.
    constexpr float infinity = std::numeric_limits<float>::infinity();
    alignas(max_lanes * sizeof(float)) LaneFloats firsts;
    alignas(max_lanes * sizeof(float)) LaneFloats lasts;
    firsts.fill(infinity);
    lasts.fill(-infinity);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const PathRange<Scalar> its = range(first + lane);
      if (its.is_empty()) continue;
      firsts[lane] = its.first;
      lasts[lane] = its.last;
    }
    return {hn::Load(FloatTag(), firsts.data()), hn::Load(FloatTag(), lasts.data())};
  }
#endif

 private:
  const Query<Scalar>& batch_;                                   ///< The query of the whole batch.
  std::span<const QueryOptions<Scalar>> options_;                ///< The options of each path, or none.
  PathKind kind_;                                                ///< The kind of all paths.
  std::array<RangeWeights<Scalar>, max_slots<Scalar>> weights_;  ///< The range weights of each slot.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
