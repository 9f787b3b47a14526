#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <surehit/executor.hpp>
#include <surehit/scene.hpp>
#include <vector>

namespace surehit::example {

/// What an instance of a town blocks: a bit of its mask. Glass blocks movement but not sight. An open door blocks
/// nothing.
enum Blocks : std::uint32_t { blocks_movement = 1, blocks_sight = 2 };

/// A town of 400 plots with houses, gardens, colonnades and markets. It is a scene of 2,000 instances of a dozen
/// meshes. Metres, z up; the ground is at z = 0.
class Town {
 public:
  static constexpr std::size_t plots_in_a_row = 20;
  static constexpr float plot_size = 10;
  static constexpr float size = plot_size * plots_in_a_row;
  /// Nothing stands so near to the edge of a plot.
  static constexpr float street_half_width = 1;

  /// Draws what is on which plot.
  explicit Town(std::uint64_t seed);

  /// Opens and closes doors as they are in this tick.
  void set_doors(std::uint32_t tick, const std::optional<Executor>& executor);

  [[nodiscard]] const Scenef& scene() const { return scene_; }
  /// The number of triangles of all instances.
  [[nodiscard]] std::size_t triangle_count() const;

 private:
  Scenef scene_;
  std::vector<InstanceId> doors_;
};

}  // namespace surehit::example
