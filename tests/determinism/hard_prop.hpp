#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hard_mesh.hpp"
#include "lattice.hpp"
#include "support/random.hpp"

namespace surehit::test {

/// `Answers::hash` of the questions below.
template <typename Scalar>
inline constexpr std::uint64_t published_prop_hash = 0;
template <>
inline constexpr std::uint64_t published_prop_hash<float> = 0xfa2d6808741fc484u;
template <>
inline constexpr std::uint64_t published_prop_hash<double> = 0xad708742bfcc1f36u;

/// A level of 128 triangles, a prop of 400 in it that is 256 times smaller, and an inlay of 400 in the prop that is 128
/// times smaller again. So the grid has an inner grid, and this has one too. With them come 1,000 questions, the same
/// on every platform. Points are drawn as whole numbers, and no step from these to a Scalar rounds.
template <typename Scalar>
class HardProp : public HardMesh<Scalar> {
 public:
  static constexpr std::size_t question_count = 1'000;

  HardProp() {
    add_level();
    add_scattered(prop, 400);
    add_scattered(inlay, 400);
    masks = asked_masks(triangles.size());
    questions.options = asked_options<Scalar>();
    while (questions.all.size() < question_count) {
      const Path<Scalar> path = draw(questions.all.size() % families);
      questions.all.push_back({path, random_.one_in(4) ? 1 + static_cast<std::size_t>(random_.below(2)) : 0});
    }
  }

  using HardMesh<Scalar>::masks;
  using HardMesh<Scalar>::questions;
  using HardMesh<Scalar>::triangles;

 private:
  using Point = LatticePoint;
  /// The cube around a point, up to `reach` away on each axis.
  struct Part {
    Point middle;
    std::int64_t reach;
  };

  static constexpr std::uint64_t families = 8;
  static constexpr std::int64_t unit = std::int64_t{1} << (std::numeric_limits<Scalar>::digits - 24);
  // Not where planes between cells are.
  static constexpr Part level = {{0, 0, 0}, unit << 20};
  static constexpr Part prop = {{300'000 * unit, -170'000 * unit, 70'000 * unit}, unit << 12};
  static constexpr Part inlay = {{301'300 * unit, -171'700 * unit, 69'100 * unit}, unit << 5};

  static constexpr Scalar spacing = Scalar{1} / static_cast<Scalar>(unit << 16);

  /// Exact: no coordinate is larger than three times the level's reach.
  static Vector3<Scalar> scalars(const Point& point) { return test::scalars(point, spacing); }

  Point within(const Part& part) { return sum(part.middle, draw_lattice_point(random_, part.reach)); }
  Point anywhere() {
    constexpr std::array<Part, 3> parts = {level, prop, inlay};
    return within(parts[random_.below(3)]);
  }

  void add(const LatticeTriangle& triangle) {
    lattice_.push_back(triangle);
    this->add_corners({scalars(triangle[0]), scalars(triangle[1]), scalars(triangle[2])});
  }
  void add_level() {
    constexpr std::int64_t squares = 8;
    constexpr std::int64_t step = 2 * level.reach / squares;
    const auto corner = [&](std::int64_t x, std::int64_t y) -> Point {
      return {x * step - level.reach, y * step - level.reach, (5 * x + 3 * y) % 4 * step / 4};
    };
    for (std::int64_t y = 0; y < squares; ++y) {
      for (std::int64_t x = 0; x < squares; ++x) {
        add({corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)});
        add({corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)});
      }
    }
  }
  /// All bits are drawn of some. The others have corners in common, and lie in common planes.
  void add_scattered(const Part& part, int count) {
    for (int i = 0; i < count; ++i) {
      const std::int64_t step = i % 2 == 0 ? 1 : part.reach / 8;
      const auto corner = [&] {
        Point point = draw_lattice_point(random_, part.reach / step / 8);
        for (std::int64_t& x : point) x *= step;
        return point;
      };
      Point around = draw_lattice_point(random_, part.reach / step / 2);
      for (std::size_t axis = 0; axis < 3; ++axis) around[axis] = around[axis] * step + part.middle[axis];
      add({around, sum(around, corner()), sum(around, corner())});
    }
  }

  Point vertex() {
    const LatticeTriangle& corners = lattice_[random_.below(lattice_.size())];
    return corners[random_.below(3)];
  }
  /// A point of an edge, or as near to it as the lattice comes.
  Point beside_edge() {
    const auto& [a, b, c] = lattice_[random_.below(lattice_.size())];
    const std::int64_t parts = random_.between(0, 4);
    return {a[0] + (b[0] - a[0]) * parts / 4, a[1] + (b[1] - a[1]) * parts / 4, a[2] + (b[2] - a[2]) * parts / 4};
  }

  Path<Scalar> any_kind(const LatticeSegment& segment) {
    const Vector3<Scalar> start = scalars(segment.start);
    const Vector3<Scalar> end = scalars(segment.end);
    return path_of_any_kind<Scalar>(random_, start, end, end - start);
  }
  Path<Scalar> through(const Point& aim) {
    const Point start = anywhere();
    return any_kind({start, reflected(start, aim)});
  }
  Path<Scalar> draw(std::uint64_t family) {
    switch (family) {
      case 0:
        return any_kind({anywhere(), anywhere()});
      case 1:
        return through(vertex());
      case 2:
        return through(beside_edge());
      case 3:
        return any_kind({anywhere(), vertex()});
      case 4:
        return any_kind({vertex(), vertex()});
      case 5: {  // along an axis
        Point start = vertex();
        Point end = start;
        const std::uint64_t axis = random_.below(3);
        start[axis] -= random_.one_in(2) ? prop.reach : level.reach;
        end[axis] += prop.reach;
        return any_kind({start, end});
      }
      case 6: {  // of no length
        const Point point = random_.one_in(2) ? vertex() : beside_edge();
        return any_kind({point, point});
      }
      default: {  // in the plane of a triangle
        const auto& [a, b, c] = lattice_[random_.below(lattice_.size())];
        return any_kind({reflected(b, a), reflected(a, c)});
      }
    }
  }

  Random random_{20261127};
  std::vector<LatticeTriangle> lattice_;
};

}  // namespace surehit::test
