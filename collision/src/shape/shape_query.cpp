#include "shape/shape_query.hpp"

#include "shape/shape_visitor.hpp"
#include "support/rounding_flags.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {
namespace {

/// A visitor that is made when the walk comes to its first list. Most small shapes come to none.
template <typename Shape, typename Keep>
class LateVisitor final : public SweptVisitor {
  using Scalar = ScalarOf<Shape>;
  using Visitor = ShapeVisitor<Shape, Keep>;

 public:
  LateVisitor(const ShapeQuery<Scalar>& query, const Shape& shape) : query_(query), shape_(shape) {}

  double visit_list(CellWord word) override { return made().visit_list(word); }
  void visit_all() { made().visit_all(); }
  [[nodiscard]] bool is_done() const { return visitor_ && visitor_->is_done(); }
  /// Returns the visitor, or null if there was nothing to visit.
  [[nodiscard]] Visitor* visitor() { return visitor_ ? &*visitor_ : nullptr; }

 private:
  Visitor& made() {
    if (!visitor_) visitor_.emplace(query_, shape_, enters_);
    return *visitor_;
  }

  const ShapeQuery<Scalar>& query_;
  const Shape& shape_;
  typename Visitor::Times enters_;
  std::optional<Visitor> visitor_;
};

/// Gives the visitor all triangles that the shape may touch.
template <typename Shape, typename Visitor>
void walk(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape, Visitor& visitor) {
  ++query.statistics.paths;
  if (query.grid.is_empty() || !is_valid(shape) || !(query.options.max_t >= 0)) return;
  const SweptExtents extents = swept_extents(shape);
  const SweptWalk way = {
      query.grid, extents, query.mesh.slabs(), last_t(query.options), visitor, query.statistics.cells};
  if (!way.walk()) visitor.visit_all();
}

}  // namespace

template <typename Shape>
std::optional<ShapeHit<ScalarOf<Shape>>> search_first(const ShapeQuery<ScalarOf<Shape>>& query,
                                                      const Shape& shape) noexcept {
  LateVisitor<Shape, KeepFirst<ShapeCandidate<Shape>>> late(query, shape);
  walk(query, shape, late);
  auto* const visitor = late.visitor();
  if (visitor == nullptr || !visitor->keep().first) return std::nullopt;
  return visitor->narrowphase().hit(*visitor->keep().first);
}

template <typename Shape>
bool search_any(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape) noexcept {
  LateVisitor<Shape, KeepAny<ShapeCandidate<Shape>>> late(query, shape);
  walk(query, shape, late);
  return late.is_done();
}

template <typename Shape>
void search_all(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape,
                std::vector<ShapeHit<ScalarOf<Shape>>>& hits) {
  LateVisitor<Shape, KeepAll<ShapeCandidate<Shape>>> late(query, shape);
  walk(query, shape, late);
  auto* const visitor = late.visitor();
  if (visitor == nullptr) return;
  visitor->narrowphase().sort(visitor->keep().all);
  for (const ShapeCandidate<Shape>& candidate : visitor->keep().all) {
    const ShapeHit<ScalarOf<Shape>> hit = visitor->narrowphase().hit(candidate);
    if (query.accepts(hit)) hits.push_back(hit);
  }
}

#define SUREHIT_INSTANTIATE(Shape)                                                                   \
  template std::optional<ShapeHit<ScalarOf<Shape>>> search_first(const ShapeQuery<ScalarOf<Shape>>&, \
                                                                 const Shape&) noexcept;             \
  template bool search_any(const ShapeQuery<ScalarOf<Shape>>&, const Shape&) noexcept;               \
  template void search_all(const ShapeQuery<ScalarOf<Shape>>&, const Shape&, std::vector<ShapeHit<ScalarOf<Shape>>>&);
SUREHIT_INSTANTIATE(SweptBox<float>)
SUREHIT_INSTANTIATE(SweptBox<double>)
SUREHIT_INSTANTIATE(SweptSphere<float>)
SUREHIT_INSTANTIATE(SweptSphere<double>)
SUREHIT_INSTANTIATE(SweptCapsule<float>)
SUREHIT_INSTANTIATE(SweptCapsule<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
