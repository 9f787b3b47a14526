#include "surehit_query/explanation_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "surehit_query/hit_text.hpp"

namespace surehit::example {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void add_box(Drawing& drawing, const Boxd& box, const Colour& colour, Drawing::Stroke stroke) {
  if (!box.low.allFinite() || !box.high.allFinite()) return;  // The mesh is as large as numbers are.
  const auto corner = [&](unsigned bits) -> Vector3d {
    const auto pick = [&](unsigned axis) { return (bits >> axis & 1) != 0 ? box.high[axis] : box.low[axis]; };
    return {pick(0), pick(1), pick(2)};
  };
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (unsigned bits = 0; bits < 8; ++bits) {
      if ((bits >> axis & 1) == 0) drawing.lines.push_back({corner(bits), corner(bits | 1U << axis), colour, stroke});
    }
  }
}

Colour colour_of(CellFinding finding) {
  if (finding == CellFinding::empty) return empty_colour;
  return finding == CellFinding::list ? list_colour : passed_colour;
}

Colour colour_of(PairOutcome outcome) {
  if (outcome == PairOutcome::hit) return hit_colour;
  return outcome == PairOutcome::miss ? miss_colour : left_out_colour;
}

/// The part of a path that is drawn: what is near the mesh, and a little more.
struct Part {
  double first;
  double last;
};

template <typename Scalar>
Part part_of(const Path<Scalar>& path, const Vector3d& direction, const Boxd& box) {
  Part inside = {-infinity, infinity};
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    const double start = path.start[axis];
    const double low = (box.low[axis] - start) / direction[axis];
    const double high = (box.high[axis] - start) / direction[axis];
    inside = {std::max(inside.first, std::min(low, high)), std::min(inside.last, std::max(low, high))};
  }
  // A path that misses the box passes it where this part is turned round.
  if (inside.first > inside.last) std::swap(inside.first, inside.last);
  const double more =
      0.2 * std::max(inside.last - inside.first,
                     box.is_empty() ? 0 : (box.high - box.low).norm() / std::max(direction.norm(), 1e-300));
  const Part kind = {path.has_start() ? 0 : -infinity, path.has_end() ? 1 : infinity};
  return {std::clamp(inside.first - more, kind.first, kind.last),
          std::clamp(inside.last + more, kind.first, kind.last)};
}

/// The corners of all shapes, each with the colour of its shape.
template <typename Add>
void for_each_vertex(const Drawing& drawing, const Add& add) {
  for (const auto& [from, to, colour, stroke] : drawing.lines) {
    add(from, colour);
    add(to, colour);
  }
  for (const auto& [triangle, colour] : drawing.faces) {
    for (const Vector3d& corner : {triangle.a, triangle.b, triangle.c}) add(corner, colour);
  }
}

void append_spaced(double number, std::string& text) {
  text += ' ';
  append_number(number, text);
}

}  // namespace

