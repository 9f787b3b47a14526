#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "shape/shape_contact.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/shape_options.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// A triangle that a moving shape touches.
template <typename AnyShape>
struct ShapeCandidate {
  using Shape = AnyShape;
  using AnyTriangle = Triangle<ScalarOf<Shape>>;
  using Options = ShapeQueryOptions<ScalarOf<Shape>>;

  std::uint32_t id;                    ///< The id of the triangle.
  Triangle<ScalarOf<Shape>> triangle;  ///< The corners of the triangle.
  ContactOf<Shape> contact;            ///< The contact.

  /// Returns the triangle for those who decide about it.
  [[nodiscard]] const AnyTriangle& whole_triangle() const { return triangle; }
  /// Returns what decides ties.
  [[nodiscard]] auto ids() const { return std::tie(id); }
  /// Returns true if both contacts are known to have the same exact t.
  [[nodiscard]] bool is_timed_like(const ShapeCandidate& other) const {
    return are_timed_alike(triangle, contact, other.triangle, other.contact);
  }
};

/// Decides one moving shape against triangles. Running error bounds decide nearly all of them. Exact integers decide
/// the rest. The shape must be valid. `Candidate` is `ShapeCandidate`, or `PlacedShapeCandidate` in a scene.
template <typename Shape, typename Candidate = ShapeCandidate<Shape>>
class ShapeNarrowphase {
  using Scalar = ScalarOf<Shape>;
  using AnyTriangle = typename Candidate::AnyTriangle;
  using Options = typename Candidate::Options;

 public:
  ShapeNarrowphase(const Shape& shape, const Options& options, QueryStatistics& statistics);

  /// Returns true, with the contact in `found`, if the shape touches the triangle and the options admit it. A contact
  /// after `limit` may count as none. Masks, filters and what is ignored are for the caller.
  [[nodiscard]] bool find_contact(const AnyTriangle& triangle, double limit, ContactOf<Shape>& found) const;
  /// Decides whether the shape has a simple contact with the triangle before `limit` that the options admit, if this is
  /// certain.
  [[nodiscard]] Verdict find_simple_contact(const AnyTriangle& triangle, double limit, ContactOf<Shape>& found) const;
  /// Returns true if x comes before y: by the exact t, then by the ids.
  [[nodiscard]] bool comes_before(const Candidate& x, const Candidate& y) const;
  /// Sorts the candidates by `comes_before`, and keeps each triangle once.
  void sort(std::vector<Candidate>& found) const;
  /// Returns the contact as it is reported.
  [[nodiscard]] ShapeHit<Scalar> hit(const Candidate& candidate) const;

 private:
  /// Returns true if `max_t` and `culling` admit a contact.
  [[nodiscard]] bool admits(const AnyTriangle& triangle, const ContactOf<Shape>& contact) const;

  const Shape& shape_;
  const Options& options_;
  QueryStatistics& statistics_;
};

}  // namespace surehit::detail
