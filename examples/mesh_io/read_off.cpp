#include "mesh_io/read_off.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh_io/input_error.hpp"
#include "mesh_io/lower_case.hpp"
#include "mesh_io/mesh_builder.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/text_lines.hpp"

namespace surehit::example {
namespace {

/// The words of a text, comments left out, one by one or line by line.
class Words {
 public:
  explicit Words(std::string_view text) : lines_(text) {}

  /// Goes on to the next line that has words, if those of this one are used up. Returns false at the end.
  bool has_next() {
    while (used_ == fields_.size()) {
      if (!lines_.next()) return false;
      split(without_comment(lines_.line()), fields_);
      used_ = 0;
    }
    return true;
  }
  /// There must be one, as `has_next` says.
  std::string_view next() {
    ++taken_;
    return fields_[used_++];
  }
  /// The words that the line still has.
  [[nodiscard]] std::size_t left_in_line() const { return fields_.size() - used_; }
  /// Puts the rest of the word that was taken last back in its place.
  void put_back(std::string_view rest) {
    --taken_;
    fields_[--used_] = rest;
  }
  /// How many words were taken.
  [[nodiscard]] std::size_t taken() const { return taken_; }

  [[nodiscard]] const TextLines& lines() const { return lines_; }

 private:
  TextLines lines_;
  std::vector<std::string_view> fields_;
  std::size_t used_ = 0;
  std::size_t taken_ = 0;
};

/// What the first words say.
struct OffHeader {
  std::size_t attributes = 0;  ///< numbers that follow the coordinates of a vertex; a color counts as 4
  /// How many numbers may follow them in a file with this first word, the likelier first.
  std::vector<std::size_t> possible_attributes = {0, 4, 3};
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
};

/// What the lines of a body look like. Lines are right where they may be a vertex or a face by their number of words.
struct OffLines {
  /// There is one for each element. Most of the first ones are alike, and half of the others are right faces.
  bool are_elements = false;
  /// There is one for each element, and all but a few are right.
  bool are_right_elements = false;
  /// Most of the first ones are right vertices, and alike.
  bool are_right_vertices = false;
};

/// The header, and the words that follow it.
struct OffBody {
  OffHeader header;
  Words words;
  OffLines lines;  ///< filled where the first look does not tell
};

/// How the numbers of the body are told apart. Most files have a line for each vertex and for each face, and some of
/// these give attributes that their first word does not tell of. The format's own way is by their number alone,
/// whatever the line breaks, but for what follows the corners of a face in its line: that is a color. Some files have
/// several faces in a line, and no colors.
struct OffLayout {
  enum class Faces : std::uint8_t { line_each, with_colors, without_colors };

  std::optional<std::size_t> attributes;  ///< of each vertex; none where a vertex is a line, with whatever it holds
  Faces faces = Faces::line_each;
};

/// Whether a line of so many numbers may be a vertex of the usual kinds.
bool is_vertex_line(std::size_t numbers, const OffHeader& header) {
  const auto& possible = header.possible_attributes;
  return numbers >= 3 && std::find(possible.begin(), possible.end(), numbers - 3) != possible.end();
}

/// Whether so many numbers behind the corners of a face are a color, or nothing.
bool may_be_color(std::size_t numbers) { return numbers <= 4 && numbers != 2; }

template <typename Scalar>
class OffBodyReader {
 public:
  OffBodyReader(const OffBody& body, const OffLayout& layout)
      : words_(body.words), header_(body.header), layout_(layout) {}

  Mesh<Scalar> read() {
    naming_the_line(words_.lines(), [this] {
      for (std::int64_t i = 0; i < header_.vertices; ++i, ++elements_) read_vertex(i);
      for (std::int64_t i = 0; i < header_.faces; ++i, ++elements_) read_face(i);
      if (words_.has_next()) throw InputError("something follows the last face");
    });
    return mesh_.finish();
  }

  /// How far the reading came: in vertices and faces, and in words.
  [[nodiscard]] std::pair<std::int64_t, std::size_t> progress() const { return {elements_, words_.taken()}; }

 private:
  void begin(const char* kind, std::int64_t index) {
    if (!words_.has_next()) throw InputError("the file ends before " + std::string(kind) + " " + std::to_string(index));
  }

  [[nodiscard]] std::string_view next(const char* kind) {
    if (!words_.has_next()) throw InputError("the file ends within a " + std::string(kind));
    return words_.next();
  }

  void read_vertex(std::int64_t index) {
    begin("vertex", index);
    if (!layout_.attributes) check_vertex_line(words_.left_in_line());
    const std::size_t attributes = layout_.attributes ? *layout_.attributes : words_.left_in_line() - 3;
    std::array<Scalar, 3> vertex;
    const std::size_t line = words_.lines().number();
    for (Scalar& coordinate : vertex) coordinate = parse_number_or_non_finite<Scalar>(next("vertex"));
    for (std::size_t i = 0; i < attributes; ++i) {
      static_cast<void>(parse_number_or_non_finite<Scalar>(next("vertex")));
    }
    mesh_.add_vertex(vertex, line);
  }

