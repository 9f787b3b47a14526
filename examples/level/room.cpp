#include "level/room.hpp"

#include <map>

namespace surehit::example {
namespace {

using Lattice = std::array<std::uint32_t, 3>;

/// Gives each lattice point on the room's surface one vertex, whichever sides ask for it.
class RoomBuilder {
 public:
  RoomBuilder(const Point& low, const Point& high, const Lattice& cells) : low_(low), high_(high), cells_(cells) {}

  /// The two sides across an axis.
  void add_sides(std::size_t axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (std::uint32_t j = 0; j < cells_[v]; ++j) {
      for (std::uint32_t i = 0; i < cells_[u]; ++i) {
        for (const bool high_side : {false, true}) {
          Lattice corner{};
          corner[axis] = high_side ? cells_[axis] : 0;
          const auto at = [&](std::uint32_t di, std::uint32_t dj) {
            corner[u] = i + di;
            corner[v] = j + dj;
            return vertex(corner);
          };
          const std::uint32_t a = at(0, 0);
          const std::uint32_t b = high_side ? at(0, 1) : at(1, 0);
          const std::uint32_t c = at(1, 1);
          const std::uint32_t d = high_side ? at(1, 0) : at(0, 1);
          mesh_.triangles.push_back({a, b, c});
          mesh_.triangles.push_back({a, c, d});
        }
      }
    }
  }

  [[nodiscard]] Mesh<float> take() { return std::move(mesh_); }

 private:
  std::uint32_t vertex(const Lattice& corner) {
    const auto [entry, is_new] = ids_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back({coordinate(corner, 0), coordinate(corner, 1), coordinate(corner, 2)});
    return entry->second;
  }

  [[nodiscard]] float coordinate(const Lattice& corner, std::size_t axis) const {
    if (corner[axis] == cells_[axis]) return high_[axis];
    return low_[axis] +
           (high_[axis] - low_[axis]) * (static_cast<float>(corner[axis]) / static_cast<float>(cells_[axis]));
  }

  Point low_;
  Point high_;
  Lattice cells_;
  std::map<Lattice, std::uint32_t> ids_;
  Mesh<float> mesh_;
};

}  // namespace

Mesh<float> build_room(const Point& low, const Point& high, const std::array<std::uint32_t, 3>& cells) {
  RoomBuilder builder(low, high, cells);
  for (std::size_t axis = 0; axis < 3; ++axis) builder.add_sides(axis);
  return builder.take();
}

}  // namespace surehit::example
