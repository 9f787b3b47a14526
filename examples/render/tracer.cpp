#include "render/tracer.hpp"

#include <cstdint>
#include <vector>

#include "render/free_points.hpp"
#include "render/optics.hpp"

namespace surehit::example {
namespace {

/// Rays with less light than this are left out, to save time. On black they would still show a little: what is shown is
/// the root of the light, and that of 1/1024 is 1/32.
constexpr float too_faint = 1.0f / 1024;

/// Rays that are asked about together. The arrays have an element for each.
struct Wave {
  std::vector<Rayf> rays;
  std::vector<Medium> media;
  std::vector<Light> weights;  ///< The share of its light that goes to the pixel.
  std::vector<std::uint32_t> pixels;

  void add(const Rayf& ray, Medium medium, const Light& weight, std::uint32_t pixel) {
    if (weight.maxCoeff() < too_faint) return;
    rays.push_back(ray);
    media.push_back(medium);
    weights.push_back(weight);
    pixels.push_back(pixel);
  }
};

/// Where a ray arrives.
struct Surface {
  const Material* material;
  Light colour;
  Vector3f place;      ///< just before the surface
  Vector3f direction;  ///< of the ray, with length 1
  Vector3f normal;     ///< is interpolated, and points against the ray
  Vector3f flat;       ///< is that of the triangle, and points against the ray
};

/// Which square of a chess board a place is on.
bool is_second_square(const Eigen::Vector2f& place) {
  return (static_cast<std::int64_t>(std::floor(place.x())) + static_cast<std::int64_t>(std::floor(place.y()))) % 2 != 0;
}

Surface surface_at(const World& world, const Rayf& ray, const Hitf& hit, const Vector3f& place) {
  const Model& model = world.model();
  Surface surface{&model.material(hit.triangle), {}, place, ray.direction / ray.direction.norm(), {}, {}};
  const auto against_ray = [&](const Vector3f& normal) {
    return Vector3f(surface.direction.dot(normal) > 0 ? -normal : normal);
  };
  surface.colour = surface.material->colour;
  if (!model.texture_coordinates.empty() &&
      is_second_square(interpolated(model.texture_coordinates[hit.triangle], hit.u, hit.v))) {
    surface.colour = surface.material->second_colour;
  }
  surface.flat = against_ray(world.collider().normal(hit.triangle));
  surface.normal = surface.flat;
  if (model.normals.empty()) return surface;
  const Vector3f sum = interpolated(model.normals[hit.triangle], hit.u, hit.v);
  const float length = sum.norm();
  if (!(length > 0)) return surface;
  // Where the interpolated normal points away from the ray, the triangle's own one is the better of the two.
  const Vector3f normal = hit.side == Side::back ? Vector3f(-sum / length) : Vector3f(sum / length);
  if (normal.dot(surface.direction) < 0) surface.normal = normal;
  return surface;
}

/// The light of lamps that a surface sends back along the ray, without what it reflects and refracts.
class LampLight {
 public:
  explicit LampLight(const Stage& stage) : stage_(stage) {}

  /// Adds what all lamps would give to a surface, with a way to each.
  void add(const Surface& surface, const Light& weight, std::uint32_t pixel) {
    const Vector3f mirrored = reflected(surface.direction, surface.normal);
    for (const Lamp& lamp : stage_.lamps) {
      const Vector3f way = lamp.position - surface.place;
      const Vector3f towards = way / way.norm();
      const float cosine = towards.dot(surface.normal);
      if (!(cosine > 0)) continue;
      const Material& material = *surface.material;
      Light light = material.is_glass ? Light::Zero() : Light(cosine * surface.colour);
      const float aim = mirrored.dot(towards);
      if (material.highlight > 0 && aim > 0) light += material.highlight * whole_power(aim, material.shininess);
      ways_.push_back({surface.place, lamp.position});
      gifts_.push_back({weight * light * lamp.light, pixel});
    }
  }

  /// Gives the pixels what is not in the shadow.
  void give(const World& world, std::span<Light> lights, RayCounts& counts) const {
    std::vector<float> shares(ways_.size());
    counts.measure(RayKind::shadow, ways_.size(), [&] { world.light_shares(ways_, shares); });
    for (std::size_t i = 0; i < ways_.size(); ++i) lights[gifts_[i].pixel] += shares[i] * gifts_[i].light;
  }

