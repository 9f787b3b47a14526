// The hits of many paths, rounded side by side. Highway compiles this for each instruction set.

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

/// Turns what `FirstHit` kept of the batch's paths into hits, as many at a time as a vector has doubles. What they
/// cannot tell goes through the narrowphase one by one.
template <typename Queries>
class BatchRounding {
 public:
  BatchRounding(const Queries& queries, const PathSpan<float>& paths, std::span<Hit<float>> hits)
      : queries_(queries), query_(queries.of_batch()), paths_(paths), hits_(hits) {}

  /// A path that has ended, if it has hit anything.
  HWY_INLINE void add(std::size_t index, FirstHit<float>& first) {
    if (!first.is_found()) return;
    if (first.is_weighed()) {
      const Path<float> path = paths_[index];
      const auto& query = queries_.query(index);
      const auto& range = queries_.range(index);
      hits_[index] = first.hit(query, Narrowphase<float>(path, query.options, range, query.statistics));
      return;
    }
    index_[count_] = index;
    entry_[count_] = first.entry();
    t_size_[count_] = first.t_size();
    edge_size_[count_] = first.edge_size();
    static_assert(sizeof(Triangle<float>) == 9 * sizeof(float));
    // Four numbers at once, one of which is another vector's: the last one, or the first where there is none behind.
    if (is_packed_) {
      copy(0, paths_.packed(index), 0);
      copy(1, paths_.packed(index), 2);
    } else {
      std::array<float, 6> numbers;
      paths_.copy(index, numbers.data());
      copy(0, numbers.data(), 0);
      copy(1, numbers.data(), 2);
    }
    copy(2, &first.triangle(), 0);
    copy(3, &first.triangle(), 3);
    copy(4, &first.triangle(), 5);
    if (++count_ == hn::Lanes(DoubleTag())) flush();
  }

  HWY_NOINLINE void flush() {
    if (count_ == 0) return;
    const DoubleTag d;
    const FloatTag df;
    const auto vectors = [&](std::size_t which, bool is_behind_another = false) -> Vectors<DoubleTag> {
      hn::Vec<FloatTag> first, second, third, fourth;
      hn::LoadInterleaved4(df, vectors_[which][0].data(), first, second, third, fourth);
      const auto of = [&](const auto& x, const auto& y, const auto& z) -> Vectors<DoubleTag> {
        return {hn::PromoteTo(d, x), hn::PromoteTo(d, y), hn::PromoteTo(d, z)};
      };
      return is_behind_another ? of(second, third, fourth) : of(first, second, third);
    };
    const Vectors<DoubleTag> start = vectors(0);
    Vectors<DoubleTag> direction = vectors(1, true);
    if (paths_.kind() == PathKind::segment) {
      direction = {hn::Sub(direction.x, start.x), hn::Sub(direction.y, start.y), hn::Sub(direction.z, start.z)};
    }
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
  /// As many as the widest instruction set of today has doubles.
  static constexpr std::size_t max_hits = 8;

  HWY_INLINE void copy(std::size_t which, const void* numbers, std::size_t from) {
    auto& four = vectors_[which][count_];
    std::memcpy(four.data(), static_cast<const char*>(numbers) + from * sizeof(float), sizeof four);
  }

  HWY_NOINLINE void round_alone(std::size_t i) {
    const Path<float> path = paths_[index_[i]];
    const auto& query = queries_.query(index_[i]);
    const auto& range = queries_.range(index_[i]);
    const Narrowphase<float> narrowphase(path, query.options, range, query.statistics);
    const std::uint32_t id = query_.grid.entries()[entry_[i]];
    Candidate<float> candidate{id, query_.mesh.triangle(id), {}};
    if (narrowphase.find_contact(candidate.triangle, candidate.contact)) hits_[index_[i]] = narrowphase.hit(candidate);
  }

  const Queries& queries_;
  const Query<float>& query_;
  const PathSpan<float>& paths_;
  const bool is_packed_ = paths_.is_packed();
  std::span<Hit<float>> hits_;
  std::size_t count_ = 0;
  /// The path's start and its end or direction, and the triangle's corners, each with one number more. Beyond the last
  /// hit anything finite.
  alignas(max_hits * sizeof(float)) std::array<std::array<std::array<float, 4>, max_hits>, 5> vectors_ = {};
  alignas(max_hits * sizeof(float)) std::array<float, max_hits> t_size_ = {};  ///< what `HitIntervals` goes by besides,
  alignas(max_hits * sizeof(float)) std::array<float, max_hits> edge_size_ = {};  //
  std::array<std::size_t, max_hits> index_;
  std::array<std::size_t, max_hits> entry_;  ///< the one where the id stands, which is on its way into the cache
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
