#include "support/pair_families.hpp"

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <utility>

#include "support/neighbour.hpp"

namespace surehit::test {
namespace {

using IntegerVector = Vector3<std::int64_t>;

/// 2^exponent, the exponent of a normal number.
template <typename Scalar>
Scalar power_of_two(std::int64_t exponent) {
  Scalar result = 1;
  for (; exponent > 0; --exponent) result *= 2;
  for (; exponent < 0; ++exponent) result /= 2;
  return result;
}

/// A plane of integer points, and in it a triangle whose edges are divided in 64: corner a is point(0, 0), b is
/// point(64, 0), c is point(0, 64), and point(i, j) has the weights u = i/64 and v = j/64 exactly.
struct Lattice {
  IntegerVector origin;
  IntegerVector step_b;
  IntegerVector step_c;

  [[nodiscard]] IntegerVector point(std::int64_t i, std::int64_t j) const { return origin + i * step_b + j * step_c; }
};

/// Integers in a triangle's edges, see Lattice.
struct Weights {
  std::int64_t i;
  std::int64_t j;
};

template <typename Scalar>
class PairDrawer {
 public:
  explicit PairDrawer(Random& random) : random_(random) {}

  Pair<Scalar> general() {
    const Triangle<Scalar> triangle = random_triangle();
    if (random_.one_in(2)) return {{symmetric_vector(), symmetric_vector()}, triangle};
    const Scalar v = random_.unit<Scalar>();
    const Scalar u = random_.unit<Scalar>() * (1 - v);
    return aimed(triangle, u, v);
  }

  Pair<Scalar> aimed_at_edge() {
    const Triangle<Scalar> triangle = random_triangle();
    const Scalar weight = random_.unit<Scalar>();
    const std::int64_t k = random_.between(0, edge_parts);
    switch (random_.below(6)) {
      case 0:
        return aimed(triangle, weight, 0);
      case 1:
        return aimed(triangle, 0, weight);
      case 2:
        return aimed(triangle, weight, 1 - weight);
      case 3:
        return exactly_through({k, 0});
      case 4:
        return exactly_through({0, k});
      default:
        return exactly_through({k, edge_parts - k});
    }
  }

  Pair<Scalar> aimed_at_vertex() {
    const Weights corner = random_corner();
    if (random_.one_in(2)) return exactly_through(corner);
    return aimed(random_triangle(), static_cast<Scalar>(corner.i / edge_parts),
                 static_cast<Scalar>(corner.j / edge_parts));
  }

  Pair<Scalar> end_on_plane() {
    const Lattice lattice = random_lattice();
    const Weights weights = random_.one_in(4) ? random_corner() : random_weights();
    const IntegerVector on_plane = lattice.point(weights.i, weights.j);
    const IntegerVector elsewhere = on_plane + random_integers(way_bits);
    return converted(lattice, on_plane, elsewhere);
  }

  Pair<Scalar> end_beside_plane() {
    Pair<Scalar> pair = end_on_plane();
    Vector3<Scalar>& end = random_.one_in(2) ? pair.segment.start : pair.segment.end;
    nudge(end[random_axis()], 1);
    return pair;
  }

  Pair<Scalar> overlapping_in_plane() {
    const Lattice lattice = random_lattice();
    const Weights inside = random_inner_weights();
    const Weights way = random_way();
    const std::int64_t back = random_.between(0, 2);
    return converted(lattice, lattice.point(inside.i + way.i, inside.j + way.j),
                     lattice.point(inside.i - back * way.i, inside.j - back * way.j));
  }

