#include "support/capsule_families.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "support/rational_turn.hpp"
#include "support/triangle_draws.hpp"

namespace surehit::test {
namespace {

/// A capsule and a triangle in whole numbers.
struct IntegerPair {
  IntegerVector start, end, axis;
  std::int64_t radius;
  std::array<IntegerVector, 3> corners;
};

template <typename Scalar>
class CapsulePairDrawer : public TriangleDraws<Scalar> {
 public:
  explicit CapsulePairDrawer(Random& random) : TriangleDraws<Scalar>(random), random_(random) {}

  CapsulePair<Scalar> general() {
    const Triangle<Scalar> triangle = this->triangle();
    const Vector3<Scalar> axis = vector();
    const Scalar radius = this->radius();
    return aimed(triangle, axis, radius, vector() * 2);
  }

  /// A wall with an upright edge, in a random upright plane.
  CapsulePair<Scalar> upright_at_walls() {
    Triangle<Scalar> wall = this->triangle();
    wall.c[0] = wall.a[0];
    wall.c[1] = wall.a[1];
    const Vector3<Scalar> axis(0, 0, random_.symmetric<Scalar>());
    const Scalar radius = this->radius();
    CapsulePair<Scalar> pair = aimed(wall, axis, radius, vector() * 2);
    if (random_.one_in(3)) std::swap(pair.triangle.a, pair.triangle.b);
    if (random_.one_in(3)) pair.capsule.end[2] = pair.capsule.start[2];
    return random_.one_in(4) ? beside(pair) : pair;
  }
  CapsulePair<Scalar> lying_on_floors() {
    Triangle<Scalar> floor = this->triangle();
    floor.b[2] = floor.c[2] = floor.a[2];
    Vector3<Scalar> axis = vector();
    axis[2] = 0;
    const Scalar radius = this->radius();
    CapsulePair<Scalar> pair = aimed(floor, axis, radius, vector() * 2);
    if (random_.one_in(3)) {
      pair.capsule.end[0] = pair.capsule.start[0];
      pair.capsule.end[1] = pair.capsule.start[1];
    }
    return random_.one_in(4) ? beside(pair) : pair;
  }

  /// A capsule whose core stays at the height of the radius above a feature, and passes straight over it.
  CapsulePair<Scalar> tangent() { return turned(tangent_in_integers()); }

  CapsulePair<Scalar> beside(CapsulePair<Scalar> pair) {
    const auto axis = static_cast<Eigen::Index>(random_.below(3));
    SweptCapsule<Scalar>& capsule = pair.capsule;
    if (random_.one_in(7)) {
      nudge(capsule.radius);
      if (capsule.radius < 0) capsule.radius = 0;
      return pair;
    }
    const std::array<Vector3<Scalar>*, 6> vectors = {&capsule.start,   &capsule.end,     &capsule.half_axis,
                                                     &pair.triangle.a, &pair.triangle.b, &pair.triangle.c};
    nudge((*vectors[random_.below(6)])[axis]);
    return pair;
  }

  /// A core that stays at a height between 0 and the radius over the plane. The height is often one of these two.
  CapsulePair<Scalar> in_plane() {
    IntegerPair pair;
    pair.radius = random_.between(0, 20);
    const std::int64_t height = random_.one_in(2)   ? 0
                                : random_.one_in(2) ? pair.radius
                                                    : random_.between(0, pair.radius);
    for (IntegerVector& corner : pair.corners) corner = flat(30, 0);
    pair.start = flat(90, height);
    pair.end = flat(90, height);
    const IntegerVector edge = pair.corners[1] - pair.corners[0];
    if (random_.one_in(3)) {
      // Along an edge, or beside it at a distance that may be the radius.
      pair.start = pair.corners[0] - random_.between(-1, 3) * edge;
      pair.end = pair.corners[0] + random_.between(-1, 3) * edge;
      pair.start[2] = pair.end[2] = height;
    }
    pair.axis = flat(20, 0);
    const std::uint64_t kind = random_.below(6);
    if (kind == 0) pair.axis = edge;
    if (kind == 1) pair.axis = pair.end - pair.start;
    if (kind == 2) pair.axis[2] = random_.between(-20, 20);
    if (kind == 3) pair.axis = {0, 0, random_.between(-20, 20)};
    return turned(pair);
  }

