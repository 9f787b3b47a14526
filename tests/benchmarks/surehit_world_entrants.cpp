#include <algorithm>
#include <string>
#include <surehit/scene.hpp>

#include "world_entrants.hpp"

namespace surehit::benchmark {
namespace {

class SurehitWorld : public WorldContender {
 public:
  void build(const World& world) override {
    world_ = &world;
    colliders_.clear();
    for (const auto& mesh : world.meshes) colliders_.push_back(std::make_shared<Colliderf>(mesh.view()));
    scene_ = {};
    ids_.clear();
    for (const auto& [mesh, pose] : world.instances) ids_.push_back(scene_.add(colliders_[mesh], pose));
    scene_.commit();
  }

  void move(std::span<const Posef> poses) override {
    for (std::size_t i = 0; i < poses.size(); ++i) scene_.set_pose(ids_[i], poses[i]);
    scene_.commit();
  }

  void exchange_one() override {
    const auto& [mesh, pose] = world_->instances[next_];
    scene_.remove(ids_[next_]);
    ids_[next_] = scene_.add(colliders_[mesh], pose);
    next_ = (next_ + 1) % ids_.size();
    scene_.commit();
  }

 protected:
  Scenef scene_;

 private:
  const World* world_ = nullptr;
  std::vector<std::shared_ptr<const Colliderf>> colliders_;
  std::vector<InstanceId> ids_;
  std::size_t next_ = 0;  ///< the instance that is exchanged next
};

class SurehitWorldBatch : public SurehitWorld {
 public:
  void first(const PathBatch& paths, std::span<Hitf> hits) override {
    hits_.resize(paths.size());
    scene_.first_hits(paths.segments(), hits_);
    for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = hits_[i];
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) override {
    scene_.any_hits(paths.segments(), blocked);
  }

 private:
  std::vector<SceneHitf> hits_;
};

/// A batch for a few paths each.
class SurehitWorldSmallBatches : public SurehitWorld {
 public:
  explicit SurehitWorldSmallBatches(std::size_t size) : size_(size) {}

  void first(const PathBatch& paths, std::span<Hitf> hits) override {
    std::vector<SceneHitf> room(size_);
    for_each_batch(paths, size_, [&](const auto& some, std::size_t begin) {
      const std::span found = std::span(room).first(some.size());
      scene_.first_hits(some, found);
      std::copy(found.begin(), found.end(), hits.begin() + static_cast<std::ptrdiff_t>(begin));
    });
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) override {
    for_each_batch(paths, size_, [&](const auto& some, std::size_t begin) {
      scene_.any_hits(some, blocked.subspan(begin, some.size()));
    });
  }

 private:
  std::size_t size_;
};

class SurehitWorldSingle : public SurehitWorld {
 public:
  void first(const PathBatch& paths, std::span<Hitf> hits) override {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      hits[i] = scene_.first_hit(paths.segments()[i]).value_or(SceneHitf{});
    }
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) override {
    for (std::size_t i = 0; i < paths.size(); ++i) blocked[i] = scene_.any_hit(paths.segments()[i]) ? 1 : 0;
  }
};

}  // namespace

std::vector<WorldEntrant> surehit_small_batch_world_entrants() {
  std::vector<WorldEntrant> entrants;
  for (const std::size_t size : small_batch_sizes) {
    entrants.push_back({"surehit in batches of", std::to_string(size),
                        [size] { return std::make_unique<SurehitWorldSmallBatches>(size); }});
  }
  return entrants;
}

std::vector<WorldEntrant> surehit_world_entrants() {
  return {{Entrant::our_library, "batch", [] { return std::make_unique<SurehitWorldBatch>(); }},
          {Entrant::our_library, "single", [] { return std::make_unique<SurehitWorldSingle>(); }}};
}

}  // namespace surehit::benchmark
