// One path against one triangle, in every field: the library against the rationals and CGAL. Then a collider of that
// one triangle, whose kernel the pair alone does not go through.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "byte_source.hpp"
#include "crosscheck/collider_judge.hpp"
#include "crosscheck/pair_judge.hpp"
#include "finding.hpp"
#include "point_edits.hpp"
#include "support/exact_oracle.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
QueryOptions<Scalar> read_options(ByteSource& bytes, const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  Random random(bytes.take<std::uint16_t>());
  const auto contact = exact_contact(path, triangle);
  return draw_options(random, contact ? nearest<Scalar>(contact->t) : random.unit<Scalar>());
}

template <typename Scalar>
void check_triangle_alone(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                          const QueryOptions<Scalar>& options) {
  const std::array corners = {triangle.a, triangle.b, triangle.c};
  constexpr std::array<std::uint32_t, 3> ids = {0, 1, 2};
  const TriangleMeshView<Scalar> mesh(corners, ids);
  Collider<Scalar> collider;
  if (!collider.try_build(mesh)) return;
  const std::string difference = collider_difference(collider, ExactMeshOracle<Scalar>(mesh, {}), path, options);
  if (!difference.empty()) stop_at(difference + "\nof the mesh of " + hex_text(triangle));
}

template <typename Scalar>
void check(ByteSource bytes) {
  const auto kind = static_cast<PathKind>(bytes.below(3));
  const bool has_direction = bytes.one_in(2);
  const std::size_t family = bytes.below(all_pair_families.size() + 1);
  Random random(bytes.take<std::uint32_t>());
  const bool has_options = bytes.one_in(4);
  ByteSource options_bytes = bytes;
  if (has_options) bytes.take<std::uint16_t>();

  Pair<Scalar> pair{{Vector3<Scalar>::Zero(), Vector3<Scalar>::Zero()},
                    {Vector3<Scalar>::Zero(), Vector3<Scalar>::UnitX(), Vector3<Scalar>::UnitY()}};
  if (family < all_pair_families.size()) pair = draw_pair<Scalar>(all_pair_families[family], random);
  auto& [segment, triangle] = pair;
  const std::array points = {&segment.start, &segment.end, &triangle.a, &triangle.b, &triangle.c};
  while (!bytes.is_empty()) edit_points<Scalar>(bytes, points);

  // The second point is where the path goes to, or it is itself the direction of a ray or a line.
  Path<Scalar> path = path_along(segment, kind);
  if (has_direction) path.toward = segment.end;
  const QueryOptions<Scalar> options =
      has_options ? read_options(options_bytes, path, triangle) : QueryOptions<Scalar>{};
  stop_at(judge_pair(path, triangle, options).difference);
  check_triangle_alone(path, triangle, options);
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
