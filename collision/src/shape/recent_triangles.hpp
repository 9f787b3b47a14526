#pragma once

#include <array>
#include <cstdint>

#include "surehit/triangle_mesh_view.hpp"

namespace surehit::detail {

/// Remembers the last triangles that a shape was tested against, since most triangles are in the lists of several
/// cells.
class RecentTriangles {
 public:
  RecentTriangles() { ids_.fill(no_triangle); }
  /// Returns true if the triangle is still remembered. Remembers it.
  [[nodiscard]] bool has(std::uint32_t id) {
    std::uint32_t& place = ids_[id % ids_.size()];
    const bool is_there = place == id;
    place = id;
    return is_there;
  }
  /// Forgets a triangle that is remembered.
  void forget(std::uint32_t id) { ids_[id % ids_.size()] = no_triangle; }

 private:
  std::array<std::uint32_t, 64> ids_;
};

}  // namespace surehit::detail
