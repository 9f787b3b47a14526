#include "render/world.hpp"

#include <algorithm>

namespace surehit::example {
namespace {

/// The share of light that goes through all of a glass body.
constexpr float light_through_glass = 0.7f;

/// The rule of `World`, for a batch of paths.
class SeenSides {
 public:
  SeenSides(const Model& model, std::span<const Medium> media, Culling culling)
      : model_(model), media_(media), culling_(culling) {}

  bool operator()(std::size_t path, const Hitf& hit) const {
    if (model_.material(hit.triangle).is_glass) {
      return hit.side == (media_[path] == Medium::glass ? Side::back : Side::front);
    }
    switch (culling_) {
      case Culling::back:
        return hit.side == Side::front;
      case Culling::front:
        return hit.side == Side::back;
      case Culling::none:
        break;
    }
    return true;
  }

 private:
  const Model& model_;
  std::span<const Medium> media_;
  Culling culling_;
};

}  // namespace

World::World(const Model& model, Culling culling) : model_(model), culling_(culling) {
  std::vector<std::uint32_t> masks;
  for (std::uint32_t i = 0; i < model.mesh.triangles.size(); ++i) {
    const bool is_glass = model.material(i).is_glass;
    has_glass_ |= is_glass;
    masks.push_back(is_glass ? glass_mask : solid_mask);
  }
  if (const BuildResult built = collider_.try_build(model.mesh.view(), {.masks = masks}); !built) throw built.error();
}

void World::first_hits(std::span<const Rayf> rays, std::span<const Medium> media, std::span<Hitf> hits) const {
  const SeenSides filter(model_, media, culling_);
  if (has_glass_) {
    ask(rays, hits, {.filter = filter});
  } else {
    first_hits(rays, hits);
  }
}

void World::any_hits(std::span<const Segmentf> segments, std::span<const Medium> media,
                     std::span<std::uint8_t> blocked) const {
  const SeenSides filter(model_, media, culling_);
  if (has_glass_) {
    ask(segments, blocked, {.filter = filter});
  } else {
    ask(segments, blocked, {.options = options()});
  }
}

void World::light_shares(std::span<const Segmentf> segments, std::span<float> shares) const {
  std::vector<std::uint8_t> blocked(segments.size());
  QueryOptionsf options = this->options();
  options.mask = solid_mask;
  ask(segments, blocked, {.options = options});
  for (std::size_t i = 0; i < blocked.size(); ++i) shares[i] = blocked[i] != 0 ? 0.0f : 1.0f;
  if (!has_glass_) return;
  ask(segments, blocked, {.options = {.mask = glass_mask}});
  for (std::size_t i = 0; i < blocked.size(); ++i) {
    if (blocked[i] != 0) shares[i] *= light_through_glass;
  }
}

void World::ask(std::span<const Rayf> rays, std::span<Hitf> hits, const BatchOptionsf& options) const {
  if (gpu_ != nullptr) {
    gpu_->first_hits(rays, hits, options);
  } else {
    collider_.first_hits(rays, hits, options);
  }
}

void World::ask(std::span<const Segmentf> segments, std::span<std::uint8_t> blocked,
                const BatchOptionsf& options) const {
  if (gpu_ != nullptr) {
    gpu_->any_hits(segments, blocked, options);
  } else {
    collider_.any_hits(segments, blocked, options);
  }
}

}  // namespace surehit::example
