#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "hard_mesh.hpp"
#include "lattice.hpp"
#include "support/random.hpp"

namespace surehit::test {

/// `Answers::hash` of the questions below.
template <typename Scalar>
inline constexpr std::uint64_t published_hash = 0;
template <>
inline constexpr std::uint64_t published_hash<float> = 0xd88a62f1b9569e69u;
template <>
inline constexpr std::uint64_t published_hash<double> = 0xad3e23d18afb4535u;

/// The same of the few that `keep_few` keeps.
template <typename Scalar>
inline constexpr std::uint64_t published_hash_of_few = 0;
template <>
inline constexpr std::uint64_t published_hash_of_few<float> = 0x412b87b10ef1b365u;
template <>
inline constexpr std::uint64_t published_hash_of_few<double> = 0x62162969c7fc932eu;

/// A mesh of 1,000 triangles and 10,000 questions that are hard for it, the same on every platform. Points are those of
/// a lattice, drawn as whole numbers. No step from these to a Scalar rounds.
template <typename Scalar>
class HardQuestions : public HardMesh<Scalar> {
 public:
  static constexpr std::size_t question_count = 10'000;

  HardQuestions() {
    add_ground();
    add_copies();
    add_scattered();
    add_degenerate();
    add_denormal();
    masks = asked_masks(triangles.size());
    questions.options = asked_options<Scalar>();
    while (questions.all.size() < question_count) {
      const std::size_t id = questions.all.size();
      const Path<Scalar> path = id % 400 == 0 ? draw_of_any_magnitude() : draw(id % families);
      const std::uint64_t options = random_.one_in(4) ? 1 + random_.below(2) : 0;
      questions.all.push_back({path, static_cast<std::size_t>(options)});
    }
  }

  using HardMesh<Scalar>::masks;
  using HardMesh<Scalar>::questions;
  using HardMesh<Scalar>::triangles;

 private:
  using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
  using Point = LatticePoint;

  static constexpr std::uint64_t families = 14;
  /// The lattice is finer than that of float by this many bits, so significands are as full.
  static constexpr int finer = std::numeric_limits<Scalar>::digits - 24;
  static constexpr Scalar spacing = Scalar{1} / static_cast<Scalar>(std::int64_t{1} << (14 + finer));
  static constexpr std::int64_t reach = std::int64_t{1} << (17 + finer);
  static constexpr std::uint32_t ground_cells = 16;

  /// Exact: a mesh is within 2 `reach`, what is reflected in it within 8 and a difference within 16, 2^21 for float.
  static Vector3<Scalar> scalars(const Point& point) { return test::scalars(point, spacing); }
  static Vector3<Scalar> times(const Vector3<Scalar>& point, Scalar factor) {
    return {point[0] * factor, point[1] * factor, point[2] * factor};
  }
  /// From its bits, for a product might be flushed to zero.
  static Scalar denormal(std::int64_t ulps) {
    constexpr Bits minus = Bits{1} << (8 * sizeof(Scalar) - 1);
    return std::bit_cast<Scalar>(
        static_cast<Bits>(ulps < 0 ? minus | static_cast<Bits>(-ulps) : static_cast<Bits>(ulps)));
  }
  static Vector3<Scalar> denormals(const Point& ulps) {
    return {denormal(ulps[0]), denormal(ulps[1]), denormal(ulps[2])};
  }

  /// a + (b - a) b_parts / parts + (c - a) c_parts / parts, its quotients cut to whole numbers.
  static Point blend(const LatticeTriangle& triangle, std::int64_t b_parts, std::int64_t c_parts, std::int64_t parts) {
    const auto& [a, b, c] = triangle;
    Point result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = a[i] + ((b[i] - a[i]) * b_parts + (c[i] - a[i]) * c_parts) / parts;
    }
    return result;
  }