  CapsulePair<Scalar> starts_touching() {
    CapsulePair<Scalar> pair = general();
    const Vector3<Scalar> way = pair.capsule.end - pair.capsule.start;
    const Vector3<Scalar> touched = inside(pair.triangle);
    const Vector3<Scalar> offset = vector();
    pair.capsule.start = touched + offset * pair.capsule.radius + place() * pair.capsule.half_axis;
    pair.capsule.end = pair.capsule.start + way;
    return pair;
  }
  /// Often through a point of an edge or a corner, in whole numbers.
  CapsulePair<Scalar> starts_across() {
    if (random_.one_in(2)) {
      CapsulePair<Scalar> pair = starts_touching();
      const Vector3<Scalar> touched = inside(pair.triangle);
      pair.capsule.start = touched + place() * pair.capsule.half_axis;
      return pair;
    }
    IntegerPair pair;
    pair.radius = random_.between(0, 5);
    for (IntegerVector& corner : pair.corners) corner = 2 * flat(15, 0);
    IntegerVector on = flat(15, 0);
    if (random_.one_in(3)) on = pair.corners[0];
    if (random_.one_in(3)) on = (pair.corners[0] + pair.corners[1]) / 2;
    pair.axis = random_.one_in(2) ? flat(15, random_.between(-20, 20)) : flat(30, 0);
    if (random_.one_in(4)) pair.axis = pair.corners[1] - pair.corners[0];
    pair.start = on + random_.between(-1, 1) * pair.axis;
    pair.end = flat(60, random_.between(-60, 60));
    return turned(pair);
  }
  CapsulePair<Scalar> starts_at_distance() {
    CapsulePair<Scalar> pair = tangent();
    if (random_.one_in(2)) std::swap(pair.capsule.start, pair.capsule.end);
    if (random_.one_in(2)) pair.capsule.end = vector() * static_cast<Scalar>(100);
    return pair;
  }

  /// A capsule right beside the triangle, whose short step leads it on, off or along.
  CapsulePair<Scalar> small_steps() {
    const Triangle<Scalar> triangle = this->triangle();
    const Vector3<Scalar> normal = (triangle.b - triangle.a).cross(triangle.c - triangle.a);
    const Scalar radius = random_.unit<Scalar>() / 8;
    const Scalar length = 1 / static_cast<Scalar>(1 << (10 + random_.below(12)));
    const Vector3<Scalar> away = random_.one_in(2) ? Vector3<Scalar>(normal) : vector();
    const Scalar size = std::sqrt(away.squaredNorm());
    if (!(size > 0)) return general();
    const Vector3<Scalar> point = random_.one_in(2) ? inside(triangle) : on_edge(triangle);
    Vector3<Scalar> axis = vector();
    if (axis.dot(away) < 0) axis = -axis;
    const Vector3<Scalar> start = point + away * ((radius + length * random_.unit<Scalar>()) / size) + axis;
    return {{start, start + vector() * (2 * length), axis, radius}, triangle};
  }

