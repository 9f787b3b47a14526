#pragma once

#include <cstdint>
#include <string>
#include <surehit/explain.hpp>
#include <vector>

#include "picture/canvas.hpp"

namespace surehit::example {

/// Coloured lines and triangles in space.
struct Drawing {
  enum class Stroke : std::uint8_t {
    cell,          ///< An edge of a cell whose triangles are not asked.
    list,          ///< An edge of a cell whose triangles are asked.
    path,          ///< The path, up to its first hit.
    rest_of_path,  ///< The path behind it.
  };
  struct Line {
    Vector3d from;
    Vector3d to;
    Colour colour;
    Stroke stroke;
  };
  struct Face {
    Triangled triangle;
    Colour colour;
  };

  std::vector<Line> lines;
  std::vector<Face> faces;
  std::vector<Vector3d> points;  ///< The point of the first hit, if there is one.
};

inline constexpr Colour path_colour = Colour::hex(0xffd166);
inline constexpr Colour empty_colour = Colour::hex(0x5680b8);
inline constexpr Colour passed_colour = Colour::hex(0x8f7bd6);
inline constexpr Colour list_colour = Colour::hex(0x5fb3b3);
inline constexpr Colour miss_colour = Colour::hex(0x6c7a89);
inline constexpr Colour left_out_colour = Colour::hex(0x454d5c);
inline constexpr Colour hit_colour = Colour::hex(0xd9734a);
inline constexpr Colour first_colour = Colour::hex(0xe5383b);

/// Draws the cells, the candidates and the path of a query.
template <typename Scalar>
[[nodiscard]] Drawing draw_explanation(const Collider<Scalar>& collider, const Path<Scalar>& path,
                                       const Explanation<Scalar>& explanation);

/// Returns the drawing as a PLY file, with edges, faces and colours of vertices.
[[nodiscard]] std::string ply_text(const Drawing& drawing);
/// Returns the drawing as an OBJ file, with lines, faces and colours of vertices.
[[nodiscard]] std::string obj_text(const Drawing& drawing);

}  // namespace surehit::example
