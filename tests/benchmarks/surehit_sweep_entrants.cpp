#include <algorithm>
#include <surehit/collider.hpp>
#include <surehit/scene.hpp>

#include "sweep_entrants.hpp"

namespace surehit::benchmark {
namespace {

class InMesh : public SweepContender {
 public:
  void build(const TriangleMeshViewf& mesh) override { asked_ = Colliderf(mesh); }

 protected:
  using PathHit = Hitf;
  using Touch = ShapeHitf;

  Colliderf asked_;
};

class InWorld : public WorldSweepContender {
 public:
  void build(const World& world) override {
    std::vector<std::shared_ptr<const Colliderf>> colliders;
    for (const auto& mesh : world.meshes) colliders.push_back(std::make_shared<Colliderf>(mesh.view()));
    asked_ = {};
    for (const auto& [mesh, pose] : world.instances) asked_.add(colliders[mesh], pose);
    asked_.commit();
  }

 protected:
  using PathHit = SceneHitf;
  using Touch = SceneShapeHitf;

  Scenef asked_;
};

template <typename Base>
class SegmentBatch : public Base {
 public:
  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override {
    hits_.resize(hits.size());
    this->asked_.first_hits(sweeps.paths().segments().first(hits.size()), hits_);
    for (std::size_t i = 0; i < hits.size(); ++i) hits[i].triangle = hits_[i].triangle;
  }

 private:
  std::vector<typename Base::PathHit> hits_;
};

template <typename Base>
class SingleSegments : public Base {
 public:
  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override {
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const auto hit = this->asked_.first_hit(sweeps.paths().segments()[i]);
      hits[i].triangle = hit ? hit->triangle : no_triangle;
    }
  }
};

template <typename Base>
class ShapeBatch : public Base {
 public:
  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override {
    if constexpr (std::is_same_v<typename Base::Touch, ShapeHitf>) {
      this->asked_.first_hits(sweeps.shapes(hits.size()), hits);
    } else {
      hits_.resize(hits.size());
      this->asked_.first_hits(sweeps.shapes(hits.size()), hits_);
      std::copy(hits_.begin(), hits_.end(), hits.begin());
    }
  }

 private:
  std::vector<typename Base::Touch> hits_;  ///< of worlds
};

template <typename Base>
class SingleShapes : public Base {
 public:
  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override {
    for (std::size_t i = 0; i < hits.size(); ++i) {
      hits[i] = this->asked_.first_hit(sweeps.shape(i)).value_or(typename Base::Touch{});
    }
  }
};

}  // namespace

std::vector<SweepEntrant> surehit_sweep_entrants() {
  return {{Entrant::our_library, "segment batch", [] { return std::make_unique<SegmentBatch<InMesh>>(); }},
          {Entrant::our_library, "batch", [] { return std::make_unique<ShapeBatch<InMesh>>(); }},
          {Entrant::our_library, "single", [] { return std::make_unique<SingleShapes<InMesh>>(); }}};
}

std::vector<WorldSweepEntrant> surehit_world_sweep_entrants() {
  return {{Entrant::our_library, "segment batch", [] { return std::make_unique<SegmentBatch<InWorld>>(); }},
          {Entrant::our_library, "batch", [] { return std::make_unique<ShapeBatch<InWorld>>(); }},
          {Entrant::our_library, "single", [] { return std::make_unique<SingleShapes<InWorld>>(); }},
          {Entrant::our_library, "segment single", [] { return std::make_unique<SingleSegments<InWorld>>(); }}};
}

}  // namespace surehit::benchmark
