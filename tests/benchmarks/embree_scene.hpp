#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <surehit/hit.hpp>
#include <surehit/path.hpp>
#include <surehit/triangle_mesh_view.hpp>

#include "path_batch.hpp"

namespace surehit::benchmark {

/// Flush-to-zero and denormals-are-zero for as long as it lives: Embree's manual asks for both wherever it is called.
class FlushedDenormals {
 public:
  FlushedDenormals();
  ~FlushedDenormals();
  FlushedDenormals(const FlushedDenormals&) = delete;
  FlushedDenormals& operator=(const FlushedDenormals&) = delete;

 private:
  unsigned control_;
};

/// Returns the ray whose t is 0 at the start and 1 at the end, and goes from 0 to `last_t`.
[[nodiscard]] RTCRay ray_along(const Segmentf& segment, float last_t);

/// Sets t and the triangle of each hit, a ray at a time. Of an instance, the triangle is that of its mesh.
void first_hits_of_rays(RTCScene scene, const PathBatch& paths, std::span<Hitf> hits);
/// Sets what is blocked, a ray at a time.
void any_hits_of_rays(RTCScene scene, const PathBatch& paths, std::span<std::uint8_t> blocked);

struct EmbreeMode {
  bool robust;
  RTCBuildQuality quality;
};

/// One mesh on a device of its own, which works on the calling thread alone and counts its bytes.
class EmbreeScene {
 public:
  explicit EmbreeScene(EmbreeMode mode);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  void build(const TriangleMeshViewf& mesh);
  void rebuild(const TriangleMeshViewf& mesh);

  [[nodiscard]] RTCScene handle() const { return scene_; }
  [[nodiscard]] std::size_t memory_bytes() const { return static_cast<std::size_t>(bytes_.load()); }

 private:
  void copy_vertices(const TriangleMeshViewf& mesh);
  void throw_on_error() const;

  EmbreeMode mode_;
  std::atomic<std::ptrdiff_t> bytes_ = 0;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  RTCGeometry geometry_ = nullptr;  ///< owned by the scene
  float* vertices_ = nullptr;       ///< owned by the geometry
};

}  // namespace surehit::benchmark
