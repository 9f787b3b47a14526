#include "mesh/mesh_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <type_traits>

#include "filter/kernel_bound.hpp"
#include "grid/list_cells.hpp"
#include "mesh/slab_fitter.hpp"
#include "support/in_parts.hpp"
#include "support/rounding_flags.hpp"

namespace surehit {
namespace {

/// The number of coordinates that the widest vector load may read beyond the last triangle.
constexpr std::size_t slack = 64;
/// The number of lists in a task of an executor.
constexpr std::size_t lists_in_a_part = std::size_t{1} << 12;
/// The number of top cells in a task of an executor.
constexpr std::size_t top_cells_in_a_part = std::size_t{1} << 14;

template <typename Fill>
void fill_all(const Grid& grid, const Executor* executor, const Fill& fill) {
  detail::in_parts(executor, grid.lists().size() - 1, lists_in_a_part, [&](std::size_t first, std::size_t last) {
    for (std::size_t list = first; list < last; ++list) fill(CellWord::listing(static_cast<std::uint32_t>(list)));
  });
}

/// Returns whether a slab is at most half as thick as the box around the same triangles.
bool is_thin(CellSlab slab, CellBox box) {
  float of_box = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto normal = static_cast<float>(std::abs(slab.normal(axis)));
    of_box += normal * static_cast<float>(box.high(axis) - box.low(axis)) / CellBox::parts;
  }
  return static_cast<float>(slab.high() + 1 - slab.low()) * CellSlab::step <= of_box / 2;
}

/// Returns whether at most a quarter of some sampled lists have slabs that are not thin. Lists of one triangle do not
/// count, because a flat slab holds any triangle. Returns false for a mesh with few lists, where slabs are not
/// worthwhile. `fit` returns the slab of a cell's list.
template <typename Fit>
bool is_smooth(const Grid& grid, const Fit& fit) {
  constexpr std::size_t samples = 32;
  constexpr std::size_t few = 8;
  const std::span<const CellWord> tops = grid.all_top();
  std::size_t thin = 0;
  std::size_t thick = 0;
  for (std::size_t sample = 0; sample < samples && 4 * thick <= samples; ++sample) {
    // The sample is the first list at or after some cell.
    std::size_t top = tops.size() * sample / samples;
    const std::size_t end = tops.size() * (sample + 1) / samples;
    const auto is_list = [](CellWord word) { return !word.is_empty() && !word.is_divided() && !word.has_inner_grid(); };
    while (top < end && !is_list(tops[top])) ++top;
    if (top == end) continue;
    const GridFrame& frame = grid.frame_of_top(top);
    if (!frame.has_floats) continue;
    const std::size_t cell = top - frame.first_top;
    detail::visit_list_cells(grid, frame, cell, cell + 1, [&](const detail::ListCell& cell_of_list) {
      if (grid.entry_count(cell_of_list.word) < 2) return;
      (is_thin(fit(frame, cell_of_list), grid.box(cell_of_list.word)) ? thin : thick) += 1;
    });
  }
  return 3 * thick <= thin && thin + thick > few;
}

}  // namespace

template <typename Scalar>
MeshBlocks<Scalar>::MeshBlocks(const TriangleMeshView<Scalar>& mesh, const Grid& grid, const Executor* executor) {
  rebuild(mesh, grid, executor);
}

template <typename Scalar>
void MeshBlocks<Scalar>::rebuild(const TriangleMeshView<Scalar>& mesh, const Grid& grid, const Executor* executor) {
  copy_vertices(mesh);
  constexpr std::size_t max_short_indices = std::size_t{1} << 16;
  if (mesh.vertex_count() <= max_short_indices) {
    copy_corners<std::uint16_t>(mesh);
  } else {
    copy_corners<std::uint32_t>(mesh);
  }
  fill_blocks(*this, grid, executor, Slabs::where_smooth);
}

template <typename Scalar>
void MeshBlocks<Scalar>::rebuild(MeshBlocks& old, const VertexView<Scalar>& vertices, const Grid& grid,
                                 const Executor* executor) {
  copy_vertices(old.view_with(vertices));
  fill_blocks(old, grid, executor, Slabs::none);
  corners_.swap(old.corners_);
}

template <typename Scalar>
void MeshBlocks<Scalar>::copy_vertices(const TriangleMeshView<Scalar>& mesh) {
  vertices_.resize(mesh.vertex_count() + 1);
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) vertices_[i] = mesh.vertex(i);
  vertices_.back().setZero();
}

template <typename Scalar>
template <typename Index>
void MeshBlocks<Scalar>::copy_corners(const TriangleMeshView<Scalar>& mesh) {
  if (!std::holds_alternative<Corners<Index>>(corners_)) corners_.template emplace<Corners<Index>>();
  auto& triangles = *std::get_if<Corners<Index>>(&corners_);
  triangles.resize(mesh.triangle_count());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) triangles[i][k] = static_cast<Index>(mesh.corner(i, k));
  }
}

