#include "surehit_query/read_scene.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "mesh_io/input_error.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/read_file.hpp"
#include "mesh_io/text_lines.hpp"
#include "surehit_query/mask_list.hpp"
#include "surehit_query/number_table.hpp"

namespace surehit::example {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t pose_numbers = 12;
constexpr char quotation_mark = '"';

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(white_space), text.size());
  return text.substr(begin, text.find_last_not_of(white_space) + 1 - begin);
}

/// Takes a name in quotation marks off the front of the line.
std::string take_quoted_name(std::string_view& line) {
  std::string name;
  std::size_t at = 1;
  for (;;) {
    const std::size_t mark = line.find(quotation_mark, at);
    if (mark == std::string_view::npos) throw InputError("a quotation mark is missing behind " + quoted(line));
    name += line.substr(at, mark - at);
    at = mark + 1;
    if (!line.substr(at).starts_with(quotation_mark)) break;
    name += quotation_mark;
    ++at;
  }
  line.remove_prefix(at);
  if (!line.empty() && line.front() != ',' && white_space.find(line.front()) == std::string_view::npos) {
    throw InputError("white space or a comma is missing behind the name of the mesh");
  }
  return name;
}

/// Takes the name of the mesh off the front of the line, and what separates it from the numbers.
std::string take_name(std::string_view& line) {
  std::string name;
  if (line.starts_with(quotation_mark)) {
    name = take_quoted_name(line);
  } else {
    const std::size_t end = std::min({line.find_first_of(white_space), line.find(','), line.size()});
    name = line.substr(0, end);
    line.remove_prefix(end);
  }
  line = trimmed(line);
  if (line.starts_with(',')) line = trimmed(line.substr(1));
  if (name.empty()) throw InputError("the name of the mesh is missing");
  return name;
}

/// What stands behind the name of a mesh.
class PlacingWords {
 public:
  explicit PlacingWords(std::string_view text) {
    std::vector<std::string_view> part;
    if (!text.empty()) split_at_commas(text, part, words_);
  }

  template <typename Scalar>
  void place(PlacedMesh<Scalar>& placed) {
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 3; ++column) placed.pose.linear(row, column) = take_pose_number<Scalar>();
      placed.pose.translation[row] = take_pose_number<Scalar>();
    }
    bool has_motion = false;
    bool has_mask = false;
    while (at_ < words_.size()) {
      const std::string_view word = words_[at_++];
      if (word == "motion") {
        name_once(word, has_motion);
        for (Scalar& coordinate : placed.motion) coordinate = parse_number<Scalar>(take("motion needs 3 numbers"));
      } else if (word == "mask") {
        name_once(word, has_mask);
        placed.mask = parse_mask(take("mask needs a number"));
      } else {
        throw InputError("expected motion or mask, not " + quoted(word));
      }
    }
  }

 private:
  static bool is_name(std::string_view word) { return word == "motion" || word == "mask"; }

  static void name_once(std::string_view name, bool& is_named) {
    if (is_named) throw InputError(std::string(name) + " is there twice");
    is_named = true;
  }

  std::string_view take(const char* error) {
    if (at_ == words_.size() || is_name(words_[at_])) throw InputError(error);
    return words_[at_++];
  }

  template <typename Scalar>
  Scalar take_pose_number() {
    if (at_ == words_.size() || is_name(words_[at_])) {
      throw InputError("a pose has " + std::to_string(pose_numbers) + " numbers, not " + std::to_string(at_));
    }
    return parse_number<Scalar>(words_[at_++]);
  }

  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

template <typename Scalar>
std::vector<PlacedMesh<Scalar>> parse_scene(std::string_view text, const fs::path& folder) {
  std::vector<PlacedMesh<Scalar>> scene;
  TextLines lines(text);
  naming_the_line(lines, [&] {
    while (lines.next()) {
      std::string_view line = trimmed(lines.line());
      if (line.empty() || line.front() == '#') continue;
      PlacedMesh<Scalar> placed;
      placed.line = lines.number();
      placed.mesh_path = (folder / take_name(line)).lexically_normal().string();
      PlacingWords(line).place(placed);
      scene.push_back(std::move(placed));
    }
  });
  return scene;
}

}  // namespace

template <typename Scalar>
std::vector<PlacedMesh<Scalar>> read_scene(const std::string& path) {
  const bool is_standard_input = path == "-";
  try {
    return parse_scene<Scalar>(read_file(path), is_standard_input ? fs::path() : fs::path(path).parent_path());
  } catch (const InputError& error) {
    throw error.at(is_standard_input ? "standard input" : path);
  }
}

template std::vector<PlacedMesh<float>> read_scene<float>(const std::string&);
template std::vector<PlacedMesh<double>> read_scene<double>(const std::string&);

}  // namespace surehit::example