 private:
  struct Gift {
    Light light;
    std::uint32_t pixel;
  };

  const Stage& stage_;
  std::vector<Segmentf> ways_;
  std::vector<Gift> gifts_;
};

/// The direction of a mirror image. It never leads into the surface.
Vector3f mirrored_direction(const Surface& surface) {
  const Vector3f direction = reflected(surface.direction, surface.normal);
  return direction.dot(surface.flat) > 0 ? direction : reflected(surface.direction, surface.flat);
}

/// Adds to a wave what glass reflects and lets through.
void add_rays_of_glass(const Surface& surface, Medium medium, const Light& weight, std::uint32_t pixel, Wave& next) {
  const float index = surface.material->refraction;
  const float ratio = medium == Medium::air ? 1 / index : index;
  Refraction refraction = refracted(surface.direction, surface.normal, ratio);
  if (refraction.direction.dot(surface.flat) > 0) refraction = refracted(surface.direction, surface.flat, ratio);
  const float share = refraction.reflected_share;
  next.add({surface.place, mirrored_direction(surface)}, medium, share * weight, pixel);
  if (share == 1) return;
  const Medium behind = medium == Medium::air ? Medium::glass : Medium::air;
  next.add({surface.place, refraction.direction}, behind, (1 - share) * weight, pixel);
}

/// What a wave arrives at. What misses everything gives its pixel the background.
struct Arrivals {
  Wave wave;
  std::vector<Hitf> hits;
};

Arrivals arrivals_of(const Wave& wave, std::span<const Hitf> hits, const Stage& stage, std::span<Light> lights) {
  Arrivals arrivals;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].triangle == no_triangle) {
      lights[wave.pixels[i]] += wave.weights[i] * background(stage, wave.rays[i].direction);
    } else {
      arrivals.wave.add(wave.rays[i], wave.media[i], wave.weights[i], wave.pixels[i]);
      arrivals.hits.push_back(hits[i]);
    }
  }
  return arrivals;
}

}  // namespace

void Tracer::trace(std::span<const Rayf> primary, std::span<Light> lights, RayCounts& counts) const {
  Wave wave;
  for (std::uint32_t i = 0; i < primary.size(); ++i) {
    lights[i] = Light::Zero();
    wave.add(primary[i], Medium::air, Light::Ones(), i);
  }
  std::vector<Hitf> hits;
  std::vector<Vector3f> places;
  for (int depth = 0; !wave.rays.empty() && depth <= max_depth_; ++depth) {
    hits.resize(wave.rays.size());
    counts.measure(depth == 0 ? RayKind::primary : RayKind::secondary, hits.size(),
                   [&] { world_.first_hits(wave.rays, wave.media, hits); });
    const Arrivals arrivals = arrivals_of(wave, hits, stage_, lights);
    const Wave& arrived = arrivals.wave;
    places.resize(arrived.rays.size());
    counts.measure(RayKind::free_point, places.size(),
                   [&] { free_points(world_, arrived.rays, arrived.media, arrivals.hits, places); });

    LampLight lamps(stage_);
    Wave next;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Surface surface = surface_at(world_, arrived.rays[i], arrivals.hits[i], places[i]);
      const Material& material = *surface.material;
      const std::uint32_t pixel = arrived.pixels[i];
      Light weight = arrived.weights[i];
      if (material.is_glass) {
        if (arrived.media[i] == Medium::air) lamps.add(surface, weight, pixel);
        add_rays_of_glass(surface, arrived.media[i], weight, pixel, next);
        continue;
      }
      if (material.mirror > 0) {
        const float share = polished_share(material.mirror, -surface.direction.dot(surface.normal));
        next.add({surface.place, mirrored_direction(surface)}, arrived.media[i], share * weight, pixel);
        weight *= 1 - share;
      }
      lights[pixel] += weight * surface.colour * stage_.ambient * (0.75f + 0.25f * surface.normal.z());
      lamps.add(surface, weight, pixel);
    }
    lamps.give(world_, lights, counts);
    wave = std::move(next);
  }
  for (std::size_t i = 0; i < wave.rays.size(); ++i) {
    lights[wave.pixels[i]] += wave.weights[i] * background(stage_, wave.rays[i].direction);
  }
}

}  // namespace surehit::example