  Point within(std::int64_t limit) { return draw_lattice_point(random_, limit); }
  /// Returns one from the ground or its copies. Their coordinates are multiples of 4, so quarters are exact.
  LatticeTriangle coarse_triangle() { return lattice_[random_.below(coarse_)]; }
  LatticeTriangle any_triangle() { return lattice_[random_.below(lattice_.size())]; }
  Point vertex() {
    const LatticeTriangle triangle = any_triangle();
    return triangle[random_.below(3)];
  }
  Point inner_point() { return blend(coarse_triangle(), 1, 1, 4); }
  Point beside_edge() {
    const LatticeTriangle triangle = any_triangle();
    return blend(triangle, random_.between(0, 7), 0, 7);
  }
  Point point_in_plane(const LatticeTriangle& triangle) {
    const std::int64_t b_parts = random_.between(-8, 8);
    return blend(triangle, b_parts, random_.between(-8, 8), 4);
  }
  Point point_along_edge(const LatticeTriangle& triangle) { return blend(triangle, random_.between(-8, 8), 0, 4); }

  void add(const LatticeTriangle& triangle) {
    lattice_.push_back(triangle);
    this->add_corners({scalars(triangle[0]), scalars(triangle[1]), scalars(triangle[2])});
  }

  /// 512 with common edges, of four heights, so that many neighbours lie in one plane.
  void add_ground() {
    constexpr std::int64_t step = reach / ground_cells;
    std::vector<Point> points;
    for (std::uint32_t y = 0; y <= ground_cells; ++y) {
      for (std::uint32_t x = 0; x <= ground_cells; ++x) {
        points.push_back(
            {(x - std::int64_t{8}) * step, (y - std::int64_t{8}) * step, random_.between(-1, 2) * step / 4});
        this->add_vertex(scalars(points.back()));
      }
    }
    for (std::uint32_t y = 0; y < ground_cells; ++y) {
      for (std::uint32_t x = 0; x < ground_cells; ++x) {
        const std::uint32_t corner = y * (ground_cells + 1) + x;
        const std::uint32_t above = corner + ground_cells + 1;
        triangles.push_back({corner, corner + 1, above + 1});
        triangles.push_back({corner, above + 1, above});
      }
    }
    for (const auto& [a, b, c] : triangles) lattice_.push_back({points[a], points[b], points[c]});
  }
  /// 96 in the same planes as others: the same triangle, turned or seen from behind, or one that covers it.
  void add_copies() {
    const std::size_t ground = lattice_.size();
    for (int i = 0; i < 48; ++i) {
      const auto [a, b, c] = lattice_[random_.below(ground)];
      add(random_.one_in(2) ? LatticeTriangle{b, c, a} : LatticeTriangle{a, c, b});
      add(LatticeTriangle{a, reflected(a, b), reflected(a, c)});
    }
    coarse_ = lattice_.size();
  }
  /// 352 with all bits of their coordinates drawn.
  void add_scattered() {
    for (int i = 0; i < 352; ++i) {
      const Point a = within(reach);
      add(LatticeTriangle{a, reflected(a, difference(a, within(reach / 8))),
                          reflected(a, difference(a, within(reach / 8)))});
    }
  }
  /// 24 that are segments or points.
  void add_degenerate() {
    for (int i = 0; i < 8; ++i) {
      const auto [a, b, c] = coarse_triangle();
      add(LatticeTriangle{a, b, blend({a, b, c}, 1, 0, 2)});
      add(LatticeTriangle{c, a, c});
      add(LatticeTriangle{b, b, b});
    }
  }
  /// 16 about the origin, less than 64 of the least numbers wide.
  void add_denormal() {
    for (int i = 0; i < 16; ++i) {
      this->add_corners({denormals(within(32)), denormals(within(32)), denormals(within(32))});
    }
  }

  Path<Scalar> any_kind(const Vector3<Scalar>& start, const Vector3<Scalar>& end, const Vector3<Scalar>& direction) {
    return path_of_any_kind<Scalar>(random_, start, end, direction);
  }
  Path<Scalar> any_kind(const LatticeSegment& segment) {
    const auto& [start, end] = segment;
    return any_kind(scalars(start), scalars(end), scalars(difference(end, start)));
  }
  Path<Scalar> through(const Point& aim) {
    const Point start = within(reach);
    return any_kind({start, reflected(start, aim)});
  }

