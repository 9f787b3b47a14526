#include "support/box_families.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "support/triangle_draws.hpp"

namespace surehit::test {
namespace {

using IntegerVector = Vector3<std::int64_t>;

template <typename Scalar>
class BoxPairDrawer : public TriangleDraws<Scalar> {
 public:
  explicit BoxPairDrawer(Random& random) : TriangleDraws<Scalar>(random), random_(random) {}

  BoxPair<Scalar> general() {
    const Triangle<Scalar> triangle = this->triangle();
    const Vector3<Scalar> largest = extents();
    const Vector3<Scalar> half = largest / static_cast<Scalar>(1 << random_.below(5));
    return aimed(triangle, half, vector() * 2);
  }

  /// A box that is in contact with a point of the triangle, in whole numbers. Often the box grazes it: its corner that
  /// comes first is there, and it moves along the plane, along an edge or along an axis.
  BoxPair<Scalar> grazing() {
    std::array<IntegerVector, 3> corners;
    for (IntegerVector& corner : corners) corner = 4 * integers(8);  // So the points below are whole numbers.
    const IntegerVector h = {random_.between(0, 20), random_.between(0, 20), random_.between(0, 20)};
    const IntegerVector ab = corners[1] - corners[0];
    const IntegerVector ac = corners[2] - corners[0];
    const IntegerVector coordinate = IntegerVector::Unit(static_cast<Eigen::Index>(random_.below(3)));
    IntegerVector along = corners[0];
    IntegerVector step = random_.between(-3, 3) * ab;
    step += random_.between(-3, 3) * ac;
    IntegerVector out = ab.cross(ac);
    switch (random_.below(3)) {
      case 0:
        along += ab / 4 + ac / 2;
        break;
      case 1:
        along += ab / 2;
        out = ab.cross(coordinate);
        step = random_.between(-3, 3) * ab;
        step += random_.between(-9, 9) * coordinate;
        break;
      default:
        out = random_.one_in(2) ? coordinate : integers(4);
        step = integers(30);
        if (random_.one_in(2)) step -= step.cwiseProduct(coordinate);
    }
    if (random_.one_in(3)) step = integers(30);
    if (random_.one_in(2)) out = -out;
    IntegerVector centre = along;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const std::int64_t sign = out[i] > 0 ? 1 : out[i] < 0 ? -1 : random_.between(-1, 1);
      centre[i] += sign * h[i];
    }
    const IntegerVector start = centre - random_.between(0, 4) * step;
    const IntegerVector end = centre + random_.between(0, 4) * step;
    return scaled(start, end, h, corners);
  }

