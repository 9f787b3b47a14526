// A mesh of up to 80 triangles, built at any settings or rebuilt, and a few paths: all that the collider answers,
// against brute force in rationals. Some have a prop with an inner grid. Moving shapes on the same ways: against each
// pair of a shape and a triangle.

#include "surehit/collider.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "byte_source.hpp"
#include "crosscheck/collider_judge.hpp"
#include "finding.hpp"
#include "point_edits.hpp"
#include "support/exact_mesh_oracle.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/same_bits.hpp"
#include "support/scene_drawer.hpp"
#include "support/shape_text.hpp"
#include "support/small_meshes.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test {
namespace {

GridOptions read_grid_options(ByteSource& bytes) {
  constexpr std::array cells_per_triangle = {1.0, 0.0, 0.05, 5.0, 60.0};
  constexpr std::array<std::uint32_t, 6> crowded = {128, 0, 1, 2, 4, 16};
  GridOptions options;
  if (bytes.one_in(2)) {
    for (std::uint32_t& cells : options.resolution) cells = static_cast<std::uint32_t>(bytes.below(12));
  }
  options.cells_per_triangle = cells_per_triangle[bytes.below(cells_per_triangle.size())];
  options.crowded = crowded[bytes.below(crowded.size())];
  return options;
}

template <typename Scalar>
class ColliderCase {
 public:
  explicit ColliderCase(ByteSource bytes) {
    instruction_set_ = instruction_sets()[bytes.below(instruction_sets().size())];
    const auto kind = bytes.take<std::uint8_t>();
    Random drawn(bytes.take<std::uint16_t>());
    const bool has_prop = kind >= 240;
    mesh_ = has_prop ? draw_prop(drawn) : draw_small_mesh<Scalar>(kind % small_mesh_kind_count, drawn);
    mesh_.triangles.resize(std::min(mesh_.triangles.size(), (has_prop ? 17 : 1) + bytes.below(64)));
    mesh_.paths.erase(mesh_.paths.begin() + std::min<std::ptrdiff_t>(std::ssize(mesh_.paths), 3), mesh_.paths.end());
    if (!has_prop || bytes.one_in(4)) grid_options_ = read_grid_options(bytes);
    is_rebuilt_ = bytes.one_in(3);
    if (bytes.one_in(2)) {
      for (std::size_t i = mesh_.triangles.size(); i > 0; --i)
        masks_.push_back(static_cast<std::uint32_t>(1 + drawn.below(3)));
    }
    const bool has_options = bytes.one_in(2);
    Random options(bytes.take<std::uint16_t>());
    vertices_before_ = mesh_.vertices;
    edit(bytes);
    if (has_options) draw_query(options);
  }

  void check() const {
    const ForcedInstructionSet forced(instruction_set_);
    const ExactMeshOracle<Scalar> oracle(mesh_.view(), masks_);
    Collider<Scalar> collider;
    const bool is_finite = std::all_of(mesh_.vertices.begin(), mesh_.vertices.end(),
                                       [](const Vector3<Scalar>& vertex) { return vertex.allFinite(); });
    if (build(collider) != is_finite) stop_at(text() + "is refused, or accepted with a vertex that is not finite");
    if (!is_finite) return;
    for (const Path<Scalar>& path : mesh_.paths) {
      tell(collider_difference(collider, oracle, path, options_));
    }
    check_batch<Segment<Scalar>>(collider, oracle, PathKind::segment);
    check_batch<Ray<Scalar>>(collider, oracle, PathKind::ray);
    check_batch<Line<Scalar>>(collider, oracle, PathKind::line);
    check_shapes(collider);
  }

 private:
  /// More than the lanes of any instruction set, and not a multiple of them.
  static constexpr std::size_t batch_size = 37;

  /// Draws a prop on the ground, and paths. Sets options of the grid that give the prop a grid of its own.
  SmallMesh<Scalar> draw_prop(Random& random) {
    const DrawnMesh drawn = ground_with_prop(std::is_same_v<Scalar, float>, random);
    grid_options_ = drawn.grid;
    SmallMesh<Scalar> mesh;
    mesh.triangles = drawn.triangles;
    for (const Vector3<double>& vertex : drawn.vertices) mesh.vertices.push_back(vertex.cast<Scalar>());
    const std::vector<std::array<std::uint32_t, 3>> of_prop(drawn.triangles.begin() + 8, drawn.triangles.end());
    PathDrawer<Scalar> about_mesh(mesh.view(), random.bits());
    PathDrawer<Scalar> about_prop({mesh.vertices, of_prop}, random.bits());
    for (int i = 0; i < 3; ++i) mesh.paths.push_back(random.one_in(3) ? about_mesh.draw() : about_prop.draw());
    return mesh;
  }

