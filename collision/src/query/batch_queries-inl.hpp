// What the paths of a batch are asked. Highway compiles this for each instruction set.

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
#include "query/path_range.hpp"
#include "query/query.hpp"
#if HWY_TARGET != HWY_SCALAR  // It has no lanes.
#include "walk/lane_walk-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The paths of a batch that are walked at the same time, each in its slot. More would gain little and take stack.
template <typename Scalar>
constexpr std::size_t max_slots = std::is_same_v<Scalar, float> ? 48 : 32;

/// Asks the same of all paths of a batch.
template <typename Scalar>
class SharedQuery {
 public:
  static constexpr bool is_shared = true;

  SharedQuery(const Query<Scalar>& batch, PathKind kind)
      : query_(batch), range_(kind, batch.options), weights_(range_) {}

  [[nodiscard]] const Query<Scalar>& of_batch() const { return query_; }
  /// Returns what path `index` is asked.
  [[nodiscard]] const Query<Scalar>& query(std::size_t /*index*/) const { return query_; }
  /// Returns the range that this admits.
  [[nodiscard]] const PathRange<Scalar>& range(std::size_t /*index*/) const { return range_; }
  /// Returns the weights of the range of the path that walks in this slot.
  [[nodiscard]] const RangeWeights<Scalar>& weights_in(std::size_t /*slot*/) const { return weights_; }
  /// Returns true if no path can have a hit.
  [[nodiscard]] bool admits_nothing() const { return range_.is_empty(); }

  struct Ends {
    Scalar first, last;
  };
  /// Returns the ends of the ranges of `count` paths, from path `first` on.
  [[nodiscard]] Ends ends(std::size_t /*first*/, std::size_t /*count*/) const { return {range_.first, range_.last}; }

 private:
  const Query<Scalar>& query_;
  PathRange<Scalar> range_;
  RangeWeights<Scalar> weights_;
};

/// Asks each path of a batch for itself, because it has its own options, or because the filter gets its index.
template <typename Scalar>
class OwnQueries {
 public:
  static constexpr bool is_shared = false;

  /// `options` has one element for each path, or none.
  OwnQueries(const Query<Scalar>& batch, std::span<const QueryOptions<Scalar>> options, PathKind kind)
      : batch_(batch), options_(options), kind_(kind) {}

  [[nodiscard]] const Query<Scalar>& of_batch() const { return batch_; }
  [[nodiscard]] Query<Scalar> query(std::size_t index) const { return query_of_path(batch_, options_, index); }
  [[nodiscard]] PathRange<Scalar> range(std::size_t index) const {
    return {kind_, options_.empty() ? batch_.options : options_[index]};
  }
  [[nodiscard]] const RangeWeights<Scalar>& weights_in(std::size_t slot) const { return weights_[slot]; }
  /// Keeps the weights of path `index`, which begins to walk in a slot.
  void set_weights(std::size_t slot, std::size_t index) { weights_[slot] = RangeWeights<Scalar>(range(index)); }
  [[nodiscard]] bool admits_nothing() const { return false; }

#if HWY_TARGET != HWY_SCALAR
  struct Ends {
    Floats first, last;  ///< A lane each.
  };
  [[nodiscard]] Ends ends(std::size_t first, std::size_t count) const {
    // The ends of an empty range are exchanged, so that its path misses the grid.
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
  const Query<Scalar>& batch_;
  std::span<const QueryOptions<Scalar>> options_;
  PathKind kind_;
  std::array<RangeWeights<Scalar>, max_slots<Scalar>> weights_;
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
