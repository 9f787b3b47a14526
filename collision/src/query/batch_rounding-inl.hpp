// Rounds the hits of many paths side by side. Highway compiles this file for each instruction set.

#if defined(SUREHIT_BATCH_ROUNDING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_BATCH_ROUNDING_INL
#undef SUREHIT_BATCH_ROUNDING_INL
#else
#define SUREHIT_BATCH_ROUNDING_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "filter/double_hit_rounding-inl.hpp"
#include "filter/hit_rounding-inl.hpp"
#include "narrowphase.hpp"
#include "query/batch_queries-inl.hpp"
#include "query/hit_visitors-inl.hpp"
#include "surehit/path_span.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Hits that wait to be rounded, as many as a vector has doubles. Lanes without a hit have any finite numbers.
template <typename Scalar>
class WaitingHits;

/// The rounded hits of one vector.
template <typename Scalar>
struct RoundedBatch {
  static constexpr std::size_t max_hits = 8;  ///< The number of doubles in the widest vectors of today.
  std::array<Scalar, max_hits> t, u, v;       ///< The rounded numbers.
  std::uint64_t rounded;                      ///< The mask of the hits in which they are right.
  std::uint64_t front;                        ///< The mask of the hits whose path arrives at the front.

  /// Stores `RoundedHits` or `RoundedDoubleHits`, whose numbers have the tag `d`.
  template <class D, class Rounded>
  HWY_INLINE RoundedBatch(D d, const Rounded& in_lanes) : rounded(in_lanes.rounded), front(in_lanes.front) {
    hn::StoreU(in_lanes.t, d, t.data());
    hn::StoreU(in_lanes.u, d, u.data());
    hn::StoreU(in_lanes.v, d, v.data());
  }
};

template <>
class WaitingHits<float> {
 public:
  using DoubleTag = hn::CappedTag<double, 8>;

  /// Sets hit i. The path is six floats in a row.
  HWY_INLINE void set(std::size_t i, const float* path, const FirstHit<float>& first) {
    t_size_[i] = first.t_size();
    edge_size_[i] = first.edge_size();
    static_assert(sizeof(Triangle<float>) == 9 * sizeof(float));
    // Each copy has four numbers: three coordinates, and the number after them. There is none after the last vector of
    // the path, and none after the last corner. So those copies begin one number earlier.
    copy(i, 0, path, 0);
    copy(i, 1, path, 2);
    copy(i, 2, &first.triangle(), 0);
    copy(i, 3, &first.triangle(), 3);
    copy(i, 4, &first.triangle(), 5);
  }

  /// Rounds all hits, which are the first `count` ones.
  HWY_INLINE RoundedBatch<float> round(PathKind kind, std::size_t count) const {
    const DoubleTag d;
    const FloatTag df;
    const auto vectors = [&](std::size_t which, bool has_one_before = false) -> Vectors<DoubleTag> {
      hn::Vec<FloatTag> first, second, third, fourth;
      hn::LoadInterleaved4(df, vectors_[which][0].data(), first, second, third, fourth);
      const auto of = [&](const auto& x, const auto& y, const auto& z) -> Vectors<DoubleTag> {
        return {hn::PromoteTo(d, x), hn::PromoteTo(d, y), hn::PromoteTo(d, z)};
      };
      return has_one_before ? of(second, third, fourth) : of(first, second, third);
    };
    const auto doubles = [&](const std::array<float, max_hits>& floats) {
      return hn::PromoteTo(d, hn::Load(df, floats.data()));
    };
    return {df, rounded_hits<DoubleTag>(d, kind, vectors(0), vectors(1, true), vectors(2), vectors(3), vectors(4, true),
                                        doubles(t_size_), doubles(edge_size_), (std::uint64_t{1} << count) - 1)};
  }

 private:
  using FloatTag = hn::Rebind<float, DoubleTag>;
  static constexpr std::size_t max_hits = RoundedBatch<float>::max_hits;

  /// Copies four numbers of hit i, from number `from` on.
  HWY_INLINE void copy(std::size_t i, std::size_t which, const void* numbers, std::size_t from) {
    auto& four = vectors_[which][i];
    std::memcpy(four.data(), static_cast<const char*>(numbers) + from * sizeof(float), sizeof four);
  }

  /// The start of each path, its end or direction, and the three corners of the triangle. Each has one number more, as
  /// `set` copies it.
  alignas(max_hits * sizeof(float)) std::array<std::array<std::array<float, 4>, max_hits>, 5> vectors_ = {};
  alignas(max_hits * sizeof(float)) std::array<float, max_hits> t_size_ = {};     ///< The t size of each hit.
  alignas(max_hits * sizeof(float)) std::array<float, max_hits> edge_size_ = {};  ///< The edge size of each hit.
};

template <>
class WaitingHits<double> {
 public:
  using DoubleTag = hn::CappedTag<double, 8>;

