#include "point_edits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "support/neighbour.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
class PointEditor {
 public:
  PointEditor(ByteSource& bytes, std::span<Vector3<Scalar>* const> points) : bytes_(bytes), points_(points) {}

  void edit() {
    Vector3<Scalar>& edited = point();
    switch (bytes_.below(12)) {
      case 0:
        edited[axis()] = read_number<Scalar>(bytes_);
        break;
      case 1:
        edited[axis()] = point()[axis()];
        break;
      case 2:
        edited = point();
        break;
      case 3:
        put_on_line(edited);
        break;
      case 4:
        put_in_plane(edited);
        break;
      case 5:
        put_behind(edited);
        break;
      case 6:
      case 7:
        nudge(edited[axis()]);
        break;
      case 8:
        edited = -edited;
        break;
      case 9:
        flatten();
        break;
      case 10:
        scale();
        break;
      default:
        coarsen();
        break;
    }
  }

 private:
  static constexpr Scalar edge_parts = 64;

  Vector3<Scalar>& point() { return *points_[bytes_.below(points_.size())]; }
  Eigen::Index axis() { return static_cast<Eigen::Index>(bytes_.below(3)); }
  Scalar weight() { return static_cast<Scalar>(bytes_.take<std::int8_t>()) / edge_parts; }

  void nudge(Scalar& coordinate) {
    const int steps = bytes_.take<std::int8_t>() % 9;
    if (!std::isfinite(coordinate)) return;
    const Scalar moved = neighbour(coordinate, steps);
    if (std::isfinite(moved)) coordinate = moved;
  }

  static void put(Vector3<Scalar>& edited, const Vector3<Scalar>& place) {
    if (place.allFinite()) edited = place;
  }

  // Exact where the coordinates are multiples of 64 times some unit, as `coarsen` leaves them.
  void put_on_line(Vector3<Scalar>& edited) {
    const Vector3<Scalar> from = point();
    put(edited, from + weight() * (point() - from));
  }
  void put_in_plane(Vector3<Scalar>& edited) {
    const Vector3<Scalar> from = point();
    const Vector3<Scalar> first = weight() * (point() - from);
    put(edited, from + first + weight() * (point() - from));
  }
  /// As far behind one point as another is before it, twice as far, and so on: a path between them goes through it.
  void put_behind(Vector3<Scalar>& edited) {
    const Vector3<Scalar> middle = point();
    put(edited, middle + static_cast<Scalar>(bytes_.below(4)) * (middle - point()));
  }

  /// Gives some of the points or all of them one coordinate in common.
  void flatten() {
    const Eigen::Index chosen = axis();
    const Scalar coordinate = point()[chosen];
    const std::size_t first = bytes_.below(points_.size());
    for (Vector3<Scalar>* each : points_.subspan(first)) (*each)[chosen] = coordinate;
  }

  /// Multiplies one point or all of them, on some axes or on all. One alone may be a direction, and the path the same.
  void scale() {
    const std::size_t axes = 1 + bytes_.below(7);
    const int exponent = bytes_.take<std::int16_t>() % std::numeric_limits<Scalar>::max_exponent;
    const std::size_t chosen = bytes_.below(points_.size());
    for (Vector3<Scalar>* each : bytes_.one_in(2) ? points_ : points_.subspan(chosen, 1)) {
      for (Eigen::Index k = 0; k < 3; ++k) {
        const Scalar scaled = std::ldexp((*each)[k], exponent);
        if ((axes >> k & 1) != 0 && std::isfinite(scaled)) (*each)[k] = scaled;
      }
    }
  }

  /// Leaves every coordinate the multiples of a 4th to a 512th of the largest one, 64 times a power of two.
  void coarsen() {
    Scalar largest = 0;
    for (const Vector3<Scalar>* each : points_) {
      if (each->allFinite()) largest = std::max(largest, each->cwiseAbs().maxCoeff());
    }
    if (largest == 0) return;
    const int unit = std::ilogb(largest) - 2 - static_cast<int>(bytes_.below(8));
    for (Vector3<Scalar>* each : points_) {
      for (Scalar& coordinate : each->reshaped()) {
        coordinate = std::ldexp(std::trunc(std::ldexp(coordinate, -unit)), unit);
      }
    }
  }

  ByteSource& bytes_;
  std::span<Vector3<Scalar>* const> points_;
};

}  // namespace

template <typename Scalar>
Scalar read_number(ByteSource& bytes) {
  using Limits = std::numeric_limits<Scalar>;
  using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
  constexpr std::array extremes = {Scalar{0},        -Scalar{0},     Limits::max(),        -Limits::max(),
                                   Limits::min(),    -Limits::min(), Limits::denorm_min(), -Limits::denorm_min(),
                                   Limits::max() / 2};
  switch (bytes.below(7)) {
    case 0:
      return static_cast<Scalar>(bytes.take<std::int8_t>());
    case 1:
      return static_cast<Scalar>(bytes.take<std::int16_t>()) / 256;
    case 2: {
      const Scalar power = std::ldexp(Scalar{1}, bytes.take<std::int16_t>() % Limits::max_exponent);
      return bytes.one_in(2) ? -power : power;
    }
    case 3:
      return static_cast<Scalar>(bytes.take<std::int16_t>()) * Limits::denorm_min();
    case 4:
      return extremes[bytes.below(extremes.size())];
    case 5:
      return neighbour(Scalar{1}, bytes.take<std::int8_t>());
    default:
      return std::bit_cast<Scalar>(bytes.take<Bits>());
  }
}

template <typename Scalar>
void edit_points(ByteSource& bytes, std::span<Vector3<Scalar>* const> points) {
  PointEditor<Scalar>(bytes, points).edit();
}

template float read_number(ByteSource&);
template double read_number(ByteSource&);
template void edit_points(ByteSource&, std::span<Vector3<float>* const>);
template void edit_points(ByteSource&, std::span<Vector3<double>* const>);

}  // namespace surehit::test
