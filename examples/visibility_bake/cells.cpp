#include "visibility_bake/cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "mesh_io/input_error.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/read_file.hpp"
#include "mesh_io/text_lines.hpp"

namespace surehit::example {
namespace {

/// A floor is at most this steep.
constexpr float min_upwardness = 0.7f;
/// How high above the floors nothing may be in the way of a step.
constexpr float knee = 0.7f;
constexpr float max_columns = 1e7f;

/// The floors along a vertical line.
void add_floors(const Colliderf& collider, const Rayf& down, float headroom, std::vector<Vector3f>& floors) {
  std::vector<Hitf> hits;
  collider.all_hits(down, hits);
  float ceiling = down.origin.z();
  bool is_in_the_open = true;
  for (const Hitf& hit : hits) {
    const float height = down.origin.z() - hit.t;
    const bool is_floor = hit.side == Side::front && collider.normal(hit.triangle).z() > min_upwardness;
    if (is_floor && is_in_the_open && ceiling - height >= headroom) {
      floors.emplace_back(down.origin.x(), down.origin.y(), height);
    }
    is_in_the_open = hit.side == Side::back;
    ceiling = height;
  }
}

using Column = std::pair<long, long>;

Column column_of(const Vector3f& place, float spacing) {
  return {std::lround(place.x() / spacing), std::lround(place.y() / spacing)};
}

}  // namespace

std::vector<Vector3f> find_floors(const Colliderf& collider, const WalkOptions& options) {
  const Boxf& box = collider.box();
  std::vector<Vector3f> floors;
  if (box.is_empty()) return floors;
  const Vector3f counts = ((box.high - box.low) / options.spacing).array().ceil().max(1.0f);
  if (!(counts.x() * counts.y() < max_columns)) {
    throw InputError("--spacing: the plan has more than " + std::to_string(static_cast<int>(max_columns)) + " squares");
  }
  for (int row = 0; row < static_cast<int>(counts.y()); ++row) {
    for (int column = 0; column < static_cast<int>(counts.x()); ++column) {
      const Vector3f top(box.low.x() + options.spacing * (static_cast<float>(column) + 0.5f),
                         box.low.y() + options.spacing * (static_cast<float>(row) + 0.5f),
                         box.high.z() + 2 * options.headroom);
      add_floors(collider, {top, {0, 0, -1}}, options.headroom, floors);
    }
  }
  return floors;
}

std::vector<Vector3f> reachable_floors(const Colliderf& collider, const std::vector<Vector3f>& floors,
                                       const Vector3f& start, const WalkOptions& options) {
  std::map<Column, std::vector<std::size_t>> columns;
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < floors.size(); ++i) {
    columns[column_of(floors[i] - floors.front(), options.spacing)].push_back(i);
    const float distance = (floors[i] - start).norm();
    if (distance <= 4 * options.spacing && (!nearest || distance < (floors[*nearest] - start).norm())) nearest = i;
  }
  if (!nearest) return {};
  std::vector<bool> is_reached(floors.size());
  std::vector<std::size_t> waiting = {*nearest};
  is_reached[*nearest] = true;
  const auto can_step = [&](const Vector3f& from, const Vector3f& to) {
    const Vector3f above(0, 0, knee);
    return std::abs(from.z() - to.z()) <= options.max_slope * options.spacing &&
           !collider.any_hit(Segmentf{from + above, to + above});
  };
  while (!waiting.empty()) {
    const std::size_t here = waiting.back();
    waiting.pop_back();
    const Column column = column_of(floors[here] - floors.front(), options.spacing);
    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const auto neighbours = columns.find({column.first + dx, column.second + dy});
      if (neighbours == columns.end()) continue;
      for (const std::size_t next : neighbours->second) {
        if (is_reached[next] || !can_step(floors[here], floors[next])) continue;
        is_reached[next] = true;
        waiting.push_back(next);
      }
    }
  }
  std::vector<Vector3f> reached;
  for (std::size_t i = 0; i < floors.size(); ++i) {
    if (is_reached[i]) reached.push_back(floors[i]);
  }
  return reached;
}

std::vector<Vector3f> read_places(const std::string& path) {
  std::vector<Vector3f> places;
  try {
    const std::string text = read_file(path);
    TextLines lines(text);
    naming_the_line(lines, [&] {
      std::vector<std::string_view> fields;
      while (lines.next()) {
        split(without_comment(lines.line()), fields);
        if (fields.empty()) continue;
        if (fields.size() != 3) {
          throw InputError("a place has 3 coordinates, not " + std::to_string(fields.size()));
        }
        places.emplace_back(parse_number<float>(fields[0]), parse_number<float>(fields[1]),
                            parse_number<float>(fields[2]));
      }
    });
  } catch (const InputError& error) {
    throw error.at(path);
  }
  return places;
}

}  // namespace surehit::example