  Path<Scalar> draw(std::uint64_t family) {
    const LatticeTriangle triangle = coarse_triangle();
    switch (family) {
      case 0:
        return any_kind({within(reach), within(reach)});
      case 1:
        return through(vertex());
      case 2:  // an edge
        return through(blend(triangle, random_.between(0, 4), 0, 4));
      case 3:  // as near to an edge as the lattice comes
        return through(beside_edge());
      case 4:
        return any_kind({within(reach), vertex()});
      case 5: {  // ends on the surface, or a step of the lattice beside it
        Point end = inner_point();
        end[2] += random_.between(-1, 1);
        return any_kind({within(reach), end});
      }
      case 6:
        return any_kind({inner_point(), within(reach)});
      case 7:
        return any_kind({point_in_plane(triangle), point_in_plane(triangle)});
      case 8:
        return any_kind({point_along_edge(triangle), point_along_edge(triangle)});
      case 9:
        return axis_parallel(random_.one_in(2) ? vertex() : inner_point());
      case 10: {  // parallel to a plane of two axes
        const Point start = random_.one_in(2) ? vertex() : within(reach);
        Point end = vertex();
        const std::uint64_t axis = random_.below(3);
        end[axis] = start[axis];
        return any_kind({start, end});
      }
      case 11:
        return no_length();
      case 12: {  // from far away to the other side, through the origin
        const Vector3<Scalar> start = far_away();
        const Vector3<Scalar> end = times(start, random_.one_in(2) ? Scalar{-1} : Scalar{-0x1p-20F});
        return any_kind(start, end, end);
      }
      default: {  // a vertex and a point far away
        const Vector3<Scalar> start = far_away();
        const Vector3<Scalar> end = scalars(vertex());
        return random_.one_in(2) ? any_kind(start, end, times(start, -1)) : any_kind(end, start, start);
      }
    }
  }
  /// Slow to answer, and so few.
  Path<Scalar> draw_of_any_magnitude() {
    if (random_.one_in(2)) {
      const Point start = within(64);
      const Point end = within(64);
      return any_kind(denormals(start), denormals(end), denormals(difference(end, start)));
    }
    const Vector3<Scalar> start = random_.one_in(2) ? scalars(vertex()) : any_finite();
    const Vector3<Scalar> end = any_finite();
    return any_kind(start, end, end);
  }
  Path<Scalar> axis_parallel(const Point& on_mesh) {
    const std::uint64_t axis = random_.below(3);
    Point start = on_mesh;
    Point end = on_mesh;
    start[axis] = random_.between(-reach, reach);
    end[axis] = random_.between(-reach, reach);
    return any_kind({start, end});
  }
  Path<Scalar> no_length() {
    const Point point = random_.one_in(3) ? within(reach) : random_.one_in(2) ? vertex() : inner_point();
    return any_kind({point, point});
  }
  /// Now and then so far that no grid can place it.
  Vector3<Scalar> far_away() {
    const Scalar factor = random_.one_in(100) ? Scalar{0x1p90F} : random_.one_in(2) ? Scalar{0x1p50F} : Scalar{0x1p20F};
    return times(scalars(within(reach / 64)), factor);
  }
  Vector3<Scalar> any_finite() { return {any_finite_scalar(), any_finite_scalar(), any_finite_scalar()}; }
  /// Judged by its exponent, since compilers may take it that no number is infinite.
  Scalar any_finite_scalar() {
    constexpr Bits exponent = std::bit_cast<Bits>(std::numeric_limits<Scalar>::infinity());
    Bits bits = exponent;
    while ((bits & exponent) == exponent) bits = static_cast<Bits>(random_.bits());
    return std::bit_cast<Scalar>(bits);
  }

  Random random_{20261121};
  std::vector<LatticeTriangle> lattice_;  ///< all but the denormal ones
  std::size_t coarse_ = 0;
};

}  // namespace surehit::test
