#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "shape/approach.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/capsule_terms.hpp"
#include "shape/outline.hpp"
#include "support/inlining.hpp"

namespace surehit::detail {

/// Decides whether a moving capsule touches a triangle, and where first. Follows SHAPES.md, whose lemmas it cites. The
/// numbers are either exact integers, or doubles with bounds. With the latter, an answer counts only if it is certain.
///
/// Two parts, one of the triangle and one of the core, have an equation: its root is the t at which they come within
/// the radius (C5). If they are the nearest parts then, they touch. Usually no other parts can be as near, and the
/// first contact is found (C6). Otherwise `comes_before(x, y)` says whether the root of contact x is before that of y.
template <typename Terms>
class CapsuleTouch {
 public:
  CapsuleTouch(const Terms& terms, const Outline& outline, const CoreTilt& tilt)
      : terms_(terms), outline_(outline), tilt_(tilt), approach_(terms.step, terms.radius) {}

  /// Returns the first contact, or nothing if they do not touch. The bounds of t are not set. Passes over the parts
  /// that `findings` rules out, and adds to these.
  template <typename ComesBefore>
  std::optional<CapsuleContact> find(const ComesBefore& comes_before, CapsuleFindings& findings) {
    const auto ask = [&](const CapsuleContact& parts, CapsuleFindings::Parts& ruled_out, const auto& question) {
      const std::size_t index = CapsuleFindings::index_of(parts);
      if (ruled_out[index]) return false;
      if (question()) return true;
      ruled_out[index] = signs_.is_certain();
      return false;
    };
    // If a root is the first contact, then they do not touch at the start.
    std::optional<CapsuleContact> first;
    const auto take_first = [&](const CapsuleContact& parts) {
      begin();
      if (!ask(parts, findings.never_entered, [&] { return enters(parts); })) return false;
      is_final_ = is_strict_ && signs_.is_certain();
      if (is_final_ || !first || !comes_before(*first, parts)) first = parts;
      return is_final_;
    };
    if (for_each_part(false, take_first)) {
      is_certain_ = true;
      return first;
    }
    end();
    const bool is_certain_later = is_certain_;
    is_certain_ = true;
    std::optional<CapsuleContact> nearest;
    const auto take_nearest = [&](const CapsuleContact& parts) {
      begin();
      if (!ask(parts, findings.never_nearest, [&] { return is_nearest_at_start(parts); })) return false;
      nearest = parts;
      return is_strict_ && signs_.is_certain();
    };
    if (for_each_part(true, take_nearest)) is_certain_ = true;
    begin();
    if (nearest && reaches(*nearest)) {
      first = nearest;
      first->at_start = is_final_ = true;
    } else {
      is_certain_ &= is_certain_later;
    }
    end();
    return first;
  }

  /// Returns true if all signs that the answer needs were certain.
  [[nodiscard]] bool is_certain() const { return is_certain_; }
  /// Returns true if the contact did not need an order of roots.
  [[nodiscard]] bool is_final() const { return is_final_; }

 private:
  /// t = 0 as a time.
  struct Start {
    template <typename X, typename Y>
    [[nodiscard]] int sign_of(Signs& signs, const X& x, const Y&) const {
      return signs.of(x);
    }
  };

  static std::size_t next(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }
  static std::size_t before(std::size_t corner) { return corner == 0 ? 2 : corner - 1; }
  /// Returns the sign of the end's place on the core.
  static int sign_of(CorePart core) { return core == CorePart::low_end ? -1 : core == CorePart::high_end ? 1 : 0; }

  /// Begins to ask about other parts.
  void begin() {
    end();
    signs_ = Signs();
    is_strict_ = true;
  }
  void end() { is_certain_ &= signs_.is_certain(); }

  /// Returns true if a sign is not negative. Notes if it is zero.
  [[nodiscard]] bool holds(int sign) {
    is_strict_ &= sign != 0;
    return sign >= 0;
  }

