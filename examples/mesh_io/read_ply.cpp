#include "mesh_io/read_ply.hpp"

#include <bit>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh_io/mesh_builder.hpp"
#include "mesh_io/ply_header.hpp"
#include "mesh_io/ply_values.hpp"

namespace surehit::example {
namespace {

std::uint64_t list_size(const std::int64_t count) {
  if (count < 0) throw InputError("the count of a list is negative: " + std::to_string(count));
  return static_cast<std::uint64_t>(count);
}

template <typename Values>
void skip_property(const PlyProperty& property, Values& values) {
  values.skip(property.type, property.count_type ? list_size(values.integer(*property.count_type)) : 1);
}

/// Reads the elements of one kind, each by `read_one(property)` for all of its properties in turn.
template <typename Values, typename ReadOne>
void for_each_element(const PlyElement& element, Values& values, ReadOne read_one) {
  if (element.properties.empty()) return;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    try {
      values.begin_element();
      read_one();
      values.end_element();
    } catch (const InputError& error) {
      const std::string place = printable(element.name) + " " + std::to_string(i);
      if (std::string_view(error.what()).starts_with(place + " ")) throw;  // a face that cannot be cut says so itself
      throw error.at(place);
    }
  }
}

template <typename Scalar, typename Values>
class PlyBodyReader {
 public:
  PlyBodyReader(const PlyHeader& header, Values values) : header_(header), values_(std::move(values)) {}

  /// The mesh, not yet finished.
  MeshBuilder<Scalar> read() {
    const PlyElement& vertex = header_.element("vertex");
    for (const PlyElement& element : header_.elements) {
      if (&element == &vertex) {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element, vertex.count);
      } else if (element.name == "tristrips") {
        read_strips(element, vertex.count);
      } else {
        skip(element);
      }
    }
    values_.end_file();
    return std::move(mesh_);
  }

 private:
  void read_vertices(const PlyElement& element) {
    constexpr std::size_t none = 3;
    std::vector<std::size_t> axis_of(element.properties.size(), none);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      const auto property = element.find(name);
      if (!property || element.properties[*property].count_type) {
        throw InputError("the element vertex has no number " + example::quoted(name));
      }
      axis_of[*property] = axis;
    }
    for_each_element(element, values_, [&] {
      std::array<Scalar, 3> vertex;
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (axis_of[i] == none) {
          skip_property(element.properties[i], values_);
        } else {
          vertex[axis_of[i]] = values_.template number<Scalar>(element.properties[i].type);
        }
      }
      mesh_.add_vertex(vertex, values_.line());
    });
  }

  void read_faces(const PlyElement& element, std::uint64_t vertex_count) {
    std::vector<std::uint32_t> corners;
    for_each_list(element, [&](const PlyProperty& list, std::uint64_t size) {
      corners.clear();
      for (; size > 0; --size) corners.push_back(checked_corner(values_.integer(list.type), vertex_count));
      mesh_.add_face(corners, values_.line());
    });
  }

  /// In a strip each corner makes a triangle with the two before it, every second one the other way round. -1 begins a
  /// new strip. A triangle that names a corner twice leads on to another part of the strip, and is no surface.
  void read_strips(const PlyElement& element, std::uint64_t vertex_count) {
    std::vector<std::uint32_t> corners(3);
    std::vector<std::uint32_t> face(3);
    for_each_list(element, [&](const PlyProperty& list, std::uint64_t size) {
      for (std::uint64_t in_strip = 0; size > 0; --size) {
        const std::int64_t index = values_.integer(list.type);
        if (index == -1) {
          in_strip = 0;
          continue;
        }
        corners = {corners[1], corners[2], checked_corner(index, vertex_count)};
        ++in_strip;
        const auto [a, b, c] = std::tuple(corners[0], corners[1], corners[2]);
        if (in_strip < 3 || a == b || b == c || c == a) continue;
        const bool is_turned = in_strip % 2 == 0;
        face = {is_turned ? b : a, is_turned ? a : b, c};
        mesh_.add_face(face, values_.line());
      }
    });
  }

  /// Reads elements that are a list of indices and more, each list by `read_list(property, size)`.
  template <typename ReadList>
  void for_each_list(const PlyElement& element, ReadList read_list) {
    const auto found = element.find("vertex_indices") ? element.find("vertex_indices") : element.find("vertex_index");
    if (!found || !element.properties[*found].count_type || !is_integer(element.properties[*found].type)) {
      if (element.count == 0) return;
      throw InputError("the element " + printable(element.name) + " has no list 'vertex_indices' of integers");
    }
    for_each_element(element, values_, [&] {
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (i == *found) {
          read_list(property, list_size(values_.integer(*property.count_type)));
        } else {
          skip_property(property, values_);
        }
      }
    });
  }

  void skip(const PlyElement& element) {
    for_each_element(element, values_, [&] {
      for (const PlyProperty& property : element.properties) skip_property(property, values_);
    });
  }

  const PlyHeader& header_;
  Values values_;
  MeshBuilder<Scalar> mesh_;
};

template <typename Scalar>
Mesh<Scalar> read_text_body(const PlyHeader& header, TextLines& lines) {
  PlyBodyReader<Scalar, PlyTextValues> body(header, PlyTextValues(lines));
  return naming_the_line(lines, [&] { return body.read(); }).finish();
}

/// Where header lines end in a lone \r, a \n behind the last one is the first byte of the body.
std::string_view binary_body(const PlyHeader& header, const TextLines& lines) {
  const std::size_t returned = header.ends_in_lone_return && lines.line_end() == "\r\n" ? 1 : 0;
  return {lines.rest().data() - returned, lines.rest().size() + returned};
}

template <typename Scalar>
Mesh<Scalar> read_binary_body(const PlyHeader& header, const TextLines& lines) {
  const std::endian order = header.format == PlyFormat::binary_big_endian ? std::endian::big : std::endian::little;
  const PlyBinaryValues values(ByteReader(binary_body(header, lines), order));
  return PlyBodyReader<Scalar, PlyBinaryValues>(header, values).read().finish();
}

}  // namespace

template <typename Scalar>
Mesh<Scalar> read_ply(std::string_view bytes) {
  TextLines lines(bytes);
  const PlyHeader header = naming_the_line(lines, [&] { return read_ply_header(lines); });
  return header.format == PlyFormat::ascii ? read_text_body<Scalar>(header, lines)
                                           : read_binary_body<Scalar>(header, lines);
}

template Mesh<float> read_ply<float>(std::string_view);
template Mesh<double> read_ply<double>(std::string_view);

}  // namespace surehit::example
