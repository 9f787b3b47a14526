#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <surehit/executor.hpp>
#include <surehit/hit.hpp>
#include <surehit/triangle_mesh_view.hpp>

#include "path_batch.hpp"

namespace surehit::benchmark {

/// A library, asked in one way.
class Contender {
 public:
  Contender() = default;
  virtual ~Contender() = default;
  Contender(const Contender&) = delete;
  Contender& operator=(const Contender&) = delete;

  /// From nothing. Copies what it needs of the mesh.
  virtual void build(const TriangleMeshViewf& mesh) = 0;
  /// The triangles of the last build with their vertices moved.
  virtual void rebuild(const TriangleMeshViewf& mesh) { build(mesh); }
  /// Returns the size of what the build left behind, copied geometry included.
  [[nodiscard]] virtual std::size_t memory_bytes() const = 0;

  /// Sets t and the triangle of each hit. The triangle is `no_triangle` for a miss.
  virtual void first(const PathBatch& paths, std::span<Hitf> hits) const = 0;
  virtual void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const = 0;

  /// `first` on the executor's threads. A library that has no tasks of its own is given the same paths in `parts`.
  virtual void first_on_threads([[maybe_unused]] const PathBatch& paths, std::span<const PathBatch> parts,
                                Executor executor, std::span<Hitf> hits) const {
    executor.run(parts.size(), [&](std::size_t index) {
      std::size_t before = 0;
      for (const PathBatch& part : parts.first(index)) before += part.size();
      first(parts[index], hits.subspan(before, parts[index].size()));
    });
  }
};

}  // namespace surehit::benchmark
