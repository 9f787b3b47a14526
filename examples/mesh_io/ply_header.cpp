#include "mesh_io/ply_header.hpp"

#include <algorithm>
#include <utility>

#include "mesh_io/parse_number.hpp"

namespace surehit::example {
namespace {

using Fields = std::vector<std::string_view>;

constexpr std::pair<std::string_view, PlyFormat> format_names[] = {
    {"ascii", PlyFormat::ascii},
    {"binary_little_endian", PlyFormat::binary_little_endian},
    {"binary_big_endian", PlyFormat::binary_big_endian},
};

constexpr std::pair<std::string_view, PlyType> type_names[] = {
    {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64},
};

template <typename Names>
auto named(const Names& names, std::string_view name, const char* kind) {
  const auto* const found =
      std::find_if(std::begin(names), std::end(names), [name](const auto& entry) { return entry.first == name; });
  if (found == std::end(names)) throw InputError("unknown " + std::string(kind) + " " + quoted(name));
  return found->second;
}

PlyElement parse_element(const Fields& fields, const PlyHeader& header) {
  if (fields.size() != 3) throw InputError("expected: element NAME COUNT");
  const auto same_name = [&](const PlyElement& element) { return element.name == fields[1]; };
  if (std::any_of(header.elements.begin(), header.elements.end(), same_name)) {
    throw InputError("a second element " + quoted(fields[1]));
  }
  const std::int64_t count = parse_integer(fields[2]);
  if (count < 0) throw InputError("a count is negative: " + quoted(fields[2]));
  return {fields[1], static_cast<std::uint64_t>(count), {}};
}

PlyProperty parse_property(const Fields& fields, const PlyHeader& header) {
  const bool is_list = fields.size() > 1 && fields[1] == "list";
  if (fields.size() != (is_list ? 5 : 3)) {
    throw InputError("expected: property TYPE NAME, or: property list COUNT_TYPE TYPE NAME");
  }
  if (header.elements.empty()) throw InputError("a property before the first element");
  const PlyProperty property = {fields.back(), named(type_names, fields[fields.size() - 2], "type"),
                                is_list ? std::optional(named(type_names, fields[2], "type")) : std::nullopt};
  if (property.count_type && !is_integer(*property.count_type)) throw InputError("the count of a list is an integer");
  if (header.elements.back().find(property.name)) throw InputError("a second property " + quoted(property.name));
  return property;
}

void read_first_line(TextLines& lines) {
  if (lines.next() && lines.line() == "ply") return;
  Fields fields;
  split(lines.line(), fields);
  if (!fields.empty() && fields[0] == "ply") {
    throw InputError(fields.size() == 1
                         ? "the first line of a PLY file is ply alone, but here it has a blank beside it"
                         : "the first line of a PLY file is ply alone, but here it goes on with " + quoted(fields[1]));
  }
  throw InputError("a PLY file begins with a line: ply");
}

}  // namespace

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [property](const PlyProperty& candidate) { return candidate.name == property; });
  if (found == properties.end()) return std::nullopt;
  return static_cast<std::size_t>(found - properties.begin());
}

const PlyElement& PlyHeader::element(std::string_view name) const {
  const auto found = std::find_if(elements.begin(), elements.end(),
                                  [name](const PlyElement& candidate) { return candidate.name == name; });
  if (found == elements.end()) throw InputError("the header has no element " + quoted(name));
  return *found;
}

PlyHeader read_ply_header(TextLines& lines) {
  Fields fields;
  const auto next_fields = [&] {
    do {
      if (!lines.next()) throw InputError("the file ends within the header");
      split(lines.line(), fields);
    } while (fields.empty() || fields[0] == "comment" || fields[0] == "obj_info");
  };

  read_first_line(lines);
  PlyHeader header;
  header.ends_in_lone_return = lines.line_end() == "\r";
  next_fields();
  if (fields.size() != 3 || fields[0] != "format") throw InputError("expected: format NAME VERSION");
  header.format = named(format_names, fields[1], "format");

  for (next_fields(); fields[0] != "end_header"; next_fields()) {
    if (fields[0] == "element") {
      header.elements.push_back(parse_element(fields, header));
    } else if (fields[0] == "property") {
      const PlyProperty property = parse_property(fields, header);
      header.elements.back().properties.push_back(property);
    } else {
      throw InputError("unknown header line " + quoted(lines.line()));
    }
  }
  return header;
}

}  // namespace surehit::example