  CapsulePair<Scalar> with_sizes(Scalar radius, Scalar length) {
    const Triangle<Scalar> triangle = this->triangle();
    const Vector3<Scalar> axis = vector() * length;
    return aimed(triangle, axis, radius, vector() * std::max<Scalar>(1, radius));
  }
  CapsulePair<Scalar> far_away() {
    CapsulePair<Scalar> pair = general();
    const Vector3<Scalar> by = this->far();
    for (Vector3<Scalar>* x :
         {&pair.capsule.start, &pair.capsule.end, &pair.triangle.a, &pair.triangle.b, &pair.triangle.c}) {
      *x += by;
    }
    return pair;
  }
  CapsulePair<Scalar> sliver() {
    CapsulePair<Scalar> pair = general();
    this->make_sliver(pair.triangle);
    return aimed(pair.triangle, pair.capsule.half_axis, pair.capsule.radius, vector());
  }
  CapsulePair<Scalar> degenerate() {
    CapsulePair<Scalar> pair = random_.one_in(2) ? tangent() : in_plane();
    this->make_degenerate(pair.triangle);
    if (random_.one_in(4)) pair.capsule.half_axis = pair.triangle.b - pair.triangle.a;
    this->maybe_swap_corners(pair.triangle);
    return pair;
  }
  CapsulePair<Scalar> at_rest() {
    CapsulePair<Scalar> pair = random_.one_in(2) ? tangent() : random_.one_in(2) ? general() : starts_touching();
    if (random_.one_in(2)) pair = beside(pair);
    pair.capsule.end = pair.capsule.start;
    return pair;
  }
  CapsulePair<Scalar> small_integers() {
    const auto draw = [&] { return static_cast<Scalar>(random_.between(-3, 3)); };
    const auto point = [&] { return Vector3<Scalar>{draw(), draw(), draw()}; };
    return {{point(), point(), point(), static_cast<Scalar>(random_.between(0, 3))}, {point(), point(), point()}};
  }
  CapsulePair<Scalar> mixed_magnitudes() {
    const auto draw = [&] { return random_.one_in(4) ? Scalar{0} : random_.any_finite<Scalar>(); };
    const auto point = [&] { return Vector3<Scalar>{draw(), draw(), draw()}; };
    return {{point(), point(), point(), std::fabs(draw())}, {point(), point(), point()}};
  }

  /// All corners are within the radius of a point of the core: at the start, at the end, or in the middle of its way.
  /// The core often meets the triangle.
  CapsulePair<Scalar> contains() {
    if (random_.one_in(3)) return contains_in_integers();
    const Triangle<Scalar> triangle = this->triangle();
    Vector3<Scalar> point = vector();
    if (random_.one_in(3)) point = random_.one_in(2) ? inside(triangle) : triangle.a;
    const Vector3<Scalar> axis = vector() * 3;
    const Vector3<Scalar> centre = point + place() * axis;
    // Two points of the cube are less than 3.47 apart.
    const Scalar radius = Scalar{3.5} + random_.unit<Scalar>();
    const Vector3<Scalar> way = vector() * 12;
    const std::uint64_t kind = random_.below(3);
    if (kind == 0) return {{centre, centre + way, axis, radius}, triangle};
    if (kind == 1) return {{centre - way, centre, axis, radius}, triangle};
    return {{centre - way, centre + way, axis, radius}, triangle};
  }

 private:
  using TriangleDraws<Scalar>::inside;
  using TriangleDraws<Scalar>::nudge;
  using TriangleDraws<Scalar>::on_edge;
  using TriangleDraws<Scalar>::vector;