/// Fills the blocks with the triangles of `indexed`.
template <typename Scalar>
void MeshBlocks<Scalar>::fill_blocks(const MeshBlocks& indexed, const Grid& grid, const Executor* executor,
                                     Slabs wanted) {
  indexed.with_corners([&](const auto& triangles) { fill_blocks(triangles, grid, executor, wanted); });
}

template <typename Scalar>
template <typename Index>
void MeshBlocks<Scalar>::fill_blocks(const Corners<Index>& triangles, const Grid& grid, const Executor* executor,
                                     [[maybe_unused]] Slabs wanted) {
  blocks_.resize(offset(grid.lists().size(), grid.entries().size()) + slack);
  if constexpr (std::is_same_v<Scalar, float>) place_boxes(grid);
  using Four = Eigen::Matrix<Scalar, 4, 1>;
  using FourPoints = Eigen::Matrix<Scalar, 4, 4>;
  /// The largest components of some triangles: of their first corners, and of their edges from there.
  struct Sizes {
    Four corner = Four::Zero();
    Four edge = Four::Zero();
  };
  const auto fill_four = [&](const std::array<std::uint32_t, 4>& ids, Scalar* list, std::size_t count, Sizes& sizes) {
    std::array<FourPoints, 3> corners;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::array<Index, 3>& triangle = triangles[ids[k]];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vector3<Scalar>& vertex = vertices_[triangle[corner]];
        corners[corner].col(static_cast<Eigen::Index>(k)) = Eigen::Map<const Four>(vertex.data());
      }
    }
    for (std::size_t corner = 0; corner < 3; ++corner) {
      corners[corner].transposeInPlace();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Eigen::Map<Four>(list + (3 * corner + axis) * count) = corners[corner].col(static_cast<Eigen::Index>(axis));
      }
    }
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      sizes.corner = sizes.corner.cwiseMax(corners[0].col(axis).cwiseAbs());
      for (const std::size_t corner : {1U, 2U}) {
        sizes.edge = sizes.edge.cwiseMax((corners[corner].col(axis) - corners[0].col(axis)).cwiseAbs());
      }
    }
  };
  const detail::PackedIds& ids = grid.entries();
  const auto fill = [&](CellWord word) {
    const std::size_t first = grid.first_entry(word);
    const std::size_t count = grid.entry_count(word);
    Scalar* edge_size = blocks_.data() + offset(word.list(), first);
    Scalar* list = edge_size + 1;
    if (count == 0) {  // All triangles of the cell are in its inner grid.
      *edge_size = 0;
      return;
    }
    Sizes sizes;
    if (count >= 4) {
      const auto four_from = [&](std::size_t i) -> std::array<std::uint32_t, 4> {
        return {ids[first + i], ids[first + i + 1], ids[first + i + 2], ids[first + i + 3]};
      };
      for (std::size_t i = 0; i + 4 < count; i += 4) fill_four(four_from(i), list + i, count, sizes);
      // The last four may overlap those before them.
      fill_four(four_from(count - 4), list + count - 4, count, sizes);
    } else {
      std::array<std::uint32_t, 4> four;
      for (std::size_t k = 0; k < 4; ++k) four[k] = ids[first + std::min(k, count - 1)];
      std::array<Scalar, coordinates * 4> of_four;
      fill_four(four, of_four.data(), 4, sizes);
      for (std::size_t k = 0; k < coordinates; ++k) std::copy_n(of_four.data() + 4 * k, count, list + k * count);
    }
    constexpr Scalar largest_size = detail::KernelBound<Scalar>::largest_size;
    const Scalar edge = sizes.edge.maxCoeff();
    const bool is_small = sizes.corner.maxCoeff() <= largest_size / 2 && edge <= largest_size;
    *edge_size = is_small ? edge : std::numeric_limits<Scalar>::infinity();
    if (has_boxes(count)) {
      fill_boxes(list, count, boxes_.data() + box_coordinates * octet_places_.place(first_octet(first)));
    }
  };
  slabs_.clear();
  if (grid.lists().empty()) return;
  if constexpr (std::is_same_v<Scalar, float>) {
    if (wanted == Slabs::where_smooth && try_fill_with_slabs(grid, executor, fill)) return;
  }
  fill_all(grid, executor, fill);
}

