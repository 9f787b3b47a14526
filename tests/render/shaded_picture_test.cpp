#include "render/shaded_picture.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <string>

#include "picture/pixel_bytes.hpp"
#include "render/shapes.hpp"
#include "support/instruction_sets.hpp"
#include "support/sanitizer.hpp"

namespace surehit::example::shaded_picture_test {
namespace {

constexpr ShadingOptions small{.width = 160, .height = 120};

Canvas draw(const Stage& stage, const ShadingOptions& options = small, Culling culling = Culling::none) {
  RayCounts counts;
  return draw_shaded(World(stage.model, culling), stage, options, counts);
}

/// A stage that is dark but for what a test puts there.
Stage dark_stage(const Vector3f& eye, const Vector3f& target) {
  Stage stage;
  stage.ambient = Light::Zero();
  stage.horizon = stage.zenith = Light::Zero();
  stage.eye = eye;
  stage.target = target;
  stage.degrees = 50;
  return stage;
}

void add(Stage& stage, Model model, const Material& material) {
  set_material(model, material);
  stage.model.append(model);
}

/// Four corners, which turn to the left as its normal sees them.
Model rectangle(const std::array<Vector3f, 4>& corners) {
  Model model;
  for (const Vector3f& corner : corners) model.mesh.vertices.push_back({corner.x(), corner.y(), corner.z()});
  model.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Vector3f normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  model.normals.assign(2, {normal, normal, normal});
  const Eigen::Vector2f place = Eigen::Vector2f::Zero();
  model.texture_coordinates.assign(2, {place, place, place});
  return model;
}

/// The two sides of a level slab of glass that is wider than what is seen.
void add_slab(Stage& stage, float bottom, float top, float refraction) {
  constexpr float far = 200;
  const Material glass{.is_glass = true, .refraction = refraction};
  add(stage, rectangle({{{-far, -far, top}, {far, -far, top}, {far, far, top}, {-far, far, top}}}), glass);
  add(stage, rectangle({{{-far, -far, bottom}, {-far, far, bottom}, {far, far, bottom}, {far, -far, bottom}}}), glass);
}

/// Where the ray of a pixel meets the plane z = 0.
Vector3f on_ground(const Camera& camera, int column, int row) {
  const Rayf ray = camera.ray(column, row);
  return ray.origin - ray.origin.z() / ray.direction.z() * ray.direction;
}

TEST(ShadedPicture, silhouette_of_a_sphere_is_a_cone) {
  const Vector3f centre(1, 7, 2);
  constexpr double radius = 1.5;
  Stage stage = dark_stage({-1, -2, 3}, {0.6f, 6.5f, 2.3f});
  stage.ambient = Light::Ones();
  add(stage, tessellated_sphere(centre, radius, 6), {.colour = Light::Ones(), .second_colour = Light::Ones()});
  const Canvas canvas = draw(stage);
  const Camera camera = camera_of(stage, small.width, small.height);
  // The flat triangles are inside of the sphere, by less than this share of the radius.
  constexpr double sagitta = 1e-4;
  int inside = 0;
  int outside = 0;
  for (int j = 0; j < small.height; ++j) {
    for (int i = 0; i < small.width; ++i) {
      const Rayf ray = camera.ray(i, j);
      const Vector3d direction = ray.direction.cast<double>().normalized();
      const Vector3d way = (centre - ray.origin).cast<double>();
      const double distance = (way - way.dot(direction) * direction).norm();
      const bool is_lit = canvas.at(i, j).red > 0;
      if (distance < radius * (1 - sagitta)) {
        ++inside;
        EXPECT_TRUE(is_lit) << i << ' ' << j;
      } else if (distance > radius * (1 + 1e-6)) {
        ++outside;
        EXPECT_FALSE(is_lit) << i << ' ' << j;
      }
    }
  }
  EXPECT_GT(inside, 1'000);
  EXPECT_GT(outside, 1'000);
  EXPECT_GT(inside + outside, small.width * small.height - 10) << "hardly any pixel is in doubt";
}

TEST(ShadedPicture, shadow_ends_where_the_lamp_says) {
  // A board over x < 0, and a lamp twice as high: the shadow ends at x = 1.
  Stage stage = dark_stage({2, -3, 5}, {1.2f, 0, 0});
  add(stage, chess_board({0, 0, 0}, 40, 40), {});
  add(stage, chess_board({-10, 0, 1}, 20, 20), {});
  stage.lamps = {{{-1, 0, 2}, Light::Ones()}};
  const Canvas canvas = draw(stage);
  const Camera camera = camera_of(stage, small.width, small.height);
  const Colliderf board(chess_board({-10, 0, 1}, 20, 20).mesh.view());
  int dark = 0;
  int lit = 0;
  for (int j = 0; j < small.height; ++j) {
    for (int i = 0; i < small.width; ++i) {
      if (board.any_hit(camera.ray(i, j))) continue;
      const float x = on_ground(camera, i, j).x();
      if (std::abs(x - 1) < 1e-5f || x > 19) continue;
      const bool is_lit = canvas.at(i, j).red > 0;
      EXPECT_EQ(is_lit, x > 1) << i << ' ' << j << " at x = " << x;
      ++(is_lit ? lit : dark);
    }
  }
  EXPECT_GT(dark, 1'000);
  EXPECT_GT(lit, 1'000);
}

TEST(ShadedPicture, nothing_shades_itself) {
  // Grazing light on a plane of many triangles, at heights that are no round numbers.
  Stage stage = dark_stage({0.7f, -6, 3.1f}, {0, 0, 0.1f});
  add(stage, chess_board({0.1f, 0.2f, 0.3f}, 9.7f, 97), {});
  stage.lamps = {{{40, 3, 0.31f}, Light::Ones()}};
  const World world(stage.model, Culling::none);
  const Camera camera = camera_of(stage, small.width, small.height);
  const Canvas canvas = draw(stage);
  int hits = 0;
  for (int j = 0; j < small.height; ++j) {
    for (int i = 0; i < small.width; ++i) {
      if (!world.collider().any_hit(camera.ray(i, j))) continue;
      ++hits;
      EXPECT_GT(canvas.at(i, j).red, 0) << i << ' ' << j;
    }
  }
  EXPECT_GT(hits, 5'000);
}

TEST(ShadedPicture, mirror_shows_a_point_where_it_must) {
  Stage stage = dark_stage({0, -8, 3}, {0, 0, 0});
  stage.ambient = Light::Ones();
  const Vector3f place(0.7f, 0.4f, 1.3f);
  const Light red(1, 0, 0);
  add(stage, chess_board({0, 0, 0}, 40, 40), {.colour = Light(0, 1, 0), .second_colour = Light(0, 1, 0), .mirror = 1});
  add(stage, tessellated_sphere(place, 0.1f, 2), {.colour = red, .second_colour = red});
  const Canvas canvas = draw(stage);
  const Camera camera = camera_of(stage, small.width, small.height);
  const auto colour_at = [&](const Vector3f& point) {
    const Eigen::Vector2f spot = camera.place_of(point);
    return canvas.at(static_cast<int>(spot.x()), static_cast<int>(spot.y()));
  };
  const Vector3f image(place.x(), place.y(), -place.z());
  EXPECT_GT(colour_at(place).red, 0.5f);
  EXPECT_GT(colour_at(image).red, 0.5f);
  EXPECT_EQ(colour_at(image).green, 0) << "a perfect mirror has no colour of its own";
  EXPECT_EQ(colour_at(image + Vector3f(0.3f, 0, 0)).red, 0) << "beside the image";
}

TEST(ShadedPicture, glass_that_refracts_as_air_is_invisible) {
  Stage stage = dark_stage({0, -8, 3}, {0, 0, 1});
  stage.ambient = Light::Ones();
  add(stage, chess_board({0, 0, 0}, 40, 40), {.second_colour = Light::Zero()});
  const Canvas without = draw(stage);
  add(stage, tessellated_sphere({0.2f, 0.1f, 1.5f}, 1.4f, 4), {.is_glass = true, .refraction = 1});
  const Canvas with = draw(stage);
  int different = 0;
  for (int j = 0; j < small.height; ++j) {
    for (int i = 0; i < small.width; ++i) {
      different += std::abs(with.at(i, j).red - without.at(i, j).red) > 1e-3f;
    }
  }
  // Directions are rounded again, which may take a ray to the next square.
  EXPECT_LT(different, 10);
  stage.model.materials.back().refraction = 1.5f;
  const Canvas refracting = draw(stage);
  different = 0;
  for (int j = 0; j < small.height; ++j) {
    for (int i = 0; i < small.width; ++i) {
      different += std::abs(refracting.at(i, j).red - without.at(i, j).red) > 0.1f;
    }
  }
  EXPECT_GT(different, 500);
}

TEST(ShadedPicture, slab_of_glass_shifts_what_is_behind_it) {
  constexpr float thickness = 1;
  constexpr float index = 1.5f;
  Stage stage = dark_stage({0.1f, -4, 4}, {0, 0, 0});
  stage.ambient = Light::Ones();
  add(stage, chess_board({0, 0, 0}, 200, 200), {.second_colour = Light::Zero()});
  add_slab(stage, 1, 1 + thickness, index);
  const Canvas canvas = draw(stage);
  const Camera camera = camera_of(stage, small.width, small.height);
  const auto is_first_square = [](float x, float y) { return (std::lround(std::floor(x) + std::floor(y)) & 1) == 0; };
  int shifted = 0;
  for (int j = 0; j < small.height; ++j) {
    for (int i = 0; i < small.width; ++i) {
      const Vector3f straight = on_ground(camera, i, j);
      const Vector3f direction = camera.ray(i, j).direction.normalized();
      const float sine = direction.head<2>().norm();
      // Inside, the ray is steeper, as Snell says.
      const float tangent = sine / std::sqrt(1 - sine * sine);
      const float tangent_inside = sine / std::sqrt(index * index - sine * sine);
      const Eigen::Vector2f place =
          straight.head<2>() - thickness * (tangent - tangent_inside) * direction.head<2>() / sine;
      const auto is_in_doubt = [](float x) { return std::abs(x - std::round(x)) < 1e-3f; };
      if (is_in_doubt(place.x()) || is_in_doubt(place.y())) continue;
      const bool is_first = is_first_square(place.x(), place.y());
      EXPECT_EQ(canvas.at(i, j).red > 0.5f, is_first) << i << ' ' << j;
      shifted += is_first != is_first_square(straight.x(), straight.y());
    }
  }
  EXPECT_GT(shifted, 3'000) << "without the shift, all of these would be wrong";
}

TEST(ShadedPicture, glass_turns_light_round_beyond_the_critical_angle) {
  // Half of a cube, cut from edge to edge. The ray goes straight in, and meets the cut at 45 degrees. For an index of
  // 1.5, this is beyond the critical angle of 41.8 degrees, so all light comes from the floor below. For an index
  // of 1.3, the angle is 50.3 degrees, and hardly any does.
  const auto middle = [&](float index) {
    Stage stage = dark_stage({0, -3, 1}, {0, 1, 1});
    stage.ambient = Light::Ones();
    const Light white = Light::Ones();
    add(stage, chess_board({0, 0, -1}, 4, 4), {.colour = white, .second_colour = white});
    const Material glass{.is_glass = true, .refraction = index};
    add(stage, rectangle({{{-1, 0, 0}, {1, 0, 0}, {1, 0, 2}, {-1, 0, 2}}}), glass);
    add(stage, rectangle({{{-1, 0, 0}, {-1, 2, 0}, {1, 2, 0}, {1, 0, 0}}}), glass);
    add(stage, rectangle({{{-1, 0, 2}, {1, 0, 2}, {1, 2, 0}, {-1, 2, 0}}}), glass);
    const float root = draw(stage).at(80, 60).red;
    return root * root;
  };
  // What goes in and out loses four percent each time.
  EXPECT_NEAR(middle(1.5f), 0.96f * 0.96f, 2e-3);
  EXPECT_LT(middle(1.3f), 0.1f);
}

TEST(ShadedPicture, glass_dims_the_light_of_lamps) {
  Stage stage = dark_stage({0, 0, 1}, {0, 0.001f, 0});
  add(stage, chess_board({0, 0, 0}, 40, 4), {});
  stage.lamps = {{{1, 1, 6}, Light::Constant(0.5f)}};
  const auto middle = [&] {
    const float root = draw(stage).at(80, 60).red;
    return root * root;
  };
  const float without = middle();
  ASSERT_GT(without, 0.1f);
  add_slab(stage, 3, 4, 1.5f);
  EXPECT_NEAR(middle(), 0.7f * without, 1e-6);
}

TEST(ShadedPicture, culled_sides_are_not_there) {
  Stage stage = dark_stage({0, 0, 5}, {0, 0.001f, 0});
  stage.ambient = Light::Ones();
  add(stage, chess_board({0, 0, 0}, 40, 4), {});
  const auto middle = [&](Culling culling) { return draw(stage, small, culling).at(80, 60).red; };
  EXPECT_GT(middle(Culling::none), 0);
  EXPECT_GT(middle(Culling::back), 0);
  EXPECT_EQ(middle(Culling::front), 0);
  stage.eye.z() = -5;
  EXPECT_GT(middle(Culling::none), 0);
  EXPECT_EQ(middle(Culling::back), 0);
}

TEST(ShadedPicture, depth_limits_what_mirrors_show) {
  // Between two mirrors, a ray is reflected again and again. At the limit, it sees the background.
  Stage stage = dark_stage({0, 0, 1}, {0, 0.001f, 0});
  stage.horizon = stage.zenith = Light::Ones();
  const Material mirror{.colour = Light::Zero(), .second_colour = Light::Zero(), .mirror = 0.5f};
  add(stage, chess_board({0, 0, 0}, 400, 4), mirror);
  add(stage, chess_board({0, 0, 2}, 400, 4), mirror);
  const auto middle = [&](int depth) {
    ShadingOptions options = small;
    options.max_depth = depth;
    const float root = draw(stage, options).at(80, 60).red;
    return root * root;
  };
  EXPECT_NEAR(middle(0), 0.5f, 1e-3);
  EXPECT_NEAR(middle(1), 0.25f, 1e-3);
  EXPECT_NEAR(middle(4), 1.0f / 32, 1e-3);
}

TEST(ShadedPicture, more_samples_are_a_mean) {
  Stage stage = dark_stage({0, -8, 3}, {0, 0, 1});
  stage.ambient = Light::Ones();
  add(stage, chess_board({0, 0, 0}, 40, 40), {.second_colour = Light::Zero()});
  ShadingOptions fine = small;
  fine.width *= 2;
  fine.height *= 2;
  ShadingOptions averaged = small;
  averaged.samples = 2;
  const Canvas fine_canvas = draw(stage, fine);
  const Canvas canvas = draw(stage, averaged);
  const auto light = [](const Canvas& from, int x, int y) { return from.at(x, y).red * from.at(x, y).red; };
  for (int j = 0; j < small.height; ++j) {
    for (int i = 0; i < small.width; ++i) {
      const float mean = (light(fine_canvas, 2 * i, 2 * j) + light(fine_canvas, 2 * i + 1, 2 * j) +
                          light(fine_canvas, 2 * i, 2 * j + 1) + light(fine_canvas, 2 * i + 1, 2 * j + 1)) /
                         4;
      ASSERT_NEAR(light(canvas, i, j), mean, 1e-5) << i << ' ' << j;
    }
  }
}

/// So many pixels that there are several batches.
constexpr ShadingOptions several_batches{
    .width = test::has_sanitizer ? 192 : 320, .height = test::has_sanitizer ? 108 : 180, .samples = 1};

TEST(ShadedPicture, is_the_same_for_any_number_of_threads) {
  const Stage stage = exercise_stage();
  const std::string alone = pixel_bytes(draw(stage, several_batches));
  for (const unsigned threads : {2u, 3u, 8u}) {
    ShadingOptions options = several_batches;
    options.threads = threads;
    EXPECT_EQ(pixel_bytes(draw(stage, options)), alone) << threads;
  }
}

TEST(ShadedPicture, is_the_same_on_every_instruction_set) {
  for (const Stage& stage : {exercise_stage(), level_stage()}) {
    const std::string best = pixel_bytes(draw(stage, several_batches));
    for (const std::int64_t target : test::instruction_sets()) {
      const test::ForcedInstructionSet forced(target);
      EXPECT_EQ(pixel_bytes(draw(stage, several_batches)), best) << test::name_of_instruction_set(target);
    }
  }
}

TEST(ShadedPicture, rays_of_either_length_show_the_same) {
  Stage stage = exercise_stage();
  ShadingOptions options = small;
  const Canvas as_is = draw(stage, options);
  options.length = DirectionLength::unit;
  const Canvas unit = draw(stage, options);
  int different = 0;
  for (int j = 0; j < small.height; ++j) {
    for (int i = 0; i < small.width; ++i) {
      different += std::abs(as_is.at(i, j).red - unit.at(i, j).red) > 0.02f;
    }
  }
  EXPECT_LT(different, small.width * small.height / 200) << "rounding moves a few rays over edges";
}

TEST(ShadedPicture, counts_its_rays) {
  const Stage stage = exercise_stage();
  RayCounts counts;
  static_cast<void>(draw_shaded(World(stage.model, Culling::none), stage, small, counts));
  EXPECT_EQ(counts.rays(RayKind::primary), std::size_t{160 * 120});
  EXPECT_GT(counts.rays(RayKind::shadow), 1'000u);
  EXPECT_GT(counts.rays(RayKind::secondary), 1'000u);
  EXPECT_GT(counts.rays(RayKind::free_point), 1'000u);
  for (const char* name : {"primary", "shadow", "secondary", "free points", "M rays/s"}) {
    EXPECT_NE(counts.text().find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace surehit::example::shaded_picture_test
