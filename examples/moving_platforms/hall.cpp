#include "moving_platforms/hall.hpp"

namespace surehit::example {
namespace {

using Kind = Platform::Kind;

constexpr float thin = 0.125f;

/// Adds platforms to a hall. Places are counted from its low corner.
class HallBuilder {
 public:
  explicit HallBuilder(Hall& hall) : hall_(hall) {}

  void add_lift(float x, std::uint32_t ahead) {
    add({Kind::lift, {box(4, 3, thin)}, {x, 4.5f, 1}, {0, 0, 11.5f}, 72, 24, ahead});
  }

  /// A door across the hall that opens upwards.
  void add_gate(float x, std::uint32_t ahead) {
    add({Kind::door, {box(thin, 7.5f, 5.5f)}, {x, 0.25f, 3}, {0, 0, 6.5f}, 32, 16, ahead});
  }

  /// The two halves of a door along the hall. Closed, they leave a gap for what is between them.
  void add_double_door(float x, std::uint32_t ahead) {
    constexpr float width = 3;
    constexpr float gap = 0.125f;
    const Boxf half = box(width, thin, 8);
    add({Kind::door, {half}, {x - width - gap / 2, 4, 3}, {-2, 0, 0}, 32, 16, ahead});
    add({Kind::door, {half}, {x + gap / 2, 4, 3}, {2, 0, 0}, 32, 16, ahead});
  }

  /// An open car of a train.
  void add_car(float x) {
    const Vector3f size(4, 2.5f, 1.75f);
    std::vector<Boxf> boxes = {box(size.x(), size.y(), thin)};
    for (const bool is_far : {false, true}) {
      for (const Vector3f::Index axis : {0, 1}) {
        Boxf side{{0, 0, thin}, size};
        if (is_far) {
          side.low[axis] = size[axis] - thin;
        } else {
          side.high[axis] = thin;
        }
        // The sides along y lie between those along x.
        if (axis == 1) {
          side.low.x() = thin;
          side.high.x() = size.x() - thin;
        }
        boxes.push_back(side);
      }
    }
    add({Kind::train, boxes, {x, 0.75f, 0.5f}, {16.5f, 0, 0}, 60, 36, 0});
  }

 private:
  static Boxf box(float x, float y, float z) { return {{0, 0, 0}, {x, y, z}}; }

  void add(Platform platform) {
    platform.home += hall_.room.low;
    hall_.platforms.push_back(std::move(platform));
  }

  Hall& hall_;
};

}  // namespace

Hall build_hall() {
  Hall hall{{{32, 32, 32}, {64, 40, 48}}, {}, {}};
  HallBuilder builder(hall);
  for (const float x : {1.0f, 5.25f, 9.5f}) builder.add_car(x);
  builder.add_lift(5, 0);
  builder.add_lift(23, 96);
  builder.add_gate(10.25f, 0);
  builder.add_gate(21.75f, 48);
  builder.add_double_door(16, 24);
  for (const float x : {2.5f, 29.5f}) hall.fans.push_back({hall.room.low + Vector3f(x, 6, 9), 1.75f, 0.0737f});
  hall.fans.push_back({hall.room.low + Vector3f(16, 6.25f, 7), 2.75f, -0.0737f});
  return hall;
}

}  // namespace surehit::example