  Pair<Scalar> touching_in_plane() {
    const Lattice lattice = random_lattice();
    const Weights corner = random_corner();
    const Weights other = random_corner();
    if (random_.one_in(3)) {
      // Along the line of an edge or through a corner, up to it, or short of it.
      const std::int64_t from = random_.between(-2, 3);
      const std::int64_t to = random_.between(-2, 3);
      const auto along = [&](std::int64_t k) {
        return lattice.point(corner.i + k * (other.i - corner.i) / 2, corner.j + k * (other.j - corner.j) / 2);
      };
      return converted(lattice, along(from), along(to));
    }
    const Weights way = random_way();
    const Weights touched = random_.one_in(2) ? corner : midpoint(corner, other);
    const std::int64_t beyond = random_.between(-1, 1);
    return converted(lattice, lattice.point(touched.i + way.i, touched.j + way.j),
                     lattice.point(touched.i - beyond * way.i, touched.j - beyond * way.j));
  }

  /// Both ends have a negative weight of the same corner.
  Pair<Scalar> disjoint_in_plane() {
    const Lattice lattice = random_lattice();
    const std::uint64_t corner = random_.below(3);
    const auto outside = [&] {
      const std::int64_t negative = random_.between(-edge_parts, -1);
      const std::int64_t other = random_.between(-edge_parts, edge_parts);
      const std::array<Weights, 3> choice = {
          {{negative, other}, {other, negative}, {other, edge_parts - negative - other}}};
      return lattice.point(choice[corner].i, choice[corner].j);
    };
    // Compilers differ in which argument of a call they evaluate first.
    const IntegerVector end = outside();
    const IntegerVector start = outside();
    return converted(lattice, start, end);
  }

  Pair<Scalar> near_parallel() {
    Pair<Scalar> pair = random_.one_in(2) ? overlapping_in_plane() : touching_in_plane();
    for (Vector3<Scalar>* end : {&pair.segment.start, &pair.segment.end}) {
      for (Scalar& coordinate : end->reshaped()) {
        if (random_.one_in(2)) nudge(coordinate, static_cast<int>(random_.between(1, 8)));
      }
    }
    return pair;
  }

  Pair<Scalar> sliver() {
    Triangle<Scalar> triangle = random_triangle();
    triangle.c = triangle.a + random_.unit<Scalar>() * (triangle.b - triangle.a);
    for (Scalar& coordinate : triangle.c.reshaped()) nudge(coordinate, static_cast<int>(random_.below(4)));
    if (random_.one_in(2)) std::swap(triangle.b, triangle.c);
    return aimed(triangle, random_.unit<Scalar>(), 0);
  }

  Pair<Scalar> degenerate_triangle() {
    Lattice lattice = random_lattice();
    IntegerVector way = random_integers(way_bits);
    switch (random_.below(4)) {
      case 0:
        lattice.step_c = lattice.step_b;
        break;
      case 1:
        (random_.one_in(2) ? lattice.step_b : lattice.step_c).setZero();
        break;
      case 2:
        lattice.step_b.setZero();
        lattice.step_c.setZero();
        break;
      default:
        // Corners on one line, in any order.
        lattice.step_c = (lattice.step_b.array() / 8 * random_.between(-8, 8)).matrix();
        lattice.step_b = (lattice.step_b.array() / 8 * random_.between(-8, 8)).matrix();
    }
    if (random_.one_in(3)) {
      const Weights along = random_way();
      way = along.i * lattice.step_b + along.j * lattice.step_c;
    }
    const Weights weights = random_weights();
    const IntegerVector target = lattice.point(weights.i, weights.j);
    Pair<Scalar> pair = converted(lattice, target + way, target - random_.between(-1, 2) * way);
    if (random_.one_in(8)) nudge(pair.segment.end[random_axis()], 1);
    return pair;
  }

  Pair<Scalar> zero_length() {
    Pair<Scalar> pair = random_.one_in(4) ? degenerate_triangle() : end_on_plane();
    if (random_.one_in(16)) pair.segment.start = pair.triangle.b;
    pair.segment.end = pair.segment.start;
    if (random_.one_in(4)) nudge(pair.segment.start[random_axis()], 1);
    if (!random_.one_in(8)) pair.segment.end = pair.segment.start;
    return pair;
  }

  Pair<Scalar> small_integers() {
    const std::int64_t reach = random_.one_in(2) ? 2 : 6;
    Pair<Scalar> pair;
    for (Vector3<Scalar>* point : points_of(pair)) {
      for (Scalar& coordinate : point->reshaped()) coordinate = static_cast<Scalar>(random_.between(-reach, reach));
    }
    return pair;
  }

