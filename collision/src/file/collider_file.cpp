#include "file/collider_file.hpp"

#include <array>
#include <limits>
#include <string>
#include <utility>

#include "file/file_reader.hpp"
#include "file/file_writer.hpp"
#include "file/grid_file.hpp"
#include "file/list_check.hpp"
#include "support/in_parts.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// The counts and the options, which follow the head.
struct Counts {
  static constexpr std::size_t bytes = 72;  ///< Their size in the file.

  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t masks = 0;
  GridOptions options;
  GridCounts grid;

  template <typename Scalar>
  [[nodiscard]] static Counts of(const ColliderState<Scalar>& state) {
    return {state.mesh.view().vertex_count(), state.mesh.triangle_count(), state.masks.size(), state.grid_options,
            GridCounts::of(state.grid)};
  }
  [[nodiscard]] static Counts from(FileReader& reader) {
    Counts counts;
    counts.vertices = reader.take_count();
    counts.triangles = reader.take_count();
    counts.masks = reader.take_count();
    for (std::uint32_t& cells : counts.options.resolution) cells = reader.take<std::uint32_t>();
    counts.options.crowded = reader.take<std::uint32_t>();
    counts.options.cells_per_triangle = reader.take<double>();
    counts.grid.frames = reader.take<std::uint32_t>();
    counts.grid.lists = reader.take<std::uint32_t>();
    counts.grid.cells = reader.take_count();
    counts.grid.entries = reader.take_count();
    return counts;
  }
  void write(FileWriter& writer) const {
    writer.write(std::uint64_t{vertices});
    writer.write(std::uint64_t{triangles});
    writer.write(std::uint64_t{masks});
    for (const std::uint32_t cells : options.resolution) writer.write(cells);
    writer.write(options.crowded);
    writer.write(options.cells_per_triangle);
    writer.write(grid.frames);
    writer.write(grid.lists);
    writer.write(std::uint64_t{grid.cells});
    writer.write(std::uint64_t{grid.entries});
  }

  /// Returns the number of bytes of an index.
  [[nodiscard]] std::size_t index_bytes() const {
    return vertices <= std::size_t{1} << 16 ? sizeof(std::uint16_t) : sizeof(std::uint32_t);
  }
  /// Returns the size of each part, and the number of its elements, in the order of the file.
  template <typename Scalar>
  [[nodiscard]] std::array<std::pair<std::size_t, std::size_t>, 7> parts() const {
    PackedIds ids;
    ids.clear(triangles);
    return {{{vertices, 3 * sizeof(Scalar)},
             {triangles, 3 * index_bytes()},
             {masks, sizeof(std::uint32_t)},
             {grid.frames, frame_bytes<Scalar>},
             {grid.cells, 1},
             {grid.lists, list_bytes},
             {grid.entries, ids.width()}}};
  }
};
static_assert(3 * 8 + 4 * 4 + 8 + 2 * 4 + 2 * 8 == Counts::bytes);

}  // namespace

template <typename Scalar>
std::uint64_t saved_bytes(const ColliderState<Scalar>& state) {
  std::uint64_t size = head_bytes + Counts::bytes + checksum_bytes;
  for (const auto& [count, bytes] : Counts::of(state).template parts<Scalar>()) size += std::uint64_t{count} * bytes;
  return size;
}

template <typename Scalar>
bool save(const ColliderState<Scalar>& state, const ByteSink& sink) {
  FileWriter writer(sink);
  writer.write_head(FileKind::collider, sizeof(Scalar), saved_bytes(state));
  const Counts counts = Counts::of(state);
  counts.write(writer);
  const TriangleMeshView<Scalar> mesh = state.mesh.view();
  writer.write_bytes({ViewMemory::of(mesh.vertices()).first, mesh.vertex_count() * 3 * sizeof(Scalar)});
  writer.write_bytes({ViewMemory::of(mesh.triangles()).first, mesh.triangle_count() * 3 * counts.index_bytes()});
  writer.write_bytes(std::as_bytes(std::span(state.masks)));
  GridFile::write<Scalar>(state.grid, writer);
  return writer.finish();
}

namespace {

std::string named(ListFault::Kind kind) {
  switch (kind) {
    case ListFault::Kind::no_list:
      return "a cell that it meets has no list";
    case ListFault::Kind::missing:
      return "it meets the cell of this list, which does not have it next";
    case ListFault::Kind::outside_box:
      return "it is the last of a list whose box does not hold its triangles";
    case ListFault::Kind::too_many:
      return "it is in this list, whose cell it does not meet";
    case ListFault::Kind::inner_box:
      return "the box is not that of its triangles";
    case ListFault::Kind::inner_share:
      return "inner grids have too many triangles";
  }
  return {};
}

/// Returns where a fault of the lists is.
template <typename Scalar>
InvalidFile invalid_list(const ListFault& fault, const Grid& grid, const GridFile::Offsets& offsets) {
  using Kind = ListFault::Kind;
  if (fault.kind == Kind::inner_box) {
    const std::size_t offset = offsets.frames + (1 + fault.inner_grid) * frame_bytes<Scalar>;
    return {
        InvalidFile::Reason::invalid_grid, offset,
        "byte " + std::to_string(offset) + ": grid " + std::to_string(1 + fault.inner_grid) + ": " + named(fault.kind)};
  }
  const std::size_t offset =
      fault.kind == Kind::no_list ? offsets.cells : offsets.entries + fault.entry * grid.entries().width();
  return {InvalidFile::Reason::invalid_list, offset,
          "byte " + std::to_string(offset) + ": triangle " + std::to_string(fault.triangle) + ": " + named(fault.kind)};
}

}  // namespace