  /// Sets hit i. The path is six doubles in a row.
  HWY_INLINE void set(std::size_t i, const double* path, const FirstHit<double>& first) {
    for (std::size_t k = 0; k < 6; ++k) numbers_[k][i] = path[k];
    const Triangle<double>& triangle = first.triangle();
    std::size_t k = 6;
    for (const auto* const corner : {&triangle.a, &triangle.b, &triangle.c}) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) numbers_[k++][i] = (*corner)[axis];
    }
  }

  /// Rounds all hits.
  HWY_INLINE RoundedBatch<double> round(PathKind kind, std::size_t /*count*/) const {
    const DoubleTag d;
    const auto vectors = [&](std::size_t k) -> Vectors<DoubleTag> {
      const auto load = [&](std::size_t which) { return hn::Load(d, numbers_[which].data()); };
      return {load(k), load(k + 1), load(k + 2)};
    };
    const DoubleHitIntervals<DoubleTag> intervals(d, kind, vectors(0), vectors(3), vectors(6), vectors(9), vectors(12));
    return {d, RoundedDoubleHits<DoubleTag>(d, intervals)};
  }

 private:
  /// The start of each path, its end or direction, and the three corners of the triangle, coordinate by coordinate.
  alignas(64) std::array<std::array<double, RoundedBatch<double>::max_hits>, 15> numbers_ = {};
};

/// Rounds the hits of a batch. It rounds as many at a time as a vector has doubles. The narrowphase rounds those that
/// this cannot decide, one by one.
template <typename Scalar, typename Queries>
class BatchRounding {
 public:
  BatchRounding(const Queries& queries, const PathSpan<Scalar>& paths, std::span<Hit<Scalar>> hits)
      : queries_(queries), query_(queries.of_batch()), paths_(paths), hits_(hits) {}

  /// Takes the hit that the visitor of a path has kept. It is called when the path ends. A hit of the kernel is rounded
  /// later, but at the latest by `flush`.
  HWY_INLINE void add(std::size_t index, FirstHit<Scalar>& first) {
    if (!first.is_found()) return;
    if (first.is_decided()) {
      const Path<Scalar> path = paths_[index];
      const auto& query = queries_.query(index);
      const auto& range = queries_.range(index);
      hits_[index] = first.decide_hit(Narrowphase<Scalar>(path, query.options, range, query.statistics));
      return;
    }
    index_[count_] = index;
    entry_[count_] = first.entry();
    waiting_.set(count_, is_packed_ ? paths_.packed(index) : copy_path(index), first);
    if (++count_ == hn::Lanes(typename WaitingHits<Scalar>::DoubleTag())) flush();
  }

  /// Rounds all hits that were added and not rounded yet.
  HWY_NOINLINE void flush() {
    if (count_ == 0) return;
    const RoundedBatch<Scalar> batch = waiting_.round(paths_.kind(), count_);
    for (std::size_t i = 0; i < count_; ++i) {
      if ((batch.rounded >> i & 1) != 0) {
        hits_[index_[i]] = {batch.t[i], batch.u[i], batch.v[i], query_.grid.entries()[entry_[i]],
                            (batch.front >> i & 1) != 0 ? Side::front : Side::back};
      } else {
        round_alone(i);
      }
    }
    count_ = 0;
  }

 private:
  static constexpr std::size_t max_hits = RoundedBatch<Scalar>::max_hits;

  /// Copies the numbers of a path that does not lie in six numbers in a row.
  HWY_NOINLINE const Scalar* copy_path(std::size_t index) {
    paths_.copy(index, path_.data());
    return path_.data();
  }

  /// Lets the narrowphase decide and round hit i.
  HWY_NOINLINE void round_alone(std::size_t i) {
    const Path<Scalar> path = paths_[index_[i]];
    const auto& query = queries_.query(index_[i]);
    const auto& range = queries_.range(index_[i]);
    const Narrowphase<Scalar> narrowphase(path, query.options, range, query.statistics);
    const std::uint32_t id = query_.grid.entries()[entry_[i]];
    Candidate<Scalar> candidate{id, query_.mesh.triangle(id), {}};
    if (narrowphase.find_contact(candidate.triangle, candidate.contact)) hits_[index_[i]] = narrowphase.hit(candidate);
  }

  const Queries& queries_;                     ///< The queries of the paths.
  const Query<Scalar>& query_;                 ///< The query of the batch.
  const PathSpan<Scalar>& paths_;              ///< The paths of the batch.
  const bool is_packed_ = paths_.is_packed();  ///< True if paths can be read in place.
  std::span<Hit<Scalar>> hits_;                ///< The answers.
  std::size_t count_ = 0;                      ///< The number of hits to round.
  std::array<Scalar, 6> path_;                 ///< The path that `copy_path` has copied.
  WaitingHits<Scalar> waiting_;                ///< The hits to round.
  std::array<std::size_t, max_hits> index_;    ///< The index of each path.
  std::array<std::size_t, max_hits> entry_;    ///< The grid's entry with the triangle's id. It is being prefetched.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
