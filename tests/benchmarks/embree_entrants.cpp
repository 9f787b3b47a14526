#include <algorithm>

#include "embree_scene.hpp"
#include "entrants.hpp"

namespace surehit::benchmark {
namespace {

class EmbreeContender : public Contender {
 public:
  explicit EmbreeContender(EmbreeMode mode) : scene_(mode) {}

  void build(const TriangleMeshViewf& mesh) override { scene_.build(mesh); }
  void rebuild(const TriangleMeshViewf& mesh) override { scene_.rebuild(mesh); }
  [[nodiscard]] std::size_t memory_bytes() const override { return scene_.memory_bytes(); }

 protected:
  EmbreeScene scene_;
};

class EmbreeSingle : public EmbreeContender {
 public:
  using EmbreeContender::EmbreeContender;

  void first(const PathBatch& paths, std::span<Hitf> hits) const override {
    first_hits_of_rays(scene_.handle(), paths, hits);
  }
  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const override {
    any_hits_of_rays(scene_.handle(), paths, blocked);
  }
};

void set_rays(RTCRay8& rays, const PathOctet& octet, float last_t) {
  const auto copy = [](const float(&from)[8], float* to) { std::copy_n(from, 8, to); };
  copy(octet.start[0], rays.org_x);
  copy(octet.start[1], rays.org_y);
  copy(octet.start[2], rays.org_z);
  copy(octet.direction[0], rays.dir_x);
  copy(octet.direction[1], rays.dir_y);
  copy(octet.direction[2], rays.dir_z);
  std::fill_n(rays.tnear, 8, 0.0f);
  std::fill_n(rays.tfar, 8, last_t);
  std::fill_n(rays.time, 8, 0.0f);
  std::fill_n(rays.mask, 8, ~0u);
  std::fill_n(rays.flags, 8, 0u);
}

class EmbreePackets : public EmbreeContender {
 public:
  EmbreePackets(EmbreeMode mode, RTCIntersectContextFlags coherence) : EmbreeContender(mode), coherence_(coherence) {}

  void first(const PathBatch& paths, std::span<Hitf> hits) const override {
    const FlushedDenormals flushed;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherence_;
    for (std::size_t i = 0; i < paths.octets().size(); ++i) {
      RTCRayHit8 query;
      set_rays(query.ray, paths.octets()[i], paths.last_t());
      std::fill_n(query.hit.primID, 8, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(query.hit.geomID, 8, RTC_INVALID_GEOMETRY_ID);
      rtcIntersect8(all_valid, scene_.handle(), &context, &query);
      for (std::size_t lane = 0; lane < 8; ++lane) {
        hits[8 * i + lane].t = query.ray.tfar[lane];
        hits[8 * i + lane].triangle = query.hit.primID[lane];
      }
    }
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const override {
    const FlushedDenormals flushed;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherence_;
    for (std::size_t i = 0; i < paths.octets().size(); ++i) {
      RTCRay8 rays;
      set_rays(rays, paths.octets()[i], paths.last_t());
      rtcOccluded8(all_valid, scene_.handle(), &context, &rays);
      for (std::size_t lane = 0; lane < 8; ++lane) blocked[8 * i + lane] = rays.tfar[lane] < 0 ? 1 : 0;
    }
  }

 private:
  alignas(32) static constexpr int all_valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};

  RTCIntersectContextFlags coherence_;
};

static_assert(RTC_INVALID_GEOMETRY_ID == no_triangle, "a miss of Embree's is a miss of ours as it stands");

}  // namespace

std::vector<Entrant> embree_entrants() {
  std::vector<Entrant> entrants;
  for (const bool robust : {false, true}) {
    for (const RTCBuildQuality quality : {RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM}) {
      const EmbreeMode mode{robust, quality};
      const std::string library = std::string("Embree ") + (robust ? "robust" : "fast") +
                                  (quality == RTC_BUILD_QUALITY_LOW ? " low" : " medium");
      const auto packets = [&](const char* variant, RTCIntersectContextFlags coherence) {
        entrants.push_back({library, "x8", variant, [=] { return std::make_unique<EmbreePackets>(mode, coherence); }});
      };
      entrants.push_back({library, "x1", "", [=] { return std::make_unique<EmbreeSingle>(mode); }});
      packets("incoherent", RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
      packets("coherent", RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    }
  }
  return entrants;
}

}  // namespace surehit::benchmark
