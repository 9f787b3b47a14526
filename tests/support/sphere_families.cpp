#include "support/sphere_families.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "support/rational_turn.hpp"
#include "support/triangle_draws.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
class SpherePairDrawer : public TriangleDraws<Scalar> {
 public:
  explicit SpherePairDrawer(Random& random) : TriangleDraws<Scalar>(random), random_(random) {}

  SpherePair<Scalar> general() {
    const Triangle<Scalar> triangle = this->triangle();
    const Scalar factor = random_.unit<Scalar>();
    const Scalar radius = factor / static_cast<Scalar>(1 << random_.below(6));
    return aimed(triangle, radius, vector() * 2);
  }

  /// A ball whose centre stays at the height of its radius above a feature, and passes straight over it.
  SpherePair<Scalar> tangent() {
    const auto draw = [&](std::int64_t size) { return random_.between(-size, size); };
    const std::int64_t radius = random_.between(1, 40);
    std::array<IntegerVector, 3> corners = {IntegerVector{draw(30), draw(30), 0}, IntegerVector{draw(30), draw(30), 0},
                                            IntegerVector{draw(30), draw(30), 0}};
    IntegerVector over = {draw(30), draw(30), radius};
    const std::uint64_t feature = random_.below(3);
    if (feature != 0) {
      over = corners[0];
      over[2] = radius;
      corners[2][2] = -random_.between(0, 20);
      if (feature == 2) corners[1][2] = -random_.between(0, 20);
      if (feature == 1 && random_.one_in(2)) {
        // Over an inner point of the edge.
        over[0] = (corners[0][0] + corners[1][0]) / 2;
        over[1] = (corners[0][1] + corners[1][1]) / 2;
      }
    }
    const IntegerVector step = {draw(30), draw(30), 0};
    const std::int64_t before = random_.between(0, 4);
    const std::int64_t after = random_.between(0, 4);
    const IntegerVector start = over - before * step;
    const IntegerVector end = over + after * step;
    return turned(start, end, radius, corners);
  }

  SpherePair<Scalar> beside(SpherePair<Scalar> pair) {
    const auto axis = static_cast<Eigen::Index>(random_.below(3));
    switch (random_.below(6)) {
      case 0:
        nudge(pair.sphere.radius);
        if (pair.sphere.radius < 0) pair.sphere.radius = 0;
        break;
      case 1:
        nudge(pair.sphere.start[axis]);
        break;
      case 2:
        nudge(pair.sphere.end[axis]);
        break;
      case 3:
        nudge(pair.triangle.a[axis]);
        break;
      case 4:
        nudge(pair.triangle.b[axis]);
        break;
      default:
        nudge(pair.triangle.c[axis]);
    }
    return pair;
  }

  /// A ball that stays at a height between 0 and the radius over the plane. The height is often one of these two.
  SpherePair<Scalar> in_plane() {
    const auto draw = [&](std::int64_t size) { return random_.between(-size, size); };
    const std::int64_t radius = random_.between(0, 20);
    const std::int64_t height = random_.one_in(2) ? 0 : random_.one_in(2) ? radius : random_.between(0, radius);
    const std::array<IntegerVector, 3> corners = {IntegerVector{draw(30), draw(30), 0},
                                                  IntegerVector{draw(30), draw(30), 0},
                                                  IntegerVector{draw(30), draw(30), 0}};
    IntegerVector start = {draw(90), draw(90), height};
    IntegerVector end = {draw(90), draw(90), height};
    if (random_.one_in(3)) {
      // Along an edge, or beside it at a distance that may be the radius.
      const IntegerVector edge = corners[1] - corners[0];
      start = corners[0] - random_.between(-1, 3) * edge;
      end = corners[0] + random_.between(-1, 3) * edge;
      start[2] = end[2] = height;
    }
    return turned(start, end, radius, corners);
  }

  SpherePair<Scalar> starts_touching() {
    SpherePair<Scalar> pair = general();
    const Vector3<Scalar> way = pair.sphere.end - pair.sphere.start;
    const Vector3<Scalar> touched = inside(pair.triangle);
    pair.sphere.start = touched + vector() * pair.sphere.radius;
    pair.sphere.end = pair.sphere.start + way;
    return pair;
  }

  /// The tangent ball begins right over what it grazes, or there and moves away from it or toward it.
  SpherePair<Scalar> starts_at_distance() {
    SpherePair<Scalar> pair = tangent();
    if (random_.one_in(2)) std::swap(pair.sphere.start, pair.sphere.end);
    if (random_.one_in(2)) pair.sphere.end = vector() * static_cast<Scalar>(100);
    return pair;
  }

