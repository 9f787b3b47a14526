#pragma once

#include <cstdint>
#include <vector>

#include "shape/shape_contact.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/shape_options.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// A triangle that a moving shape touches.
template <typename Shape>
struct ShapeCandidate {
  std::uint32_t id;                    ///< The id of the triangle.
  Triangle<ScalarOf<Shape>> triangle;  ///< The corners of the triangle.
  ContactOf<Shape> contact;            ///< The contact.
};

/// Decides one moving shape against triangles. Running error bounds decide nearly all of them. Exact integers decide
/// the rest. The shape must be valid.
template <typename Shape>
class ShapeNarrowphase {
  using Scalar = ScalarOf<Shape>;

 public:
  ShapeNarrowphase(const Shape& shape, const ShapeQueryOptions<Scalar>& options, QueryStatistics& statistics);

  /// Returns true, with the contact in `found`, if the shape touches the triangle and the options admit it. A contact
  /// after `limit` may count as none. Masks, filters and the ignored triangle are for the caller.
  [[nodiscard]] bool find_contact(const Triangle<Scalar>& triangle, double limit, ContactOf<Shape>& found) const;
  /// Returns true if x comes before y: by the exact t, then by the id.
  [[nodiscard]] bool comes_before(const ShapeCandidate<Shape>& x, const ShapeCandidate<Shape>& y) const;
  /// Sorts the candidates by `comes_before`, and keeps each triangle once.
  void sort(std::vector<ShapeCandidate<Shape>>& found) const;
  /// Returns the contact as it is reported.
  [[nodiscard]] ShapeHit<Scalar> hit(const ShapeCandidate<Shape>& candidate) const;

 private:
  /// Returns true if `max_t` and `culling` admit a contact.
  [[nodiscard]] bool admits(const Triangle<Scalar>& triangle, const ContactOf<Shape>& contact) const;

  const Shape& shape_;
  const ShapeQueryOptions<Scalar>& options_;
  QueryStatistics& statistics_;
};

}  // namespace surehit::detail
