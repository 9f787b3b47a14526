#include "character/trail_picture.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "character/capsule_sweep.hpp"
#include "render/corner_normals.hpp"
#include "render/shaded_picture.hpp"
#include "render/shapes.hpp"
#include "render/stage.hpp"

namespace surehit::example {
namespace {

constexpr std::array<Colour, 6> colours = {Colour::hex(0xffb02e), Colour::hex(0xff5d5d), Colour::hex(0x43d9a3),
                                           Colour::hex(0x58b4ff), Colour::hex(0xd58bff), Colour::hex(0xe6f25a)};
/// Trails are a little above the floor.
constexpr float foot = Body::radius + Body::half_height - 0.03f;

/// A colour as light, which the picture shows by its root.
Light light_of(const Colour& colour) {
  return {colour.red * colour.red, colour.green * colour.green, colour.blue * colour.blue};
}

/// A ball that is pulled apart into a capsule.
Model capsule_at(const Vector3f& position, const Colour& colour) {
  Model model = tessellated_sphere(position, Body::radius, 3);
  for (auto& vertex : model.mesh.vertices) {
    vertex[2] += vertex[2] >= position.z() ? Body::half_height : -Body::half_height;
  }
  set_material(model, {.colour = light_of(colour), .highlight = 0.3f, .shininess = 60});
  return model;
}

Stage hall_with(const Trails& trails) {
  Stage stage = level_stage();
  stage.eye = {40.2f, 20.6f, 3.2f};
  stage.target = {36.4f, 31.5f, 0.8f};
  stage.degrees = 56;
  stage.ambient = Light::Constant(0.24f);
  for (std::size_t i = 0; i < trails.positions().size(); ++i) {
    stage.model.append(capsule_at(trails.positions()[i].back(), colours[i % colours.size()]));
  }
  return stage;
}

/// Draws what the eye sees of a trail.
class TrailPen {
 public:
  TrailPen(Canvas& canvas, const Stage& stage, const Colliderf& collider)
      : canvas_(canvas),
        stage_(stage),
        collider_(collider),
        camera_(camera_of(stage, canvas.width(), canvas.height())) {}

  void draw(const std::vector<Vector3f>& positions, const Colour& colour) {
    for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
      draw_piece(positions[i] - Vector3f(0, 0, foot), positions[i + 1] - Vector3f(0, 0, foot), colour);
    }
  }

 private:
  void draw_piece(const Vector3f& from, const Vector3f& to, const Colour& colour) {
    const Vector3f forward = (stage_.target - stage_.eye).normalized();
    const float distance = forward.dot(from - stage_.eye);
    if (distance < 0.5f || forward.dot(to - stage_.eye) < 0.5f) return;
    for (const Vector3f& end : {from, to}) {
      if (collider_.any_hit(Segmentf{stage_.eye, end})) return;
    }
    const auto spot = [&](const Vector3f& point) {
      const Eigen::Vector2f place = camera_.place_of(point);
      return Spot{place.x(), place.y()};
    };
    const float width = 0.035f * static_cast<float>(canvas_.height()) / distance;
    canvas_.draw_line(spot(from), spot(to), width, colour, 0.9f);
  }

  Canvas& canvas_;
  const Stage& stage_;
  const Colliderf& collider_;
  Camera camera_;
};

}  // namespace

void Trails::note(std::span<const Character> characters) {
  positions_.resize(characters.size());
  for (std::size_t i = 0; i < characters.size(); ++i) positions_[i].push_back(characters[i].position);
}

Canvas draw_trails(const Trails& trails, int width, int height, unsigned threads) {
  const Stage stage = hall_with(trails);
  const World world(stage.model, Culling::none);
  RayCounts counts;
  Canvas canvas =
      draw_shaded(world, stage, {.width = width, .height = height, .samples = 2, .threads = threads}, counts);
  TrailPen pen(canvas, stage, world.collider());
  for (std::size_t i = 0; i < trails.positions().size(); ++i) {
    pen.draw(trails.positions()[i], colours[i % colours.size()]);
  }
  return canvas;
}

}  // namespace surehit::example
