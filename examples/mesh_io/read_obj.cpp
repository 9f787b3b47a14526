#include "mesh_io/read_obj.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesh_io/input_error.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/polygon.hpp"
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
    // A face may stand before its vertices, so only now is it known what is out of range.
    if (greatest_ > static_cast<std::int64_t>(mesh_.vertices.size())) {
      throw InputError("line " + std::to_string(greatest_line_) + ": vertex index " + std::to_string(greatest_) +
                       " is out of range, there are " + std::to_string(mesh_.vertices.size()) + " vertices");
    }
    return std::move(mesh_);
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

  void read_vertex() {
    if (fields_.size() < 4) {
      throw InputError("a vertex needs 3 coordinates, not " + std::to_string(fields_.size() - 1));
    }
    mesh_.vertices.push_back(
        {parse_number<Scalar>(fields_[1]), parse_number<Scalar>(fields_[2]), parse_number<Scalar>(fields_[3])});
  }

  void read_face() {
    corners_.clear();
    for (std::size_t i = 1; i < fields_.size(); ++i) corners_.push_back(corner(fields_[i]));
    append_fan(corners_, mesh_.triangles);
  }

  /// A corner is 7, 7/1, 7/1/3 or 7//3, of which only the vertex matters.
  std::uint32_t corner(std::string_view field) {
    if (field.find_first_not_of("-0123456789/") != std::string_view::npos) {
      throw InputError(quoted(field) + " is not a face corner");
    }
    const std::int64_t index = parse_integer(field.substr(0, field.find('/')));
    if (index == 0) throw InputError("vertex indices count from 1, there is no vertex 0");
    const auto count = static_cast<std::int64_t>(mesh_.vertices.size());
    if (index < 0) {
      if (index < -count) {
        throw InputError("vertex index " + std::to_string(index) + " reaches back before the first of " +
                         std::to_string(count) + " vertices");
      }
      return checked_corner(count + index, mesh_.vertices.size());
    }
    if (index > greatest_) {
      greatest_ = index;
      greatest_line_ = lines_.number();
    }
    return checked_corner(index - 1, std::numeric_limits<std::uint64_t>::max());
  }

  TextLines lines_;
  Fields fields_;
  Fields continued_;
  std::vector<std::uint32_t> corners_;
  Mesh<Scalar> mesh_;
  std::int64_t greatest_ = 0;  ///< of the positive vertex indices, which count from 1
  std::size_t greatest_line_ = 0;
};

}  // namespace

template <typename Scalar>
Mesh<Scalar> read_obj(std::string_view text) {
  return ObjReader<Scalar>(text).read();
}

template Mesh<float> read_obj<float>(std::string_view);
template Mesh<double> read_obj<double>(std::string_view);

}  // namespace surehit::example
