#include "mesh_io/read_obj.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesh_io/input_error.hpp"
#include "mesh_io/mesh_builder.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/text_lines.hpp"

namespace surehit::example {
namespace {

using Fields = std::vector<std::string_view>;

/// Free-form curves and surfaces are not among them: to pass over a surface would be to read another shape.
constexpr std::array<std::string_view, 19> passed_over = {
    "vt",     "vn",     "vp",     "p",     "l",        "g",        "s",   "mg",         "o",        "usemtl",
    "mtllib", "usemap", "maplib", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj"};

template <typename Scalar>
class ObjReader {
 public:
  explicit ObjReader(std::string_view text) : lines_(text) {}

  Mesh<Scalar> read() {
    naming_the_line(lines_, [this] {
      while (next_statement()) read_statement();
    });
    // A face may come before its vertices, so only now is it known what is out of range.
    if (greatest_ > static_cast<std::int64_t>(mesh_.vertex_count())) {
      throw InputError("line " + std::to_string(max_line_) + ": vertex index " + std::to_string(greatest_) +
                       " is out of range, there are " + std::to_string(mesh_.vertex_count()) + " vertices");
    }
    return mesh_.finish();
  }

 private:
  /// Gathers the fields of one statement, which a backslash at a line's end continues on the next line.
  bool next_statement() {
    if (!lines_.next()) return false;
    split(without_comment(lines_.line()), fields_);
    while (!fields_.empty() && fields_.back().ends_with('\\')) {
      fields_.back().remove_suffix(1);
      if (fields_.back().empty()) fields_.pop_back();
      if (!lines_.next()) throw InputError("the file ends where a backslash promises another line");
      split(without_comment(lines_.line()), continued_);
      fields_.insert(fields_.end(), continued_.begin(), continued_.end());
    }
    return true;
  }

  void read_statement() {
    if (fields_.empty()) return;
    const std::string_view keyword = fields_.front();
    if (keyword == "v") return read_vertex();
    if (keyword == "f") return read_face();
    if (std::find(passed_over.begin(), passed_over.end(), keyword) == passed_over.end()) {
      throw InputError("unknown statement " + quoted(keyword));
    }
  }

  /// x y z, or with a weight x y z w, or with a color x y z r g b and x y z r g b a.
  void read_vertex() {
    const std::size_t numbers = fields_.size() - 1;
    if (numbers < 3) throw InputError("a vertex needs 3 coordinates, not " + std::to_string(numbers));
    if (numbers == 5 || numbers > 7) {
      throw InputError(
          "a vertex has 3 coordinates and then nothing, a weight, or a color of 3 or 4 numbers, but here are " +
          std::to_string(numbers) + " numbers");
    }
    std::array<Scalar, 3> vertex;
    for (std::size_t axis = 0; axis < 3; ++axis) vertex[axis] = number(1 + axis);
    for (std::size_t i = 4; i < fields_.size(); ++i) static_cast<void>(number(i));
    if (numbers == 4) divide(vertex, number(4));
    mesh_.add_vertex(vertex, lines_.number());
  }

  [[nodiscard]] Scalar number(std::size_t field) const { return parse_number_or_non_finite<Scalar>(fields_[field]); }

  /// A weight other than 1 makes the coordinates homogeneous.
  void divide(std::array<Scalar, 3>& vertex, Scalar weight) const {
    if (weight == 0 || !std::isfinite(weight)) {
      throw InputError("a vertex of weight " + quoted(fields_[4]) + " is no point");
    }
    for (Scalar& coordinate : vertex) {
      const Scalar quotient = coordinate / weight;
      if (std::isinf(quotient) && std::isfinite(coordinate)) {
        throw InputError("divided by its weight " + quoted(fields_[4]) + ", a coordinate is beyond the largest number");
      }
      coordinate = quotient;
    }
  }

  void read_face() {
    corners_.clear();
    for (std::size_t i = 1; i < fields_.size(); ++i) corners_.push_back(corner(fields_[i]));
    mesh_.add_face(corners_, lines_.number());
  }

  /// A corner is 7, 7/1, 7/1/3 or 7//3. Only the vertex matters.
  std::uint32_t corner(std::string_view field) {
    if (field.find_first_not_of("-0123456789/") != std::string_view::npos) {
      throw InputError(quoted(field) + " is not a face corner");
    }
    const std::int64_t index = parse_integer(field.substr(0, field.find('/')));
    if (index == 0) throw InputError("vertex indices count from 1, there is no vertex 0");
    const auto count = static_cast<std::int64_t>(mesh_.vertex_count());
    if (index < 0) {
      if (index < -count) {
        throw InputError("vertex index " + std::to_string(index) + " reaches back before the first of " +
                         std::to_string(count) + " vertices");
      }
      return checked_corner(count + index, mesh_.vertex_count());
    }
    if (index > greatest_) {
      greatest_ = index;
      max_line_ = lines_.number();
    }
    return checked_corner(index - 1, std::numeric_limits<std::uint64_t>::max());
  }

  TextLines lines_;
  Fields fields_;
  Fields continued_;
  std::vector<std::uint32_t> corners_;
  MeshBuilder<Scalar> mesh_;
  std::int64_t greatest_ = 0;  ///< of the positive vertex indices, which count from 1
  std::size_t max_line_ = 0;
};

}  // namespace

template <typename Scalar>
Mesh<Scalar> read_obj(std::string_view text) {
  return ObjReader<Scalar>(text).read();
}

template Mesh<float> read_obj<float>(std::string_view);
template Mesh<double> read_obj<double>(std::string_view);

}  // namespace surehit::example
