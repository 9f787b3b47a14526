#include <malloc.h>

#include <iterator>
#include <limits>

#include "cgal_tree.hpp"
#include "entrants.hpp"

namespace surehit::benchmark {
namespace {

/// CGAL reports no sizes, so the allocator is asked: what it has handed out.
std::size_t heap_bytes() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

class CgalContender : public Contender {
 public:
  void build(const TriangleMeshViewf& mesh) override {
    tree_.clear();
    triangles_ = {};
    const std::size_t before = heap_bytes();
    triangles_.reserve(mesh.triangle_count());
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) triangles_.push_back(to_cgal(mesh.triangle(i)));
    tree_.rebuild(triangles_.cbegin(), triangles_.cend());
    tree_.build();
    bytes_ = heap_bytes() - before;
  }

  [[nodiscard]] std::size_t memory_bytes() const override { return bytes_; }

  /// Its search for a first intersection takes rays only, and would follow a short segment's line far beyond it; so all
  /// triangles that a segment meets are found, and ordered by t in double.
  void first(const PathBatch& paths, std::span<Hitf> hits) const override {
    std::vector<CgalPrimitive::Id> met;
    paths.visit([&](const auto& all) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto path = to_cgal(all[i]);
        met.clear();
        tree_.all_intersected_primitives(path, std::back_inserter(met));
        hits[i] = first_of(met, path);
      }
    });
  }

  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) const override {
    paths.visit([&](const auto& all) {
      for (std::size_t i = 0; i < all.size(); ++i) blocked[i] = tree_.do_intersect(to_cgal(all[i])) ? 1 : 0;
    });
  }

 private:
  template <typename AnyPath>
  [[nodiscard]] Hitf first_of(const std::vector<CgalPrimitive::Id>& met, const AnyPath& path) const {
    Hitf first;
    double least = std::numeric_limits<double>::infinity();
    for (const CgalPrimitive::Id& triangle : met) {
      const CgalKernel::Vector_3 normal =
          CGAL::cross_product(triangle->vertex(1) - triangle->vertex(0), triangle->vertex(2) - triangle->vertex(0));
      const double along = normal * path.to_vector();
      const double t = along == 0 ? 0 : normal * (triangle->vertex(0) - path.source()) / along;
      if (!(t < least)) continue;
      least = t;
      first.t = static_cast<float>(t);
      first.triangle = static_cast<std::uint32_t>(triangle - triangles_.cbegin());
    }
    return first;
  }

  CgalTriangles triangles_;
  CgalTree tree_;
  std::size_t bytes_ = 0;
};

}  // namespace

std::vector<Entrant> cgal_entrants() {
  return {{"CGAL", "", "", [] { return std::make_unique<CgalContender>(); }}};
}

}  // namespace surehit::benchmark
