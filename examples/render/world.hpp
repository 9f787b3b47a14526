#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <surehit/collider.hpp>
#include <vector>

#include "command_line/gpu_batches.hpp"
#include "render/model.hpp"

namespace surehit::example {

/// What a ray goes through.
enum class Medium : std::uint8_t { air, glass };

/// A model that rays are asked about, in batches.
///
/// A ray in air meets glass from the front alone, and a ray in glass from the back alone. So a ray that is refracted
/// may start just before the surface that it goes through: it does not meet this surface again, and no neighbour of it.
/// This needs closed glass, with normals that point outwards. A ray sees all else as `culling` says.
class World {
 public:
  /// Builds a collider of the model, which must outlive this. Throws InvalidMesh.
  World(const Model& model, Culling culling);
  /// Asks a GPU from now on, as `GpuBatches` says. The answers are the same. Where there is glass, first hits are left
  /// to the host, because the rule about glass is a filter.
  void use_gpu(const std::string& name) { gpu_ = std::make_unique<GpuBatches>(collider_, name); }
  /// Returns the number of rays that are asked about at once.
  [[nodiscard]] std::size_t rays_of_a_batch() const { return gpu_ != nullptr ? 1 << 18 : 1 << 14; }
  /// The GPU that is asked, or null.
  [[nodiscard]] const GpuBatches* gpu() const { return gpu_.get(); }

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const Colliderf& collider() const { return collider_; }
  [[nodiscard]] bool has_glass() const { return has_glass_; }
  /// What narrows the queries, besides the rule about glass.
  [[nodiscard]] QueryOptionsf options() const { return {.culling = culling_}; }

  /// Sets `hits[i]` to what ray i first meets.
  void first_hits(std::span<const Rayf> rays, std::span<const Medium> media, std::span<Hitf> hits) const;
  /// Does the same without the rule about glass.
  void first_hits(std::span<const Rayf> rays, std::span<Hitf> hits) const { ask(rays, hits, {.options = options()}); }
  /// Sets `blocked[i]` to 1 if segment i meets anything, and to 0 otherwise.
  void any_hits(std::span<const Segmentf> segments, std::span<const Medium> media,
                std::span<std::uint8_t> blocked) const;
  /// Sets `shares[i]` to the share of a lamp's light that arrives at the other end of segment i. Solid surfaces block
  /// the light, and glass dims it.
  void light_shares(std::span<const Segmentf> segments, std::span<float> shares) const;

 private:
  static constexpr std::uint32_t solid_mask = 1;
  static constexpr std::uint32_t glass_mask = 2;

  void ask(std::span<const Rayf> rays, std::span<Hitf> hits, const BatchOptionsf& options) const;
  void ask(std::span<const Segmentf> segments, std::span<std::uint8_t> blocked, const BatchOptionsf& options) const;

  const Model& model_;
  Culling culling_;
  bool has_glass_ = false;
  Colliderf collider_;
  std::unique_ptr<GpuBatches> gpu_;
};

}  // namespace surehit::example
