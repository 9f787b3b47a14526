#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <variant>

#include "grid/grid.hpp"
#include "mesh/octet_places.hpp"
#include "support/default_init_allocator.hpp"
#include "surehit/triangle_mesh_view.hpp"
#include "surehit/vertex_view.hpp"

namespace surehit {

/// A collider's copy of its mesh. It has the vertices as they were given. It has the indices, in 16 bits if all fit.
/// For each list of the grid it has a block: the corners of the list's triangles, coordinate by coordinate, as the
/// kernel loads them. A long list of floats has a box around each eight triangles. A smooth mesh also has a slab around
/// the triangles of each list, until the mesh moves.
template <typename Scalar>
class MeshBlocks {
 public:
  MeshBlocks() = default;
  /// Copies a valid mesh, which must be that of the grid. May throw std::bad_alloc.
  MeshBlocks(const TriangleMeshView<Scalar>& mesh, const Grid& grid, const Executor* executor = nullptr);

  /// Makes this the mesh of `old` with as many new vertices. It has no slabs, because the paths of one tick do not save
  /// the time to fit them. The indices move from `old`, so `old` may only be used for the next rebuild. Memory is
  /// reused. If this throws, `old` has not changed.
  void rebuild(MeshBlocks& old, const VertexView<Scalar>& vertices, const Grid& grid,
               const Executor* executor = nullptr);
  /// Copies a valid mesh, as the constructor does. It reuses memory, and may throw std::bad_alloc.
  void rebuild(const TriangleMeshView<Scalar>& mesh, const Grid& grid, const Executor* executor = nullptr);

  [[nodiscard]] std::size_t triangle_count() const noexcept {
    return with_corners([](const auto& triangles) { return triangles.size(); });
  }
  [[nodiscard]] Triangle<Scalar> triangle(std::uint32_t id) const noexcept {
    return with_corners([&](const auto& triangles) -> Triangle<Scalar> {
      const auto& [a, b, c] = triangles[id];
      return {vertices_[a], vertices_[b], vertices_[c]};
    });
  }
  /// Returns triangle `index` of a list of `count` triangles.
  [[nodiscard]] static Triangle<Scalar> triangle(const Scalar* corners, std::size_t count, std::size_t index) noexcept {
    const auto at = [&](std::size_t k) { return corners[k * count + index]; };
    return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, {at(6), at(7), at(8)}};
  }
  /// Returns a view of the mesh as it was given. It refers to the memory of this copy.
  [[nodiscard]] TriangleMeshView<Scalar> view() const noexcept;
  /// Returns a view of the same triangles with as many other vertices.
  [[nodiscard]] TriangleMeshView<Scalar> view_with(const VertexView<Scalar>& vertices) const noexcept;
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

  static constexpr std::size_t coordinates = 9;
  /// Returns the block of the grid's list of that number. The list must begin at `first_entry`.
  [[nodiscard]] const Scalar* block(std::size_t list, std::size_t first_entry) const noexcept {
    return blocks_.data() + offset(list, first_entry);
  }
  /// Returns the largest component of the list's edges b - a and c - a. It is infinite if coordinates are too large for
  /// the kernel.
  [[nodiscard]] static Scalar edge_size(const Scalar* block) noexcept { return *block; }
  /// Returns the same from the coordinates of the list.
  [[nodiscard]] static Scalar edge_size_of(const Scalar* corners) noexcept { return corners[-1]; }
  /// Returns the coordinates of a list of `count` triangles. Coordinate k of triangle i is at k count + i. A vector
  /// load may read beyond the last one.
  [[nodiscard]] static const Scalar* corners(const Scalar* block) noexcept { return block + 1; }

  /// The number of triangles of an octet, which are neighbours in a list. The last octet of a list has up to 15.
  static constexpr std::size_t octet = 8;
  /// Returns the boxes around the octets of a list of floats, or null if it is so short that a look at them takes
  /// longer than it saves. Coordinate k of box i is at k m + i, for m boxes: the three lowest and the three highest.
  /// They are exact. A vector load may read beyond the last one. All lists are short in double.
  [[nodiscard]] const Scalar* octet_boxes(std::size_t first_entry, std::size_t count) const noexcept {
    if (!has_boxes(count)) return nullptr;
    return boxes_.data() + box_coordinates * octet_places_.place(first_octet(first_entry));
  }

  /// Returns whether lists have slabs. On a smooth mesh, most slabs are much thinner than the boxes of their lists.
  [[nodiscard]] bool has_slabs() const noexcept { return !slabs_.empty(); }
  /// Returns the slabs of the grid's lists, by list number, or null if there are none.
  [[nodiscard]] const CellSlab* slabs() const noexcept { return has_slabs() ? slabs_.data() : nullptr; }
  [[nodiscard]] CellSlab slab(CellWord word) const noexcept { return slabs_[word.list()]; }

 private:
  static std::size_t offset(std::size_t list, std::size_t first_entry) noexcept {
    return coordinates * first_entry + list;  // Each earlier list has one edge size too.
  }
  static constexpr std::size_t box_coordinates = 6;
  /// Returns whether the octets of a list of `count` triangles have boxes.
  static bool has_boxes(std::size_t count) noexcept {
    constexpr std::size_t min_count = 4 * octet;
    return std::is_same_v<Scalar, float> && count >= min_count;
  }
  /// Returns the number of a list's first octet among those of all lists. No two lists share one: the last of
  /// `count / octet` octets comes before the first one of the next list.
  static std::size_t first_octet(std::size_t first_entry) noexcept { return first_entry / octet; }
  enum class Slabs : std::uint8_t { none, where_smooth };
  template <typename Index>
  using Corners = detail::UnsetVector<std::array<Index, 3>>;
  using VariantCorners = std::variant<Corners<std::uint16_t>, Corners<std::uint32_t>>;
  /// Corners with indices of either size. GCC 12 ends a variant whose copy constructor throws as if it had a value, so
  /// a copy is assigned to an empty one.
  struct AnyCorners : VariantCorners {
    AnyCorners() = default;
    AnyCorners(const AnyCorners& other) : VariantCorners() { *this = other; }
    AnyCorners& operator=(const AnyCorners& other) = default;
    AnyCorners(AnyCorners&&) noexcept = default;
    AnyCorners& operator=(AnyCorners&&) noexcept = default;
    ~AnyCorners() = default;
  };

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
  void place_boxes(const Grid& grid);
  void fill_boxes(const Scalar* list, std::size_t count, Scalar* boxes) const noexcept;
  template <typename Fill>
  bool try_fill_with_slabs(const Grid& grid, const Executor* executor, const Fill& fill);

  detail::UnsetVector<Vector3<Scalar>> vertices_;  ///< There is one extra vertex, for a vector load of the last one.
  AnyCorners corners_;
  detail::UnsetVector<Scalar> blocks_;
  detail::UnsetVector<Scalar> boxes_;  ///< The boxes of all octets that have one.
  detail::OctetPlaces octet_places_;
  detail::UnsetVector<CellSlab> slabs_;
};

}  // namespace surehit