  Pair<Scalar> mixed_magnitudes() {
    if (random_.one_in(2)) {
      Pair<Scalar> pair;
      for (Vector3<Scalar>* point : points_of(pair)) {
        for (Scalar& coordinate : point->reshaped()) {
          coordinate = random_.one_in(16) ? Scalar{0} : random_.any_finite<Scalar>();
        }
      }
      return pair;
    }
    // One drawn elsewhere, each axis with a scale of its own. Towards zero its coordinates round, and many coincide.
    Pair<Scalar> pair = random_.one_in(2) ? general() : aimed_at_edge();
    const bool one_scale = random_.one_in(2);
    std::int64_t exponent = random_exponent();
    for (int axis = 0; axis < 3; ++axis) {
      if (!one_scale) exponent = random_exponent();
      rescale(pair, axis, exponent);
    }
    return pair;
  }

  Pair<Scalar> far_from_origin() {
    // As far as 1e5 and 1e7 are for float: 7 and 1 of its bits are left for fractions.
    const int fraction_bits = random_.one_in(2) ? 7 : 1;
    const Scalar distance = power_of_two<Scalar>(std::numeric_limits<Scalar>::digits - fraction_bits);
    const Vector3<Scalar> offset = distance * symmetric_vector();
    const Scalar size = power_of_two<Scalar>(random_.between(0, 6));
    Pair<Scalar> pair = random_.one_in(2) ? general() : aimed_at_edge_of(random_triangle());
    for (Vector3<Scalar>* point : points_of(pair)) *point = offset + size * *point;
    return pair;
  }

 private:
  static constexpr std::int64_t edge_parts = 64;
  // The lattice's sums need two bits more than the largest of their terms, and the Scalar has to hold them exactly.
  static constexpr int origin_bits = std::numeric_limits<Scalar>::digits - 3;
  static constexpr int way_bits = origin_bits - 2;
  static constexpr int step_bits = origin_bits - 9;

  static std::array<Vector3<Scalar>*, 5> points_of(Pair<Scalar>& pair) {
    return {&pair.segment.start, &pair.segment.end, &pair.triangle.a, &pair.triangle.b, &pair.triangle.c};
  }

  static Weights midpoint(const Weights& left, const Weights& right) {
    return {(left.i + right.i) / 2, (left.j + right.j) / 2};
  }

  int random_axis() { return static_cast<int>(random_.below(3)); }

  void nudge(Scalar& coordinate, int steps) { coordinate = neighbour(coordinate, random_.one_in(2) ? steps : -steps); }

  Vector3<Scalar> symmetric_vector() {
    Vector3<Scalar> vector;
    for (Scalar& coordinate : vector.reshaped()) coordinate = random_.symmetric<Scalar>();
    return vector;
  }

  Triangle<Scalar> random_triangle() {
    Triangle<Scalar> triangle;
    for (Vector3<Scalar>* corner : {&triangle.a, &triangle.b, &triangle.c}) *corner = symmetric_vector();
    return triangle;
  }

  IntegerVector random_integers(int bits) {
    const std::int64_t bound = std::int64_t{1} << random_.between(bits / 3, bits);
    IntegerVector vector;
    for (std::int64_t& coordinate : vector.reshaped()) {
      coordinate = random_.one_in(8) ? 0 : random_.between(-bound, bound);
    }
    return vector;
  }

  Lattice random_lattice() {
    Lattice lattice;
    do {
      lattice = {random_integers(origin_bits), random_integers(step_bits), random_integers(step_bits)};
      // A share of the planes lie along an axis, where most products vanish.
      if (random_.one_in(6)) {
        const int axis = random_axis();
        lattice.step_b[axis] = lattice.step_c[axis] = 0;
      }
    } while (is_flat(lattice));
    return lattice;
  }

