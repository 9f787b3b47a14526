#include "double_kernel_on_targets.hpp"

// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collision/filter/double_kernel_on_targets.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "filter/double_hit_rounding-inl.hpp"
#include "filter/double_kernel-inl.hpp"
#include "filter/hit_rounding-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

using DoubleTag = hn::CappedTag<double, 8>;
using DoubleVector = hn::Vec<DoubleTag>;
using LaneNumbers = std::array<double, 8>;

std::size_t lanes_of_double() { return hn::Lanes(DoubleTag()); }

/// Calls `at(first, count)` for every vector's worth.
template <typename At>
void for_each_vector(std::size_t size, const At& at) {
  for (std::size_t first = 0; first < size; first += hn::Lanes(DoubleTag())) {
    at(first, std::min(hn::Lanes(DoubleTag()), size - first));
  }
}

template <typename Number>
DoubleVector gather(std::size_t count, const Number& number) {
  alignas(64) LaneNumbers numbers = {};
  for (std::size_t i = 0; i < count; ++i) numbers[i] = number(i);
  return hn::Load(DoubleTag(), numbers.data());
}

LaneNumbers numbers_of(DoubleVector vector) {
  alignas(64) LaneNumbers numbers = {};
  hn::Store(vector, DoubleTag(), numbers.data());
  return numbers;
}

/// The vector that begins at coordinate `k` of pairs from `first` on.
Vectors<DoubleTag> gather_vectors(std::span<const test::PairCoordinates> pairs, std::size_t first, std::size_t count,
                                  std::size_t k) {
  const auto load = [&](std::size_t j) { return gather(count, [&](std::size_t i) { return pairs[first + i][j]; }); };
  return {load(k), load(k + 1), load(k + 2)};
}

void determinants_of(std::span<const test::PairCoordinates> pairs, std::span<test::LaneDeterminants> results) {
  for_each_vector(pairs.size(), [&](std::size_t first, std::size_t count) {
    const auto vectors = [&](std::size_t k) { return gather_vectors(pairs, first, count, k); };
    const DoubleDeterminants<DoubleTag> of(DoubleTag(), vectors(0), vectors(3), vectors(6), vectors(9), vectors(12));
    const auto put = [&](DoubleVector value, DoubleVector sizes, Bounded test::LaneDeterminants::*member) {
      const LaneNumbers values = numbers_of(value);
      const LaneNumbers radii = numbers_of(of.radius(sizes));
      for (std::size_t i = 0; i < count; ++i) results[first + i].*member = {values[i], radii[i]};
    };
    put(of.det, of.det_size, &test::LaneDeterminants::det);
    put(of.height, of.height_size, &test::LaneDeterminants::height);
    put(of.u, of.u_size, &test::LaneDeterminants::u);
    put(of.v, of.v_size, &test::LaneDeterminants::v);
  });
}

void quotients_of(std::span<const Bounded> numerators, std::span<const Bounded> denominators,
                  std::span<std::array<double, 2>> results) {
  for_each_vector(numerators.size(), [&](std::size_t first, std::size_t count) {
    const auto load = [&](std::span<const Bounded> of, double Bounded::*part) {
      return gather(count, [&](std::size_t i) { return of[first + i].*part; });
    };
    const auto by = Quotients<DoubleTag>::by(DoubleTag(), load(denominators, &Bounded::value),
                                             load(denominators, &Bounded::radius));
    const auto interval = by.of(load(numerators, &Bounded::value), load(numerators, &Bounded::radius));
    const LaneNumbers lower = numbers_of(interval.lower);
    const LaneNumbers upper = numbers_of(interval.upper);
    for (std::size_t i = 0; i < count; ++i) results[first + i] = {lower[i], upper[i]};
  });
}

