#include "agents_tick/town.hpp"

#include <array>
#include <memory>
#include <random>

#include "level/architecture.hpp"

namespace surehit::example {
namespace {

using ColliderPointer = std::shared_ptr<const Colliderf>;

constexpr std::uint32_t blocks_all = blocks_movement | blocks_sight;
constexpr float storey = 3;
constexpr Opening doorway = {1, 2.25f, 0, 2.25f};
constexpr Opening shop_window = {4, 7, 0, 2.5f};

template <typename Add>
ColliderPointer collider_of(float edge, Add add) {
  SolidBuilder builder(edge);
  add(builder);
  return std::make_shared<const Colliderf>(builder.take().view());
}

ColliderPointer wall_of(float length, std::vector<Opening> openings) {
  return collider_of(1, [&](SolidBuilder& builder) {
    add_wall(builder, {Wall::Along::x, 0, 0, length, 0.25f, std::move(openings)}, storey);
  });
}

ColliderPointer box_of(const Point& low, const Point& high) {
  return collider_of(1, [&](SolidBuilder& builder) { builder.add_box(low, high); });
}

/// The meshes of the town. The origin of each is on the ground.
struct Pieces {
  ColliderPointer front = wall_of(8, {doorway, shop_window});
  ColliderPointer wall = wall_of(8, {{2, 4, 0.875f, 2.5f}});
  ColliderPointer door = box_of({doorway.from, -0.0625f, 0}, {doorway.to, 0.0625f, doorway.high});
  ColliderPointer glass = box_of({shop_window.from, -0.03125f, 0}, {shop_window.to, 0.03125f, shop_window.high});
  ColliderPointer crate = box_of({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 1});
  ColliderPointer shelf = box_of({-1, -0.25f, 0}, {1, 0.25f, 1.875f});
  ColliderPointer pillar = collider_of(0.375f, [](SolidBuilder& b) { add_pillar(b, {0, 0, 0}, storey, 0.375f); });
  ColliderPointer stairs = collider_of(2, [](SolidBuilder& b) { add_stairs(b, {-2, -1.5f, 0}, 4, 0.375f, 0.25f, 8); });
  ColliderPointer railing = collider_of(4, [](SolidBuilder& b) { add_railing(b, {-3, 0, 0}, {3, 0, 0}, 1, 0.25f); });
  ColliderPointer tree = collider_of(0.5f, [](SolidBuilder& b) {
    b.add_round({0, 0, -0.25f}, 2.5f, 0.25f, 0.1875f);
    b.add_round({0, 0, 2.25f}, 3, 1.25f, 0.0625f);
  });
  ColliderPointer ground = collider_of(10, [](SolidBuilder& b) {
    b.add_parallelogram({0, 0, 0}, {Town::size, 0, 0}, {0, Town::size, 0});
  });
  ColliderPointer fence = wall_of(Town::size, {});
};

/// A turn about the vertical whose x axis goes to (cosine, sine).
Posef turned(float cosine, float sine, const Vector3f& translation) {
  Posef pose = Posef::translated(translation);
  pose.linear << cosine, -sine, 0, sine, cosine, 0, 0, 0, 1;
  return pose;
}

class TownBuilder {
 public:
  TownBuilder(Scenef& scene, std::vector<InstanceId>& doors, std::uint64_t seed)
      : scene_(scene), doors_(doors), bits_(seed) {}

  void build() {
    add(pieces_.ground, {}, blocks_movement);
    for (int side = 0; side < 4; ++side) {
      const Posef pose = quarter_turned(side, {-Town::size / 2, -Town::size / 2, 0});
      add(pieces_.fence, {pose.linear, pose.translation + Vector3f(Town::size, Town::size, 0) / 2}, blocks_all);
    }
    for (std::size_t row = 0; row < Town::plots_in_a_row; ++row) {
      for (std::size_t column = 0; column < Town::plots_in_a_row; ++column) {
        if (row + column == 0) continue;  // an empty square
        const Vector3f corner(static_cast<float>(column), static_cast<float>(row), 0);
        add_plot(Town::plot_size * corner + Vector3f(Town::plot_size, Town::plot_size, 0) / 2);
      }
    }
    scene_.commit();
  }

