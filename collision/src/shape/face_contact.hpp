#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>

#include "exact/scaled_double.hpp"
#include "shape/sphere_contact.hpp"
#include "shape/sphere_terms.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// Returns the size of a vector's greatest component.
[[nodiscard]] inline double greatest(const Vector<double>& x) {
  return std::max({std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2])});
}

/// Returns true if nothing underflows or overflows in the contacts below (S8).
[[nodiscard]] inline bool are_usual_sizes(std::initializer_list<double> sizes, double radius) {
  return std::min(sizes) >= 0x1p-60 && std::max(std::max(sizes), radius) <= 0x1p50;
}

/// How a ball touches the inside of a triangle, in double, with bounds for the whole triangle. Most contacts are such
/// ones. It costs less than `SphereTouch`. SHAPES.md has the proof (S8).
class FaceContact {
 public:
  template <typename Scalar>
  FaceContact(const SweptSphere<Scalar>& ball, const Triangle<Scalar>& triangle) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      const double a = triangle.a[axis];
      const double start = ball.start[axis];
      to_b_[i] = double{triangle.b[axis]} - a;
      to_c_[i] = double{triangle.c[axis]} - a;
      from_a_[i] = start - a;
      step_[i] = double{ball.end[axis]} - start;
    }
    radius_ = ball.radius;
    edge_ = std::max(greatest(to_b_), greatest(to_c_));
    far_ = greatest(from_a_);
    way_ = greatest(step_);
    normal_ = cross(to_b_, to_c_);
    square_ = dot(normal_, normal_);
  }

  /// Decides whether the ball touches the inside of the triangle before `limit` or not, if that is certain. `undecided`
  /// may be any contact, or none. `t` becomes bounds of its time. Without a hit, the lower one alone has a meaning.
  /// `passed` becomes an edge that the ball is beside when it comes to the plane, or at its start if it is near the
  /// plane then. Without a value, nothing is known.
  [[nodiscard]] Verdict find(double limit, DoubleRange& t, std::optional<std::size_t>& passed) const {
    t = {0, 0};
    passed = std::nullopt;
    if (!are_usual_sizes({edge_, far_, way_}, radius_)) return Verdict::undecided;
    const double side = dot(normal_, from_a_);
    const double along = dot(normal_, step_);
    const double unit = 0x1p-47 * edge_ * edge_;
    const double above = std::fabs(side) - radius_ * std::sqrt(square_);
    const double error = unit * (far_ + radius_);
    if (above < -error) return find_within(t, passed);
    if (above <= error) return Verdict::undecided;
    const double approach = side < 0 ? along : -along;
    const double of_rate = unit * way_;
    if (approach < -of_rate) return Verdict::miss;
    t.lower = (above - error) / (approach + of_rate) * (1 - 0x1p-50);
    if (t.lower > limit) return Verdict::miss;
    t.upper = (above + error) / (approach - of_rate) * (1 + 0x1p-50);
    if (!(approach > of_rate && t.upper <= 1)) return Verdict::undecided;
    return find_within(t, passed);
  }

  /// Returns bounds of the weights u and v of the touched point, where the ball touches the inside at a time within
  /// `t`. Both are {0, 0} where nothing is known.
  [[nodiscard]] std::array<DoubleRange, 2> weights(const DoubleRange& t) const {
    if (!are_usual_sizes({edge_, far_, way_}, radius_)) return {};
    const Weights weights = weights_at(t);
    if (weights.one <= weights.error) return {};
    const auto quotient = [&](double weight) {
      return DoubleRange{(weight - weights.error) / (weights.one + weights.error),
                         (weight + weights.error) / (weights.one - weights.error)};
    };
    return {quotient(weights.b), quotient(weights.c)};
  }

 private:
  /// The weights of the touched point, times the square of the normal. Each is off by at most a third of `error`.
  struct Weights {
    double b, c, one, error;
  };
  /// Decides about the time in `t` when the ball comes to the plane, or begins near it.
  [[nodiscard]] Verdict find_within(const DoubleRange& t, std::optional<std::size_t>& passed) const {
    const Weights weights = weights_at(t);
    // Edge k is opposite to corner k + 2.
    const std::array<double, 3> opposite = {weights.c, weights.one - weights.b - weights.c, weights.b};
    const auto edge = static_cast<std::size_t>(std::min_element(opposite.begin(), opposite.end()) - opposite.begin());
    if (opposite[edge] > weights.error) return Verdict::hit;
    if (opposite[edge] < -weights.error) passed = edge;
    return Verdict::undecided;
  }
  [[nodiscard]] Weights weights_at(const DoubleRange& t) const {
    const double middle = (t.lower + t.upper) / 2;
    Vector<double> centre;
    for (std::size_t i = 0; i < 3; ++i) centre[i] = from_a_[i] + middle * step_[i];
    const double size = far_ + way_;
    const double off = (t.upper - t.lower) * way_ + 0x1p-48 * size;
    return {dot(normal_, cross(centre, to_c_)), dot(normal_, cross(to_b_, centre)), square_,
            edge_ * edge_ * edge_ * (64 * off + 0x1p-42 * (size + edge_))};
  }

  Vector<double> to_b_, to_c_, from_a_, step_, normal_;
  double radius_, edge_, far_, way_, square_;
};

}  // namespace surehit::detail