  void edit(ByteSource& bytes) {
    std::vector<Vector3<Scalar>*> points;
    for (Path<Scalar>& path : mesh_.paths) points.insert(points.end(), {&path.start, &path.toward});
    for (Vector3<Scalar>& vertex : mesh_.vertices) points.push_back(&vertex);
    while (!bytes.is_empty()) {
      if (bytes.one_in(4)) {
        std::array<std::uint32_t, 3>& triangle = mesh_.triangles[bytes.below(mesh_.triangles.size())];
        triangle[bytes.below(3)] = static_cast<std::uint32_t>(bytes.below(mesh_.vertices.size()));
      } else {
        edit_points<Scalar>(bytes, points);
      }
    }
  }

  void draw_query(Random& random) {
    const std::vector<Hit<Scalar>> hits = ExactMeshOracle<Scalar>(mesh_.view(), {}).all_hits(mesh_.paths.front(), {});
    const Hit<Scalar> hit = hits.empty() ? Hit<Scalar>{} : hits[random.below(hits.size())];
    options_ = draw_options(random, hit.t);
    if (random.one_in(3)) options_.ignored_triangle = hit.triangle;
    if (random.one_in(2)) options_.mask = static_cast<std::uint32_t>(random.below(4));
  }

  [[nodiscard]] bool build(Collider<Scalar>& collider) const {
    const BuildOptions options{grid_options_, masks_};
    if (!is_rebuilt_) return collider.try_build(mesh_.view(), options).has_value();
    return collider.try_build({vertices_before_, mesh_.triangles}, options) &&
           collider.try_rebuild(mesh_.view().vertices());
  }

  template <typename Shape>
  void check_batch(const Collider<Scalar>& collider, const ExactMeshOracle<Scalar>& oracle, PathKind kind) const {
    std::vector<Shape> shapes;
    std::vector<Hit<Scalar>> expected;
    for (const Path<Scalar>& path : mesh_.paths) {
      if (path.kind != kind) continue;
      shapes.push_back({path.start, path.toward});
      const std::vector<Hit<Scalar>> hits = oracle.all_hits(path, options_);
      expected.push_back(hits.empty() ? Hit<Scalar>{} : hits.front());
    }
    if (shapes.empty()) return;
    for (std::size_t i = 0; shapes.size() < batch_size; ++i) {
      shapes.push_back(Shape(shapes[i]));
      expected.push_back(Hit<Scalar>(expected[i]));
    }

    std::vector<Hit<Scalar>> hits(batch_size);
    std::vector<std::uint8_t> blocked(batch_size, 2);
    QueryStatistics statistics;
    collider.first_hits(shapes, hits, {.options = options_, .statistics = &statistics});
    collider.any_hits(shapes, blocked, {.options = options_, .statistics = &statistics});
    for (std::size_t i = 0; i < batch_size; ++i) {
      if (same_bits(hits[i], expected[i]) && blocked[i] == (expected[i].triangle != no_triangle)) continue;
      tell("batch of " + hex_text(Path<Scalar>(shapes[i])) + '\n' + hex_text(options_) + "\nexpected: " +
           hex_text(expected[i]) + "\nanswered: " + hex_text(hits[i]) + ", blocked: " + std::to_string(blocked[i]));
    }
    if (statistics.paths != 2 * batch_size) tell("a batch counts its paths as " + std::to_string(statistics.paths));
  }

