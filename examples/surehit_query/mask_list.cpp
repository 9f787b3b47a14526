#include "surehit_query/mask_list.hpp"

#include <charconv>

#include "mesh_io/input_error.hpp"
#include "mesh_io/read_file.hpp"
#include "mesh_io/text_lines.hpp"

namespace surehit::example {
namespace {

constexpr std::uint32_t all_bits = ~std::uint32_t{0};

std::vector<std::uint32_t> parse_masks(std::string_view text) {
  std::vector<std::uint32_t> masks;
  std::vector<std::string_view> fields;
  TextLines lines(text);
  naming_the_line(lines, [&] {
    while (lines.next()) {
      split(lines.line(), fields);
      if (fields.empty() || fields[0].starts_with('#')) continue;
      if (fields.size() != 1) throw InputError("expected one mask, not " + std::to_string(fields.size()));
      masks.push_back(parse_mask(fields[0]));
    }
  });
  return masks;
}

}  // namespace

std::uint32_t parse_mask(std::string_view text) {
  const bool is_hex = text.starts_with("0x") || text.starts_with("0X");
  const std::string_view digits = text.substr(is_hex ? 2 : 0);
  std::uint32_t mask = 0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), mask, is_hex ? 16 : 10);
  if (error != std::errc{} || rest != digits.data() + digits.size()) {
    throw InputError(quoted(text) + " is no mask of 32 bits");
  }
  return mask;
}

void check_is_there(const std::optional<std::uint32_t>& id, std::size_t count, const std::string& kind) {
  if (id && *id >= count) {
    throw InputError("--ignore-" + kind + ": there is no " + kind + " " + std::to_string(*id) + " among " +
                     std::to_string(count) + ", which count from 0");
  }
}

std::vector<std::uint32_t> read_masks(const std::string& path) {
  try {
    return parse_masks(read_file(path));
  } catch (const InputError& error) {
    throw error.at(path == "-" ? "standard input" : path);
  }
}

template <typename Scalar>
std::vector<std::uint32_t> masks_of(const QueryRequest& request, const Mesh<Scalar>& mesh) {
  const auto triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
  check_is_there(request.ignored_triangle, triangle_count, "triangle");
  check_is_there(request.ignored_face, mesh.face_count(), "face");

  std::vector<std::uint32_t> masks;
  if (!request.masks_path.empty()) {
    const std::vector<std::uint32_t> listed = read_masks(request.masks_path);
    const bool is_by_face = listed.size() == mesh.face_count();
    if (!is_by_face && listed.size() != triangle_count) {
      throw InputError(request.masks_path + ": " + std::to_string(listed.size()) + " masks for " +
                       std::to_string(triangle_count) + " triangles of " + std::to_string(mesh.face_count()) +
                       " faces");
    }
    for (std::uint32_t i = 0; i < triangle_count; ++i) masks.push_back(listed[is_by_face ? mesh.face_of(i) : i]);
  }
  if (request.ignored_face) {
    masks.resize(triangle_count, all_bits);
    for (std::uint32_t i = 0; i < triangle_count; ++i) {
      if (mesh.face_of(i) == *request.ignored_face) masks[i] = 0;
    }
  }
  return masks;
}

template std::vector<std::uint32_t> masks_of(const QueryRequest&, const Mesh<float>&);
template std::vector<std::uint32_t> masks_of(const QueryRequest&, const Mesh<double>&);

}  // namespace surehit::example
