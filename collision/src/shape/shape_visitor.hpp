#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>

#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/kept_contacts.hpp"
#include "shape/recent_triangles.hpp"
#include "shape/shape_filter.hpp"
#include "shape/shape_narrowphase.hpp"
#include "shape/shape_query.hpp"
#include "shape/sphere_contact.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {

/// Gives the triangles of the lists that a walk visits to `Keep`. This keeps the hits that its query wants.
template <typename Shape, typename Keep>
class ShapeVisitor final : public SweptVisitor {
  using Scalar = ScalarOf<Shape>;

 public:
  using Times = typename ShapeFilter<Scalar>::Times;

  /// `enters` has no meaning between two calls.
  ShapeVisitor(const ShapeQuery<Scalar>& query, const Shape& shape, Times& enters)
      : query_(query),
        filter_(shape),
        enters_(enters),
        narrowphase_(shape, query.options, query.statistics),
        keep_(last_t(query.options)) {}

  double visit_list(CellWord word) override {
    ShapeList<Scalar> list = list_of(word);
    std::array<NearTriangles, 8> near;
    for (std::size_t found = near.size(); found == near.size() && !is_done();) {
      list.limit = keep_.limit;
      found = ShapeFilter<Scalar>::find_near({&list, 1}, near);
      visit_near(word, list, std::span(near).first(found));
    }
    return is_done() ? -1 : limit();
  }
  /// Returns the triangles of a list that count.
  [[nodiscard]] ShapeList<Scalar> list_of(CellWord word) const {
    const std::uint32_t count = query_.grid.entry_count(word);
    const std::size_t first = query_.grid.first_entry(word);
    const PackedIds::Range ids = query_.grid.entries().between(first, first + count);
    const std::size_t counting = keep_.count_that_counts(ids, [](std::uint32_t id) { return std::tuple(id); });
    query_.statistics.candidates += counting;
    return {&filter_, MeshBlocks<Scalar>::corners(query_.mesh.block(word.list(), first)), count, 0, counting, limit()};
  }
  /// Takes those of some triangles of a list that the shape touches.
  void visit_near(CellWord word, const ShapeList<Scalar>& list, std::span<const NearTriangles> near) {
    while (!near.empty() && !is_done()) {
      const std::size_t from = near.front().from / max_at_once * max_at_once;
      std::size_t count = 0;
      std::uint64_t found = 0;
      for (; count < near.size() && near[count].from < from + max_at_once; ++count) {
        found |= near[count].found << (near[count].from - from);
      }
      visit_at_once(word, list, near.first(count), from, found);
      near = near.subspan(count);
    }
  }
  void visit_all() {
    ++query_.statistics.unclipped;
    query_.statistics.candidates += query_.mesh.triangle_count();
    for (std::uint32_t id = 0; id < query_.mesh.triangle_count() && !is_done(); ++id)
      take(id, query_.mesh.triangle(id));
  }
  [[nodiscard]] double limit() const { return keep_.limit; }
  [[nodiscard]] bool is_done() const { return keep_.is_done; }
  [[nodiscard]] Keep& keep() { return keep_; }
  [[nodiscard]] const ShapeNarrowphase<Shape>& narrowphase() const { return narrowphase_; }

 private:
  static constexpr std::size_t max_at_once = 64;  ///< So many triangles of a list are put in order.
  /// If more triangles may be touched, it costs less to ask for their times first.
  static constexpr int max_simple = 2;

  /// Takes those of some triangles that the shape touches, where bit 0 of `found` stands for triangle `from`.
  void visit_at_once(CellWord word, const ShapeList<Scalar>& list, std::span<const NearTriangles> near,
                     std::size_t from, std::uint64_t found) {
    if constexpr (has_simple_contacts<Shape>) {
      if (std::popcount(found) <= max_simple) found = take_simple(word, list, from, found);
    }
    if (is_done()) return;
    std::uint64_t timed = 0;
    for (const NearTriangles& some : near) {
      const std::size_t shift = some.from - from;
      const NearTriangles left = {some.list, some.from, found >> shift & some.found};
      if (left.found != 0) timed |= filter_.find_times(list, left, keep_.limit, &enters_[shift]) << shift;
    }
    take_in_order(word, list, from, timed);
  }

  /// Takes the triangles of these bits, where bit 0 stands for triangle `from`. The one that may be touched first comes
  /// first. Its hit may lower the limit below all others.
  void take_in_order(CellWord word, const ShapeList<Scalar>& list, std::size_t from, std::uint64_t found) {
    const std::size_t first = query_.grid.first_entry(word) + from;
    while (found != 0 && !is_done()) {
      const std::size_t lane = first_to_enter(found, enters_);
      if (enters_[lane] > keep_.limit) return;
      found &= ~(std::uint64_t{1} << lane);
      const std::uint32_t id = query_.grid.entries()[first + lane];
      if (recent_.has(id) || keep_.passes_over(std::tuple(id))) continue;
      take(id, MeshBlocks<Scalar>::triangle(list.corners, list.count, from + lane));
    }
  }
  /// Decides about triangles whose contact is simple. Returns the others.
  std::uint64_t take_simple(CellWord word, const ShapeList<Scalar>& list, std::size_t from, std::uint64_t found) {
    const std::size_t first = query_.grid.first_entry(word) + from;
    std::uint64_t left = 0;
    for (; found != 0 && !is_done(); found &= found - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(found));
      const std::uint32_t id = query_.grid.entries()[first + lane];
      if (recent_.has(id) || keep_.passes_over(std::tuple(id)) || !query_.takes_part(id)) continue;
      ShapeCandidate<Shape> candidate{id, MeshBlocks<Scalar>::triangle(list.corners, list.count, from + lane), {}};
      const Verdict verdict = narrowphase_.find_simple_contact(candidate.triangle, keep_.limit, candidate.contact);
      if (verdict == Verdict::hit) keep_.take(query_, narrowphase_, candidate);
      if (verdict != Verdict::undecided) continue;
      recent_.forget(id);
      left |= std::uint64_t{1} << lane;
    }
    return left;
  }
  void take(std::uint32_t id, const Triangle<Scalar>& triangle) {
    if (!query_.takes_part(id)) return;
    ShapeCandidate<Shape> candidate{id, triangle, {}};
    ++query_.statistics.undecided;
    if (narrowphase_.find_contact(triangle, keep_.limit, candidate.contact))
      keep_.take(query_, narrowphase_, candidate);
  }

  const ShapeQuery<Scalar>& query_;
  ShapeFilter<Scalar> filter_;
  Times& enters_;
  ShapeNarrowphase<Shape> narrowphase_;
  RecentTriangles recent_;
  Keep keep_;
};

/// Returns a hit as it is reported.
template <typename Shape>
ShapeHit<ScalarOf<Shape>> hit_of(const ShapeQuery<ScalarOf<Shape>>&, const ShapeNarrowphase<Shape>& narrowphase,
                                 const ShapeCandidate<Shape>& candidate) {
  return narrowphase.hit(candidate);
}

}  // namespace surehit::detail
