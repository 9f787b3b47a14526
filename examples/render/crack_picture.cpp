#include "render/crack_picture.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <surehit/collider.hpp>
#include <utility>
#include <vector>

#include "command_line/chunked_run.hpp"
#include "command_line/interruption.hpp"
#include "mesh_io/input_error.hpp"
#include "render/frame_colours.hpp"
#include "render/id_picture.hpp"
#include "render/plain_intersect.hpp"
#include "render/ray_counts.hpp"

namespace surehit::example {
namespace {

constexpr Colour hole = Colour::hex(0xff2a2a);
constexpr int margin = 12;
constexpr int caption_height = 36;

/// The triangles at a vertex.
struct Fan {
  std::uint32_t vertex = 0;
  std::vector<std::uint32_t> triangles;
  float longest_edge = 0;
};

Vector3f vertex_of(const Mesh<float>& mesh, std::uint32_t vertex) {
  const auto& [x, y, z] = mesh.vertices[vertex];
  return {x, y, z};
}

/// For each vertex, the lowest id of those at its place. Many files give each face vertices of its own.
std::vector<std::uint32_t> ids_of_places(const Mesh<float>& mesh) {
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::ranges::less(), [&](std::uint32_t i) { return mesh.vertices[i]; });
  std::vector<std::uint32_t> ids(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_new = i == 0 || mesh.vertices[order[i]] != mesh.vertices[order[i - 1]];
    ids[order[i]] = is_new ? order[i] : ids[order[i - 1]];
  }
  return ids;
}

/// The triangles at each place that has vertices.
class VertexFans {
 public:
  explicit VertexFans(const Mesh<float>& mesh)
      : mesh_(mesh), places_(ids_of_places(mesh)), ends_(mesh.vertices.size() + 1) {
    for (const auto& corners : mesh.triangles) {
      for (const std::uint32_t corner : corners) ++ends_[places_[corner] + 1];
    }
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    triangles_.resize(ends_.back());
    std::vector<std::size_t> next(ends_.begin(), ends_.end() - 1);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      for (const std::uint32_t corner : mesh.triangles[i]) triangles_[next[places_[corner]]++] = i;
    }
  }

  [[nodiscard]] Fan fan(std::uint32_t vertex) const {
    Fan fan;
    fan.vertex = vertex;
    const std::uint32_t place = places_[vertex];
    const auto begin = triangles_.begin();
    fan.triangles.assign(begin + static_cast<std::ptrdiff_t>(ends_[place]),
                         begin + static_cast<std::ptrdiff_t>(ends_[place + 1]));
    for (const std::uint32_t triangle : fan.triangles) {
      for (const std::uint32_t corner : mesh_.triangles[triangle]) {
        fan.longest_edge = std::max(fan.longest_edge, (vertex_of(mesh_, corner) - vertex_of(mesh_, vertex)).norm());
      }
    }
    return fan;
  }

  /// Whether each edge at the vertex is one of two triangles of the fan in turn.
  [[nodiscard]] bool is_closed(const Fan& fan) const {
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> second;
    for (const std::uint32_t triangle : fan.triangles) {
      const auto& corners = mesh_.triangles[triangle];
      const auto is_here = [&](std::uint32_t corner) { return places_[corner] == places_[fan.vertex]; };
      const auto at = static_cast<std::size_t>(std::ranges::find_if(corners, is_here) - corners.begin());
      first.push_back(places_[corners[(at + 1) % 3]]);
      second.push_back(places_[corners[(at + 2) % 3]]);
    }
    std::ranges::sort(first);
    std::ranges::sort(second);
    return fan.triangles.size() >= 3 && first == second && std::ranges::adjacent_find(first) == first.end();
  }

 private:
  const Mesh<float>& mesh_;
  std::vector<std::uint32_t> places_;
  std::vector<std::size_t> ends_;  ///< where the triangles of the next place begin
  std::vector<std::uint32_t> triangles_;
};

/// Whether all triangles of a fan face upwards.
bool faces_up(const Mesh<float>& mesh, const Fan& fan) {
  constexpr float min_slope = 0.25f;
  return std::ranges::all_of(fan.triangles,
                             [&](std::uint32_t triangle) { return normal(mesh.view(), triangle).z() > min_slope; });
}

