#include "mesh_io/read_stl.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh_io/byte_reader.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/lower_case.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/text_lines.hpp"

namespace surehit::example {
namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t triangles_begin = header_size + sizeof(std::uint32_t);
constexpr std::uint64_t triangle_size = 50;

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
      if (!next_line()) throw InputError("the file is empty");
      while (keyword_ == "solid") read_solid();
      if (!fields_.empty()) throw_expected("solid");
      return std::move(mesh_);
    });
  }

 private:
  /// Goes to the next line that is neither blank nor a color. At the end there are no fields and no keyword.
  bool next_line() {
    while (lines_.next()) {
      if (lines_.line().find('\0') != std::string_view::npos) throw InputError("the line has a NUL byte in it");
      split(lines_.line(), fields_);
      if (fields_.empty()) continue;
      keyword_ = lower_case(fields_[0]);
      if (keyword_ == "end" && fields_.size() > 1) keyword_ += lower_case(fields_[1]);
      if (keyword_ != "color" && keyword_ != "colour") return true;
    }
    fields_.clear();
    keyword_.clear();
    return false;
  }

  void next_line_of_facet() {
    if (!next_line()) throw InputError("the file ends within a facet");
  }

  [[noreturn]] void throw_expected(const char* keyword) const {
    throw InputError("expected " + std::string(keyword) + ", not " + quoted(fields_.front()));
  }

  void expect(const char* keyword) const {
    if (keyword_ != keyword) throw_expected(keyword);
  }

  /// A solid ends with endsolid, or without where another begins or the file ends.
  void read_solid() {
    for (next_line(); keyword_ != "endsolid"; next_line()) {
      if (keyword_.empty() || keyword_ == "solid") return;
      read_facet();
    }
    next_line();
  }

  void read_facet() {
    expect("facet");
    next_line_of_facet();
    expect("outer");
    std::array<std::array<Scalar, 3>, 3> corners;
    for (auto& corner : corners) corner = read_corner();
    for (const char* keyword : {"endloop", "endfacet"}) {
      next_line_of_facet();
      expect(keyword);
    }
    append_triangle(corners, mesh_);
  }

  std::array<Scalar, 3> read_corner() {
    next_line_of_facet();
    expect("vertex");
    if (fields_.size() != 4) {
      throw InputError("a vertex has 3 coordinates, not " + std::to_string(fields_.size() - 1));
    }
    return {parse_number<Scalar>(fields_[1]), parse_number<Scalar>(fields_[2]), parse_number<Scalar>(fields_[3])};
  }

  TextLines lines_;
  std::vector<std::string_view> fields_;
  std::string keyword_;  ///< in lower case; `end solid` is one word
  Mesh<Scalar> mesh_;
};

/// The binary kind: 80 bytes of any text, the count of triangles, and 50 bytes for each.
class StlBinary {
 public:
  /// There must be the bytes of a count.
  explicit StlBinary(std::string_view bytes) : bytes_(bytes), count_(reader(header_size).take<std::uint32_t>()) {}

  /// The last two bytes of a triangle are its attribute: a color, or the size of what follows it.
  enum class Attribute : std::uint8_t { color, size };

  /// Where the last triangle ends. Nothing where the bytes end before it.
  [[nodiscard]] std::optional<std::size_t> end(Attribute attribute) const {
    std::uint64_t end = triangles_begin;
    if (attribute == Attribute::color) {
      end += count_ * triangle_size;
      return end <= bytes_.size() ? std::optional(end) : std::nullopt;
    }
    for (std::uint64_t i = 0; i < count_; ++i) {
      if (end + triangle_size > bytes_.size()) return std::nullopt;
      end += triangle_size;
      end += reader(end - sizeof(std::uint16_t)).take<std::uint16_t>();
    }
    return end <= bytes_.size() ? std::optional(end) : std::nullopt;
  }

  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::uint64_t count() const { return count_; }

