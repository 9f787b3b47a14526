#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "grid/grid.hpp"
#include "support/default_init_allocator.hpp"
#include "surehit/triangle_mesh_view.hpp"
#include "surehit/vertex_view.hpp"

namespace surehit {

/// A collider's copy of its mesh: the vertices as they were given, the indices, in 16 bits if that numbers all
/// vertices, and for each list of the grid the triangles' corners a, b and c, coordinate by coordinate, as the kernel
/// loads them; where the mesh is smooth, and until it moves, also the slab in which they lie.
template <typename Scalar>
class MeshBlocks {
 public:
  MeshBlocks() = default;
  /// Of a valid mesh and its grid. May throw std::bad_alloc.
  MeshBlocks(const TriangleMeshView<Scalar>& mesh, const Grid& grid, const Executor* executor = nullptr);

  /// Becomes `old` with other vertices, as many, but without slabs, which the paths of one tick would not earn, and
  /// takes its indices over: `old` is good for the next rebuild only. Memory is reused. If that throws, `old` is as
  /// before.
  void rebuild(MeshBlocks& old, const VertexView<Scalar>& vertices, const Grid& grid,
               const Executor* executor = nullptr);

  [[nodiscard]] std::size_t triangle_count() const noexcept {
    return with_corners([](const auto& triangles) { return triangles.size(); });
  }
  [[nodiscard]] Triangle<Scalar> triangle(std::uint32_t id) const noexcept {
    return with_corners([&](const auto& triangles) -> Triangle<Scalar> {
      const auto& [a, b, c] = triangles[id];
      return {vertices_[a], vertices_[b], vertices_[c]};
    });
  }
  /// The triangle at `index` of a list of `count`.
  [[nodiscard]] static Triangle<Scalar> triangle(const Scalar* corners, std::size_t count, std::size_t index) noexcept {
    const auto at = [&](std::size_t k) { return corners[k * count + index]; };
    return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, {at(6), at(7), at(8)}};
  }
  /// Of the mesh as it was given, in the memory of this copy.
  [[nodiscard]] TriangleMeshView<Scalar> view() const noexcept;
  /// Of the same triangles with other vertices, as many.
  [[nodiscard]] TriangleMeshView<Scalar> view_with(const VertexView<Scalar>& vertices) const noexcept;
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

  static constexpr std::size_t coordinates = 9;
  /// Of the grid's list of that number, which begins at `first_entry`.
  [[nodiscard]] const Scalar* block(std::size_t list, std::size_t first_entry) const noexcept {
    return blocks_.data() + offset(list, first_entry);
  }
  /// The greatest component of the list's edges b - a and c - a; infinite where coordinates are too large for the
  /// kernel.
  [[nodiscard]] static Scalar edge_size(const Scalar* block) noexcept { return *block; }
  /// Coordinate k of triangle i of a list of `count` is at k count + i. A vector load may read beyond the last.
  [[nodiscard]] static const Scalar* corners(const Scalar* block) noexcept { return block + 1; }

  /// Whether lists have slabs: those of a smooth mesh, for most of which these are much thinner than the boxes.
  [[nodiscard]] bool has_slabs() const noexcept { return !slabs_.empty(); }
  /// Of the grid's lists, by their numbers; null if they have none.
  [[nodiscard]] const CellSlab* slabs() const noexcept { return has_slabs() ? slabs_.data() : nullptr; }
  [[nodiscard]] CellSlab slab(CellWord word) const noexcept { return slabs_[word.number()]; }

 private:
  static std::size_t offset(std::size_t list, std::size_t first_entry) noexcept {
    return coordinates * first_entry + list;  // each list before this one has an edge size too
  }
  enum class Slabs : std::uint8_t { none, where_smooth };
  template <typename Index>
  using Corners = detail::UnsetVector<std::array<Index, 3>>;
  using AnyCorners = std::variant<Corners<std::uint16_t>, Corners<std::uint32_t>>;

  template <typename Visit>
  decltype(auto) with_corners(const Visit& visit) const {
    if (const auto* triangles = std::get_if<Corners<std::uint16_t>>(&corners_)) return visit(*triangles);
    return visit(*std::get_if<Corners<std::uint32_t>>(&corners_));
  }
  void copy_vertices(const TriangleMeshView<Scalar>& mesh);
  template <typename Index>
  void copy_corners(const TriangleMeshView<Scalar>& mesh);
  void fill_blocks(const MeshBlocks& indexed, const Grid& grid, const Executor* executor, Slabs wanted);
  template <typename Index>
  void fill_blocks(const Corners<Index>& triangles, const Grid& grid, const Executor* executor, Slabs wanted);
  template <typename Fill>
  bool try_fill_with_slabs(const Grid& grid, const Executor* executor, const Fill& fill);

  detail::UnsetVector<Vector3<Scalar>> vertices_;  ///< and one more, for a vector load of the last
  AnyCorners corners_;
  detail::UnsetVector<Scalar> blocks_;
  detail::UnsetVector<CellSlab> slabs_;
};

}  // namespace surehit
