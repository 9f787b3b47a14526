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

#include "filter/hit_rounding-inl.hpp"
#include "narrowphase.hpp"
#include "query/batch_queries-inl.hpp"
#include "query/hit_visitors-inl.hpp"
#include "surehit/path_span.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Rounds the hits of a batch. It rounds as many at a time as a vector has doubles. The narrowphase rounds those that
/// doubles cannot decide, one by one.
template <typename Queries>
class BatchRounding {
 public:
  BatchRounding(const Queries& queries, const PathSpan<float>& paths, std::span<Hit<float>> hits)
      : queries_(queries), query_(queries.of_batch()), paths_(paths), hits_(hits) {}

  /// Takes the hit that the visitor of a path has kept. It is called when the path ends. A hit of the kernel is rounded
  /// later, but at the latest by `flush`.
  HWY_INLINE void add(std::size_t index, FirstHit<float>& first) {
    if (!first.is_found()) return;
    if (first.is_decided()) {
      const Path<float> path = paths_[index];
      const auto& query = queries_.query(index);
      const auto& range = queries_.range(index);
      hits_[index] = first.decide_hit(Narrowphase<float>(path, query.options, range, query.statistics));
      return;
    }
    index_[count_] = index;
    entry_[count_] = first.entry();
    t_size_[count_] = first.t_size();
    edge_size_[count_] = first.edge_size();
    static_assert(sizeof(Triangle<float>) == 9 * sizeof(float));
    // Each copy has four numbers: three coordinates, and the number after them. There is none after the last vector of
    // the path, and none after the last corner. So those copies begin one number earlier.
    const float* const path = is_packed_ ? paths_.packed(index) : copy_path(index);
    copy(0, path, 0);
    copy(1, path, 2);
    copy(2, &first.triangle(), 0);
    copy(3, &first.triangle(), 3);
    copy(4, &first.triangle(), 5);
    if (++count_ == hn::Lanes(DoubleTag())) flush();
  }

  /// Rounds all hits that were added and not rounded yet.
  HWY_NOINLINE void flush() {
    if (count_ == 0) return;
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
    const Vectors<DoubleTag> start = vectors(0);
    const Vectors<DoubleTag> direction = directions_of<DoubleTag>(paths_.kind(), start, vectors(1, true));
    const auto doubles = [&](const std::array<float, max_hits>& floats) {
      return hn::PromoteTo(d, hn::Load(df, floats.data()));
    };
    const HitIntervals<DoubleTag> intervals(d, start, direction, vectors(2), vectors(3), vectors(4, true),
                                            doubles(t_size_), doubles(edge_size_));
    const RoundedHits<DoubleTag> rounded(d, intervals);
    std::array<float, max_hits> t;
    std::array<float, max_hits> u;
    std::array<float, max_hits> v;
    hn::StoreU(rounded.t, df, t.data());
    hn::StoreU(rounded.u, df, u.data());
    hn::StoreU(rounded.v, df, v.data());
    for (std::size_t i = 0; i < count_; ++i) {
      if ((rounded.rounded >> i & 1) != 0) {
        hits_[index_[i]] = {t[i], u[i], v[i], query_.grid.entries()[entry_[i]],
                            (rounded.front >> i & 1) != 0 ? Side::front : Side::back};
      } else {
        round_alone(i);
      }
    }
    count_ = 0;
  }

 private:
  using DoubleTag = hn::CappedTag<double, 8>;
  using FloatTag = hn::Rebind<float, DoubleTag>;
  /// The number of doubles in the widest vectors of today.
  static constexpr std::size_t max_hits = 8;

  /// Copies four numbers of the next hit, from number `from` on.
  HWY_INLINE void copy(std::size_t which, const void* numbers, std::size_t from) {
    auto& four = vectors_[which][count_];
    std::memcpy(four.data(), static_cast<const char*>(numbers) + from * sizeof(float), sizeof four);
  }

  /// Copies the numbers of a path that does not lie in six floats in a row.
  HWY_NOINLINE const float* copy_path(std::size_t index) {
    paths_.copy(index, path_.data());
    return path_.data();
  }

  /// Lets the narrowphase decide and round hit i.
  HWY_NOINLINE void round_alone(std::size_t i) {
    const Path<float> path = paths_[index_[i]];
    const auto& query = queries_.query(index_[i]);
    const auto& range = queries_.range(index_[i]);
    const Narrowphase<float> narrowphase(path, query.options, range, query.statistics);
    const std::uint32_t id = query_.grid.entries()[entry_[i]];
    Candidate<float> candidate{id, query_.mesh.triangle(id), {}};
    if (narrowphase.find_contact(candidate.triangle, candidate.contact)) hits_[index_[i]] = narrowphase.hit(candidate);
  }

  const Queries& queries_;                     ///< The queries of the paths.
  const Query<float>& query_;                  ///< The query of the batch.
  const PathSpan<float>& paths_;               ///< The paths of the batch.
  const bool is_packed_ = paths_.is_packed();  ///< True if paths can be read in place.
  std::span<Hit<float>> hits_;                 ///< The answers.
  std::size_t count_ = 0;                      ///< The number of hits to round.
  std::array<float, 6> path_;                  ///< The path that `copy_path` has copied.
  /// The start of each path, its end or direction, and the three corners of the triangle. Each has one number more, as
  /// `add` copies it. Lanes after the last hit have any finite numbers.
  alignas(max_hits * sizeof(float)) std::array<std::array<std::array<float, 4>, max_hits>, 5> vectors_ = {};
  alignas(max_hits * sizeof(float)) std::array<float, max_hits> t_size_ = {};     ///< The t size of each hit.
  alignas(max_hits * sizeof(float)) std::array<float, max_hits> edge_size_ = {};  ///< The edge size of each hit.
  std::array<std::size_t, max_hits> index_;                                       ///< The index of each path.
  std::array<std::size_t, max_hits> entry_;  ///< The grid's entry with the triangle's id. It is being prefetched.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