  template <typename Scalar>
  [[nodiscard]] Mesh<Scalar> read(Attribute attribute) const {
    Mesh<Scalar> mesh;
    ByteReader triangles = reader(triangles_begin);
    for (std::uint64_t i = 0; i < count_; ++i) {
      triangles.skip(3 * sizeof(float));  // the normal
      std::array<std::array<Scalar, 3>, 3> corners;
      for (auto& corner : corners) {
        for (Scalar& coordinate : corner) {
          coordinate = triangles.take<float>();
          if (!std::isfinite(coordinate)) {
            throw InputError("triangle " + std::to_string(i) + ": a coordinate is not finite");
          }
        }
      }
      const auto value = triangles.take<std::uint16_t>();
      if (attribute == Attribute::size) triangles.skip(value);
      append_triangle(corners, mesh);
    }
    return mesh;
  }

 private:
  [[nodiscard]] ByteReader reader(std::size_t begin) const { return {bytes_.substr(begin), std::endian::little}; }

  std::string_view bytes_;
  std::uint64_t count_;
};

bool begins_with_solid(std::string_view bytes) {
  const std::size_t word = std::min(bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf"), bytes.size());
  return lower_case(bytes.substr(word, 5)) == "solid";
}

/// Whether at most a tenth of the bytes, rounded up, is nothing that a text has.
bool is_readable(std::string_view bytes) {
  const auto unreadable = std::count_if(bytes.begin(), bytes.end(), [](char c) {
    return (c < ' ' || c > '~') && white_space.find(c) == std::string_view::npos && c != '\n';
  });
  return static_cast<std::size_t>(unreadable) <= (bytes.size() + 9) / 10;
}

/// Tells text from binary files, which may begin with "solid" as well. What follows their header is no text. In a text
/// the bytes of the count spell many millions of triangles, more than it has bytes for.
bool is_text(std::string_view bytes, std::optional<std::size_t> end_of_triangles) {
  constexpr std::size_t looked_at = 1024;
  if (!end_of_triangles) {
    return bytes.find('\0') == std::string_view::npos || is_readable(bytes.substr(header_size, looked_at));
  }
  const std::size_t size = *end_of_triangles - header_size;
  return begins_with_solid(bytes) && is_readable(bytes.substr(header_size, std::min(size, looked_at)));
}

template <typename Scalar>
Mesh<Scalar> read_binary(const StlBinary& binary) {
  const auto end = binary.end(StlBinary::Attribute::color);
  const auto end_by_sizes = binary.end(StlBinary::Attribute::size);
  const std::string triangles = std::to_string(binary.count()) + " triangles";
  if (end != binary.size() && end_by_sizes == binary.size()) return binary.read<Scalar>(StlBinary::Attribute::size);
  if (!end) {
    throw InputError("a binary STL file of " + triangles + " is " +
                     std::to_string(triangles_begin + binary.count() * triangle_size) + " bytes long, not " +
                     std::to_string(binary.size()));
  }
  if (end_by_sizes && end_by_sizes != end) {
    throw InputError("the attributes of its " + triangles +
                     " may be colors or sizes of what follows each, and the file's length fits neither");
  }
  Mesh<Scalar> mesh = binary.read<Scalar>(StlBinary::Attribute::color);
  const std::size_t left = binary.size() - *end;
  if (left >= triangle_size) {
    mesh.warnings.push_back(std::to_string(left) + " bytes follow the last of " + triangles + ", and are passed over");
  }
  return mesh;
}

template <typename Scalar>
Mesh<Scalar> read_either(std::string_view bytes) {
  if (bytes.size() < triangles_begin) return StlTextReader<Scalar>(bytes).read();
  const StlBinary binary(bytes);
  const auto end = binary.end(StlBinary::Attribute::color);
  if (end != bytes.size() && is_text(bytes, end)) return StlTextReader<Scalar>(bytes).read();
  return read_binary<Scalar>(binary);
}

}  // namespace

template <typename Scalar>
Mesh<Scalar> read_stl(std::string_view bytes) {
  Mesh<Scalar> mesh = read_either<Scalar>(bytes);
  if (mesh.triangles.empty()) mesh.warnings.emplace_back(no_triangles);
  return mesh;
}

template Mesh<float> read_stl<float>(std::string_view);
template Mesh<double> read_stl<double>(std::string_view);

}  // namespace surehit::example
