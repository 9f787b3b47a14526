#include <span>
#include <string>
#include <surehit/collider.hpp>
#include <vector>

#include "entrants.hpp"

namespace surehit::benchmark {
namespace {

class SurehitContender : public Contender {
 public:
  void build(const TriangleMeshViewf& mesh) override { collider_ = Colliderf(mesh); }

  void rebuild(const TriangleMeshViewf& mesh) override { collider_.rebuild(mesh.vertices()); }

  [[nodiscard]] std::size_t memory_bytes() const override { return collider_.memory_bytes(); }

 protected:
  Colliderf collider_;
};

class SurehitBatch : public SurehitContender {
 public:
  void first(const PathBatch& paths, std::span<Hitf> hits) const override {
    paths.visit([&](const auto& all) { collider_.first_hits(all, hits); });
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const override {
    paths.visit([&](const auto& all) { collider_.any_hits(all, blocked); });
  }

  void first_on_threads(const PathBatch& paths, std::span<const PathBatch>, Executor executor,
                        std::span<Hitf> hits) const override {
    paths.visit([&](const auto& all) { collider_.first_hits(all, hits, {.executor = executor}); });
  }
};

class SurehitSingle : public SurehitContender {
 public:
  void first(const PathBatch& paths, std::span<Hitf> hits) const override {
    paths.visit([&](const auto& all) {
      for (std::size_t i = 0; i < all.size(); ++i) hits[i] = collider_.first_hit(all[i]).value_or(Hitf{});
    });
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const override {
    paths.visit([&](const auto& all) {
      for (std::size_t i = 0; i < all.size(); ++i) blocked[i] = collider_.any_hit(all[i]) ? 1 : 0;
    });
  }
};

/// A batch for a few paths each.
class SurehitSmallBatches : public SurehitContender {
 public:
  explicit SurehitSmallBatches(std::size_t size) : size_(size) {}

  void first(const PathBatch& paths, std::span<Hitf> hits) const override {
    for_each_batch(paths, size_, [&](const auto& some, std::size_t begin) {
      collider_.first_hits(some, hits.subspan(begin, some.size()));
    });
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const override {
    for_each_batch(paths, size_, [&](const auto& some, std::size_t begin) {
      collider_.any_hits(some, blocked.subspan(begin, some.size()));
    });
  }

 private:
  std::size_t size_;
};

/// The same mesh and paths in double.
class SurehitInDouble : public Contender {
 public:
  void build(const TriangleMeshViewf& mesh) override {
    copy_vertices(mesh);
    collider_ = Colliderd({vertices_, mesh.triangles()});
  }

  void rebuild(const TriangleMeshViewf& mesh) override {
    copy_vertices(mesh);
    collider_.rebuild(vertices_);
  }

  [[nodiscard]] std::size_t memory_bytes() const override { return collider_.memory_bytes(); }

  void first(const PathBatch& paths, std::span<Hitf> hits) const override {
    hits_.resize(paths.size());
    paths.visit_in_double([&](const auto& all) { collider_.first_hits(all, hits_); });
    for (std::size_t i = 0; i < hits.size(); ++i) {
      hits[i].t = static_cast<float>(hits_[i].t);
      hits[i].triangle = hits_[i].triangle;
    }
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const override {
    paths.visit_in_double([&](const auto& all) { collider_.any_hits(all, blocked); });
  }

 private:
  void copy_vertices(const TriangleMeshViewf& mesh) {
    vertices_.resize(mesh.vertex_count());
    for (std::size_t i = 0; i < vertices_.size(); ++i) vertices_[i] = mesh.vertex(i).cast<double>();
  }

  std::vector<Vector3d> vertices_;
  Colliderd collider_;
  mutable std::vector<Hitd> hits_;
};

}  // namespace

std::vector<Entrant> surehit_double_entrants() {
  return {{"surehit in double", "batch", "", [] { return std::make_unique<SurehitInDouble>(); }}};
}

std::vector<Entrant> surehit_small_batch_entrants() {
  std::vector<Entrant> entrants;
  for (const std::size_t size : small_batch_sizes) {
    entrants.push_back({"surehit in batches of", std::to_string(size), "",
                        [size] { return std::make_unique<SurehitSmallBatches>(size); }});
  }
  return entrants;
}

std::vector<Entrant> surehit_entrants() {
  return {{Entrant::our_library, "batch", "", [] { return std::make_unique<SurehitBatch>(); }},
          {Entrant::our_library, "single", "", [] { return std::make_unique<SurehitSingle>(); }}};
}

}  // namespace surehit::benchmark