/// Whether the eye sees the fan in the middle of the view, and nothing else at the same place.
bool is_seen(const Colliderf& collider, const Fan& fan, const CrackView& view) {
  // The fan is at t = 1.
  constexpr float just_behind = 1.001f;
  std::vector<Hitf> hits;
  collider.all_hits(Rayf{view.camera.eye, view.camera.target - view.camera.eye}, hits, {.max_t = just_behind});
  return !hits.empty() && std::ranges::all_of(hits, [&](const Hitf& hit) {
    return std::ranges::find(fan.triangles, hit.triangle) != fan.triangles.end();
  });
}

/// All triangles that a ray of the view may come near on its way to the vertex, by any rounding. Those behind it are
/// met from behind.
std::vector<std::uint32_t> triangles_near(const Mesh<float>& mesh, const CrackView& view) {
  const Vector3f way_low = view.camera.eye.cwiseMin(view.camera.target);
  const Vector3f way_high = view.camera.eye.cwiseMax(view.camera.target);
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Trianglef triangle = mesh.view().triangle(i);
    const Vector3f low = triangle.a.cwiseMin(triangle.b).cwiseMin(triangle.c);
    const Vector3f high = triangle.a.cwiseMax(triangle.b).cwiseMax(triangle.c);
    const Vector3f slack = Vector3f::Constant(0.01f * (high - low).norm() + 1000 * view.width);
    const bool is_near = ((low - slack).array() <= way_high.array()).head<2>().all() &&
                         (way_low.array() <= (high + slack).array()).head<2>().all();
    if (is_near) near.push_back(i);
  }
  return near;
}

/// How far away the eye may be, in edges. What plain floats lose grows with the distance, so far ones come first. In a
/// room, the near ones are below the ceiling.
constexpr std::array<float, 6> distances = {40, 20, 10, 5, 2.5f, 1.25f};

/// The view of a vertex from a distance.
CrackView view_of(const Mesh<float>& mesh, const Fan& fan, float distance_in_edges, int size) {
  const Vector3f place = vertex_of(mesh, fan.vertex);
  CrackView view;
  view.vertex = fan.vertex;
  // Not from straight above: there, the origin would share coordinates with the vertex, and even plain floats would be
  // exact.
  const float distance = distance_in_edges * fan.longest_edge;
  view.width = 0x1p-20f * distance;
  const Vector3f eye = place + distance * Vector3f(0.11f, -0.17f, 1);
  view.camera = {eye, place, Vector3f::UnitY(), view.width / 2 / distance, size, size};
  return view;
}

/// Says what vertices lack that cannot be shown.
std::string reason(std::size_t vertices, std::size_t closed, std::size_t upward) {
  const auto counted = [](std::size_t count) { return std::to_string(count); };
  return "no vertex can be shown: it needs triangles all around it that face upwards and that are seen from above. "
         "Of " +
         counted(vertices) + " vertices, " + counted(closed) + " have triangles all around them, " + counted(upward) +
         " of these face upwards" + (upward > 0 ? ", and all of them are hidden" : "") +
         (upward == 0 && closed > 0 ? ": --up may be wrong" : "");
}

std::string reason_of_one(const VertexFans& fans, const Mesh<float>& mesh, const Fan& fan) {
  const std::string what = !fans.is_closed(fan)   ? " do not lie all around it"
                           : !faces_up(mesh, fan) ? " do not all face upwards"
                                                  : " are hidden from above";
  return "--vertex: the triangles at vertex " + std::to_string(fan.vertex) + what;
}

/// What the plain test sees: the triangle with the smallest t, if there is one.
std::optional<std::uint32_t> seen_by_plain_test(const Mesh<float>& mesh, const std::vector<std::uint32_t>& triangles,
                                                const Rayf& ray) {
  std::optional<std::uint32_t> first;
  PlainHit best{};
  for (const std::uint32_t triangle : triangles) {
    const auto hit = plain_intersect(ray, mesh.view().triangle(triangle));
    if (!hit || (first && hit->t >= best.t)) continue;
    best = *hit;
    first = triangle;
  }
  return first && best.is_front ? first : std::nullopt;
}

}  // namespace