  /// A ball right beside the triangle, whose short step leads it on, off or along.
  SpherePair<Scalar> small_steps() {
    const Triangle<Scalar> triangle = this->triangle();
    const Vector3<Scalar> normal = (triangle.b - triangle.a).cross(triangle.c - triangle.a);
    const Scalar radius = random_.unit<Scalar>() / 8;
    const Scalar length = 1 / static_cast<Scalar>(1 << (10 + random_.below(12)));
    const Vector3<Scalar> away = random_.one_in(2) ? Vector3<Scalar>(normal) : vector();
    const Scalar size = std::sqrt(away.squaredNorm());
    if (!(size > 0)) return general();
    Vector3<Scalar> start = random_.one_in(2) ? inside(triangle) : on_edge(triangle);
    start += away * ((radius + length * random_.unit<Scalar>()) / size);
    return {{start, start + vector() * (2 * length), radius}, triangle};
  }

  SpherePair<Scalar> with_radius(Scalar radius) {
    const Triangle<Scalar> triangle = this->triangle();
    return aimed(triangle, radius, vector() * std::max<Scalar>(1, radius));
  }

  SpherePair<Scalar> far_away() {
    SpherePair<Scalar> pair = general();
    const Vector3<Scalar> by = this->far();
    for (Vector3<Scalar>* x :
         {&pair.sphere.start, &pair.sphere.end, &pair.triangle.a, &pair.triangle.b, &pair.triangle.c}) {
      *x += by;
    }
    return pair;
  }

  SpherePair<Scalar> sliver() {
    SpherePair<Scalar> pair = general();
    this->make_sliver(pair.triangle);
    return aimed(pair.triangle, pair.sphere.radius, vector());
  }

  SpherePair<Scalar> degenerate() {
    SpherePair<Scalar> pair = random_.one_in(2) ? tangent() : in_plane();
    this->make_degenerate(pair.triangle);
    this->maybe_swap_corners(pair.triangle);
    return pair;
  }

  SpherePair<Scalar> at_rest() {
    SpherePair<Scalar> pair = random_.one_in(2) ? tangent() : random_.one_in(2) ? general() : starts_touching();
    if (random_.one_in(2)) pair = beside(pair);
    pair.sphere.end = pair.sphere.start;
    return pair;
  }

  SpherePair<Scalar> small_integers() {
    const auto draw = [&] { return static_cast<Scalar>(random_.between(-3, 3)); };
    const auto point = [&] { return Vector3<Scalar>{draw(), draw(), draw()}; };
    return {{point(), point(), static_cast<Scalar>(random_.between(0, 3))}, {point(), point(), point()}};
  }

  SpherePair<Scalar> mixed_magnitudes() {
    const auto draw = [&] { return random_.one_in(4) ? Scalar{0} : random_.any_finite<Scalar>(); };
    const auto point = [&] { return Vector3<Scalar>{draw(), draw(), draw()}; };
    return {{point(), point(), std::fabs(draw())}, {point(), point(), point()}};
  }

  /// All corners are within the radius of the centre: at the start, at the end, or in the middle of its way. The centre
  /// is often on the triangle.
  SpherePair<Scalar> contains() {
    if (random_.one_in(3)) return contains_in_integers();
    const Triangle<Scalar> triangle = this->triangle();
    Vector3<Scalar> centre = vector();
    if (random_.one_in(3)) centre = random_.one_in(2) ? inside(triangle) : triangle.a;
    // Two points of the cube are less than 3.47 apart.
    const Scalar radius = Scalar{3.5} + random_.unit<Scalar>();
    const Vector3<Scalar> way = vector() * 12;
    const std::uint64_t kind = random_.below(3);
    if (kind == 0) return {{centre, centre + way, radius}, triangle};
    if (kind == 1) return {{centre - way, centre, radius}, triangle};
    return {{centre - way, centre + way, radius}, triangle};
  }

 private:
  using TriangleDraws<Scalar>::inside;
  using TriangleDraws<Scalar>::nudge;
  using TriangleDraws<Scalar>::on_edge;
  using TriangleDraws<Scalar>::vector;