  /// Also true for a few that are not: a cross product modulo 2^64 that is not zero is not zero.
  static bool is_flat(const Lattice& lattice) {
    const Vector3<std::uint64_t> step_b = lattice.step_b.template cast<std::uint64_t>();
    const Vector3<std::uint64_t> step_c = lattice.step_c.template cast<std::uint64_t>();
    return step_b.cross(step_c) == Vector3<std::uint64_t>::Zero();
  }

  Weights random_corner() {
    constexpr std::array<Weights, 3> corners = {{{0, 0}, {edge_parts, 0}, {0, edge_parts}}};
    return corners[random_.below(3)];
  }

  Weights random_weights() { return {random_.between(-8, edge_parts + 8), random_.between(-8, edge_parts + 8)}; }

  Weights random_inner_weights() {
    const std::int64_t i = random_.between(0, edge_parts);
    return {i, random_.between(0, edge_parts - i)};
  }

  Weights random_way() { return {random_.between(-edge_parts, edge_parts), random_.between(-edge_parts, edge_parts)}; }

  Pair<Scalar> exactly_through(const Weights& weights) {
    const Lattice lattice = random_lattice();
    const IntegerVector target = lattice.point(weights.i, weights.j);
    const IntegerVector way = random_integers(way_bits);
    return converted(lattice, target + way, target - random_.between(0, 2) * way);
  }

  /// The exact pair in Scalars, turned round at random and scaled by one power of two.
  Pair<Scalar> converted(const Lattice& lattice, const IntegerVector& start, const IntegerVector& end) {
    std::array<IntegerVector, 3> corners = {lattice.point(0, 0), lattice.point(edge_parts, 0),
                                            lattice.point(0, edge_parts)};
    std::swap(corners[0], corners[random_.below(3)]);
    std::swap(corners[1], corners[1 + random_.below(2)]);
    const bool turned = random_.one_in(2);
    const Scalar scale = power_of_two<Scalar>(random_.between(-2 * origin_bits, origin_bits));
    const auto scaled = [&](const IntegerVector& point) { return (scale * point.cast<Scalar>()).eval(); };
    return {{scaled(turned ? end : start), scaled(turned ? start : end)},
            {scaled(corners[0]), scaled(corners[1]), scaled(corners[2])}};
  }

  /// A path through a + u (b - a) + v (c - a), but for rounding.
  Pair<Scalar> aimed(const Triangle<Scalar>& triangle, Scalar u, Scalar v) {
    const Vector3<Scalar> target = triangle.a + u * (triangle.b - triangle.a) + v * (triangle.c - triangle.a);
    const Vector3<Scalar> start = symmetric_vector();
    const Scalar beyond = random_.one_in(4) ? Scalar{0} : 2 * random_.unit<Scalar>();
    return {{start, target + beyond * (target - start)}, triangle};
  }

  Pair<Scalar> aimed_at_edge_of(const Triangle<Scalar>& triangle) { return aimed(triangle, random_.unit<Scalar>(), 0); }

  /// Exponents at which numbers of a few units stay finite; the least leave a few bits of denormals.
  std::int64_t random_exponent() {
    using Limits = std::numeric_limits<Scalar>;
    const std::int64_t least = Limits::min_exponent - Limits::digits;
    const std::int64_t greatest = Limits::max_exponent - 4;
    switch (random_.below(4)) {
      case 0:
        return random_.between(least, least + 2 * Limits::digits);
      case 1:
        return random_.between(greatest - Limits::digits, greatest);
      default:
        return random_.between(least, greatest);
    }
  }

  void rescale(Pair<Scalar>& pair, int axis, std::int64_t exponent) {
    for (Vector3<Scalar>* point : points_of(pair)) {
      Scalar& coordinate = (*point)[axis];
      // Lattice coordinates carry a scale already; leaving those out that would overflow keeps every pair finite.
      const Scalar half = power_of_two<Scalar>(exponent / 2);
      const Scalar rest = power_of_two<Scalar>(exponent - exponent / 2);
      const Scalar scaled = coordinate * half * rest;
      if (scaled - scaled == 0) coordinate = scaled;
    }
  }

