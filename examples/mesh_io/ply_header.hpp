#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_io/text_lines.hpp"

namespace surehit::example {

enum class PlyFormat : std::uint8_t { ascii, binary_little_endian, binary_big_endian };

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] inline bool is_integer(PlyType type) { return type < PlyType::float32; }

/// One number, or with a `count_type` a list of them behind their count.
struct PlyProperty {
  std::string_view name;
  PlyType type;
  std::optional<PlyType> count_type;
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The index of the property in `properties`, if there is one of this name.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view property) const;
};

/// What a PLY file says that it holds. The names are views of the file's text.
struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  bool ends_in_lone_return = false;  ///< as the header's lines do, of old Macs
  std::vector<PlyElement> elements;

  /// Throws InputError where there is none of this name.
  [[nodiscard]] const PlyElement& element(std::string_view name) const;
};

/// Reads the lines up to and with `end_header`. Throws InputError, without the line.
[[nodiscard]] PlyHeader read_ply_header(TextLines& lines);

}  // namespace surehit::example
