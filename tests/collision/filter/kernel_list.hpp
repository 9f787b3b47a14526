#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "grid/grid.hpp"
#include "kernel_on_targets.hpp"
#include "mesh/mesh_blocks.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "verdict.hpp"

namespace surehit::test {

/// Triangles in one list, as the kernel meets them in a collider.
template <typename Scalar>
class KernelList {
 public:
  explicit KernelList(std::span<const Triangle<Scalar>> triangles) {
    GeneratedMesh<Scalar> mesh;
    for (const Triangle<Scalar>& triangle : triangles) {
      mesh.add(triangle);
      a_.push_back(triangle.a);
    }
    grid_ = Grid(mesh.view(), box_of(mesh.view()), {.resolution = {1, 1, 1}, .crowded = 0});
    blocks_ = MeshBlocks<Scalar>(mesh.view(), grid_);
    const CellWord word = grid_.top()[0];
    const std::size_t first = grid_.first_entry(word);
    const Scalar* block = blocks_.block(word.list(), first);
    list_ = {blocks_.corners(block), grid_.entry_count(word), blocks_.edge_size(block)};
  }
  explicit KernelList(const Triangle<Scalar>& triangle) : KernelList(std::span(&triangle, 1)) {}

  [[nodiscard]] std::size_t size() const { return list_.count; }

  /// Returns the verdict on triangle i. It is in the first lane or in a later one. The range must not be empty.
  [[nodiscard]] detail::Verdict verdict(const Path<Scalar>& path, const detail::PathRange<Scalar>& range,
                                        std::size_t i) const {
    const std::size_t from = vector_of(i);
    return verdict_of(verdicts_from(path, range, from), i - from);
  }
  /// The same by the kernel in double.
  [[nodiscard]] detail::Verdict verdict_in_double(const Path<Scalar>& path, const detail::PathRange<Scalar>& range,
                                                  std::size_t i) const requires std::is_same_v<Scalar, float> {
    const std::size_t from = vector_of(i);
    return verdict_of(in_double_from(path, range, from, std::numeric_limits<Scalar>::infinity()).verdicts, i - from);
  }

  [[nodiscard]] KernelVerdicts verdicts_from(const Path<Scalar>& path, const detail::PathRange<Scalar>& range,
                                             std::size_t from) const {
    return classify(kernel_path(path), detail::RangeWeights<Scalar>(range), list_, from);
  }

  [[nodiscard]] KernelFirst<Scalar> first_from(const Path<Scalar>& path, std::size_t from, std::uint64_t certain,
                                               Scalar limit) const {
    const detail::RangeWeights<Scalar> weights(detail::PathRange<Scalar>(path, {}));
    return first_of(kernel_path(path), weights, list_, from, certain, limit);
  }

  [[nodiscard]] KernelFirst<Scalar> first_of_one_from(const Path<Scalar>& path, std::size_t from,
                                                      std::size_t lane) const {
    const detail::RangeWeights<Scalar> weights(detail::PathRange<Scalar>(path, {}));
    return first_of_one(kernel_path(path), weights, list_, from, lane);
  }

  /// What the kernel in double says of some lanes of a list of floats.
  [[nodiscard]] KernelInDouble<Scalar> in_double_from(const Path<Scalar>& path, const detail::PathRange<Scalar>& range,
                                                      std::size_t from, Scalar limit,
                                                      std::uint64_t lanes = ~std::uint64_t{
                                                          0}) const requires std::is_same_v<Scalar, float> {
    const std::size_t count = std::min(kernel_lanes<Scalar>(), list_.count - from);
    const auto all = static_cast<std::uint64_t>((std::uint64_t{1} << count) - 1);
    const Path<double> in_double(path.kind, path.start.template cast<double>(), path.toward.template cast<double>());
    const detail::KernelPath<double> in_kernel(in_double, double{kernel_path(path).reach});
    return classify_in_double(in_kernel, range, list_, from, lanes & all, limit);
  }

 private:
  static std::size_t vector_of(std::size_t i) { return i / kernel_lanes<Scalar>() * kernel_lanes<Scalar>(); }
  static detail::Verdict verdict_of(const KernelVerdicts& verdicts, std::size_t lane) {
    if ((verdicts.possible >> lane & 1) == 0) return detail::Verdict::miss;
    return (verdicts.certain >> lane & 1) != 0 ? detail::Verdict::hit : detail::Verdict::undecided;
  }

  /// For a path that need not come to the list: its bounds are those of the farthest corner a.
  [[nodiscard]] detail::KernelPath<Scalar> kernel_path(const Path<Scalar>& path) const {
    Scalar farthest = 0;
    for (const Vector3<Scalar>& a : a_) farthest = std::max(farthest, (path.start - a).cwiseAbs().maxCoeff());
    return {path, farthest - list_.edge_size};
  }

  std::vector<Vector3<Scalar>> a_;
  Grid grid_;
  MeshBlocks<Scalar> blocks_;
  KernelTriangles<Scalar> list_;
};

}  // namespace surehit::test