  BoxPair<Scalar> beside(BoxPair<Scalar> pair) {
    const auto axis = static_cast<Eigen::Index>(random_.below(3));
    switch (random_.below(6)) {
      case 0:
        nudge(pair.box.half_extents[axis]);
        if (pair.box.half_extents[axis] < 0) pair.box.half_extents[axis] = 0;
        break;
      case 1:
        nudge(pair.box.start[axis]);
        break;
      case 2:
        nudge(pair.box.end[axis]);
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

  /// A triangle across an axis, and a box that lands on it, stands on it, or slides along it. In a third of all pairs
  /// the triangle leans along another axis.
  BoxPair<Scalar> floors() {
    const auto up = static_cast<Eigen::Index>(random_.below(3));
    const Eigen::Index other = (up + 1) % 3;
    std::array<IntegerVector, 3> corners = {integers(30), integers(30), integers(30)};
    const bool is_aligned = random_.one_in(2);  // Two edges are along axes, as those of a level.
    if (is_aligned) {
      corners[1][other] = corners[0][other];
      corners[2][(up + 2) % 3] = corners[0][(up + 2) % 3];
    }
    const std::int64_t slope = random_.one_in(3) ? random_.between(1, 2) : 0;
    for (IntegerVector& corner : corners) corner[up] = slope * corner[other];
    const IntegerVector h = {random_.between(0, 20), random_.between(0, 20), random_.between(0, 20)};
    IntegerVector start = integers(40);
    IntegerVector end = random_.one_in(2) ? start : integers(40);
    const std::int64_t ground = slope * (start[other] + h[other]);
    start[up] = ground + h[up] + (random_.one_in(2) ? 0 : random_.between(0, 30));
    end[up] = random_.one_in(2) ? start[up] : ground + random_.between(-30, 30);
    return scaled(start, end, h, corners);
  }

  BoxPair<Scalar> starts_touching() {
    BoxPair<Scalar> pair = general();
    const Vector3<Scalar> way = pair.box.end - pair.box.start;
    const Vector3<Scalar> touched = inside(pair.triangle);
    pair.box.start = touched + vector().cwiseProduct(pair.box.half_extents);
    pair.box.end = pair.box.start + way;
    return pair;
  }

  BoxPair<Scalar> contains() {
    const Triangle<Scalar> triangle = this->triangle();
    const Vector3<Scalar> half = Vector3<Scalar>(3, 3, 3) + extents();
    const Vector3<Scalar> start = vector() * 2;
    return {{start, start + vector() * 9, half}, triangle};
  }

  BoxPair<Scalar> starts_grazing() {
    BoxPair<Scalar> pair = grazing();
    if (random_.one_in(2)) std::swap(pair.box.start, pair.box.end);
    if (random_.one_in(2)) pair.box.end = vector() * static_cast<Scalar>(100);
    return pair;
  }

  /// A box right beside the triangle, whose short step leads it on, off or along.
  BoxPair<Scalar> small_steps() {
    const Triangle<Scalar> triangle = this->triangle();
    const Vector3<Scalar> half = extents() / 8;
    const Scalar length = 1 / static_cast<Scalar>(1 << (10 + random_.below(12)));
    Vector3<Scalar> start = random_.one_in(2) ? inside(triangle) : on_edge(triangle);
    const Vector3<Scalar> normal = (triangle.b - triangle.a).cross(triangle.c - triangle.a);
    for (Eigen::Index i = 0; i < 3; ++i)
      start[i] += std::copysign(half[i] + length * random_.unit<Scalar>(), normal[i]);
    return {{start, start + vector() * (2 * length), half}, triangle};
  }

  BoxPair<Scalar> with_size(Scalar size) {
    const Triangle<Scalar> triangle = this->triangle();
    const Vector3<Scalar> half = extents() * size;
    return aimed(triangle, half, vector() * std::max<Scalar>(1, size));
  }

  BoxPair<Scalar> far_away() {
    BoxPair<Scalar> pair = general();
    const Vector3<Scalar> by = this->far();
    for (Vector3<Scalar>* x : {&pair.box.start, &pair.box.end, &pair.triangle.a, &pair.triangle.b, &pair.triangle.c}) {
      *x += by;
    }
    return pair;
  }

  BoxPair<Scalar> sliver() {
    BoxPair<Scalar> pair = general();
    this->make_sliver(pair.triangle);
    return aimed(pair.triangle, pair.box.half_extents, vector());
  }

  BoxPair<Scalar> degenerate() {
    BoxPair<Scalar> pair = random_.one_in(2) ? grazing() : random_.one_in(2) ? floors() : starts_touching();
    this->make_degenerate(pair.triangle);
    this->maybe_swap_corners(pair.triangle);
    return pair;
  }

  BoxPair<Scalar> at_rest() {
    BoxPair<Scalar> pair = random_.one_in(2) ? grazing() : random_.one_in(2) ? floors() : starts_touching();
    if (random_.one_in(2)) pair = beside(pair);
    pair.box.end = pair.box.start;
    return pair;
  }

  /// Sets some half extents to zero. The box still meets the same point, since its corner goes there.
  BoxPair<Scalar> flattened(BoxPair<Scalar> pair, std::uint64_t bits) {
    const Vector3<Scalar> corner =
        random_.one_in(2) ? Vector3<Scalar>(pair.box.half_extents) : Vector3<Scalar>(0, 0, 0);
    for (Eigen::Index i = 0; i < 3; ++i) {
      if ((bits >> i & 1) == 0) continue;
      pair.box.start[i] -= corner[i];
      pair.box.end[i] -= corner[i];
      pair.box.half_extents[i] = random_.one_in(2) ? Scalar{0} : -Scalar{0};
    }
    return pair;
  }
  BoxPair<Scalar> any() {
    return random_.one_in(3) ? grazing() : random_.one_in(3) ? floors() : random_.one_in(2) ? general() : small_steps();
  }

  BoxPair<Scalar> small_integers() {
    const auto point = [&]() -> Vector3<Scalar> { return integers(3).template cast<Scalar>(); };
    return {{point(), point(), integers(3).cwiseAbs().template cast<Scalar>()}, {point(), point(), point()}};
  }

  BoxPair<Scalar> mixed_magnitudes() {
    const auto draw = [&] { return random_.one_in(4) ? Scalar{0} : random_.any_finite<Scalar>(); };
    const auto point = [&] {
      const Scalar x = draw();
      const Scalar y = draw();
      return Vector3<Scalar>(x, y, draw());
    };
    const Vector3<Scalar> start = point();
    const Vector3<Scalar> end = point();
    const Vector3<Scalar> half = point().cwiseAbs();
    const Vector3<Scalar> a = point();
    const Vector3<Scalar> b = point();
    return {{start, end, half}, {a, b, point()}};
  }

 private:
  using TriangleDraws<Scalar>::inside;
  using TriangleDraws<Scalar>::nudge;
  using TriangleDraws<Scalar>::on_edge;
  using TriangleDraws<Scalar>::vector;

  Vector3<Scalar> extents() { return vector().cwiseAbs(); }
  IntegerVector integers(std::int64_t size) {
    const std::int64_t x = random_.between(-size, size);
    const std::int64_t y = random_.between(-size, size);
    return {x, y, random_.between(-size, size)};
  }
  /// A box that passes a point of the triangle at about its half extents, so about half of all boxes touch it.
  BoxPair<Scalar> aimed(const Triangle<Scalar>& triangle, const Vector3<Scalar>& half, const Vector3<Scalar>& step) {
    const Vector3<Scalar> point = inside(triangle);
    const Vector3<Scalar> near = point + vector().cwiseProduct(half) * 2;
    const Scalar share = 2 * random_.unit<Scalar>();
    return {{near - share * step, near + (1 - share) * step, half}, triangle};
  }
  BoxPair<Scalar> scaled(const IntegerVector& start, const IntegerVector& end, const IntegerVector& half,
                         const std::array<IntegerVector, 3>& corners) {
    const IntegerVector moved = integers(9);
    const Scalar unit = Scalar{1} / static_cast<Scalar>(1 << random_.below(12));
    const auto point = [&](const IntegerVector& x) -> Vector3<Scalar> {
      return (x + moved).template cast<Scalar>() * unit;
    };
    return {{point(start), point(end), half.template cast<Scalar>() * unit},
            {point(corners[0]), point(corners[1]), point(corners[2])}};
  }

  Random& random_;
};

}  // namespace

std::string name_of(BoxFamily family) {
  switch (family) {
    case BoxFamily::general:
      return "general";
    case BoxFamily::grazing:
      return "grazing";
    case BoxFamily::beside_grazing:
      return "beside_grazing";
    case BoxFamily::floors:
      return "floors";
    case BoxFamily::starts_touching:
      return "starts_touching";
    case BoxFamily::inside:
      return "inside";
    case BoxFamily::starts_grazing:
      return "starts_grazing";
    case BoxFamily::small_steps:
      return "small_steps";
    case BoxFamily::small_boxes:
      return "small_boxes";
    case BoxFamily::huge_boxes:
      return "huge_boxes";
    case BoxFamily::far_away:
      return "far_away";
    case BoxFamily::slivers:
      return "slivers";
    case BoxFamily::degenerate_triangles:
      return "degenerate_triangles";
    case BoxFamily::at_rest:
      return "at_rest";
    case BoxFamily::flat_boxes:
      return "flat_boxes";
    case BoxFamily::no_extents:
      return "no_extents";
    case BoxFamily::small_integers:
      return "small_integers";
    case BoxFamily::mixed_magnitudes:
      return "mixed_magnitudes";
  }
  return "unknown";
}

template <typename Scalar>
BoxPair<Scalar> draw_box_pair(BoxFamily family, Random& random) {
  BoxPairDrawer<Scalar> draw(random);
  switch (family) {
    case BoxFamily::general:
      return draw.general();
    case BoxFamily::grazing:
      return draw.grazing();
    case BoxFamily::beside_grazing:
      return draw.beside(draw.grazing());
    case BoxFamily::floors:
      return draw.floors();
    case BoxFamily::starts_touching:
      return draw.starts_touching();
    case BoxFamily::inside:
      return draw.contains();
    case BoxFamily::starts_grazing:
      return draw.starts_grazing();
    case BoxFamily::small_steps:
      return draw.small_steps();
    case BoxFamily::small_boxes:
      return draw.with_size(draw.size(-30, -6));
    case BoxFamily::huge_boxes:
      return draw.with_size(draw.size(2, 30));
    case BoxFamily::far_away:
      return draw.far_away();
    case BoxFamily::slivers:
      return draw.sliver();
    case BoxFamily::degenerate_triangles:
      return draw.degenerate();
    case BoxFamily::at_rest:
      return draw.at_rest();
    case BoxFamily::flat_boxes: {
      const BoxPair<Scalar> pair = draw.any();
      return draw.flattened(pair, 1 + random.below(6));
    }
    case BoxFamily::no_extents:
      return draw.flattened(draw.any(), 7);
    case BoxFamily::small_integers:
      return draw.small_integers();
    case BoxFamily::mixed_magnitudes:
      return draw.mixed_magnitudes();
  }
  return draw.general();
}

template BoxPair<float> draw_box_pair(BoxFamily, Random&);
template BoxPair<double> draw_box_pair(BoxFamily, Random&);

}  // namespace surehit::test
