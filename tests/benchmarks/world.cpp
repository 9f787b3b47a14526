#include "world.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "level/architecture.hpp"
#include "level/solid_builder.hpp"
#include "support/random.hpp"
#include "uneven_meshes.hpp"

namespace surehit::benchmark {
namespace {

using example::SolidBuilder;
using example::Wall;
using test::Random;
using Matrix3d = Eigen::Matrix3d;

constexpr Wall::Along x_axis = Wall::Along::x;
constexpr Wall::Along y_axis = Wall::Along::y;

/// Returns as many along each side of a square that their number is in proportion to the detail.
int count_along_side(int count, float detail) {
  return std::max(3, static_cast<int>(static_cast<float>(count) * std::sqrt(detail)));
}

double draw_between(double low, double high, Random& random) { return low + random.unit<double>() * (high - low); }

/// Draws a rotation, all alike.
Matrix3d draw_rotation(Random& random) {
  for (;;) {
    Eigen::Quaterniond turn;
    for (double& coefficient : turn.coeffs()) coefficient = random.symmetric<double>();
    const double size = turn.norm();
    if (size > 0.1 && size <= 1) return turn.normalized().toRotationMatrix();
  }
}

/// Returns a turn about the vertical, by an angle whose half has this tangent. It takes no sine.
Matrix3d turn_about_z(double half_tangent) {
  const double scale = 1 / (1 + half_tangent * half_tangent);
  const double cosine = (1 - half_tangent * half_tangent) * scale;
  const double sine = 2 * half_tangent * scale;
  Matrix3d turn;
  turn << cosine, -sine, 0, sine, cosine, 0, 0, 0, 1;
  return turn;
}

Posef rounded_pose(const Matrix3d& linear, const Vector3d& translation) {
  return {linear.cast<float>(), translation.cast<float>()};
}

void append(example::Mesh<float>& mesh, const example::Mesh<float>& other, const Vector3f& offset) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const auto& [x, y, z] : other.vertices) {
    mesh.vertices.push_back({x + offset.x(), y + offset.y(), z + offset.z()});
  }
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

/// Adds a house with a door, windows, two rooms and a flat roof.
void add_house(SolidBuilder& builder, float width, float depth) {
  constexpr float height = 3;
  constexpr float thick = 0.25f;
  const float x = width / 2;
  const float y = depth / 2;
  const example::Opening door = {-0.625f, 0.625f, 0, 2.25f};
  const auto windows = [](float half_length) {
    std::vector<example::Opening> openings;
    for (float from = 1 - half_length; from + 1.5f < half_length; from += 2.5f) {
      openings.push_back({from, from + 1.25f, 0.875f, 2.25f});
    }
    return openings;
  };
  add_wall(builder, {x_axis, -y, -x, x, thick, {door}}, height);
  add_wall(builder, {x_axis, y, -x, x, thick, windows(x)}, height);
  add_wall(builder, {y_axis, -x, -y, y, thick, windows(y)}, height);
  add_wall(builder, {y_axis, x, -y, y, thick, windows(y)}, height);
  add_wall(builder, {y_axis, 0.5f, -y, y, thick, {{1, 2.25f, 0, 2.25f}}}, height);
  builder.add_box({-x - 0.5f, -y - 0.5f, height}, {x + 0.5f, y + 0.5f, height + 0.25f});
}

/// Builds what a town is made of: first the paving of a lot, then what stands on it alone, then what is small.
std::vector<example::Mesh<float>> town_meshes(float detail) {
  std::vector<example::Mesh<float>> meshes;
  const auto add = [&](const std::function<void(SolidBuilder&)>& build, float edge = 0.625f) {
    SolidBuilder builder(edge / detail);
    build(builder);
    meshes.push_back(builder.take());
  };
  add([](SolidBuilder& b) { b.add_box({-12, -12, -0.25f}, {12, 12, 0}); }, 24);
  constexpr std::array<std::array<float, 2>, 6> houses = {{{8, 10}, {10, 12}, {12, 9}, {14, 14}, {9, 16}, {18, 12}}};
  for (const std::array<float, 2>& size : houses) add([&](SolidBuilder& b) { add_house(b, size[0], size[1]); });
  add([](SolidBuilder& b) { b.add_round({0, 0, 0}, 14, 3, 2.5f); });
  add([](SolidBuilder& b) {
    for (const float x : {-4.0f, 0.0f, 4.0f}) {
      for (const float y : {-3.0f, 3.0f}) add_pillar(b, {x, y, 0}, 4, 0.375f);
    }
    b.add_box({-5, -4, 4}, {5, 4, 4.25f});
  });
  add([](SolidBuilder& b) { add_stairs(b, {-1, -2, 0}, 2, 0.375f, 0.25f, 12); });
  add([](SolidBuilder& b) { add_railing(b, {-3, 0, 0}, {3, 0, 0}, 1, 0.25f); });
  add([](SolidBuilder& b) {
    b.add_box({-4, -1, 1}, {4, 1, 1.25f});
    add_railing(b, {-4, -0.875f, 1.25f}, {4, -0.875f, 1.25f}, 1, 0.5f);
    add_railing(b, {-4, 0.875f, 1.25f}, {4, 0.875f, 1.25f}, 1, 0.5f);
  });
  add([](SolidBuilder& b) { b.add_box({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 1}); });
  add([](SolidBuilder& b) {
    b.add_turned_box({0, 0, 0}, {1, 1, 1}, 0.8f, 0.6f);
    b.add_turned_box({1.375f, 0.75f, 0}, {1, 1, 1}, 0.96f, 0.28f);
    b.add_turned_box({0.625f, 0.375f, 1}, {1, 1, 1}, 0.6f, 0.8f);
  });
  add([](SolidBuilder& b) {
    b.add_box({-1, -0.5f, 0.75f}, {1, 0.5f, 0.8125f});
    for (const float x : {-0.9375f, 0.875f}) {
      for (const float y : {-0.4375f, 0.375f}) b.add_box({x, y, 0}, {x + 0.0625f, y + 0.0625f, 0.75f});
    }
  });
  add([](SolidBuilder& b) {
    b.add_box({-1, -0.25f, 0.4375f}, {1, 0.25f, 0.5f});
    b.add_box({-1, 0.1875f, 0.5f}, {1, 0.25f, 1});
    for (const float x : {-0.9375f, 0.8125f}) b.add_box({x, -0.1875f, 0}, {x + 0.125f, 0.1875f, 0.4375f});
  });
  add([](SolidBuilder& b) {
    b.add_round({0, 0, 0}, 2.5f, 0.25f, 0.1875f);
    b.add_round({0, 0, 2.25f}, 3, 1.25f, 0.0625f);
  });
  add([](SolidBuilder& b) { add_wall(b, {x_axis, 0, -4, 4, 0.25f, {{-0.625f, 0.625f, 0, 2}}}, 2.25f); });
  add([](SolidBuilder& b) {
    b.add_round({0, 0, 0}, 0.875f, 0.75f, 0.75f);
    for (const float x : {-0.75f, 0.625f}) b.add_box({x, -0.0625f, 0.875f}, {x + 0.125f, 0.0625f, 2});
    b.add_box({-1, -0.5f, 2}, {1, 0.5f, 2.0625f});
  });
  add([](SolidBuilder& b) { b.add_round({0, 0, 0}, 1, 0.375f, 0.375f); });
  return meshes;
}

constexpr std::size_t large_town_meshes = 8;  ///< after the paving

/// 20 × 20 lots: each has its paving, a large thing and three small ones.
World town(float detail) {
  constexpr double lot = 24;
  World world;
  world.meshes = town_meshes(detail);
  Random random(1);
  const int lots = count_along_side(20, detail);
  for (int i = 0; i < lots * lots; ++i) {
    const Vector3d centre(lot * (i % lots), lot * (i / lots), 0);
    world.instances.push_back({0, Posef::translated(centre.cast<float>())});
    const auto place = [&](std::size_t mesh, double reach, double size) {
      const Vector3d offset(reach * random.symmetric<double>(), reach * random.symmetric<double>(), 0);
      world.instances.push_back(
          {mesh, rounded_pose(size * turn_about_z(2 * random.symmetric<double>()), centre + offset)});
    };
    place(1 + random.below(large_town_meshes), 1, 1);
    const std::size_t small = 1 + large_town_meshes;
    for (int j = 0; j < 3; ++j) {
      place(small + random.below(world.meshes.size() - small), 11, draw_between(0.8, 1.25, random));
    }
  }
  const double middle = lot * (lots / 2) + lot / 2;
  world.eye = {middle, middle, 1.75};
  return world;
}

/// 10,000 trees of about 5,000 triangles, turned in any direction.
World forest(float detail) {
  constexpr double apart = 4;
  World world;
  const auto pieces = std::max(2u, static_cast<std::uint32_t>(20 * std::sqrt(detail)));
  SolidBuilder trunk(0.5f / std::sqrt(detail));
  trunk.add_round({0, 0, -2}, 2, 0.25f, 0.25f);
  world.meshes.push_back(trunk.take());
  append(world.meshes.front(), bumpy_ball(1.5, pieces), {0, 0, 0.75f});
  Random random(2);
  const int trees = count_along_side(100, detail);
  for (int i = 0; i < trees * trees; ++i) {
    const Vector3d place(apart * (i % trees), apart * (i / trees), 0);
    const Matrix3d turn = draw_rotation(random);
    world.instances.push_back({0, rounded_pose(turn, place + 1.5 * draw_in_unit_ball(random))});
  }
  const double middle = apart * (trees / 2) + apart / 2;
  world.eye = {middle, middle, 1};
  return world;
}

/// 20,000 boxes of twelve triangles, of many shapes, turned in any direction.
World bricks(float detail) {
  constexpr double size = 100;
  World world;
  SolidBuilder box(1);
  box.add_box({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f});
  world.meshes.push_back(box.take());
  Random random(3);
  const auto count = static_cast<int>(20'000 * detail);
  for (int i = 0; i < count; ++i) {
    const Vector3d edges(draw_between(0.25, 2, random), draw_between(0.25, 2, random), draw_between(0.25, 2, random));
    const Matrix3d linear = draw_rotation(random) * edges.asDiagonal();
    world.instances.push_back({0, rounded_pose(linear, size * draw_in_unit_cube(random))});
  }
  world.eye = Vector3d::Constant(size / 2);
  return world;
}

/// Draws a number from 1 to 10^6, all powers of ten alike. Roots are rounded alike everywhere.
double draw_size(Random& random) {
  double size = 1;
  double factor = 1e6;
  for (int bit = 0; bit < 24; ++bit) {
    factor = std::sqrt(factor);
    if (random.one_in(2)) size *= factor;
  }
  return size;
}

/// 5,000 boxes and balls that overlap in clusters. The largest ones are 10^6 times as large as the smallest ones.
World sizes(float detail) {
  constexpr double width = 4e6;
  World world;
  world.has_details = true;
  SolidBuilder box(1);
  box.add_box({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f});
  world.meshes.push_back(box.take());
  for (const std::uint32_t pieces : {4u, 12u}) world.meshes.push_back(bumpy_ball(0.5, pieces));
  struct Cluster {
    Vector3d centre;
    double reach;
  };
  std::vector<Cluster> clusters;
  Random random(5);
  const auto count = static_cast<std::size_t>(5000 * detail);
  while (clusters.size() < std::max<std::size_t>(1, count / 25)) {
    const Vector3d centre = width * (draw_in_unit_cube(random) - Vector3d::Constant(0.5));
    clusters.push_back({centre, draw_size(random)});
  }
  while (world.instances.size() < count) {
    const auto& [centre, reach] = clusters[random.below(clusters.size())];
    const std::size_t mesh = random.below(world.meshes.size());
    const double size = draw_size(random);
    const Matrix3d turn = draw_rotation(random);
    const Vector3d place = centre + (reach + size / 2) * draw_in_unit_ball(random);
    world.instances.push_back({mesh, rounded_pose(size * turn, place)});
  }
  return world;
}

/// A single ball of 70,000 triangles.
World one(const Posef& pose, float detail) {
  World world;
  const auto pieces = std::max(2u, static_cast<std::uint32_t>(76 * detail));
  world.meshes.push_back(bumpy_ball(0.5, pieces));
  world.instances.push_back({0, pose});
  world.eye = placed(pose, {0.75, 0.5, 0.25});
  return world;
}

Posef turned_pose() {
  Random random(4);
  const Matrix3d turn = draw_rotation(random);
  return rounded_pose(turn, {10, -20, 30});
}

struct WorldKind {
  std::string name;
  std::function<World(float)> build;
};

std::vector<WorldKind> all_worlds() {
  return {{"town", town},
          {"forest", forest},
          {"bricks", bricks},
          {"sizes", sizes},
          {"one", [](float detail) { return one({}, detail); }},
          {"one_moved",
           [](float detail) {
             return one(Posef::translated({10, -20, 30}), detail);
           }},
          {"one_turned", [](float detail) { return one(turned_pose(), detail); }}};
}

}  // namespace

std::size_t World::triangle_count() const {
  std::size_t count = 0;
  for (const PlacedMesh& instance : instances) count += meshes[instance.mesh].triangles.size();
  return count;
}

Boxd World::box() const {
  std::vector<Boxf> boxes;
  for (const auto& mesh : meshes) boxes.push_back(box_of(mesh.view()));
  Boxd all;
  for (const PlacedMesh& instance : instances) {
    const Boxd of_instance = placed(instance.pose, boxes[instance.mesh]);
    all.extend(of_instance.low);
    all.extend(of_instance.high);
  }
  return all;
}

Vector3d placed(const Posef& pose, const Vector3d& point) {
  return pose.linear.cast<double>() * point + pose.translation.cast<double>();
}

Boxd placed(const Posef& pose, const Boxf& box) {
  Boxd around;
  for (int corner = 0; corner < 8; ++corner) {
    Vector3d point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = double{(corner >> axis & 1) != 0 ? box.high[axis] : box.low[axis]};
    around.extend(placed(pose, point));
  }
  return around;
}

std::vector<std::string> world_names() {
  std::vector<std::string> names;
  for (const WorldKind& world : all_worlds()) names.push_back(world.name);
  return names;
}

World build_world(const std::string& name, float detail) {
  for (const WorldKind& world : all_worlds()) {
    if (world.name != name) continue;
    World built = world.build(detail);
    built.name = name;
    return built;
  }
  throw std::logic_error("there is no world called " + name);
}

std::vector<Posef> moved_poses(const World& world, std::uint64_t seed) {
  const Boxd box = world.box();
  const double reach = 0.0005 * (box.high - box.low).norm();
  Random random(seed);
  std::vector<Posef> poses;
  for (const auto& [mesh, pose] : world.instances) {
    const Matrix3d turn = turn_about_z(0.05 * random.symmetric<double>());
    poses.push_back(rounded_pose(turn * pose.linear.cast<double>(),
                                 pose.translation.cast<double>() + reach * draw_in_unit_ball(random)));
  }
  return poses;
}

}  // namespace surehit::benchmark