/// Makes room for the boxes of long lists.
template <typename Scalar>
void MeshBlocks<Scalar>::place_boxes(const Grid& grid) {
  const std::span<const CellList> lists = grid.lists();
  octet_places_.reset(first_octet(grid.entries().size()));
  for (std::size_t i = 0; i + 1 < lists.size(); ++i) {
    const std::size_t count = lists[i + 1].first_entry - lists[i].first_entry;
    if (has_boxes(count)) octet_places_.add(first_octet(lists[i].first_entry), count / octet);
  }
  boxes_.resize(box_coordinates * octet_places_.number() + slack);
}

/// Fills in the boxes around the octets of a list of `count` triangles.
template <typename Scalar>
void MeshBlocks<Scalar>::fill_boxes(const Scalar* list, std::size_t count, Scalar* boxes) const noexcept {
  using Eight = Eigen::Array<Scalar, octet, 1>;
  const std::size_t box_count = count / octet;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = [&](std::size_t corner, std::size_t i) { return list + (3 * corner + axis) * count + i; };
    const auto eight = [&](std::size_t corner, std::size_t i) { return Eigen::Map<const Eight>(at(corner, i)); };
    for (std::size_t i = 0; i < box_count; ++i) {
      const std::size_t from = octet * i;
      Eight low = eight(0, from).min(eight(1, from)).min(eight(2, from));
      Eight high = eight(0, from).max(eight(1, from)).max(eight(2, from));
      if (i + 1 == box_count) {  // The last eight may overlap those before them.
        for (std::size_t corner = 0; corner < 3; ++corner) {
          low = low.min(eight(corner, count - octet));
          high = high.max(eight(corner, count - octet));
        }
      }
      boxes[axis * box_count + i] = low.minCoeff();
      boxes[(3 + axis) * box_count + i] = high.maxCoeff();
    }
  }
}

/// Fills all blocks and fits all slabs if the mesh is smooth. Returns whether it is.
template <typename Scalar>
template <typename Fill>
bool MeshBlocks<Scalar>::try_fill_with_slabs(const Grid& grid, const Executor* executor, const Fill& fill) {
  const auto fit = [&](const detail::SlabFitter& fitter, const detail::ListCell& cell) {
    const std::size_t first_entry = grid.first_entry(cell.word);
    return fitter.fit(cell, corners(block(cell.word.list(), first_entry)), grid.entry_count(cell.word));
  };
  const auto fill_and_fit = [&](const GridFrame& frame, const detail::ListCell& cell) {
    fill(cell.word);
    return fit(detail::SlabFitter(frame), cell);
  };
  if (!is_smooth(grid, fill_and_fit)) return false;
  // The slab of a cell with an inner grid holds the whole cell.
  slabs_.assign(grid.lists().size() - 1, CellSlab());
  // With an executor, all lists are filled first: a fit may read beyond the end of its list, where another task may
  // still write. Without, each slab is fitted right after its list is filled, while the triangles are in the cache.
  if (executor != nullptr) fill_all(grid, executor, fill);
  const auto fit_frame = [&](const GridFrame& frame) {
    const detail::SlabFitter fitter(frame);
    const std::size_t tops = std::size_t{frame.cells[0]} * frame.cells[1] * frame.cells[2];
    detail::in_parts(executor, tops, top_cells_in_a_part, [&](std::size_t first, std::size_t last) {
      detail::visit_list_cells(grid, frame, first, last, [&](const detail::ListCell& cell) {
        if (executor == nullptr) fill(cell.word);
        if (frame.has_floats && !cell.word.has_inner_grid()) slabs_[cell.word.list()] = fit(fitter, cell);
      });
    });
  };
  fit_frame(grid.frame());
  for (const GridFrame& frame : grid.inner_frames()) fit_frame(frame);
  return true;
}

template <typename Scalar>
TriangleMeshView<Scalar> MeshBlocks<Scalar>::view() const noexcept {
  return view_with(std::span<const Vector3<Scalar>>(vertices_.data(), vertices_.empty() ? 0 : vertices_.size() - 1));
}

template <typename Scalar>
TriangleMeshView<Scalar> MeshBlocks<Scalar>::view_with(const VertexView<Scalar>& vertices) const noexcept {
  return with_corners([&](const auto& triangles) -> TriangleMeshView<Scalar> { return {vertices, triangles}; });
}

template <typename Scalar>
std::size_t MeshBlocks<Scalar>::memory_bytes() const noexcept {
  const std::size_t corner_bytes =
      with_corners([](const auto& triangles) { return triangles.capacity() * sizeof(triangles.front()); });
  return vertices_.capacity() * sizeof(Vector3<Scalar>) + corner_bytes +
         (blocks_.capacity() + boxes_.capacity()) * sizeof(Scalar) + octet_places_.memory_bytes() +
         slabs_.capacity() * sizeof(CellSlab);
}

template class MeshBlocks<float>;
template class MeshBlocks<double>;

}  // namespace surehit
