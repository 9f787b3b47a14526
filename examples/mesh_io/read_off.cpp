#include "mesh_io/read_off.hpp"

#include <string>
#include <utility>
#include <vector>

#include "mesh_io/input_error.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/polygon.hpp"
#include "mesh_io/text_lines.hpp"

namespace surehit::example {
namespace {

template <typename Scalar>
class OffReader {
 public:
  explicit OffReader(std::string_view text) : lines_(text) {}

  Mesh<Scalar> read() {
    return naming_the_line(lines_, [this] {
      read_header();
      for (std::int64_t i = 0; i < vertex_count_; ++i) read_vertex(i);
      for (std::int64_t i = 0; i < face_count_; ++i) read_face(i);
      if (next_fields()) throw InputError("something follows the last face");
      return std::move(mesh_);
    });
  }

 private:
  bool next_fields() {
    while (lines_.next()) {
      split(without_comment(lines_.line()), fields_);
      if (!fields_.empty()) return true;
    }
    return false;
  }

  void next_element(const char* kind, std::int64_t index) {
    if (!next_fields()) {
      throw InputError("the file ends before " + std::string(kind) + " " + std::to_string(index));
    }
  }

  void read_header() {
    if (!next_fields()) throw InputError("the file is empty");
    read_magic();
    if (fields_.empty() && !next_fields()) throw InputError("the file ends before the counts");
    if (fields_.size() < 2 || fields_.size() > 3) {
      throw InputError("expected the counts of vertices, faces and edges");
    }
    vertex_count_ = count(fields_[0]);
    face_count_ = count(fields_[1]);
  }

  /// Takes OFF and the letters before it off the first field. Some writers put the counts on the same line, even
  /// without a space between.
  void read_magic() {
    constexpr std::string_view magic = "OFF";
    std::string_view& first = fields_.front();
    const std::size_t at = first.find(magic);
    if (at == std::string_view::npos) throw InputError("an OFF file begins with OFF, not with " + quoted(first));
    const std::string_view prefix = first.substr(0, at);
    if (prefix.find_first_not_of("STCN") != std::string_view::npos) {
      throw InputError(quoted(first) + " is a kind of OFF file without 3 coordinates a vertex");
    }
    has_attributes_ = !prefix.empty();
    first.remove_prefix(at + magic.size());
    if (first.empty()) fields_.erase(fields_.begin());
    if (!fields_.empty() && fields_.front() == "BINARY") throw InputError("binary OFF files are not supported");
  }

  static std::int64_t count(std::string_view field) {
    const std::int64_t value = parse_integer(field);
    if (value < 0) throw InputError("a count is negative: " + quoted(field));
    return value;
  }

  void read_vertex(std::int64_t index) {
    next_element("vertex", index);
    if (fields_.size() < 3 || (fields_.size() > 3 && !has_attributes_)) {
      throw InputError("a vertex has 3 coordinates, not " + std::to_string(fields_.size()));
    }
    mesh_.vertices.push_back(
        {parse_number<Scalar>(fields_[0]), parse_number<Scalar>(fields_[1]), parse_number<Scalar>(fields_[2])});
  }

  void read_face(std::int64_t index) {
    next_element("face", index);
    const auto corner_count = static_cast<std::uint64_t>(count(fields_.front()));
    if (corner_count > fields_.size() - 1) {
      throw InputError("a face of " + std::to_string(corner_count) + " corners has only " +
                       std::to_string(fields_.size() - 1) + " numbers");
    }
    corners_.clear();
    for (std::size_t i = 1; i <= corner_count; ++i) {
      corners_.push_back(checked_corner(parse_integer(fields_[i]), mesh_.vertices.size()));
    }
    append_fan(corners_, mesh_.triangles);
  }

  TextLines lines_;
  std::vector<std::string_view> fields_;
  std::vector<std::uint32_t> corners_;
  Mesh<Scalar> mesh_;
  std::int64_t vertex_count_ = 0;
  std::int64_t face_count_ = 0;
  bool has_attributes_ = false;
};

}  // namespace

template <typename Scalar>
Mesh<Scalar> read_off(std::string_view text) {
  return OffReader<Scalar>(text).read();
}

template Mesh<float> read_off<float>(std::string_view);
template Mesh<double> read_off<double>(std::string_view);

}  // namespace surehit::example