  [[nodiscard]] auto normal() const { return normal_of(terms_); }
  [[nodiscard]] auto wall_normal(std::size_t edge) const { return detail::wall_normal(terms_, edge); }
  /// Returns A × (e × A): the direction of an edge, across the axis.
  [[nodiscard]] auto edge_across_axis(std::size_t edge) const { return cross(terms_.half_axis, wall_normal(edge)); }
  /// Returns e × (e × A): the direction of -A, across the edge.
  [[nodiscard]] auto axis_across_edge(std::size_t edge) const { return cross(terms_.edge[edge], wall_normal(edge)); }
  /// Returns e × n: the direction out of the triangle, across the edge.
  [[nodiscard]] auto outward(std::size_t edge) const { return cross(terms_.edge[edge], normal()); }
  /// Returns a part of the core at the start, less a corner.
  [[nodiscard]] auto from_corner(std::size_t corner, CorePart core) const {
    return moved_to(core, terms_.from_corner[corner], terms_.half_axis);
  }
  [[nodiscard]] auto to_end(std::size_t corner, CorePart core) const {
    return moved_to(core, terms_.to_end[corner], terms_.half_axis);
  }

  /// Returns the sign of x·(w + t D).
  template <typename X, typename W, typename Time>
  [[nodiscard]] int along(const Vector<X>& x, const Vector<W>& w, const Time& time) {
    return time.sign_of(signs_, dot(x, w), dot(x, terms_.step));
  }

