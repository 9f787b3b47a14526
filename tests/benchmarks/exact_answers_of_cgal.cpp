#include <algorithm>
#include <optional>

#include "cgal_tree.hpp"
#include "exact_answers.hpp"

namespace surehit::benchmark {
namespace {

/// Asks exact predicates alone. They want triangles that are not degenerate, so those that are take part as the
/// segments that they span.
class ExactMesh {
 public:
  explicit ExactMesh(const TriangleMeshViewf& mesh) {
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
      const CgalKernel::Triangle_3 triangle = to_cgal(mesh.triangle(i));
      if (triangle.is_degenerate()) {
        const auto [least, greatest] = std::minmax({triangle[0], triangle[1], triangle[2]});
        slivers_.emplace_back(least, greatest);
      } else {
        triangles_.push_back(triangle);
      }
    }
    tree_.rebuild(triangles_.cbegin(), triangles_.cend());
    tree_.build();
  }

  template <typename AnyPath>
  [[nodiscard]] bool meets(const AnyPath& path) const {
    const auto shape_meets = [&](const auto& shape) {
      return tree_.do_intersect(shape) ||
             std::any_of(slivers_.begin(), slivers_.end(), [&](const CgalKernel::Segment_3& sliver) {
               return sliver.is_degenerate() ? CGAL::do_intersect(sliver.source(), shape)
                                             : CGAL::do_intersect(sliver, shape);
             });
    };
    return path.is_degenerate() ? shape_meets(path.source()) : shape_meets(path);
  }

 private:
  CgalTriangles triangles_;
  std::vector<CgalKernel::Segment_3> slivers_;
  CgalTree tree_;
};

}  // namespace

std::string exact_judge() { return "CGAL's exact predicates"; }

std::vector<std::uint8_t> exact_answers(const TriangleMeshViewf& mesh, const PathBatch& paths) {
  const ExactMesh exact(mesh);
  std::vector<std::uint8_t> answers(paths.size());
  paths.visit([&](const auto& all) {
    std::transform(all.begin(), all.end(), answers.begin(),
                   [&](const auto& path) { return static_cast<std::uint8_t>(exact.meets(to_cgal(path))); });
  });
  return answers;
}

}  // namespace surehit::benchmark
