#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surehit_query/query_request.hpp"

namespace surehit::example {

/// The masks that a file lists: a whole number from 0 to 4294967295 a line, decimal or hex (0x1f). Blank lines and
/// lines that begin with # are skipped. Throws InputError, which names the file and the line.
[[nodiscard]] std::vector<std::uint32_t> read_masks(const std::string& path);

/// A mask for each triangle, or none at all where all bits are set for all of them. `faces` has the face of each
/// triangle, or is empty where each triangle is one.
///
/// The file lists a mask for each triangle or, if there are as many, for each face. An ignored face gets the mask 0.
/// Throws InputError for another number of masks, and for a triangle or a face to ignore that is not there.
[[nodiscard]] std::vector<std::uint32_t> masks_of(const QueryRequest& request, std::size_t triangle_count,
                                                  const std::vector<std::uint32_t>& faces);

}  // namespace surehit::example