void intervals_of(std::span<const test::PairCoordinates> pairs, std::span<const test::HitSizes> sizes,
                  std::span<test::LaneIntervals> results) {
  for_each_vector(pairs.size(), [&](std::size_t first, std::size_t count) {
    const auto vectors = [&](std::size_t k) { return gather_vectors(pairs, first, count, k); };
    const auto size = [&](float test::HitSizes::*part) {
      return gather(count, [&](std::size_t i) { return double{sizes[first + i].*part}; });
    };
    using Intervals = HitIntervals<DoubleTag>;
    const Intervals of(DoubleTag(), vectors(0), vectors(3), vectors(6), vectors(9), vectors(12),
                       size(&test::HitSizes::t), size(&test::HitSizes::edge));
    const auto put = [&](const Intervals::Interval& interval, std::array<double, 2> test::LaneIntervals::*member) {
      const LaneNumbers lower = numbers_of(interval.lower);
      const LaneNumbers upper = numbers_of(interval.upper);
      for (std::size_t i = 0; i < count; ++i) results[first + i].*member = {lower[i], upper[i]};
    };
    put(of.t, &test::LaneIntervals::t);
    put(of.u, &test::LaneIntervals::u);
    put(of.v, &test::LaneIntervals::v);
  });
}

void intervals_from_hits_of(std::span<const test::PairCoordinates> pairs, std::span<const std::array<double, 3>> ends,
                            std::span<const test::HitSizes> sizes, std::span<test::LaneIntervals> results) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::array<double, 2> nothing = {-infinity, infinity};
  std::fill(results.begin(), results.end(), test::LaneIntervals{nothing, nothing, nothing});
#if HWY_NATIVE_FMA != 0
  for_each_vector(pairs.size(), [&](std::size_t first, std::size_t count) {
    const auto vectors = [&](std::size_t k) { return gather_vectors(pairs, first, count, k); };
    const auto size = [&](float test::HitSizes::*part) {
      return gather(count, [&](std::size_t i) { return double{sizes[first + i].*part}; });
    };
    const auto end_on = [&](std::size_t axis) {
      return gather(count, [&](std::size_t i) { return ends[first + i][axis]; });
    };
    using Intervals = HitIntervals<DoubleTag>;
    const Vectors<DoubleTag> end = {end_on(0), end_on(1), end_on(2)};
    const auto edge = size(&test::HitSizes::edge);
    const Intervals from_start(DoubleTag(), vectors(0), vectors(3), vectors(6), vectors(9), vectors(12),
                               size(&test::HitSizes::t), edge);
    const Intervals of = intervals_from_hits<DoubleTag>(DoubleTag(), PathKind::segment, vectors(0), end, vectors(6),
                                                        vectors(9), vectors(12), edge, from_start);
    const LaneNumbers t_lower = numbers_of(of.t.lower);
    const LaneNumbers t_upper = numbers_of(of.t.upper);
    const LaneNumbers u_lower = numbers_of(of.u.lower);
    const LaneNumbers u_upper = numbers_of(of.u.upper);
    const LaneNumbers v_lower = numbers_of(of.v.lower);
    const LaneNumbers v_upper = numbers_of(of.v.upper);
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(t_lower[i]) || !std::isfinite(t_upper[i])) continue;
      results[first + i] = {{t_lower[i], t_upper[i]}, {u_lower[i], u_upper[i]}, {v_lower[i], v_upper[i]}};
    }
  });
#else
  (void)pairs, (void)ends, (void)sizes;
#endif
}

