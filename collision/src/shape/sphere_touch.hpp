#pragma once

#include <cstddef>
#include <optional>

#include "shape/approach.hpp"
#include "shape/outline.hpp"
#include "shape/sphere_contact.hpp"
#include "shape/sphere_terms.hpp"

namespace surehit::detail {

/// Decides whether a moving ball touches a triangle, and where first. Follows SHAPES.md, whose lemmas it cites. The
/// numbers are either exact integers, or doubles with bounds. With the latter, an answer counts only if it is certain.
///
/// Usually one part is enough to know the first contact (S6). But a ball may roll over a triangle at a distance of
/// exactly the radius. It then comes to several edges and corners, one after the other, that fit equally well.
/// `comes_before(x, y)` says whether it comes to part x before part y.
template <typename Terms>
class SphereTouch {
 public:
  SphereTouch(const Terms& terms, const Outline& outline)
      : terms_(terms), outline_(outline), approach_(terms.step, terms.radius) {}

  /// Returns the first contact, or nothing if the ball touches nothing. The bounds of t are not set. Passes over what
  /// `findings` rules out, and adds to it.
  template <typename ComesBefore>
  [[nodiscard]] std::optional<SphereContact> find(const ComesBefore& comes_before, SphereFindings& findings) {
    // A ball that comes to the plane from outside of its reach does not touch the triangle at the start.
    if (outline_.has_face) {
      std::optional<Feature> entered;
      const auto enters = [&] { return (entered = enters_face()).has_value(); };
      if (ask(Feature::face, findings.never_entered, enters) && signs_.is_certain()) {
        return final_contact({0, 0, *entered, Feature::face});
      }
    }
    if (!findings.begins_outside) {
      const std::optional<Feature> touched = touched_at_start(findings);
      if (touched) return final_contact({0, 0, *touched, *touched, true});
    }
    std::optional<SphereContact> first;
    const auto take = [&](Feature part) {
      if (!ask(part, findings.never_entered, [&] { return enters(part); })) return false;
      const bool is_enough = is_strict_ && signs_.is_certain();
      if (is_enough || !first || !comes_before(first->feature, part)) first = SphereContact{0, 0, part, part};
      return is_enough;
    };
    return for_each_outer_part(take) ? final_contact(*first) : first;
  }

  /// Returns true if all signs that the answer needs were certain.
  [[nodiscard]] bool is_certain() const { return is_certain_; }
  /// Returns true if the contact did not need an order of roots.
  [[nodiscard]] bool is_final() const { return is_final_; }

 private:
  static std::size_t next(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }
  static std::size_t before(std::size_t corner) { return corner == 0 ? 2 : corner - 1; }

  [[nodiscard]] auto normal() const { return normal_of(terms_); }
  [[nodiscard]] auto outward(std::size_t edge) const { return cross(terms_.edge[edge], normal()); }
  [[nodiscard]] auto radius_squared() const { return terms_.radius * terms_.radius; }

  [[nodiscard]] SphereContact final_contact(const SphereContact& contact) {
    is_certain_ = is_final_ = true;
    return contact;
  }

  /// Asks a question by its signs. Notes whether all of them are certain.
  template <typename Question>
  [[nodiscard]] bool ask(const Question& question) {
    signs_ = Signs();
    is_strict_ = true;
    const bool answer = question();
    is_certain_ &= signs_.is_certain();
    return answer;
  }
  /// Asks whether a part fits, unless it is ruled out. Rules it out if it certainly does not fit.
  template <typename Question>
  [[nodiscard]] bool ask(Feature part, SphereFindings::Parts& ruled_out, const Question& fits) {
    const auto index = static_cast<std::size_t>(part);
    if (ruled_out[index]) return false;
    if (ask(fits)) return true;
    ruled_out[index] = signs_.is_certain();
    return false;
  }
  /// Returns true if a sign is not negative. Notes if it is zero.
  [[nodiscard]] bool holds(int sign) {
    is_strict_ &= sign != 0;
    return sign >= 0;
  }