CrackView find_crack_view(const Mesh<float>& mesh, std::optional<std::uint32_t> vertex, int size) {
  const Colliderf collider(mesh.view());
  std::vector<std::uint32_t> vertices;
  if (vertex) {
    if (*vertex >= mesh.vertices.size()) {
      throw InputError("--vertex: there is no vertex " + std::to_string(*vertex) + ", the mesh has " +
                       std::to_string(mesh.vertices.size()));
    }
    vertices = {*vertex};
  } else {
    vertices.resize(mesh.vertices.size());
    std::iota(vertices.begin(), vertices.end(), 0u);
    std::ranges::stable_sort(vertices, std::ranges::greater(), [&](std::uint32_t i) { return mesh.vertices[i][2]; });
  }
  const VertexFans fans(mesh);
  std::size_t closed = 0;
  std::vector<Fan> candidates;
  for (const std::uint32_t candidate : vertices) {
    Fan fan = fans.fan(candidate);
    if (!fans.is_closed(fan)) continue;
    ++closed;
    if (faces_up(mesh, fan)) candidates.push_back(std::move(fan));
  }
  for (const float distance : distances) {
    for (const Fan& fan : candidates) {
      const CrackView view = view_of(mesh, fan, distance, size);
      if (is_seen(collider, fan, view)) return view;
    }
  }
  throw InputError(vertex ? reason_of_one(fans, mesh, fans.fan(*vertex))
                          : reason(vertices.size(), closed, candidates.size()));
}

Cracks draw_cracks(const Mesh<float>& mesh, const CrackView& view, unsigned threads) {
  const Colliderf collider(mesh.view());
  const Camera camera(view.camera);
  const std::vector<std::uint32_t> triangles = triangles_near(mesh, view);
  const int size = camera.width();
  Cracks cracks;
  cracks.rays = static_cast<std::size_t>(size) * static_cast<std::size_t>(camera.height());
  cracks.picture = Canvas(2 * size + 3 * margin, camera.height() + margin + caption_height, paper);
  std::atomic<std::size_t> holes_of_plain = 0;
  std::atomic<std::size_t> holes_of_surehit = 0;
  const auto draw = [&](int x, int y, const std::optional<std::uint32_t>& seen, std::atomic<std::size_t>& holes) {
    if (!seen) ++holes;
    cracks.picture.at(x, y) = seen ? mix(paper, colour_of_id(*seen), 0.75f) : hole;
  };
  std::atomic<std::size_t> rays = 0;
  const auto start = std::chrono::steady_clock::now();
  const auto draw_rows = [&](std::size_t begin, std::size_t end) {
    stop_if_interrupted();
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      for (int column = 0; column < size; ++column) {
        const Rayf ray = camera.ray(column, row);
        draw(margin + column, margin + row, seen_by_plain_test(mesh, triangles, ray), holes_of_plain);
        const auto hit = collider.first_hit(ray);
        const bool is_seen = hit && hit->side != Side::back;
        draw(2 * margin + size + column, margin + row, is_seen ? std::optional(hit->triangle) : std::nullopt,
             holes_of_surehit);
      }
    }
    rays += (end - begin) * static_cast<std::size_t>(size);
  };
  run_in_chunks("cracks", static_cast<std::size_t>(camera.height()), 4, threads, draw_rows,
                [&] { return rate_since(start, rays); });
  cracks.holes_of_plain = holes_of_plain;
  cracks.holes_of_surehit = holes_of_surehit;
  const auto caption = [&](int x, const char* name, std::size_t holes) {
    const std::string text = std::string(name) + ": " + std::to_string(holes) + " holes";
    cracks.picture.draw_text({static_cast<float>(x), static_cast<float>(margin + camera.height() + 12)}, text, 2, ink);
  };
  caption(margin, "plain floats", cracks.holes_of_plain);
  caption(2 * margin + size, "surehit", cracks.holes_of_surehit);
  return cracks;
}

}  // namespace surehit::example
