// One moving shape against one triangle, in every field: the library against exact oracles. Then a collider of that one
// triangle, which must give the same hit by its walk and its filter in lanes.

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "byte_source.hpp"
#include "finding.hpp"
#include "point_edits.hpp"
#include "support/box_families.hpp"
#include "support/box_oracle.hpp"
#include "support/capsule_families.hpp"
#include "support/capsule_oracle.hpp"
#include "support/shape_text.hpp"
#include "support/sphere_families.hpp"
#include "support/swept_truth.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test {
namespace {

template <typename Shape, typename Scalar>
std::optional<std::string> error_of(const Shape& shape, const Triangle<Scalar>& triangle,
                                    const std::optional<ShapeHit<Scalar>>& answer) {
  return find_error(shape, triangle, answer);
}
template <typename Scalar>
std::optional<std::string> error_of(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle,
                                    const std::optional<ShapeHit<Scalar>>& answer) {
  return find_error(truth_of(sphere, triangle), answer);
}

template <typename Shape, typename Scalar>
void check(const Shape& shape, const Triangle<Scalar>& triangle) {
  const std::optional<ShapeHit<Scalar>> answer = intersect(shape, triangle);
  const auto tell = [&](const std::string& error, const std::optional<ShapeHit<Scalar>>& told) {
    stop_at(hex_text(shape) + '\n' + hex_text(triangle) + '\n' + error +
            "\nanswered: " + (told ? hex_text(*told) : "a miss"));
  };
  if (const auto error = error_of(shape, triangle, answer)) tell(*error, answer);

  const std::array corners = {triangle.a, triangle.b, triangle.c};
  constexpr std::array<std::uint32_t, 3> ids = {0, 1, 2};
  Collider<Scalar> collider;
  if (!collider.try_build({corners, ids})) return;
  const auto first = collider.first_hit(shape);
  if (first != answer) tell("a collider of the triangle has another hit", first);
  if (collider.any_hit(shape) != answer.has_value()) tell("any_hit is wrong", answer);
  const bool starts = answer && answer->started_touching;
  if (collider.overlaps(shape) != starts) tell("overlaps is wrong", answer);
  if (!answer) return;
  // Until the last free t, nothing is touched. The limit that follows keeps the hit.
  const Scalar free = collider.last_free_t(shape, *answer);
  if (!starts && collider.any_hit(shape, {.max_t = free}) && free > 0) tell("last_free_t is too high", answer);
  if (!collider.any_hit(shape, {.max_t = std::nextafter(free, Scalar{2})})) tell("last_free_t is too low", answer);
}

/// A length from the bytes. It is not negative.
template <typename Scalar>
Scalar edited_length(ByteSource& bytes, Scalar length) {
  if (!bytes.one_in(4)) return length;
  const Scalar x = std::fabs(read_number<Scalar>(bytes));
  return std::isfinite(x) ? x : length;
}

template <typename Scalar>
bool all_finite(std::span<Vector3<Scalar>* const> points) {
  for (const Vector3<Scalar>* const point : points) {
    if (!point->allFinite()) return false;
  }
  return true;
}

template <typename Scalar>
void check_sphere(ByteSource& bytes, Random& random) {
  const std::size_t family = bytes.below(all_sphere_families.size());
  auto [sphere, triangle] = draw_sphere_pair<Scalar>(all_sphere_families[family], random);
  sphere.radius = edited_length(bytes, sphere.radius);
  const std::array points = {&sphere.start, &sphere.end, &triangle.a, &triangle.b, &triangle.c};
  while (!bytes.is_empty()) edit_points<Scalar>(bytes, points);
  if (all_finite<Scalar>(points)) check(sphere, triangle);
}

template <typename Scalar>
void check_box(ByteSource& bytes, Random& random) {
  const std::size_t family = bytes.below(all_box_families.size());
  auto [box, triangle] = draw_box_pair<Scalar>(all_box_families[family], random);
  for (Scalar& length : box.half_extents) length = edited_length(bytes, length);
  const std::array points = {&box.start, &box.end, &triangle.a, &triangle.b, &triangle.c};
  while (!bytes.is_empty()) edit_points<Scalar>(bytes, points);
  if (all_finite<Scalar>(points)) check(box, triangle);
}

template <typename Scalar>
void check_capsule(ByteSource& bytes, Random& random) {
  const std::size_t family = bytes.below(all_capsule_families.size());
  auto [capsule, triangle] = draw_capsule_pair<Scalar>(all_capsule_families[family], random);
  capsule.radius = edited_length(bytes, capsule.radius);
  const std::array points = {&capsule.start, &capsule.end, &capsule.half_axis, &triangle.a, &triangle.b, &triangle.c};
  while (!bytes.is_empty()) edit_points<Scalar>(bytes, points);
  if (all_finite<Scalar>(points)) check(capsule, triangle);
}

template <typename Scalar>
void check(ByteSource bytes) {
  const std::size_t kind = bytes.below(3);
  Random random(bytes.take<std::uint32_t>());
  if (kind == 0) check_sphere<Scalar>(bytes, random);
  if (kind == 1) check_box<Scalar>(bytes, random);
  if (kind == 2) check_capsule<Scalar>(bytes, random);
}

}  // namespace
}  // namespace surehit::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  surehit::test::ByteSource bytes(std::span(data, size));
  if (bytes.one_in(2)) {
    surehit::test::check<double>(bytes);
  } else {
    surehit::test::check<float>(bytes);
  }
  return 0;
}