  void check_vertex_line(std::size_t numbers) const {
    const bool may_be_any = header_.attributes > 0 && layout_.faces != OffLayout::Faces::line_each;
    if (may_be_any ? numbers >= 3 : is_vertex_line(numbers, header_)) return;
    const std::string more =
        header_.attributes > 0 ? " and " + std::to_string(header_.attributes) + " more numbers" : "";
    throw InputError("a vertex has 3 coordinates" + more + ", not " + std::to_string(numbers));
  }

  void read_face(std::int64_t index) {
    begin("face", index);
    const std::size_t line = words_.lines().number();
    const std::int64_t corner_count = parse_integer(words_.next());
    if (corner_count < 0) throw InputError("a count is negative: " + std::to_string(corner_count));
    if (corner_count < 3) throw InputError("a face needs 3 corners or more, not " + std::to_string(corner_count));
    corners_.clear();
    for (std::int64_t i = 0; i < corner_count; ++i) {
      if (!has_next_corner()) {
        throw InputError("a face of " + std::to_string(corner_count) + " corners has only " + std::to_string(i) +
                         " numbers");
      }
      corners_.push_back(checked_corner(parse_integer(words_.next()), mesh_.vertex_count()));
    }
    mesh_.add_face(corners_, line);
    if (layout_.faces != OffLayout::Faces::without_colors) skip_color();
  }

  bool has_next_corner() {
    return layout_.faces == OffLayout::Faces::line_each ? words_.left_in_line() > 0 : words_.has_next();
  }

  void skip_color() {
    if (!may_be_color(words_.left_in_line())) {
      throw InputError("a face is followed by " + std::to_string(words_.left_in_line()) +
                       " numbers in its line, but a color has 1, 3 or 4");
    }
    while (words_.left_in_line() > 0) static_cast<void>(parse_number_or_non_finite<Scalar>(words_.next()));
  }

  Words words_;
  const OffHeader& header_;
  const OffLayout& layout_;
  std::int64_t elements_ = 0;
  std::vector<std::uint32_t> corners_;
  MeshBuilder<Scalar> mesh_;
};

/// OFF and the letters before it, in either case. Some writers put the counts on the same line, even without a space
/// between, and some leave the word out.
void read_first_word(Words& words, OffHeader& header) {
  if (!words.has_next()) throw InputError("the file is empty");
  const std::string_view first = words.next();
  const std::string lower = lower_case(first);
  constexpr std::string_view magic = "off";
  const std::size_t at = lower.find(magic);
  if (at == std::string::npos) {
    if (lower.find_first_not_of("0123456789") == std::string::npos) return words.put_back(first);
    throw InputError("an OFF file begins with OFF, or without it with the counts, not with " + quoted(first));
  }
  const std::string_view prefix = std::string_view(lower).substr(0, at);
  const bool is_of_any_dimension = first.substr(0, at + magic.size()).ends_with("nOFF");
  if (prefix.find_first_not_of("stcn") != std::string_view::npos || is_of_any_dimension) {
    throw InputError(quoted(first) + " is a kind of OFF file without 3 coordinates a vertex");
  }
  const bool has_color = prefix.find('c') != std::string_view::npos;
  header.attributes = (prefix.find('n') != std::string_view::npos ? 3 : 0) + (has_color ? 4 : 0) +
                      (prefix.find("st") != std::string_view::npos ? 2 : 0);
  if (header.attributes > 0) header.possible_attributes = {header.attributes};
  if (has_color) header.possible_attributes.push_back(header.attributes - 1);
  if (first.size() > at + magic.size()) words.put_back(first.substr(at + magic.size()));
}

std::int64_t read_count(Words& words) {
  if (!words.has_next()) throw InputError("the file ends before the counts");
  const std::string_view word = words.next();
  if (lower_case(word) == "binary") throw InputError("binary OFF files are not supported");
  const std::int64_t value = parse_integer(word);
  if (value < 0) throw InputError("a count is negative: " + quoted(word));
  return value;
}

/// What the file may be: without a count of edges, if that of faces ends its line, and with one.
std::vector<OffBody> read_header(Words words) {
  return naming_the_line(words.lines(), [&] {
    OffHeader header;
    read_first_word(words, header);
    if (!words.has_next()) throw InputError("the file ends before the counts");
    header.vertices = read_count(words);
    header.faces = read_count(words);
    std::vector<OffBody> bodies;
    if (words.left_in_line() == 0) bodies.push_back({header, words, {}});
    try {
      static_cast<void>(read_count(words));
      bodies.push_back({header, words, {}});
    } catch (const InputError&) {
      if (bodies.empty()) throw;
    }
    return bodies;
  });
}

/// The layouts in which an element need not be a line, the format's own first.
std::vector<OffLayout> free_layouts_of(const OffHeader& header, OffLayout::Faces faces) {
  std::vector<OffLayout> layouts;
  for (const std::size_t count : header.possible_attributes) layouts.push_back({count, faces});
  layouts.push_back({std::nullopt, faces});
  return layouts;
}

bool is_face_line(std::string_view first, std::size_t words) {
  std::size_t corners = 0;
  const auto [rest, error] = std::from_chars(first.data(), first.data() + first.size(), corners);
  return error == std::errc{} && rest == first.data() + first.size() && corners >= 3 && corners < words &&
         may_be_color(words - 1 - corners);
}

/// Looks at all lines, without reading their numbers.
OffLines lines_of(OffBody body) {
  const auto vertices = static_cast<std::uint64_t>(body.header.vertices);
  const auto faces = static_cast<std::uint64_t>(body.header.faces);
  std::map<std::size_t, std::uint64_t> vertex_lines;  // by their number of words
  std::uint64_t face_lines = 0;
  std::uint64_t lines = 0;
  for (; body.words.has_next(); ++lines) {
    const std::size_t words = body.words.left_in_line();
    const std::string_view first = body.words.next();
    while (body.words.left_in_line() > 0) static_cast<void>(body.words.next());
    if (lines < vertices) {
      ++vertex_lines[words];
    } else if (is_face_line(first, words)) {
      ++face_lines;
    }
  }
  if (vertex_lines.empty()) return {};
  const auto [words, alike] = *std::max_element(vertex_lines.begin(), vertex_lines.end(),
                                                [](const auto& a, const auto& b) { return a.second < b.second; });
  const bool is_right = is_vertex_line(words, body.header);
  const bool are_alike = alike > vertices / 2;
  const bool are_as_many = lines == vertices + faces;
  OffLines look;
  look.are_elements = are_as_many && are_alike && 2 * face_lines >= faces;
  look.are_right_vertices = are_alike && is_right;
  look.are_right_elements =
      are_as_many && is_right && lines - alike - face_lines <= std::max<std::uint64_t>(1, lines / 4);
  return look;
}

/// The first layout that fits all of the file is the file's.
template <typename Scalar>
class OffReader {
 public:
  explicit OffReader(std::string_view text) : bodies_(read_header(Words(text))) {}

