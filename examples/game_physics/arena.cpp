#include "game_physics/arena.hpp"

#include "level/room.hpp"

namespace surehit::example {
namespace {

/// Half a turn in eight steps, as vectors about 3/4 long on the lattice of 1/8.
constexpr std::array<std::array<float, 2>, 8> wings = {{{0.75f, 0},
                                                        {0.75f, 0.25f},
                                                        {0.5f, 0.5f},
                                                        {0.25f, 0.75f},
                                                        {0, 0.75f},
                                                        {-0.25f, 0.75f},
                                                        {-0.5f, 0.5f},
                                                        {-0.75f, 0.25f}}};

class SlatBuilder {
 public:
  explicit SlatBuilder(Mesh<float>& mesh) : mesh_(mesh) {}

  /// A slat about an axis along y, whose section turns on its way: every triangle of it lies in a plane of its own.
  void add_slat(float x, float z, std::size_t turn, const Boxf& room) {
    constexpr std::size_t rows = 2;
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    const float depth = (room.high.y() - room.low.y()) / rows;
    for (std::size_t row = 0; row <= rows; ++row) {
      const auto& wing = wings[(turn + row) % wings.size()];
      // Past half a turn the wing points the other way; the slat must go on turning, not swing back.
      const float sign = (turn + row) / wings.size() % 2 == 0 ? 1.0f : -1.0f;
      const float y = room.low.y() + depth * static_cast<float>(row);
      mesh_.vertices.push_back({x - sign * wing[0], y, z - sign * wing[1]});
      mesh_.vertices.push_back({x, y, z + 0.125f});
      mesh_.vertices.push_back({x + sign * wing[0], y, z + sign * wing[1]});
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t half = 0; half < 2; ++half) {
        const std::uint32_t near = first + 3 * row + half;
        const std::uint32_t far = near + 3;
        mesh_.triangles.push_back({near, near + 1, far + 1});
        mesh_.triangles.push_back({near, far + 1, far});
      }
    }
  }

 private:
  Mesh<float>& mesh_;
};

}  // namespace

Arena build_arena() {
  constexpr Point low = {32, 32, 32};
  constexpr Point high = {64, 36, 48};
  Arena arena{{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}, build_room(low, high, {1, 1, 1})};
  SlatBuilder slats(arena.walls);
  for (std::size_t row = 0; row < 7; ++row) {
    const float shift = row % 2 == 0 ? 0.0f : 1.0f;
    for (std::size_t column = 0; column < 15; ++column) {
      slats.add_slat(33.5f + 2 * static_cast<float>(column) + shift, 34 + 2 * static_cast<float>(row),
                     2 * column + 3 * row, arena.room);
    }
  }
  return arena;
}

}  // namespace surehit::example
