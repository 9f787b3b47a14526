#include <surehit/collider.hpp>

#include "sweep_entrants.hpp"

namespace surehit::benchmark {
namespace {

class SurehitSweep : public SweepContender {
 public:
  void build(const TriangleMeshViewf& mesh) override { collider_ = Colliderf(mesh); }

 protected:
  Colliderf collider_;
};

class SegmentBatch : public SurehitSweep {
 public:
  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override {
    hits_.resize(hits.size());
    collider_.first_hits(sweeps.paths().segments().first(hits.size()), hits_);
    for (std::size_t i = 0; i < hits.size(); ++i) hits[i].triangle = hits_[i].triangle;
  }

 private:
  std::vector<Hitf> hits_;
};

class ShapeBatch : public SurehitSweep {
 public:
  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override {
    collider_.first_hits(sweeps.shapes(hits.size()), hits);
  }
};

class SingleShapes : public SurehitSweep {
 public:
  void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) override {
    for (std::size_t i = 0; i < hits.size(); ++i) {
      hits[i] = collider_.first_hit(sweeps.shape(i)).value_or(ShapeHitf{});
    }
  }
};

}  // namespace

std::vector<SweepEntrant> surehit_sweep_entrants() {
  return {{Entrant::our_library, "segment batch", [] { return std::make_unique<SegmentBatch>(); }},
          {Entrant::our_library, "batch", [] { return std::make_unique<ShapeBatch>(); }},
          {Entrant::our_library, "single", [] { return std::make_unique<SingleShapes>(); }}};
}

}  // namespace surehit::benchmark