  Mesh<Scalar> read() {
    const OffLayout line_each;
    for (const OffBody& body : bodies_) {
      if (auto mesh = try_layout(body, line_each)) return *std::move(mesh);
    }
    // Where but a few lines are right, these are a mistake. Another layout might fit it, but with other numbers for
    // coordinates.
    for (OffBody& body : bodies_) {
      body.lines = lines_of(body);
      if (body.lines.are_right_elements) return OffBodyReader<Scalar>(body, line_each).read();
    }
    // The format's own way is with a count of edges. Colors of faces leave the most slack.
    std::reverse(bodies_.begin(), bodies_.end());
    for (const OffLayout::Faces faces : {OffLayout::Faces::without_colors, OffLayout::Faces::with_colors}) {
      for (const OffBody& body : bodies_) {
        for (const OffLayout& layout : free_layouts_of(body.header, faces)) {
          if (auto mesh = try_layout(body, layout)) return *std::move(mesh);
        }
      }
    }
    for (const OffBody& body : bodies_) {
      if (body.lines.are_elements) return OffBodyReader<Scalar>(body, line_each).read();
    }
    throw InputError(*error_);
  }

 private:
  /// Keeps the error of the layout that came furthest. But a layout that the file does not look like is a guess, which
  /// must not name what is wrong.
  std::optional<Mesh<Scalar>> try_layout(const OffBody& body, const OffLayout& layout) {
    OffBodyReader<Scalar> reader(body, layout);
    try {
      return reader.read();
    } catch (const InputError& error) {
      const bool is_guess =
          body.lines.are_right_vertices ? layout.attributes.has_value() : layout.attributes != body.header.attributes;
      if (!is_guess && (!error_ || reader.progress() > furthest_)) {
        furthest_ = reader.progress();
        error_ = error;
      }
      return std::nullopt;
    }
  }

  std::vector<OffBody> bodies_;
  std::optional<InputError> error_;
  std::pair<std::int64_t, std::size_t> furthest_;
};

}  // namespace

template <typename Scalar>
Mesh<Scalar> read_off(std::string_view text) {
  return OffReader<Scalar>(text).read();
}

template Mesh<float> read_off<float>(std::string_view);
template Mesh<double> read_off<double>(std::string_view);

}  // namespace surehit::example