  /// An end or the centre of the core is often right over a corner or an edge, or in the plane.
  CapsulePair<Scalar> contains_in_integers() {
    IntegerPair pair;
    for (IntegerVector& corner : pair.corners) corner = flat(30, 0);
    IntegerVector point = flat(30, 0);
    if (random_.one_in(3)) point = pair.corners[0];
    if (random_.one_in(3)) point = (pair.corners[0] + pair.corners[1]) / 2;
    point[2] = random_.one_in(3) ? 0 : random_.between(0, 30);
    pair.axis = flat(40, 0);
    const std::uint64_t kind = random_.below(4);
    if (kind == 0) pair.axis = pair.corners[1] - pair.corners[0];
    if (kind == 1) pair.axis = {0, 0, random_.between(-40, 40)};
    if (kind == 2) pair.axis[2] = random_.between(-40, 40);
    pair.start = point + random_.between(-1, 1) * pair.axis;
    pair.end = flat(200, random_.between(-200, 200));
    if (random_.one_in(2)) std::swap(pair.start, pair.end);
    pair.radius = 100;  // 60² + 60² + 30² is less than its square.
    return turned(pair);
  }
  IntegerPair tangent_in_integers() {
    IntegerPair pair;
    pair.radius = random_.between(1, 40);
    for (IntegerVector& corner : pair.corners) corner = flat(30, 0);
    IntegerVector over = flat(30, pair.radius);
    const std::uint64_t feature = random_.below(3);
    if (feature != 0) {
      over = pair.corners[0];
      pair.corners[2][2] = -random_.between(0, 20);
      if (feature == 2) pair.corners[1][2] = -random_.between(0, 20);
      if (feature == 1 && random_.one_in(2)) over = (pair.corners[0] + pair.corners[1]) / 2;
      over[2] = pair.radius;
    }
    // The lowest point of the core is over the feature: an end, or any point of a core that lies.
    std::int64_t place = random_.between(-1, 1);
    pair.axis = flat(20, 0);
    const std::uint64_t kind = random_.below(4);
    if (kind == 0) {
      place = random_.one_in(2) ? 1 : -1;
      pair.axis[2] = -place * random_.between(0, 20);
    } else if (kind == 1) {
      place = -1;
      pair.axis = {0, 0, random_.between(0, 20)};
    } else if (kind == 2) {
      pair.axis = pair.corners[1] - pair.corners[0];
      pair.axis[2] = 0;
    }
    over -= place * pair.axis;
    const IntegerVector step = flat(30, 0);
    pair.start = over - random_.between(0, 4) * step;
    pair.end = over + random_.between(0, 4) * step;
    return pair;
  }

  IntegerVector flat(std::int64_t size, std::int64_t height) {
    const std::int64_t x = random_.between(-size, size);
    return {x, random_.between(-size, size), height};
  }
  Scalar radius() {
    const Scalar factor = random_.unit<Scalar>();
    return factor / static_cast<Scalar>(1 << random_.below(6));
  }
  /// A place on the core, often one of its ends.
  Scalar place() { return random_.one_in(2) ? random_.symmetric<Scalar>() : Scalar(random_.one_in(2) ? 1 : -1); }
  /// A capsule that passes a point of the triangle at about its radius, so about half of all capsules touch it.
  CapsulePair<Scalar> aimed(const Triangle<Scalar>& triangle, const Vector3<Scalar>& axis, Scalar radius,
                            const Vector3<Scalar>& step) {
    const Vector3<Scalar> point = inside(triangle);
    const Vector3<Scalar> offset = vector();
    const Vector3<Scalar> near = point + offset * (2 * radius) + place() * axis;
    const Scalar share = 2 * random_.unit<Scalar>();
    return {{near - share * step, near + (1 - share) * step, axis, radius}, triangle};
  }
  CapsulePair<Scalar> turned(const IntegerPair& pair) {
    const Turn turn = draw_turn(random_);
    const IntegerVector moved = {random_.between(-9, 9), random_.between(-9, 9), random_.between(-9, 9)};
    const Scalar unit = Scalar{1} / static_cast<Scalar>(1 << random_.below(12));
    const auto vector = [&](const IntegerVector& x) -> Vector3<Scalar> {
      return {static_cast<Scalar>(x[0]) * unit, static_cast<Scalar>(x[1]) * unit, static_cast<Scalar>(x[2]) * unit};
    };
    const auto point = [&](const IntegerVector& x) { return vector(turn(x) + moved); };
    return {{point(pair.start), point(pair.end), vector(turn(pair.axis)),
             static_cast<Scalar>(pair.radius * turn.scale) * unit},
            {point(pair.corners[0]), point(pair.corners[1]), point(pair.corners[2])}};
  }

