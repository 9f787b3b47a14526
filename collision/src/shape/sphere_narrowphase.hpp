#pragma once

#include <cstdint>
#include <vector>

#include "shape/sphere_contact.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/shape_options.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// A triangle that a moving ball touches.
template <typename Scalar>
struct SphereCandidate {
  std::uint32_t id;           ///< The id of the triangle.
  Triangle<Scalar> triangle;  ///< The corners of the triangle.
  SphereContact contact;      ///< The contact.
};

/// Returns true if a ball can touch something: all numbers are finite, and the radius is not negative.
template <typename Scalar>
[[nodiscard]] bool is_valid(const SweptSphere<Scalar>& sphere);

/// Decides one moving ball against triangles. Running error bounds decide nearly all of them. Exact integers decide the
/// rest. The ball must be valid.
template <typename Scalar>
class SphereNarrowphase {
 public:
  SphereNarrowphase(const SweptSphere<Scalar>& sphere, const ShapeQueryOptions<Scalar>& options,
                    QueryStatistics& statistics);

  /// Returns true, with the contact in `found`, if the ball touches the triangle and the options admit it. A contact
  /// after `limit` may count as none. Masks, filters and the ignored triangle are for the caller.
  [[nodiscard]] bool find_contact(const Triangle<Scalar>& triangle, double limit, SphereContact& found) const;
  /// Returns true if x comes before y: by the exact t, then by the id.
  [[nodiscard]] bool comes_before(const SphereCandidate<Scalar>& x, const SphereCandidate<Scalar>& y) const;
  /// Sorts the candidates by `comes_before`, and keeps each triangle once.
  void sort(std::vector<SphereCandidate<Scalar>>& found) const;
  /// Returns the contact as it is reported.
  [[nodiscard]] ShapeHit<Scalar> hit(const SphereCandidate<Scalar>& candidate) const;

 private:
  /// Returns true if `max_t` and `culling` admit a contact.
  [[nodiscard]] bool admits(const Triangle<Scalar>& triangle, const SphereContact& contact) const;

  const SweptSphere<Scalar>& sphere_;
  const ShapeQueryOptions<Scalar>& options_;
  QueryStatistics& statistics_;
};

}  // namespace surehit::detail