void hits_of(std::span<const Path<double>> paths, std::span<const Triangle<double>> triangles,
             std::span<test::LaneHit> results) {
  for_each_vector(paths.size(), [&](std::size_t first, std::size_t count) {
    const auto vectors = [&](const auto& point_of) -> Vectors<DoubleTag> {
      const auto axis = [&](Eigen::Index k) {
        return gather(count, [&](std::size_t i) { return point_of(first + i)[k]; });
      };
      return {axis(0), axis(1), axis(2)};
    };
    const DoubleHitIntervals<DoubleTag> intervals(
        DoubleTag(), paths[first].kind, vectors([&](std::size_t i) { return paths[i].start; }),
        vectors([&](std::size_t i) { return paths[i].toward; }), vectors([&](std::size_t i) { return triangles[i].a; }),
        vectors([&](std::size_t i) { return triangles[i].b; }), vectors([&](std::size_t i) { return triangles[i].c; }));
    const RoundedDoubleHits<DoubleTag> of(DoubleTag(), intervals);
    const std::uint64_t known = bits_of(DoubleTag(), intervals.known);
    const LaneNumbers t = numbers_of(of.t);
    const LaneNumbers u = numbers_of(of.u);
    const LaneNumbers v = numbers_of(of.v);
    for (std::size_t i = 0; i < count; ++i) {
      results[first + i] = {
          t[i], u[i], v[i], (of.rounded >> i & 1) != 0, (of.front >> i & 1) != 0, (known >> i & 1) != 0, {}, {}, {}};
    }
    const auto put = [&](const DoubleHitIntervals<DoubleTag>::Interval& interval,
                         test::WordInterval test::LaneHit::*member) {
      const LaneNumbers high = numbers_of(interval.high);
      const LaneNumbers low = numbers_of(interval.low);
      const LaneNumbers bound = numbers_of(interval.bound);
      for (std::size_t i = 0; i < count; ++i) results[first + i].*member = {high[i], low[i], bound[i]};
    };
    put(intervals.t, &test::LaneHit::t_interval);
    put(intervals.u, &test::LaneHit::u_interval);
    put(intervals.v, &test::LaneHit::v_interval);
  });
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(determinants_of);
HWY_EXPORT(quotients_of);
HWY_EXPORT(intervals_of);
HWY_EXPORT(intervals_from_hits_of);
HWY_EXPORT(hits_of);
HWY_EXPORT(lanes_of_double);
void chosen_determinants(std::span<const test::PairCoordinates> pairs, std::span<test::LaneDeterminants> results) {
  HWY_DYNAMIC_DISPATCH(determinants_of)(pairs, results);
}
void chosen_quotients(std::span<const Bounded> numerators, std::span<const Bounded> denominators,
                      std::span<std::array<double, 2>> results) {
  HWY_DYNAMIC_DISPATCH(quotients_of)(numerators, denominators, results);
}
void chosen_intervals(std::span<const test::PairCoordinates> pairs, std::span<const test::HitSizes> sizes,
                      std::span<test::LaneIntervals> results) {
  HWY_DYNAMIC_DISPATCH(intervals_of)(pairs, sizes, results);
}
void chosen_intervals_from_hits(std::span<const test::PairCoordinates> pairs,
                                std::span<const std::array<double, 3>> ends, std::span<const test::HitSizes> sizes,
                                std::span<test::LaneIntervals> results) {
  HWY_DYNAMIC_DISPATCH(intervals_from_hits_of)(pairs, ends, sizes, results);
}
void chosen_hits(std::span<const Path<double>> paths, std::span<const Triangle<double>> triangles,
                 std::span<test::LaneHit> results) {
  HWY_DYNAMIC_DISPATCH(hits_of)(paths, triangles, results);
}
std::size_t chosen_lanes_of_double() { return HWY_DYNAMIC_DISPATCH(lanes_of_double)(); }

}  // namespace surehit::detail

namespace surehit::test {

void double_determinants(std::span<const PairCoordinates> pairs, std::span<LaneDeterminants> results) {
  detail::chosen_determinants(pairs, results);
}
void quotients(std::span<const detail::Bounded> numerators, std::span<const detail::Bounded> denominators,
               std::span<std::array<double, 2>> results) {
  detail::chosen_quotients(numerators, denominators, results);
}
void hit_intervals(std::span<const PairCoordinates> pairs, std::span<const HitSizes> sizes,
                   std::span<LaneIntervals> results) {
  detail::chosen_intervals(pairs, sizes, results);
}
void hit_intervals_from_hits(std::span<const PairCoordinates> pairs, std::span<const std::array<double, 3>> ends,
                             std::span<const HitSizes> sizes, std::span<LaneIntervals> results) {
  detail::chosen_intervals_from_hits(pairs, ends, sizes, results);
}
void round_hits(std::span<const Path<double>> paths, std::span<const Triangle<double>> triangles,
                std::span<LaneHit> results) {
  detail::chosen_hits(paths, triangles, results);
}
std::size_t double_lanes() { return detail::chosen_lanes_of_double(); }

}  // namespace surehit::test
#endif
