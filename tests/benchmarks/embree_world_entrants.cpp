#include <algorithm>
#include <stdexcept>

#include "embree_scene.hpp"
#include "world_entrants.hpp"

namespace surehit::benchmark {
namespace {

/// Instances of scenes of one mesh each, on a device that works on the calling thread alone. The quality is that of the
/// scene of instances.
class EmbreeWorld : public WorldContender {
 public:
  explicit EmbreeWorld(EmbreeMode mode) : mode_(mode), device_(rtcNewDevice("threads=1,set_affinity=0")) {
    throw_on_error();
  }
  ~EmbreeWorld() override {
    release_scenes();
    rtcReleaseDevice(device_);
  }

  void build(const World& world) override {
    const FlushedDenormals flushed;
    release_scenes();
    for (const auto& mesh : world.meshes) meshes_.push_back(scene_of(mesh.view()));
    scene_ = new_scene(mode_.quality);
    world_ = &world;
    for (const PlacedMesh& placed : world.instances) instances_.push_back(attach(placed));
    rtcCommitScene(scene_);
    throw_on_error();
  }

  void move(std::span<const Posef> poses) override {
    const FlushedDenormals flushed;
    for (std::size_t i = 0; i < poses.size(); ++i) place(instances_[i].geometry, poses[i]);
    rtcCommitScene(scene_);
    throw_on_error();
  }

  void exchange_one() override {
    const FlushedDenormals flushed;
    rtcDetachGeometry(scene_, instances_[next_].id);
    instances_[next_] = attach(world_->instances[next_]);
    next_ = (next_ + 1) % instances_.size();
    rtcCommitScene(scene_);
    throw_on_error();
  }

  void first(const PathBatch& paths, std::span<Hitf> hits) override { first_hits_of_rays(scene_, paths, hits); }
  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) override {
    any_hits_of_rays(scene_, paths, blocked);
  }

 private:
  [[nodiscard]] RTCScene new_scene(RTCBuildQuality quality) const {
    const RTCScene scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, mode_.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(scene, quality);
    return scene;
  }

  [[nodiscard]] RTCScene scene_of(const TriangleMeshViewf& mesh) const {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertex_count()));
    auto* corner = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangle_count()));
    throw_on_error();
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i, vertex += 3) Vector3f::Map(vertex) = mesh.vertex(i);
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
      for (std::size_t which = 0; which < 3; ++which) *corner++ = mesh.corner(i, which);
    }
    rtcCommitGeometry(geometry);
    const RTCScene scene = new_scene(RTC_BUILD_QUALITY_MEDIUM);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    throw_on_error();
    return scene;
  }

  /// An instance, which the scene owns.
  struct Attached {
    RTCGeometry geometry;
    unsigned id;
  };

  [[nodiscard]] Attached attach(const PlacedMesh& placed) const {
    const RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, meshes_[placed.mesh]);
    rtcSetGeometryTimeStepCount(instance, 1);
    place(instance, placed.pose);
    const unsigned id = rtcAttachGeometry(scene_, instance);
    rtcReleaseGeometry(instance);
    return {instance, id};
  }

  static void place(RTCGeometry instance, const Posef& pose) {
    std::array<float, 12> columns;
    Eigen::Map<Posef::Matrix3>(columns.data()) = pose.linear;
    Vector3f::Map(columns.data() + 9) = pose.translation;
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    rtcCommitGeometry(instance);
  }

  void release_scenes() {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    for (const RTCScene mesh : meshes_) rtcReleaseScene(mesh);
    scene_ = nullptr;
    meshes_.clear();
    instances_.clear();
  }

  void throw_on_error() const {
    const RTCError error = rtcGetDeviceError(device_);
    if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree fails with error " + std::to_string(error));
  }

  EmbreeMode mode_;
  RTCDevice device_ = nullptr;
  std::vector<RTCScene> meshes_;
  RTCScene scene_ = nullptr;
  const World* world_ = nullptr;
  std::vector<Attached> instances_;
  std::size_t next_ = 0;  ///< the instance that is exchanged next
};

}  // namespace

std::vector<WorldEntrant> embree_world_entrants() {
  std::vector<WorldEntrant> entrants;
  const auto add = [&](const std::string& library, EmbreeMode mode) {
    entrants.push_back({library, "x1", [=] { return std::make_unique<EmbreeWorld>(mode); }});
  };
  add("Embree fast medium", {false, RTC_BUILD_QUALITY_MEDIUM});
  add("Embree robust medium", {true, RTC_BUILD_QUALITY_MEDIUM});
  add("Embree fast low", {false, RTC_BUILD_QUALITY_LOW});
  return entrants;
}

}  // namespace surehit::benchmark