  Random& random_;
};

}  // namespace

std::string name_of(CapsuleFamily family) {
  switch (family) {
    case CapsuleFamily::general:
      return "general";
    case CapsuleFamily::upright_at_walls:
      return "upright_at_walls";
    case CapsuleFamily::lying_on_floors:
      return "lying_on_floors";
    case CapsuleFamily::tangent:
      return "tangent";
    case CapsuleFamily::beside_tangent:
      return "beside_tangent";
    case CapsuleFamily::in_plane:
      return "in_plane";
    case CapsuleFamily::starts_touching:
      return "starts_touching";
    case CapsuleFamily::starts_across:
      return "starts_across";
    case CapsuleFamily::starts_at_distance:
      return "starts_at_distance";
    case CapsuleFamily::small_steps:
      return "small_steps";
    case CapsuleFamily::small_radii:
      return "small_radii";
    case CapsuleFamily::huge_radii:
      return "huge_radii";
    case CapsuleFamily::short_axes:
      return "short_axes";
    case CapsuleFamily::long_axes:
      return "long_axes";
    case CapsuleFamily::far_away:
      return "far_away";
    case CapsuleFamily::slivers:
      return "slivers";
    case CapsuleFamily::degenerate_triangles:
      return "degenerate_triangles";
    case CapsuleFamily::at_rest:
      return "at_rest";
    case CapsuleFamily::no_radius:
      return "no_radius";
    case CapsuleFamily::no_axis:
      return "no_axis";
    case CapsuleFamily::small_integers:
      return "small_integers";
    case CapsuleFamily::mixed_magnitudes:
      return "mixed_magnitudes";
    case CapsuleFamily::inside:
      return "inside";
  }
  return "unknown";
}

template <typename Scalar>
CapsulePair<Scalar> draw_capsule_pair(CapsuleFamily family, Random& random) {
  CapsulePairDrawer<Scalar> draw(random);
  const auto with_length = [&](std::int64_t low, std::int64_t high) {
    const Scalar radius = random.unit<Scalar>() / 4;
    return draw.with_sizes(radius, draw.size(low, high));
  };
  const auto draw_exact = [&] { return random.one_in(2) ? draw.tangent() : draw.in_plane(); };
  CapsulePair<Scalar> pair;
  switch (family) {
    case CapsuleFamily::general:
      break;
    case CapsuleFamily::upright_at_walls:
      return draw.upright_at_walls();
    case CapsuleFamily::lying_on_floors:
      return draw.lying_on_floors();
    case CapsuleFamily::tangent:
      return draw.tangent();
    case CapsuleFamily::beside_tangent:
      return draw.beside(draw.tangent());
    case CapsuleFamily::in_plane:
      return draw.in_plane();
    case CapsuleFamily::starts_touching:
      return draw.starts_touching();
    case CapsuleFamily::starts_across:
      return draw.starts_across();
    case CapsuleFamily::starts_at_distance:
      return draw.starts_at_distance();
    case CapsuleFamily::small_steps:
      return draw.small_steps();
    case CapsuleFamily::small_radii:
      return draw.with_sizes(draw.size(-30, -6), 1);
    case CapsuleFamily::huge_radii:
      return draw.with_sizes(draw.size(2, 30), 1);
    case CapsuleFamily::short_axes:
      return with_length(-30, -6);
    case CapsuleFamily::long_axes:
      return with_length(2, 20);
    case CapsuleFamily::far_away:
      return draw.far_away();
    case CapsuleFamily::slivers:
      return draw.sliver();
    case CapsuleFamily::degenerate_triangles:
      return draw.degenerate();
    case CapsuleFamily::at_rest:
      return draw.at_rest();
    case CapsuleFamily::no_radius:
      pair = draw_exact();
      pair.capsule.radius = 0;
      return pair;
    case CapsuleFamily::no_axis:
      pair = random.one_in(2) ? draw_exact() : draw.general();
      pair.capsule.half_axis = {0, 0, 0};
      return pair;
    case CapsuleFamily::small_integers:
      return draw.small_integers();
    case CapsuleFamily::mixed_magnitudes:
      return draw.mixed_magnitudes();
    case CapsuleFamily::inside:
      return draw.contains();
  }
  return draw.general();
}

template CapsulePair<float> draw_capsule_pair(CapsuleFamily, Random&);
template CapsulePair<double> draw_capsule_pair(CapsuleFamily, Random&);

}  // namespace surehit::test