  /// Calls `take` with all parts that can be nearest (C2), until it returns true. The face comes before edges, and
  /// edges before corners. Returns what `take` has returned last.
  template <typename Take>
  bool for_each_part(bool with_crossing, const Take& take) {
    constexpr std::array parts = {CorePart::inside, CorePart::low_end, CorePart::high_end};
    const auto take_all = [&](Feature feature, bool is_parallel) {
      if (is_parallel) return take(CapsuleContact{0, 0, feature, CorePart::centre});
      for (const CorePart core : parts) {
        if (feature == Feature::face && core == CorePart::inside && !with_crossing) continue;
        if (take(CapsuleContact{0, 0, feature, core})) return true;
      }
      return false;
    };
    if (outline_.has_face && take_all(Feature::face, tilt_.of_plane == 0)) return true;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (outline_.edges[edge] && take_all(edge_feature(edge), tilt_.is_along[edge])) return true;
    }
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (outline_.corners[corner] && take_all(corner_feature(corner), tilt_.is_point)) return true;
    }
    return false;
  }

  /// Returns true if a way out of an edge's inside leaves the triangle, if it has the direction -s A (C4).
  [[nodiscard]] bool leaves_edge(std::size_t edge, int s) {
    if (!outline_.has_face) return true;
    return !tilt_.is_along[edge] && s * signs_.of(dot(outward(edge), terms_.half_axis)) < 0;
  }
  /// Returns the same for a corner.
  [[nodiscard]] bool leaves_corner(std::size_t corner, int s) {
    if (outline_.has_face) return leaves_edge(corner, s) || leaves_edge(before(corner), s);
    // The triangle is a segment or a point.
    const auto leads_off = [&](std::size_t edge, int sign) {
      if (!outline_.edges[edge]) return true;
      return !tilt_.is_along[edge] || sign * s * signs_.of(dot(terms_.edge[edge], terms_.half_axis)) > 0;
    };
    return leads_off(corner, 1) && leads_off(before(corner), -1);
  }

  /// Returns true if a corner and a part of the core are nearest to each other at a time (C2, C4).
  template <typename Time>
  [[nodiscard]] SUREHIT_NOINLINE bool is_nearest_corner(std::size_t corner, CorePart core, const Time& time) {
    const auto& axis = terms_.half_axis;
    const std::size_t incoming = before(corner);
    if (core == CorePart::inside) {
      if (!holds(-along(axis, from_corner(corner, CorePart::low_end), time))) return false;
      if (!holds(along(axis, from_corner(corner, CorePart::high_end), time))) return false;
      const auto& w = terms_.from_corner[corner];
      const auto leads_off = [&](std::size_t edge, int sign) {
        return !outline_.edges[edge] || tilt_.is_along[edge] || holds(sign * along(edge_across_axis(edge), w, time));
      };
      if (!leads_off(corner, -1) || !leads_off(incoming, 1)) return false;
      if (tilt_.of_plane != 0) return true;
      const int s = -along(axis, w, time);
      return s == 0 || leaves_corner(corner, s);
    }
    const int s = sign_of(core);
    const auto w = from_corner(corner, core);
    const auto leads_off = [&](std::size_t edge, int sign) {
      return !outline_.edges[edge] || holds(sign * along(terms_.edge[edge], w, time));
    };
    if (!leads_off(corner, -1) || !leads_off(incoming, 1)) return false;
    if (s == 0) return true;
    const int beyond = -s * along(axis, w, time);
    return holds(beyond) && (beyond > 0 || tilt_.of_plane != 0 || leaves_corner(corner, s));
  }

  /// Returns true if the inside of an edge and a part of the core are nearest to each other at a time (C2, C4).
  template <typename Time>
  [[nodiscard]] SUREHIT_NOINLINE bool is_nearest_edge(std::size_t edge, CorePart core, const Time& time) {
    const int s = sign_of(core);
    const auto& e = terms_.edge[edge];
    const auto w = from_corner(edge, core);
    if (!holds(along(e, w, time)) || !holds(-along(e, from_corner(next(edge), core), time))) return false;
    if (outline_.has_face && !holds(along(outward(edge), w, time))) return false;
    if (s == 0) return true;
    const int beyond = s * along(axis_across_edge(edge), w, time);
    return holds(beyond) && (beyond > 0 || tilt_.of_plane != 0 || leaves_edge(edge, s));
  }
  /// Returns the same for the inside of the core.
  template <typename Time>
  [[nodiscard]] SUREHIT_NOINLINE bool is_nearest_wall(std::size_t edge, const Time& time) {
    const auto& w = terms_.from_corner[edge];
    // The side of the wall is that of the start, since they have not touched before.
    if (tilt_.of_plane != 0 && !holds(tilt_.of_plane * signs_.of(dot(wall_normal(edge), w)))) return false;
    const auto along_edge = edge_across_axis(edge);
    if (!holds(along(along_edge, w, time))) return false;
    if (!holds(-along(along_edge, terms_.from_corner[next(edge)], time))) return false;
    const auto along_axis = axis_across_edge(edge);
    if (!holds(along(along_axis, from_corner(edge, CorePart::low_end), time))) return false;
    if (!holds(-along(along_axis, from_corner(edge, CorePart::high_end), time))) return false;
    if (tilt_.of_plane != 0) return true;
    const int s = along(along_axis, w, time);
    return s == 0 || leaves_edge(edge, s);
  }

  /// Returns true if the inside of the triangle and a part of the core, which is not its inside, are nearest to each
  /// other at a time (C2).
  template <typename Time>
  [[nodiscard]] SUREHIT_NOINLINE bool is_nearest_face(CorePart core, const Time& time) {
    const auto w = from_corner(0, core);
    if (tilt_.of_plane != 0 && !holds(-sign_of(core) * tilt_.of_plane * signs_.of(dot(normal(), w)))) return false;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (!holds(-along(outward(edge), from_corner(edge, core), time))) return false;
    }
    return true;
  }
  /// Returns true if the core crosses the triangle at the start, but not in its plane (C2).
  [[nodiscard]] SUREHIT_NOINLINE bool crosses_at_start() {
    const auto n = normal();
    if (!holds(tilt_.of_plane * signs_.of(dot(n, from_corner(0, CorePart::high_end))))) return false;
    if (!holds(-tilt_.of_plane * signs_.of(dot(n, from_corner(0, CorePart::low_end))))) return false;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (!holds(-tilt_.of_plane * signs_.of(dot(wall_normal(edge), terms_.from_corner[edge])))) return false;
    }
    return true;
  }

  /// Returns true if two parts are nearest to each other at the start.
  [[nodiscard]] bool is_nearest_at_start(const CapsuleContact& parts) {
    if (is_corner(parts.feature)) return is_nearest_corner(index_of(parts.feature), parts.core, Start());
    const bool is_inside = parts.core == CorePart::inside;
    if (is_edge(parts.feature)) {
      const std::size_t edge = index_of(parts.feature);
      return is_inside ? is_nearest_wall(edge, Start()) : is_nearest_edge(edge, parts.core, Start());
    }
    return is_inside ? crosses_at_start() : is_nearest_face(parts.core, Start());
  }

  /// Returns true if the nearest parts are at most the radius apart at the start (S2).
  [[nodiscard]] SUREHIT_NOINLINE bool reaches(const CapsuleContact& parts) {
    const bool is_inside = parts.core == CorePart::inside;
    const auto rr = terms_.radius * terms_.radius;
    const auto is_near_point = [&](const auto& w) { return signs_.of(dot(w, w) - rr) <= 0; };
    const auto is_near_line = [&](const auto& w, const auto& e) {
      const auto moment = cross(w, e);
      return signs_.of(dot(moment, moment) - rr * dot(e, e)) <= 0;
    };
    const auto is_near_plane = [&](const auto& w, const auto& n) {
      const auto height = dot(n, w);
      return signs_.of(height * height - rr * dot(n, n)) <= 0;
    };
    if (is_corner(parts.feature)) {
      const std::size_t corner = index_of(parts.feature);
      if (is_inside) return is_near_line(terms_.from_corner[corner], terms_.half_axis);
      return is_near_point(from_corner(corner, parts.core));
    }
    if (is_edge(parts.feature)) {
      const std::size_t edge = index_of(parts.feature);
      if (is_inside) return is_near_plane(terms_.from_corner[edge], wall_normal(edge));
      return is_near_line(from_corner(edge, parts.core), terms_.edge[edge]);
    }
    return is_inside || is_near_plane(from_corner(0, parts.core), normal());
  }

  /// Returns true if two parts come within the radius, and are nearest to each other then (C5).
  [[nodiscard]] bool enters(const CapsuleContact& parts) {
    const bool is_inside = parts.core == CorePart::inside;
    if (is_corner(parts.feature)) {
      const std::size_t corner = index_of(parts.feature);
      return is_inside ? enters_post(corner) : enters_corner(corner, parts.core);
    }
    if (is_edge(parts.feature)) {
      const std::size_t edge = index_of(parts.feature);
      return is_inside ? enters_wall(edge) : enters_edge(edge, parts.core);
    }
    return enters_face(parts.core);
  }
  [[nodiscard]] SUREHIT_NOINLINE bool enters_corner(std::size_t corner, CorePart core) {
    const auto w = from_corner(corner, core);
    const auto time = approach_.to_point(w, to_end(corner, core), signs_);
    return time && is_nearest_corner(corner, core, *time);
  }
  [[nodiscard]] SUREHIT_NOINLINE bool enters_post(std::size_t corner) {
    const auto& w = terms_.from_corner[corner];
    const auto time = approach_.to_line(w, terms_.to_end[corner], terms_.half_axis, signs_);
    return time && is_nearest_corner(corner, CorePart::inside, *time);
  }
  [[nodiscard]] SUREHIT_NOINLINE bool enters_edge(std::size_t edge, CorePart core) {
    const auto time = approach_.to_line(from_corner(edge, core), to_end(edge, core), terms_.edge[edge], signs_);
    return time && is_nearest_edge(edge, core, *time);
  }
  [[nodiscard]] SUREHIT_NOINLINE bool enters_wall(std::size_t edge) {
    const auto& w = terms_.from_corner[edge];
    const auto time = approach_.to_plane(w, terms_.to_end[edge], wall_normal(edge), signs_);
    return time && is_nearest_wall(edge, *time);
  }
  [[nodiscard]] SUREHIT_NOINLINE bool enters_face(CorePart core) {
    const auto time = approach_.to_plane(from_corner(0, core), to_end(0, core), normal(), signs_);
    return time && is_nearest_face(core, *time);
  }

  const Terms& terms_;
  const Outline& outline_;
  const CoreTilt& tilt_;
  Approach<typename decltype(Terms::step)::value_type, decltype(Terms::radius)> approach_;
  Signs signs_;             ///< The signs that were asked about the parts in question.
  bool is_certain_ = true;  ///< True if all signs before these were certain, as far as they count.
  bool is_final_ = false;   ///< True if the contact does not depend on an order of roots.
  bool is_strict_ = true;   ///< True if no sign about the parts in question is zero.
};

}  // namespace surehit::detail
