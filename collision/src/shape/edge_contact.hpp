#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "exact/scaled_double.hpp"
#include "shape/face_contact.hpp"
#include "shape/sphere_terms.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// How a ball touches the inside of an edge of a triangle, in double, with bounds for the whole edge. It costs less
/// than `SphereTouch`. SHAPES.md has the proof (S9, S10).
class EdgeContact {
 public:
  /// Edge k goes from corner k to the next one.
  template <typename Scalar>
  EdgeContact(const SweptSphere<Scalar>& ball, const Triangle<Scalar>& triangle, std::size_t edge)
      : radius_(ball.radius) {
    const Vector3<Scalar>* const corners[] = {&triangle.a, &triangle.b, &triangle.c, &triangle.a, &triangle.b};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      const double corner = (*corners[edge])[axis];
      const double start = ball.start[axis];
      along_[i] = double{(*corners[edge + 1])[axis]} - corner;
      to_third_[i] = double{(*corners[edge + 2])[axis]} - corner;
      from_corner_[i] = start - corner;
      step_[i] = double{ball.end[axis]} - start;
    }
    edge_ = std::max(greatest(along_), greatest(to_third_));
    far_ = greatest(from_corner_);
    way_ = greatest(step_);
    square_ = dot(along_, along_);
  }

  /// Decides whether the ball touches the inside of the edge first, and not after `limit`, if that is certain. It is a
  /// miss where it touches nothing of the triangle until then. The ball must come to the plane of the triangle beside
  /// the edge, or be beside it near the plane at its start. `t` becomes bounds of the time of a hit.
  [[nodiscard]] Verdict find(double limit, DoubleRange& t) const {
    t = {0, 0};
    if (!are_usual_sizes({edge_, far_, way_}, radius_)) return Verdict::undecided;
    const Vector<double> moment = cross(from_corner_, along_);
    const Vector<double> turn = cross(step_, along_);
    const double size = far_ * far_ + radius_ * radius_;
    const double above = dot(moment, moment) - radius_ * radius_ * square_;
    const double of_above = 0x1p-45 * edge_ * edge_ * size;
    if (above < -of_above) return is_beside(t) ? Verdict::hit : Verdict::undecided;
    if (above <= of_above) return Verdict::undecided;
    const double approach = -dot(moment, turn);
    const double of_approach = 0x1p-45 * edge_ * edge_ * far_ * way_;
    if (approach < -of_approach) return Verdict::miss;
    const double height = dot(from_corner_, turn);
    const double spare = radius_ * radius_ * dot(turn, turn) - height * height;
    const double of_spare = 0x1p-43 * edge_ * edge_ * way_ * way_ * size;
    if (spare < -of_spare) return Verdict::miss;
    if (approach <= of_approach || spare <= of_spare) return Verdict::undecided;
    const double slowest = approach - of_approach + std::sqrt((spare - of_spare) * square_) * (1 - 0x1p-48);
    const double fastest = approach + of_approach + std::sqrt((spare + of_spare) * square_) * (1 + 0x1p-48);
    t = {(above - of_above) / fastest * (1 - 0x1p-50), (above + of_above) / slowest * (1 + 0x1p-50)};
    if (t.lower > limit) return Verdict::miss;
    return t.upper <= 1 && is_beside(t) ? Verdict::hit : Verdict::undecided;
  }

  /// Returns bounds of how far along the edge it is touched, as a share of the edge, if that is at a time within `t`.
  /// They are {0, 0} where nothing is known.
  [[nodiscard]] DoubleRange share(const DoubleRange& t) const {
    if (!are_usual_sizes({edge_, far_, way_}, radius_)) return {0, 0};
    const Place place = place_at(t);
    const double of_square = 0x1p-48 * edge_ * edge_;
    if (square_ <= of_square) return {0, 0};
    return {(place.along - place.error) / (square_ + of_square), (place.along + place.error) / (square_ - of_square)};
  }

 private:
  /// Where the centre is: how far along the edge and toward the third corner, times their lengths. Both are off by at
  /// most `error`.
  struct Place {
    double along, to_third, error;
  };
  [[nodiscard]] Place place_at(const DoubleRange& t) const {
    const double middle = (t.lower + t.upper) / 2;
    Vector<double> centre;
    for (std::size_t i = 0; i < 3; ++i) centre[i] = from_corner_[i] + middle * step_[i];
    const double off = (t.upper - t.lower) * way_ + 0x1p-48 * (far_ + way_);
    return {dot(along_, centre), dot(to_third_, centre), 2 * edge_ * off};
  }
  /// Returns true if the inside of the edge certainly is the nearest part of the triangle, at all times within `t`.
  [[nodiscard]] bool is_beside(const DoubleRange& t) const {
    const Place place = place_at(t);
    const double beyond = dot(along_, to_third_) * place.along - square_ * place.to_third;
    return std::min(place.along, square_ - place.along) > place.error + 0x1p-48 * edge_ * edge_ &&
           beyond > 8 * edge_ * edge_ * place.error;
  }

  Vector<double> along_, to_third_, from_corner_, step_;
  double radius_, edge_, far_, way_, square_;
};

}  // namespace surehit::detail
