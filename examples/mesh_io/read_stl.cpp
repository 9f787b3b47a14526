#include "mesh_io/read_stl.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesh_io/byte_reader.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/text_lines.hpp"

namespace surehit::example {
namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t binary_triangle_size = 50;

template <typename Scalar>
void append_triangle(const std::array<std::array<Scalar, 3>, 3>& corners, Mesh<Scalar>& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  if (first > std::numeric_limits<std::uint32_t>::max() - 3) throw InputError("too many triangles for 32-bit indices");
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

/// The reader of the ASCII kind, in which case does not matter.
template <typename Scalar>
class StlTextReader {
 public:
  explicit StlTextReader(std::string_view text) : lines_(text) {}

  Mesh<Scalar> read() {
    return naming_the_line(lines_, [this] {
      if (!next_fields()) throw InputError("the file is empty");
      do {
        expect("solid");
        read_solid();
      } while (next_fields());
      return std::move(mesh_);
    });
  }

 private:
  bool next_fields() {
    while (lines_.next()) {
      split(lines_.line(), fields_);
      if (!fields_.empty()) return true;
    }
    return false;
  }

  void next_line_of_solid() {
    if (!next_fields()) throw InputError("the file ends within a solid");
  }

  [[nodiscard]] bool begins_with(std::string_view keyword) const {
    const auto same_letter = [](char written, char lower) {
      return written == lower || ('A' <= written && written <= 'Z' && written - 'A' + 'a' == lower);
    };
    return std::equal(fields_[0].begin(), fields_[0].end(), keyword.begin(), keyword.end(), same_letter);
  }

  void expect(std::string_view keyword) const {
    if (!begins_with(keyword)) {
      throw InputError("expected " + std::string(keyword) + ", not " + quoted(fields_.front()));
    }
  }

  void read_solid() {
    for (next_line_of_solid(); !begins_with("endsolid"); next_line_of_solid()) read_facet();
  }

  void read_facet() {
    expect("facet");
    next_line_of_solid();
    expect("outer");
    std::array<std::array<Scalar, 3>, 3> corners;
    for (auto& corner : corners) corner = read_corner();
    for (const char* keyword : {"endloop", "endfacet"}) {
      next_line_of_solid();
      expect(keyword);
    }
    append_triangle(corners, mesh_);
  }

  std::array<Scalar, 3> read_corner() {
    next_line_of_solid();
    expect("vertex");
    if (fields_.size() != 4) {
      throw InputError("a vertex has 3 coordinates, not " + std::to_string(fields_.size() - 1));
    }
    return {parse_number<Scalar>(fields_[1]), parse_number<Scalar>(fields_[2]), parse_number<Scalar>(fields_[3])};
  }

  TextLines lines_;
  std::vector<std::string_view> fields_;
  Mesh<Scalar> mesh_;
};

template <typename Scalar>
Mesh<Scalar> read_binary(ByteReader reader, std::uint32_t triangle_count) {
  Mesh<Scalar> mesh;
  for (std::uint32_t i = 0; i < triangle_count; ++i) {
    reader.skip(3 * sizeof(float));  // the normal
    std::array<std::array<Scalar, 3>, 3> corners;
    for (auto& corner : corners) {
      for (Scalar& coordinate : corner) {
        coordinate = reader.take<float>();
        if (!std::isfinite(coordinate)) {
          throw InputError("triangle " + std::to_string(i) + ": a coordinate is not finite");
        }
      }
    }
    reader.skip(sizeof(std::uint16_t));  // the attribute
    append_triangle(corners, mesh);
  }
  return mesh;
}

}  // namespace

template <typename Scalar>
Mesh<Scalar> read_stl(std::string_view bytes) {
  // Binary files may begin with "solid" as well, so the size decides. No text passes for binary by it: its bytes 80 to
  // 83 are the count of a file of many gigabytes.
  if (bytes.size() >= header_size + sizeof(std::uint32_t)) {
    ByteReader reader(bytes.substr(header_size), std::endian::little);
    const auto triangle_count = reader.take<std::uint32_t>();
    if (reader.rest().size() == std::uint64_t{triangle_count} * binary_triangle_size) {
      return read_binary<Scalar>(reader, triangle_count);
    }
    if (bytes.find('\0') != std::string_view::npos) {
      throw InputError("a binary STL file of " + std::to_string(triangle_count) + " triangles is not " +
                       std::to_string(bytes.size()) + " bytes long");
    }
  }
  return StlTextReader<Scalar>(bytes).read();
}

template Mesh<float> read_stl<float>(std::string_view);
template Mesh<double> read_stl<double>(std::string_view);

}  // namespace surehit::example