 private:
  /// A turn by quarters about the origin, after the mesh has been moved to `place`. All its numbers are exact.
  static Posef quarter_turned(int quarters, const Vector3f& place) {
    constexpr std::array<std::array<float, 2>, 4> directions = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const auto& [cosine, sine] = directions[static_cast<std::size_t>(quarters)];
    Posef pose = turned(cosine, sine, Vector3f::Zero());
    pose.translation = pose.linear * place;
    return pose;
  }

  InstanceId add(const ColliderPointer& collider, const Posef& pose, std::uint32_t mask) {
    return scene_.add(collider, pose, {.mask = mask});
  }

  std::uint32_t draw(std::uint32_t count) { return static_cast<std::uint32_t>(bits_() >> 32) % count; }
  float between(float low, float high) { return low + (high - low) * (static_cast<float>(bits_() >> 40) * 0x1p-24f); }

  /// A turn by any angle.
  Posef any_turn(const Vector3f& translation) {
    constexpr std::array<std::array<float, 2>, 4> angles = {{{1, 0}, {0.96f, 0.28f}, {0.8f, 0.6f}, {0.6f, 0.8f}}};
    const auto& [cosine, sine] = angles[draw(4)];
    return draw(2) == 0 ? turned(cosine, sine, translation) : turned(-sine, cosine, translation);
  }

  /// Each plot has five instances.
  void add_plot(const Vector3f& centre) {
    switch (draw(4)) {
      case 0:
        return add_house(centre);
      case 1:
        return add_garden(centre);
      case 2:
        return add_colonnade(centre);
      default:
        return add_market(centre);
    }
  }

  void add_house(const Vector3f& centre) {
    const int quarters = static_cast<int>(draw(4));
    const auto place = [&](int more_quarters) {
      const Posef pose = quarter_turned((quarters + more_quarters) % 4, {-4, -3.75f, 0});
      return Posef{pose.linear, pose.translation + centre};
    };
    add(pieces_.front, place(0), blocks_all);
    add(pieces_.glass, place(0), blocks_movement);
    doors_.push_back(add(pieces_.door, place(0), blocks_all));
    add(pieces_.wall, place(1), blocks_all);
    add(pieces_.wall, place(2), blocks_all);
  }

  void add_garden(const Vector3f& centre) {
    for (const float x : {-2.0f, 0.0f, 2.0f}) {
      add(pieces_.tree, any_turn(centre + Vector3f(x, between(-2, 2), 0)), blocks_all);
    }
    add(pieces_.railing, turned(1, 0, centre + Vector3f(0, -3.5f, 0)), blocks_movement);
    add(pieces_.crate, any_turn(centre + Vector3f(between(-3, 3), 3.25f, 0)), blocks_all);
  }

  void add_colonnade(const Vector3f& centre) {
    for (const float x : {-3.0f, 3.0f}) {
      for (const float y : {-3.0f, 3.0f})
        add(pieces_.pillar, Posef::translated(centre + Vector3f(x, y, 0)), blocks_all);
    }
    const Posef pose = quarter_turned(static_cast<int>(draw(4)), Vector3f::Zero());
    add(pieces_.stairs, {pose.linear, centre}, blocks_all);
  }

  void add_market(const Vector3f& centre) {
    for (const float y : {-3.0f, 0.0f, 3.0f}) {
      add(pieces_.shelf, any_turn(centre + Vector3f(between(-2.5f, -1), y, 0)), blocks_all);
    }
    for (const float y : {-2.0f, 2.0f}) {
      add(pieces_.crate, any_turn(centre + Vector3f(between(1, 3), y, 0)), blocks_all);
    }
  }

  Scenef& scene_;
  std::vector<InstanceId>& doors_;
  Pieces pieces_;
  std::mt19937_64 bits_;
};

}  // namespace

Town::Town(std::uint64_t seed) { TownBuilder(scene_, doors_, seed).build(); }

void Town::set_doors(std::uint32_t tick, const std::optional<Executor>& executor) {
  constexpr std::uint32_t ticks_to_change = 16;
  for (std::size_t i = 0; i < doors_.size(); ++i) {
    const bool is_open = (tick + i) / ticks_to_change % 2 != 0;
    const std::uint32_t mask = is_open ? 0 : blocks_all;
    if (scene_.mask(doors_[i]) != mask) scene_.set_mask(doors_[i], mask);
  }
  scene_.commit(executor);
}

std::size_t Town::triangle_count() const {
  std::size_t count = 0;
  for (const InstanceId id : scene_.instances()) count += scene_.triangle_count(id);
  return count;
}

}  // namespace surehit::example
