#include <bit>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <surehit/surehit.hpp>

namespace {

// A denormal from its bits, for a product would flush to zero where the program is linked with -ffast-math.
float denormal(std::uint32_t ulps) { return std::bit_cast<float>(ulps); }
float minus_denormal(std::uint32_t ulps) { return std::bit_cast<float>(ulps | 0x80000000u); }

int failures = 0;

void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  ++failures;
}

}  // namespace

int main() {
  Eigen::Matrix3Xf vertices(3, 3);
  vertices.col(0) << 0.0f, 0.0f, 0.0f;
  vertices.col(1) << denormal(8), 0.0f, 0.0f;
  vertices.col(2) << 0.0f, denormal(8), 0.0f;
  Eigen::Matrix<std::uint32_t, 3, Eigen::Dynamic> triangles(3, 1);
  triangles << 0, 1, 2;

  surehit::Colliderf collider;
  expect(collider.try_build({vertices, triangles}).has_value(), "a good mesh is built");

  const surehit::Segmentf through{{denormal(1), denormal(2), denormal(3)},
                                  {denormal(1), denormal(2), minus_denormal(1)}};
  const std::optional<surehit::Hitf> hit = collider.first_hit(through);
  expect(hit.has_value(), "denormals hit");
  expect(hit && *hit == surehit::Hitf{0.75f, 0.125f, 0.25f, 0, surehit::Side::front}, "t, u, v, triangle and side");
  expect(hit == surehit::intersect(through, collider.triangle(0)), "the pair has the same bits");

  const surehit::Segmentf beside{{denormal(5), denormal(4), denormal(3)},
                                 {denormal(5), denormal(4), minus_denormal(1)}};
  expect(!collider.any_hit(beside), "one denormal beside the edge is a miss");

  triangles(2, 0) = 3;
  const surehit::BuildResult refused = collider.try_build({vertices, triangles});
  expect(!refused && refused.error().reason == surehit::InvalidMesh::Reason::index_out_of_range,
         "a bad index is named");
  expect(collider.any_hit(through), "a failed rebuild keeps the mesh from before");

#if defined(__cpp_exceptions)
  bool thrown = false;
  try {
    const surehit::Colliderf bad{surehit::TriangleMeshViewf{vertices, triangles}};
  } catch (const surehit::InvalidMesh&) {
    thrown = true;
  }
  expect(thrown, "the constructor throws InvalidMesh");
#endif
  return failures == 0 ? 0 : 1;
}
