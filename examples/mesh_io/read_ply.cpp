#include "mesh_io/read_ply.hpp"

#include <bit>
#include <string>
#include <utility>
#include <vector>

#include "mesh_io/ply_header.hpp"
#include "mesh_io/ply_values.hpp"
#include "mesh_io/polygon.hpp"

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
      throw error.at(printable(element.name) + " " + std::to_string(i));
    }
  }
}

template <typename Scalar, typename Values>
class PlyBodyReader {
 public:
  PlyBodyReader(const PlyHeader& header, Values values) : header_(header), values_(std::move(values)) {}

  Mesh<Scalar> read() {
    const PlyElement& vertex = header_.element("vertex");
    const PlyElement& face = header_.element("face");
    for (const PlyElement& element : header_.elements) {
      if (&element == &vertex) {
        read_vertices(element);
      } else if (&element == &face) {
        read_faces(element, vertex.count);
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
        throw InputError("the element vertex has no number " + quoted(name));
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
      mesh_.vertices.push_back(vertex);
    });
  }

  void read_faces(const PlyElement& element, std::uint64_t vertex_count) {
    const auto found = element.find("vertex_indices") ? element.find("vertex_indices") : element.find("vertex_index");
    if (!found || !element.properties[*found].count_type || !is_integer(element.properties[*found].type)) {
      throw InputError("the element face has no list 'vertex_indices' of integers");
    }
    std::vector<std::uint32_t> corners;
    for_each_element(element, values_, [&] {
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (i == *found) {
          read_corners(element.properties[i], vertex_count, corners);
        } else {
          skip_property(element.properties[i], values_);
        }
      }
      append_fan(corners, mesh_.triangles);
    });
  }

  void read_corners(const PlyProperty& list, std::uint64_t vertex_count, std::vector<std::uint32_t>& corners) {
    corners.clear();
    for (std::uint64_t left = list_size(values_.integer(*list.count_type)); left > 0; --left) {
      corners.push_back(checked_corner(values_.integer(list.type), vertex_count));
    }
  }

  void skip(const PlyElement& element) {
    for_each_element(element, values_, [&] {
      for (const PlyProperty& property : element.properties) skip_property(property, values_);
    });
  }

  const PlyHeader& header_;
  Values values_;
  Mesh<Scalar> mesh_;
};

}  // namespace

template <typename Scalar>
Mesh<Scalar> read_ply(std::string_view bytes) {
  TextLines lines(bytes);
  const PlyHeader header = naming_the_line(lines, [&] { return read_ply_header(lines); });
  if (header.format == PlyFormat::ascii) {
    return naming_the_line(lines,
                           [&] { return PlyBodyReader<Scalar, PlyTextValues>(header, PlyTextValues(lines)).read(); });
  }
  const std::endian order = header.format == PlyFormat::binary_big_endian ? std::endian::big : std::endian::little;
  const PlyBinaryValues values(ByteReader(lines.rest(), order));
  return PlyBodyReader<Scalar, PlyBinaryValues>(header, values).read();
}

template Mesh<float> read_ply<float>(std::string_view);
template Mesh<double> read_ply<double>(std::string_view);

}  // namespace surehit::example