  /// Asks about moving shapes on the ways of the segments, and compares with the pairs of a shape and a triangle.
  void check_shapes(const Collider<Scalar>& collider) const {
    Random sizes(mesh_.triangles.size());
    for (const Path<Scalar>& path : mesh_.paths) {
      if (path.kind != PathKind::segment || !path.start.allFinite() || !path.toward.allFinite()) continue;
      const Scalar length = (path.toward / 2 - path.start / 2).cwiseAbs().maxCoeff();
      const auto size = [&] {
        return sizes.one_in(4) ? Scalar{0} : std::ldexp(length, -static_cast<int>(sizes.below(8)));
      };
      const Scalar first = size();
      switch (sizes.below(3)) {
        case 0:
          check_shape(collider, SweptSphere<Scalar>{path.start, path.toward, first});
          break;
        case 1:
          check_shape(collider, SweptBox<Scalar>{path.start, path.toward, {size(), first, size()}});
          break;
        default:
          check_shape(collider, SweptCapsule<Scalar>{path.start, path.toward, {first, size(), -size()}, size()});
      }
    }
  }
  template <typename Shape>
  void check_shape(const Collider<Scalar>& collider, const Shape& shape) const {
    ShapeQueryOptions<Scalar> options;
    options.max_t = options_.max_t;
    options.culling = options_.culling;
    options.mask = options_.mask;
    options.ignored_triangle = options_.ignored_triangle;
    options.ignore_start_contact = options_.ignore_start_contact;
    std::vector<ShapeHit<Scalar>> expected;
    for (std::uint32_t id = 0; id < mesh_.triangles.size(); ++id) {
      const std::uint32_t mask = masks_.empty() ? ~std::uint32_t{0} : masks_[id];
      if ((mask & options.mask) == 0 || id == options.ignored_triangle) continue;
      auto hit = intersect(shape, mesh_.view().triangle(id), options);
      if (!hit) continue;
      hit->triangle = id;
      expected.push_back(*hit);
    }
    const auto expect = [&](bool is_right, const char* query) {
      if (!is_right) tell(hex_text(shape) + ": " + query + " differs from the pairs");
    };
    std::vector<ShapeHit<Scalar>> all;
    collider.all_hits(shape, all, options);
    const ShapeHit<Scalar> first = all.empty() ? ShapeHit<Scalar>{} : all.front();
    expect(std::is_sorted(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.t < y.t; }), "the order");
    std::sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.triangle < y.triangle; });
    expect(all == expected, "all_hits");
    expect(collider.first_hit(shape, options).value_or(ShapeHit<Scalar>{}) == first, "first_hit");
    expect(collider.any_hit(shape, options) == !expected.empty(), "any_hit");
    constexpr std::size_t count = 9;  // One more than a batch of shapes has lanes.
    const std::vector<Shape> many(count, shape);
    std::vector<ShapeHit<Scalar>> hits(count);
    std::vector<std::uint8_t> blocked(count, 2);
    collider.first_hits(many, hits, {.options = options});
    collider.any_hits(many, blocked, {.options = options});
    expect(hits == std::vector(count, first), "first_hits");
    expect(blocked == std::vector<std::uint8_t>(count, expected.empty() ? 0 : 1), "any_hits");
  }

  void tell(const std::string& difference) const {
    if (!difference.empty()) stop_at(text() + difference);
  }

  /// The mesh as a test of its own would have it, and how it is built.
  [[nodiscard]] std::string text() const {
    std::ostringstream out;
    out << std::hexfloat << "std::vector<Vector3" << (sizeof(Scalar) == 4 ? 'f' : 'd') << "> vertices{";
    for (const Vector3<Scalar>& vertex : mesh_.vertices) write(out << "\n  ", vertex), out << ',';
    out << "};\nstd::vector<std::array<std::uint32_t, 3>> triangles{";
    for (const auto& [a, b, c] : mesh_.triangles) out << "\n  {" << a << ", " << b << ", " << c << "},";
    out << "};\nstd::vector<std::uint32_t> masks{";
    for (const std::uint32_t mask : masks_) out << mask << ", ";
    const auto& [x, y, z] = grid_options_.resolution;
    out << "};\nGridOptions{.resolution = {" << x << ", " << y << ", " << z
        << "}, .cells_per_triangle = " << grid_options_.cells_per_triangle << ", .crowded = " << grid_options_.crowded
        << "}" << (is_rebuilt_ ? ", rebuilt" : "") << ", on " << name_of_instruction_set(instruction_set_) << '\n';
    return out.str();
  }

  std::int64_t instruction_set_;
  SmallMesh<Scalar> mesh_;
  std::vector<Vector3<Scalar>> vertices_before_;
  GridOptions grid_options_;
  std::vector<std::uint32_t> masks_;
  bool is_rebuilt_ = false;
  QueryOptions<Scalar> options_;
};

}  // namespace
}  // namespace surehit::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  surehit::test::ByteSource bytes(std::span(data, size));
  if (bytes.one_in(2)) {
    surehit::test::ColliderCase<double>(bytes).check();
  } else {
    surehit::test::ColliderCase<float>(bytes).check();
  }
  return 0;
}
