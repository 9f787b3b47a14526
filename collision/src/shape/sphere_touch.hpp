#pragma once

#include <cstddef>
#include <optional>

#include "shape/approach.hpp"
#include "shape/outline.hpp"
#include "shape/sphere_contact.hpp"
#include "shape/sphere_terms.hpp"

namespace surehit::detail {

/// Decides whether a moving ball touches a triangle, and where first. Follows SHAPES.md, whose lemmas it cites. The
/// numbers are either exact integers, or doubles with bounds. With the latter, an answer counts only if all signs were
/// certain.
///
/// A ball may roll over a triangle at a distance of exactly the radius. It then comes to several edges and corners, one
/// after the other, that fit equally well. `comes_before(x, y)` says whether it comes to part x before part y.
template <typename Terms>
class SphereTouch {
 public:
  SphereTouch(const Terms& terms, const Outline& outline, Signs& signs)
      : terms_(terms), outline_(outline), signs_(signs), approach_(terms.step, terms.radius) {}

  /// Returns the part that is touched first, or nothing if the ball touches nothing. The bounds of t are not set.
  template <typename ComesBefore>
  [[nodiscard]] std::optional<SphereContact> find(const ComesBefore& comes_before) {
    // A ball that comes to the plane from outside of its reach does not touch the triangle at the start.
    if (outline_.has_face) {
      if (const std::optional<Feature> feature = enters_face()) return SphereContact{0, 0, *feature, Feature::face};
    }
    const Feature nearest = nearest_feature(terms_.from_corner);
    if (reaches(nearest, terms_.from_corner)) return SphereContact{0, 0, nearest, nearest, true};
    std::optional<Feature> first;
    const auto take = [&](Feature feature) {
      if (!first || comes_before(feature, *first)) first = feature;
    };
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (outline_.corners[corner] && enters_corner(corner)) take(corner_feature(corner));
    }
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (outline_.edges[edge] && enters_edge(edge)) take(edge_feature(edge));
    }
    if (first) return SphereContact{0, 0, *first, *first};
    return std::nullopt;
  }

 private:
  using Points = decltype(Terms::from_corner);

  static std::size_t next(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }
  static std::size_t before(std::size_t corner) { return corner == 0 ? 2 : corner - 1; }

  [[nodiscard]] auto normal() const { return normal_of(terms_); }
  [[nodiscard]] auto radius_squared() const { return terms_.radius * terms_.radius; }

  /// Returns the sign of w·e: whether a point is beyond the start of an edge. w is the point less any corner.
  template <typename W, typename E>
  [[nodiscard]] int along(const W& w, const E& e) {
    return signs_.of(dot(w, e));
  }
  /// Returns true if no edge that begins or ends at a corner leads nearer to a point (S1).
  [[nodiscard]] bool is_nearest(std::size_t corner, const Points& point) {
    const std::size_t incoming = before(corner);
    return (!outline_.edges[corner] || along(point[corner], terms_.edge[corner]) <= 0) &&
           (!outline_.edges[incoming] || along(point[corner], terms_.edge[incoming]) >= 0);
  }

  /// Returns the part of the triangle that is nearest to a point (S1).
  [[nodiscard]] Feature nearest_feature(const Points& point) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (outline_.corners[corner] && is_nearest(corner, point)) return corner_feature(corner);
    }
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (!outline_.edges[edge]) continue;
      const bool is_beside =
          along(point[edge], terms_.edge[edge]) > 0 && along(point[next(edge)], terms_.edge[edge]) < 0;
      if (!is_beside) continue;
      if (!outline_.has_face) return edge_feature(edge);
      const auto outward = cross(terms_.edge[edge], normal());
      if (signs_.of(dot(outward, point[edge])) >= 0) return edge_feature(edge);
    }
    return Feature::face;
  }

  /// Returns true if a point is at most the radius away from its nearest part (S2).
  [[nodiscard]] bool reaches(Feature nearest, const Points& point) {
    if (is_corner(nearest)) {
      const auto& w = point[index_of(nearest)];
      return signs_.of(dot(w, w) - radius_squared()) <= 0;
    }
    if (is_edge(nearest)) {
      const auto& e = terms_.edge[index_of(nearest)];
      const auto moment = cross(point[index_of(nearest)], e);
      return signs_.of(dot(moment, moment) - radius_squared() * dot(e, e)) <= 0;
    }
    const auto n = normal();
    const auto height = dot(n, point[0]);
    return signs_.of(height * height - radius_squared() * dot(n, n)) <= 0;
  }

  /// Returns the part that the ball touches when it comes to the plane, or nothing if it does not touch the triangle
  /// then (S4).
  [[nodiscard]] std::optional<Feature> enters_face() {
    const auto n = normal();
    const auto time = approach_.to_plane(terms_.from_corner[0], terms_.to_end[0], n, signs_);
    if (!time) return std::nullopt;
    int touched_edges = 0;
    std::size_t touched = 0;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const auto& e = terms_.edge[edge];
      // The distance from the edge, inward: -(side g √nn + β r), up to a positive factor.
      const auto beta = dot(n, cross(e, terms_.step)) * terms_.radius;
      const auto g = dot(e, cross(terms_.from_corner[edge], terms_.step));
      const int inward = -signs_.with_root(beta, time->side > 0 ? g : negated(g), time->square);
      if (inward < 0) return std::nullopt;
      if (inward > 0) continue;
      // Edges k and k + 1 meet in corner k + 1.
      touched = touched_edges++ == 0 ? edge : (touched == 0 && edge == 2 ? 0 : edge);
    }
    if (touched_edges == 0) return Feature::face;
    return touched_edges == 1 ? edge_feature(touched) : corner_feature(touched);
  }

  /// Returns true if the ball comes to a corner, and the corner is the nearest part then (S5).
  [[nodiscard]] bool enters_corner(std::size_t corner) {
    const auto& w = terms_.from_corner[corner];
    const auto time = approach_.to_point(w, terms_.to_end[corner], signs_);
    if (!time) return false;
    const auto leads_nearer = [&](std::size_t edge, bool is_outgoing) {
      if (!outline_.edges[edge]) return false;
      const auto& e = terms_.edge[edge];
      const int sign = time->sign_of(signs_, dot(w, e), dot(terms_.step, e));
      return is_outgoing ? sign > 0 : sign < 0;
    };
    return !leads_nearer(corner, true) && !leads_nearer(before(corner), false);
  }

  /// Returns true if the ball comes to the inside of an edge, and it is the nearest part then (S6).
  [[nodiscard]] bool enters_edge(std::size_t edge) {
    const auto& e = terms_.edge[edge];
    const auto& d = terms_.step;
    const auto& w = terms_.from_corner[edge];
    const auto time = approach_.to_line(w, terms_.to_end[edge], e, signs_);
    if (!time) return false;
    const auto dd = dot(d, d);
    const auto de = dot(d, e);
    const auto from_start = dd * dot(w, e) - dot(d, w) * de;
    if (signs_.of_roots(from_start, time->square, de, time->reduced) <= 0) return false;
    const auto& w_end = terms_.from_corner[next(edge)];
    const auto from_end = dd * dot(w_end, e) - dot(d, w_end) * de;
    if (signs_.of_roots(from_end, time->square, de, time->reduced) >= 0) return false;
    if (!outline_.has_face) return true;
    const auto outward = cross(e, normal());
    return time->sign_of(signs_, dot(outward, w), dot(outward, d)) >= 0;
  }

  const Terms& terms_;
  const Outline& outline_;
  Signs& signs_;
  Approach<typename decltype(Terms::step)::value_type, decltype(Terms::radius)> approach_;
};

}  // namespace surehit::detail
