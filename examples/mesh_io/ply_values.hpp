#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_io/byte_reader.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/ply_header.hpp"
#include "mesh_io/text_lines.hpp"

namespace surehit::example {

/// The values in the body of an ASCII PLY file: a line an element, blank lines aside.
class PlyTextValues {
 public:
  explicit PlyTextValues(TextLines& lines) : lines_(lines) {}

  void begin_element() {
    if (!next_fields()) throw InputError("the file ends too early");
    used_ = 0;
  }

  void end_element() const {
    if (used_ != fields_.size()) throw InputError(quoted(fields_[used_]) + " is more than the header announces");
  }

  void end_file() {
    if (next_fields()) throw InputError("something follows the last element");
  }

  std::int64_t integer(PlyType) { return parse_integer(next()); }

  template <typename Scalar>
  Scalar number(PlyType) {
    return parse_number_or_non_finite<Scalar>(next());
  }

  /// Where the element is.
  [[nodiscard]] std::size_t line() const { return lines_.number(); }

  void skip(PlyType, std::uint64_t count) {
    for (; count > 0; --count) next();
  }

 private:
  bool next_fields() {
    fields_.clear();
    while (fields_.empty() && lines_.next()) split(lines_.line(), fields_);
    return !fields_.empty();
  }

  std::string_view next() {
    if (used_ == fields_.size()) throw InputError("the line ends too early");
    return fields_[used_++];
  }

  TextLines& lines_;
  std::vector<std::string_view> fields_;
  std::size_t used_ = 0;
};

/// The values in the body of a binary PLY file.
class PlyBinaryValues {
 public:
  explicit PlyBinaryValues(ByteReader bytes) : bytes_(bytes) {}

  void begin_element() {}
  void end_element() {}

  void end_file() const {
    if (bytes_.rest().find_first_not_of("\r\n\x1a") != std::string_view::npos) {
      throw InputError(std::to_string(bytes_.rest().size()) + " bytes follow the last element");
    }
  }

  std::int64_t integer(PlyType type) { return take<std::int64_t>(type); }

  template <typename Scalar>
  Scalar number(PlyType type) {
    const auto written = take<double>(type);
    const auto value = static_cast<Scalar>(written);
    if (std::isinf(value) && std::isfinite(written)) throw InputError("a coordinate is beyond the largest number");
    return value;
  }

  /// A binary file has none.
  [[nodiscard]] std::size_t line() const { return 0; }

  void skip(PlyType type, std::uint64_t count) { bytes_.skip(count * size_of(type)); }

 private:
  template <typename Wanted>
  Wanted take(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return static_cast<Wanted>(bytes_.take<std::int8_t>());
      case PlyType::uint8:
        return static_cast<Wanted>(bytes_.take<std::uint8_t>());
      case PlyType::int16:
        return static_cast<Wanted>(bytes_.take<std::int16_t>());
      case PlyType::uint16:
        return static_cast<Wanted>(bytes_.take<std::uint16_t>());
      case PlyType::int32:
        return static_cast<Wanted>(bytes_.take<std::int32_t>());
      case PlyType::uint32:
        return static_cast<Wanted>(bytes_.take<std::uint32_t>());
      case PlyType::float32:
        return static_cast<Wanted>(bytes_.take<float>());
      case PlyType::float64:
        break;
    }
    return static_cast<Wanted>(bytes_.take<double>());
  }

  static std::uint64_t size_of(PlyType type) {
    constexpr std::uint64_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
  }

  ByteReader bytes_;
};

}  // namespace surehit::example
