#include "shape/shape_query.hpp"

#include "shape/shape_visitor.hpp"
#include "support/rounding_flags.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {
namespace {

/// Gives the visitor all triangles that the shape may touch.
template <typename Shape, typename Visitor>
void walk(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape, Visitor& visitor) {
  ++query.statistics.paths;
  if (query.grid.is_empty() || !is_valid(shape) || !(query.options.max_t >= 0)) return;
  if (!SweptWalk(query.grid, swept_extents(shape), visitor, query.mesh.slabs()).walk()) visitor.visit_all();
}

}  // namespace

template <typename Shape>
std::optional<ShapeHit<ScalarOf<Shape>>> search_first(const ShapeQuery<ScalarOf<Shape>>& query,
                                                      const Shape& shape) noexcept {
  typename ShapeFilter<ScalarOf<Shape>>::Times enters;
  ShapeVisitor<Shape, KeepFirst<Shape>> visitor(query, shape, enters);
  walk(query, shape, visitor);
  const auto& first = visitor.keep().first;
  if (!first) return std::nullopt;
  return visitor.narrowphase().hit(*first);
}

template <typename Shape>
bool search_any(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape) noexcept {
  typename ShapeFilter<ScalarOf<Shape>>::Times enters;
  ShapeVisitor<Shape, KeepAny<Shape>> visitor(query, shape, enters);
  walk(query, shape, visitor);
  return visitor.is_done();
}

template <typename Shape>
void search_all(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape,
                std::vector<ShapeHit<ScalarOf<Shape>>>& hits) {
  typename ShapeFilter<ScalarOf<Shape>>::Times enters;
  ShapeVisitor<Shape, KeepAll<Shape>> visitor(query, shape, enters);
  walk(query, shape, visitor);
  visitor.narrowphase().sort(visitor.keep().all);
  for (const ShapeCandidate<Shape>& candidate : visitor.keep().all) {
    const ShapeHit<ScalarOf<Shape>> hit = visitor.narrowphase().hit(candidate);
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