  /// Calls `take` with each edge and each corner, until it returns true. The corners come last. Returns what `take` has
  /// returned last.
  template <typename Take>
  bool for_each_outer_part(const Take& take) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (outline_.edges[edge] && take(edge_feature(edge))) return true;
    }
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (outline_.corners[corner] && take(corner_feature(corner))) return true;
    }
    return false;
  }

  /// Returns the part that the ball certainly touches at the start.
  [[nodiscard]] std::optional<Feature> touched_at_start(SphereFindings& findings) {
    const bool was_certain = is_certain_;
    is_certain_ = true;
    Feature nearest = Feature::face;
    const auto take = [&](Feature part) {
      if (!ask(part, findings.never_nearest, [&] { return is_nearest(part); })) return false;
      nearest = part;
      return signs_.is_certain();
    };
    if (for_each_outer_part(take)) is_certain_ = true;
    const bool touches = ask([&] { return reaches(nearest); });
    if (!is_certain_) return std::nullopt;
    if (touches) return nearest;
    findings.begins_outside = true;
    is_certain_ = was_certain;
    return std::nullopt;
  }

  /// Returns true if an edge or a corner is the part that is nearest to the start (S1).
  [[nodiscard]] bool is_nearest(Feature part) {
    const auto& w = terms_.from_corner;
    const auto along = [&](std::size_t corner, std::size_t edge) {
      return signs_.of(dot(w[corner], terms_.edge[edge]));
    };
    if (is_corner(part)) {
      const std::size_t corner = index_of(part);
      const std::size_t incoming = before(corner);
      return (!outline_.edges[corner] || along(corner, corner) <= 0) &&
             (!outline_.edges[incoming] || along(corner, incoming) >= 0);
    }
    const std::size_t edge = index_of(part);
    if (along(edge, edge) <= 0 || along(next(edge), edge) >= 0) return false;
    return !outline_.has_face || signs_.of(dot(outward(edge), w[edge])) >= 0;
  }

  /// Returns true if the start is at most the radius away from its nearest part (S2).
  [[nodiscard]] bool reaches(Feature nearest) {
    const auto& w = terms_.from_corner;
    if (is_corner(nearest)) {
      const auto& from_corner = w[index_of(nearest)];
      return signs_.of(dot(from_corner, from_corner) - radius_squared()) <= 0;
    }
    if (is_edge(nearest)) {
      const auto& e = terms_.edge[index_of(nearest)];
      const auto moment = cross(w[index_of(nearest)], e);
      return signs_.of(dot(moment, moment) - radius_squared() * dot(e, e)) <= 0;
    }
    const auto n = normal();
    const auto height = dot(n, w[0]);
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

  /// Returns true if the ball comes to an edge or a corner, and this is the nearest part then.
  [[nodiscard]] bool enters(Feature part) {
    return is_corner(part) ? enters_corner(index_of(part)) : enters_edge(index_of(part));
  }
  /// (S5)
  [[nodiscard]] bool enters_corner(std::size_t corner) {
    const auto& w = terms_.from_corner[corner];
    const auto time = approach_.to_point(w, terms_.to_end[corner], signs_);
    if (!time) return false;
    const auto leads_off = [&](std::size_t edge, int sign) {
      if (!outline_.edges[edge]) return true;
      const auto& e = terms_.edge[edge];
      return holds(sign * time->sign_of(signs_, dot(w, e), dot(terms_.step, e)));
    };
    return leads_off(corner, -1) && leads_off(before(corner), 1);
  }
  /// (S6)
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
    const auto out = outward(edge);
    return holds(time->sign_of(signs_, dot(out, w), dot(out, d)));
  }

  const Terms& terms_;
  const Outline& outline_;
  Approach<typename decltype(Terms::step)::value_type, decltype(Terms::radius)> approach_;
  Signs signs_;             ///< The signs that the last question has asked for.
  bool is_certain_ = true;  ///< True if all signs were certain, as far as they count.
  bool is_final_ = false;   ///< True if the contact does not depend on an order of roots.
  bool is_strict_ = true;   ///< True if no sign that says which part is nearest was zero.
};

}  // namespace surehit::detail
