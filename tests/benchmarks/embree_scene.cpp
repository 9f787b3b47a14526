#include "embree_scene.hpp"

#include <pmmintrin.h>
#include <sys/types.h>
#include <xmmintrin.h>

#include <stdexcept>
#include <string>

namespace surehit::benchmark {

FlushedDenormals::FlushedDenormals() : control_(_mm_getcsr()) {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}

FlushedDenormals::~FlushedDenormals() { _mm_setcsr(control_); }

RTCRay ray_along(const Segmentf& segment, float last_t) {
  const Vector3f direction = segment.end - segment.start;
  RTCRay ray = {};
  ray.org_x = segment.start.x();
  ray.org_y = segment.start.y();
  ray.org_z = segment.start.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = last_t;
  ray.mask = ~0u;
  return ray;
}

void first_hits_of_rays(RTCScene scene, const PathBatch& paths, std::span<Hitf> hits) {
  const FlushedDenormals flushed;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    RTCRayHit query;
    query.ray = ray_along(paths.segments()[i], paths.last_t());
    query.hit.primID = RTC_INVALID_GEOMETRY_ID;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &query);
    hits[i].t = query.ray.tfar;
    hits[i].triangle = query.hit.primID;
  }
}

void any_hits_of_rays(RTCScene scene, const PathBatch& paths, std::span<std::uint8_t> blocked) {
  const FlushedDenormals flushed;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    RTCRay ray = ray_along(paths.segments()[i], paths.last_t());
    rtcOccluded1(scene, &context, &ray);
    blocked[i] = ray.tfar < 0 ? 1 : 0;
  }
}

EmbreeScene::EmbreeScene(EmbreeMode mode) : mode_(mode), device_(rtcNewDevice("threads=1,set_affinity=0")) {
  throw_on_error();
  const auto count = [](void* bytes, ssize_t change, bool) {
    *static_cast<std::atomic<std::ptrdiff_t>*>(bytes) += change;
    return true;
  };
  rtcSetDeviceMemoryMonitorFunction(device_, count, &bytes_);
}

EmbreeScene::~EmbreeScene() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void EmbreeScene::build(const TriangleMeshViewf& mesh) {
  const FlushedDenormals flushed;
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, mode_.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene_, mode_.quality);
  geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry_, mode_.quality);
  vertices_ = static_cast<float*>(rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                          3 * sizeof(float), mesh.vertex_count()));
  auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangle_count()));
  throw_on_error();
  copy_vertices(mesh);
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    for (std::size_t which = 0; which < 3; ++which) *corners++ = mesh.corner(i, which);
  }
  rtcCommitGeometry(geometry_);
  rtcAttachGeometry(scene_, geometry_);
  rtcReleaseGeometry(geometry_);
  rtcCommitScene(scene_);
  throw_on_error();
}

void EmbreeScene::rebuild(const TriangleMeshViewf& mesh) {
  const FlushedDenormals flushed;
  copy_vertices(mesh);
  rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(geometry_);
  rtcCommitScene(scene_);
  throw_on_error();
}

void EmbreeScene::copy_vertices(const TriangleMeshViewf& mesh) {
  float* to = vertices_;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i, to += 3) Vector3f::Map(to) = mesh.vertex(i);
}

void EmbreeScene::throw_on_error() const {
  const RTCError error = rtcGetDeviceError(device_);
  if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree fails with error " + std::to_string(error));
}

}  // namespace surehit::benchmark