template <typename Scalar>
std::optional<InvalidFile> load(std::span<const std::byte> bytes, std::size_t base, const LoadOptions& options,
                                ColliderState<Scalar>& state) {
  using Reason = InvalidFile::Reason;
  if (auto invalid = find_invalid_head(bytes, FileKind::collider, sizeof(Scalar), base)) return invalid;
  FileReader reader = body_of(bytes, base);
  const auto fault = [](Reason reason, std::size_t offset, const std::string& message) {
    return InvalidFile(reason, offset, "byte " + std::to_string(offset) + ": " + message);
  };
  if (reader.left() < Counts::bytes) return fault(Reason::wrong_size, reader.offset(), "the counts are missing");
  const std::size_t counts_offset = reader.offset();
  const Counts counts = Counts::from(reader);
  std::size_t left = reader.left();
  for (const auto& [count, size] : counts.template parts<Scalar>()) {
    if (count > left / size) {
      return fault(Reason::wrong_counts, counts_offset,
                   "a part of " + std::to_string(count) + " times " + std::to_string(size) + " bytes does not fit");
    }
    left -= count * size;
  }
  const bool is_empty = counts.triangles == 0;
  const bool is_sound = left == 0 && (counts.masks == 0 || counts.masks == counts.triangles) &&
                        is_empty == (counts.grid.frames == 0) && is_empty == (counts.grid.cells == 0) &&
                        is_empty == (counts.grid.lists == 0) && is_empty == (counts.grid.entries == 0) &&
                        counts.grid.entries <= std::numeric_limits<std::uint32_t>::max();
  if (!is_sound) return fault(Reason::wrong_counts, counts_offset, "the counts do not fit each other");

  const std::size_t mesh_offset = reader.offset();
  const std::byte* const vertices = reader.take_bytes(counts.vertices * 3 * sizeof(Scalar)).data();
  const std::byte* const corners = reader.take_bytes(counts.triangles * 3 * counts.index_bytes()).data();
  const auto indices = [corners, count = counts.triangles]<typename Index>(Index) {
    return TriangleIndexView::strided(reinterpret_cast<const Index*>(corners), count, 0);
  };
  const TriangleMeshView<Scalar> mesh(
      VertexView<Scalar>::strided(reinterpret_cast<const Scalar*>(vertices), counts.vertices, 0),
      counts.index_bytes() == sizeof(std::uint16_t) ? indices(std::uint16_t{}) : indices(std::uint32_t{}));
  if (const std::optional<InvalidMesh> invalid = find_invalid(mesh)) {
    std::size_t offset = counts_offset;
    if (invalid->reason == InvalidMesh::Reason::non_finite_vertex) {
      offset = mesh_offset + invalid->element * 3 * sizeof(Scalar);
    } else if (invalid->reason == InvalidMesh::Reason::index_out_of_range) {
      offset = mesh_offset + counts.vertices * 3 * sizeof(Scalar) + invalid->element * 3 * counts.index_bytes();
    }
    return fault(Reason::invalid_mesh, offset, invalid->what());
  }
  state.masks.resize(counts.masks);
  for (std::uint32_t& mask : state.masks) mask = reader.take<std::uint32_t>();
  state.box = box_of(mesh);
  state.grid_options = counts.options;
  if (!is_empty) {
    GridFile::Offsets offsets;
    if (auto invalid = GridFile::read<Scalar>(reader, counts.grid, static_cast<std::uint32_t>(counts.triangles),
                                              state.grid, offsets)) {
      return invalid;
    }
    const GridFrame& frame = state.grid.frame();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      if (frame.low[axis] == double{state.box.low[k]} && frame.high[axis] == double{state.box.high[k]}) continue;
      return fault(Reason::invalid_grid, offsets.frames, "grid 0: the box is not that of the mesh");
    }
    if (options.is_trusted) {
      const auto triangles = static_cast<std::uint32_t>(counts.triangles);
      if (auto invalid = GridFile::find_disorder(state.grid, triangles, offsets)) return invalid;
    } else {
      if (const auto invalid = find_list_fault(mesh, state.grid)) {
        return invalid_list<Scalar>(*invalid, state.grid, offsets);
      }
    }
  }
  state.mesh = MeshBlocks<Scalar>(mesh, state.grid, address_of(options.executor));
  state.version = ColliderState<Scalar>::next_version();
  return std::nullopt;
}

template std::uint64_t saved_bytes(const ColliderState<float>&);
template std::uint64_t saved_bytes(const ColliderState<double>&);
template bool save(const ColliderState<float>&, const ByteSink&);
template bool save(const ColliderState<double>&, const ByteSink&);
template std::optional<InvalidFile> load(std::span<const std::byte>, std::size_t, const LoadOptions&,
                                         ColliderState<float>&);
template std::optional<InvalidFile> load(std::span<const std::byte>, std::size_t, const LoadOptions&,
                                         ColliderState<double>&);

}  // namespace surehit::detail