  Random& random_;
};

template <typename Scalar>
struct NamedDraw {
  const char* name;
  Pair<Scalar> (PairDrawer<Scalar>::*draw)();
};

/// In the order of PairFamily.
template <typename Scalar>
constexpr std::array<NamedDraw<Scalar>, all_pair_families.size()> named_draws = {{
    {"general", &PairDrawer<Scalar>::general},
    {"aimed_at_edges", &PairDrawer<Scalar>::aimed_at_edge},
    {"aimed_at_vertices", &PairDrawer<Scalar>::aimed_at_vertex},
    {"ends_on_plane", &PairDrawer<Scalar>::end_on_plane},
    {"ends_beside_plane", &PairDrawer<Scalar>::end_beside_plane},
    {"overlapping_in_plane", &PairDrawer<Scalar>::overlapping_in_plane},
    {"touching_in_plane", &PairDrawer<Scalar>::touching_in_plane},
    {"disjoint_in_plane", &PairDrawer<Scalar>::disjoint_in_plane},
    {"near_parallel", &PairDrawer<Scalar>::near_parallel},
    {"slivers", &PairDrawer<Scalar>::sliver},
    {"degenerate_triangles", &PairDrawer<Scalar>::degenerate_triangle},
    {"zero_length", &PairDrawer<Scalar>::zero_length},
    {"small_integers", &PairDrawer<Scalar>::small_integers},
    {"mixed_magnitudes", &PairDrawer<Scalar>::mixed_magnitudes},
    {"far_from_origin", &PairDrawer<Scalar>::far_from_origin},
}};

}  // namespace

std::string name_of(PairFamily family) { return named_draws<float>[static_cast<std::size_t>(family)].name; }

template <typename Scalar>
Pair<Scalar> draw_pair(PairFamily family, Random& random) {
  PairDrawer<Scalar> drawer(random);
  return (drawer.*named_draws<Scalar>[static_cast<std::size_t>(family)].draw)();
}

template <typename Scalar>
Path<Scalar> path_along(const Segment<Scalar>& segment, PathKind kind) {
  if (kind == PathKind::segment) return segment;
  Vector3<Scalar> direction = segment.end - segment.start;
  // Ends as far apart as the largest numbers have no finite difference; the end itself is as wild a direction.
  if (!direction.allFinite()) direction = segment.end;
  if (kind == PathKind::ray) return Ray<Scalar>{segment.start, direction};
  return Line<Scalar>{segment.start, direction};
}

template <typename Scalar>
QueryOptions<Scalar> draw_options(Random& random, Scalar t) {
  using Limits = std::numeric_limits<Scalar>;
  QueryOptions<Scalar> options;
  const auto limit = [&](Scalar unlimited) {
    switch (random.below(8)) {
      case 0:
        return t;
      case 1:
        return t < Limits::max() ? neighbour(t, 1) : t;
      case 2:
        return t > Limits::lowest() ? neighbour(t, -1) : t;
      case 3:
        return Scalar{0};
      case 4:
        return random.one_in(16) ? Limits::quiet_NaN() : Scalar{1};
      case 5:
        return 2 * random.symmetric<Scalar>();
      default:
        return unlimited;
    }
  };
  options.min_t = limit(-Limits::infinity());
  options.max_t = limit(Limits::infinity());
  if (random.one_in(16)) std::swap(options.min_t, options.max_t);
  if (random.one_in(3)) options.culling = random.one_in(2) ? Culling::back : Culling::front;
  options.ignore_start_contact = random.one_in(3);
  options.ignore_end_contact = random.one_in(3);
  return options;
}

template Pair<float> draw_pair(PairFamily, Random&);
template Pair<double> draw_pair(PairFamily, Random&);
template Path<float> path_along(const Segment<float>&, PathKind);
template Path<double> path_along(const Segment<double>&, PathKind);
template QueryOptions<float> draw_options(Random&, float);
template QueryOptions<double> draw_options(Random&, double);

}  // namespace surehit::test
