#include <algorithm>
#include <cmath>
#include <tuple>

#include "support/nearest_points.hpp"
#include "support/scene_oracle.hpp"
#include "support/sphere_oracle.hpp"

namespace surehit::test {
namespace {

using namespace oracle;
using Vector = Vec<mpq_class>;

/// The sign of the step times the normal.
int sign_along(const RationalPair& pair) {
  return sgn(dot(pair.step, cross(Vector(pair.b - pair.a), Vector(pair.c - pair.a))));
}

/// Whether a box around the ball's way and one around the triangle keep apart. Most pairs need no more.
bool are_apart(const RationalPair& pair, const mpq_class& radius) {
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class end = pair.start[i] + pair.step[i];
    const auto& [low, high] = std::minmax(pair.start[i], end);
    if (std::max({pair.a[i], pair.b[i], pair.c[i]}) < low - radius) return true;
    if (std::min({pair.a[i], pair.b[i], pair.c[i]}) > high + radius) return true;
  }
  return false;
}

/// Whether the limit and the culling admit a triangle that the ball touches.
template <typename Scalar>
bool is_admitted(const RationalPair& pair, const SceneShapeQueryOptions<Scalar>& options) {
  if (options.ignore_start_contact && touches_until(pair, 0)) return false;
  if (options.max_t < 1 && !touches_until(pair, double{options.max_t})) return false;
  if (options.culling == Culling::none) return true;
  return sign_along(pair) == (options.culling == Culling::back ? -1 : 1);
}

}  // namespace

template <typename Scalar>
std::optional<std::string> SceneOracle<Scalar>::find_error(const SweptSphere<Scalar>& sphere,
                                                           const SceneShapeQueryOptions<Scalar>& options,
                                                           const std::vector<SceneShapeHit<Scalar>>& hits) const {
  // The fields of a hit take as long as hundreds of decisions, so only some hits have theirs judged.
  const auto is_judged = [](std::size_t i) { return i < 2 || i % 16 == 0; };
  std::vector<mpf_class> times(hits.size());
  const mpq_class radius(double{sphere.radius});
  const Vector start = vector_of<mpq_class>(sphere.start);
  const Vector step = vector_of<mpq_class>(sphere.end) - start;
  std::size_t touched = 0;
  for (const PlacedMesh& mesh : meshes_) {
    const bool is_ignored = mesh.id == options.ignored_instance;
    if ((mesh.mask & options.instance_mask) == 0 || (is_ignored && options.ignored_triangle == no_triangle)) continue;
    const Vector motion = {mesh.motion[0].rational(), mesh.motion[1].rational(), mesh.motion[2].rational()};
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      if (is_ignored && i == options.ignored_triangle) continue;
      const std::uint32_t mask = mesh.masks.empty() ? ~std::uint32_t{0} : mesh.masks[i];
      if ((mask & options.mask) == 0) continue;
      const auto [a, b, c] = corners(mesh.id, i);
      const RationalPair pair = {start, step - motion, a, b, c, radius * radius};
      if (!(options.max_t >= 0) || are_apart(pair, radius) || !touches_until(pair, 1) || !is_admitted(pair, options)) {
        continue;
      }
      const std::string name = "instance " + std::to_string(mesh.id.index) + ", triangle " + std::to_string(i) + ": ";
      const auto hit = std::find_if(hits.begin(), hits.end(),
                                    [&](const auto& one) { return one.instance == mesh.id && one.triangle == i; });
      if (hit == hits.end()) return name + "is touched and has no hit";
      ++touched;
      const auto index = static_cast<std::size_t>(hit - hits.begin());
      if (!is_judged(index)) continue;
      const ShapeHit<Scalar>& answer = *hit;
      if (const auto error = test::find_error(pair, std::optional(answer))) return name + *error;
      times[index] = answer.started_touching ? mpf_class(0) : first_time<Scalar>(pair);
    }
  }
  if (touched != hits.size()) return "there are hits of what is not touched";
  for (std::size_t i = 1, last = 0; i < hits.size(); ++i) {
    if (hits[i].t < hits[i - 1].t) return "hit " + std::to_string(i) + " is out of order";
    if (!is_judged(i)) continue;
    const bool ascends =
        std::tie(hits[last].instance.index, hits[last].triangle) < std::tie(hits[i].instance.index, hits[i].triangle);
    const bool is_later = is_before<Scalar>(times[last], times[i]);
    if (!is_later && (!ascends || is_before<Scalar>(times[i], times[last]))) {
      return "hit " + std::to_string(i) + " is out of order";
    }
    last = i;
  }
  return std::nullopt;
}

template std::optional<std::string> SceneOracle<float>::find_error(const SweptSphere<float>&,
                                                                   const SceneShapeQueryOptions<float>&,
                                                                   const std::vector<SceneShapeHit<float>>&) const;
template std::optional<std::string> SceneOracle<double>::find_error(const SweptSphere<double>&,
                                                                    const SceneShapeQueryOptions<double>&,
                                                                    const std::vector<SceneShapeHit<double>>&) const;

}  // namespace surehit::test
