#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_io/mesh.hpp"
#include "surehit_query/query_request.hpp"

namespace surehit::example {

/// Returns the mask that a text spells: a whole number from 0 to 4294967295, decimal or hex (0x1f). Throws InputError.
[[nodiscard]] std::uint32_t parse_mask(std::string_view text);

/// Throws InputError if there is an id of this kind to ignore, but nothing has it.
void check_is_there(const std::optional<std::uint32_t>& id, std::size_t count, const std::string& kind);

/// The masks that a file lists: a whole number from 0 to 4294967295 a line, decimal or hex (0x1f). Blank lines and
/// lines that begin with # are skipped. Throws InputError, which names the file and the line.
[[nodiscard]] std::vector<std::uint32_t> read_masks(const std::string& path);

/// A mask for each triangle of the mesh, or none at all where all bits are set for all of them.
///
/// The file lists a mask for each triangle or, if there are as many, for each face. An ignored face gets the mask 0.
/// Throws InputError for another number of masks, and for a triangle or a face to ignore that is not there.
template <typename Scalar>
[[nodiscard]] std::vector<std::uint32_t> masks_of(const QueryRequest& request, const Mesh<Scalar>& mesh);

}  // namespace surehit::example