  /// The centre is often right over a corner or an edge, or in the plane.
  SpherePair<Scalar> contains_in_integers() {
    const auto draw = [&](std::int64_t size) { return random_.between(-size, size); };
    const std::array<IntegerVector, 3> corners = {IntegerVector{draw(30), draw(30), 0},
                                                  IntegerVector{draw(30), draw(30), 0},
                                                  IntegerVector{draw(30), draw(30), 0}};
    IntegerVector centre = {draw(30), draw(30), 0};
    if (random_.one_in(3)) centre = corners[0];
    if (random_.one_in(3)) centre = (corners[0] + corners[1]) / 2;
    centre[2] = random_.one_in(3) ? 0 : random_.between(0, 30);
    const IntegerVector other = {draw(200), draw(200), draw(200)};
    // 60² + 60² + 30² is less than 100².
    return random_.one_in(2) ? turned(centre, other, 100, corners) : turned(other, centre, 100, corners);
  }
  /// A ball that passes a point of the triangle at about its radius, so about half of all balls touch it.
  SpherePair<Scalar> aimed(const Triangle<Scalar>& triangle, Scalar radius, const Vector3<Scalar>& step) {
    const Vector3<Scalar> point = inside(triangle);
    const Vector3<Scalar> near = point + vector() * (2 * radius);
    const Scalar share = 2 * random_.unit<Scalar>();
    return {{near - share * step, near + (1 - share) * step, radius}, triangle};
  }
  SpherePair<Scalar> turned(const IntegerVector& start, const IntegerVector& end, std::int64_t radius,
                            const std::array<IntegerVector, 3>& corners) {
    const Turn turn = draw_turn(random_);
    const IntegerVector moved = {random_.between(-9, 9), random_.between(-9, 9), random_.between(-9, 9)};
    const Scalar unit = Scalar{1} / static_cast<Scalar>(1 << random_.below(12));
    const auto point = [&](const IntegerVector& x) -> Vector3<Scalar> {
      const IntegerVector y = turn(x) + moved;
      return {static_cast<Scalar>(y[0]) * unit, static_cast<Scalar>(y[1]) * unit, static_cast<Scalar>(y[2]) * unit};
    };
    return {{point(start), point(end), static_cast<Scalar>(radius * turn.scale) * unit},
            {point(corners[0]), point(corners[1]), point(corners[2])}};
  }

  Random& random_;
};

}  // namespace

std::string name_of(SphereFamily family) {
  switch (family) {
    case SphereFamily::general:
      return "general";
    case SphereFamily::tangent:
      return "tangent";
    case SphereFamily::beside_tangent:
      return "beside_tangent";
    case SphereFamily::in_plane:
      return "in_plane";
    case SphereFamily::starts_touching:
      return "starts_touching";
    case SphereFamily::starts_at_distance:
      return "starts_at_distance";
    case SphereFamily::small_steps:
      return "small_steps";
    case SphereFamily::small_radii:
      return "small_radii";
    case SphereFamily::huge_radii:
      return "huge_radii";
    case SphereFamily::far_away:
      return "far_away";
    case SphereFamily::slivers:
      return "slivers";
    case SphereFamily::degenerate_triangles:
      return "degenerate_triangles";
    case SphereFamily::at_rest:
      return "at_rest";
    case SphereFamily::no_radius:
      return "no_radius";
    case SphereFamily::small_integers:
      return "small_integers";
    case SphereFamily::mixed_magnitudes:
      return "mixed_magnitudes";
    case SphereFamily::inside:
      return "inside";
  }
  return "unknown";
}

template <typename Scalar>
SpherePair<Scalar> draw_sphere_pair(SphereFamily family, Random& random) {
  SpherePairDrawer<Scalar> draw(random);
  switch (family) {
    case SphereFamily::general:
      return draw.general();
    case SphereFamily::tangent:
      return draw.tangent();
    case SphereFamily::beside_tangent:
      return draw.beside(draw.tangent());
    case SphereFamily::in_plane:
      return draw.in_plane();
    case SphereFamily::starts_touching:
      return draw.starts_touching();
    case SphereFamily::starts_at_distance:
      return draw.starts_at_distance();
    case SphereFamily::small_steps:
      return draw.small_steps();
    case SphereFamily::small_radii:
      return draw.with_radius(draw.size(-30, -6));
    case SphereFamily::huge_radii:
      return draw.with_radius(draw.size(2, 30));
    case SphereFamily::far_away:
      return draw.far_away();
    case SphereFamily::slivers:
      return draw.sliver();
    case SphereFamily::degenerate_triangles:
      return draw.degenerate();
    case SphereFamily::at_rest:
      return draw.at_rest();
    case SphereFamily::no_radius: {
      SpherePair<Scalar> pair = random.one_in(2) ? draw.tangent() : draw.in_plane();
      pair.sphere.radius = 0;
      return pair;
    }
    case SphereFamily::small_integers:
      return draw.small_integers();
    case SphereFamily::mixed_magnitudes:
      return draw.mixed_magnitudes();
    case SphereFamily::inside:
      return draw.contains();
  }
  return draw.general();
}

template SpherePair<float> draw_sphere_pair(SphereFamily, Random&);
template SpherePair<double> draw_sphere_pair(SphereFamily, Random&);

}  // namespace surehit::test