template <typename Scalar>
Drawing draw_explanation(const Collider<Scalar>& collider, const Path<Scalar>& path,
                         const Explanation<Scalar>& explanation) {
  Drawing drawing;
  Boxd seen;
  for (const ExplainedCell& cell : explanation.cells) {
    seen.extend(cell.box.low);
    seen.extend(cell.box.high);
    add_box(drawing, cell.box, colour_of(cell.finding),
            cell.finding == CellFinding::list ? Drawing::Stroke::list : Drawing::Stroke::cell);
  }
  // Where no cell is looked at, the box of the mesh shows where the path is.
  if (explanation.cells.empty() && collider.triangle_count() > 0) {
    seen = {collider.box().low.template cast<double>(), collider.box().high.template cast<double>()};
    add_box(drawing, seen, empty_colour, Drawing::Stroke::cell);
  }

  std::map<std::uint32_t, Colour> colours;
  for (const ExplainedCandidate& candidate : explanation.candidates) {
    colours[candidate.triangle] = colour_of(candidate.outcome);
  }
  const auto hit = explanation.first_hit();
  if (hit) colours[hit->triangle] = first_colour;
  for (const auto& [id, colour] : colours) {
    const Triangle<Scalar> triangle = collider.triangle(id);
    drawing.faces.push_back(
        {{triangle.a.template cast<double>(), triangle.b.template cast<double>(), triangle.c.template cast<double>()},
         colour});
  }

  const Vector3d start = path.start.template cast<double>();
  const Vector3d direction = path.has_end() ? Vector3d(path.toward.template cast<double>() - start)
                                            : Vector3d(path.toward.template cast<double>());
  if (!start.allFinite() || !direction.allFinite()) return drawing;
  if (seen.is_empty()) {
    seen.extend(start);
    seen.extend(start + direction);
  }
  const Part part = part_of(path, direction, seen);
  if (!std::isfinite(part.first) || !std::isfinite(part.last)) return drawing;
  const auto at = [&](double t) -> Vector3d { return start + t * direction; };
  if (hit) {
    const double t = std::clamp(double{hit->t}, part.first, part.last);
    drawing.lines.push_back({at(part.first), at(t), path_colour, Drawing::Stroke::path});
    drawing.lines.push_back({at(t), at(part.last), path_colour, Drawing::Stroke::rest_of_path});
    drawing.points.push_back(at(t));
  } else {
    drawing.lines.push_back({at(part.first), at(part.last), path_colour, Drawing::Stroke::path});
  }
  return drawing;
}

template Drawing draw_explanation(const Collider<float>&, const Path<float>&, const Explanation<float>&);
template Drawing draw_explanation(const Collider<double>&, const Path<double>&, const Explanation<double>&);

std::string ply_text(const Drawing& drawing) {
  const std::size_t lines = drawing.lines.size();
  const std::size_t faces = drawing.faces.size();
  std::string text = "ply\nformat ascii 1.0\ncomment the path, the cells and the candidates of one query\n";
  text += "element vertex " + std::to_string(2 * lines + 3 * faces) + '\n';
  for (const char* axis : {"x", "y", "z"}) text += std::string("property double ") + axis + '\n';
  for (const char* part : {"red", "green", "blue"}) text += std::string("property uchar ") + part + '\n';
  text += "element face " + std::to_string(faces) + "\nproperty list uchar int vertex_indices\n";
  text += "element edge " + std::to_string(lines) + "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
  for_each_vertex(drawing, [&](const Vector3d& vertex, const Colour& colour) {
    append_number(vertex[0], text);
    append_spaced(vertex[1], text);
    append_spaced(vertex[2], text);
    for (const float part : {colour.red, colour.green, colour.blue}) {
      text += ' ' + std::to_string(std::lround(255 * part));
    }
    text += '\n';
  });
  for (std::size_t i = 0; i < faces; ++i) {
    const std::size_t first = 2 * lines + 3 * i;
    text += "3 " + std::to_string(first) + ' ' + std::to_string(first + 1) + ' ' + std::to_string(first + 2) + '\n';
  }
  for (std::size_t i = 0; i < lines; ++i) text += std::to_string(2 * i) + ' ' + std::to_string(2 * i + 1) + '\n';
  return text;
}

std::string obj_text(const Drawing& drawing) {
  std::string text = "# the path, the cells and the candidates of one query; vertices have colours\n";
  for_each_vertex(drawing, [&](const Vector3d& vertex, const Colour& colour) {
    text += 'v';
    for (const double coordinate : vertex) append_spaced(coordinate, text);
    for (const float part : {colour.red, colour.green, colour.blue}) append_spaced(double{part}, text);
    text += '\n';
  });
  const std::size_t lines = drawing.lines.size();
  for (std::size_t i = 0; i < lines; ++i) {
    text += "l " + std::to_string(2 * i + 1) + ' ' + std::to_string(2 * i + 2) + '\n';
  }
  for (std::size_t i = 0; i < drawing.faces.size(); ++i) {
    const std::size_t first = 2 * lines + 3 * i + 1;
    text += "f " + std::to_string(first) + ' ' + std::to_string(first + 1) + ' ' + std::to_string(first + 2) + '\n';
  }
  return text;
}

}  // namespace surehit::example
