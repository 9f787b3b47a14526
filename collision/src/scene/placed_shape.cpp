#include "scene/placed_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

double length(const Doubles& x) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

/// Returns how far a shape reaches from its centre along a vector, times the vector's length, and a `share` of all
/// terms more (I11).
template <typename Scalar>
double reach_along(const SweptSphere<Scalar>& sphere, const Doubles& x, double share) {
  return double{sphere.radius} * length(x) * (1 + share);
}
template <typename Scalar>
double reach_along(const SweptBox<Scalar>& box, const Doubles& x, double share) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    sum += std::fabs(x[i]) * double{box.half_extents[static_cast<Eigen::Index>(i)]};
  }
  return sum * (1 + share);
}
template <typename Scalar>
double reach_along(const SweptCapsule<Scalar>& capsule, const Doubles& x, double share) {
  double along = 0;
  double sizes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double product = x[i] * double{capsule.half_axis[static_cast<Eigen::Index>(i)]};
    along += product;
    sizes += std::fabs(product);
  }
  return double{capsule.radius} * length(x) * (1 + share) + std::fabs(along) + sizes * share;
}

/// Returns the largest of the numbers that make a shape what it is.
template <typename Scalar>
double size_of(const SweptSphere<Scalar>& sphere) {
  return sphere.radius;
}
template <typename Scalar>
double size_of(const SweptBox<Scalar>& box) {
  return box.half_extents.maxCoeff();
}
template <typename Scalar>
double size_of(const SweptCapsule<Scalar>& capsule) {
  return std::max(capsule.radius, capsule.half_axis.cwiseAbs().maxCoeff());
}

/// Returns a size that is larger by what is off.
double grown(double size, double slack) { return (size + slack) * (1 + 0x1p-50); }

}  // namespace

template <typename Shape, typename Scalar>
PlacedShape::PlacedShape(const Shape& shape, const Placement<Scalar>& placement, const InstanceFrame& frame,
                         Scalar share_of_motion)
    : is_usable_(frame.is_usable) {
  if (!is_usable_) return;
  double rounding = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const double moved = placement.moves ? double{placement.motion[axis]} * double{share_of_motion} : 0;
    const double last = double{shape.end[axis]} - moved;
    start_[axis] = double{shape.start[axis]} - frame.placed_anchor[i];
    end_[axis] = last - frame.placed_anchor[i];
    const double sizes = std::fabs(start_[axis]) + std::fabs(end_[axis]) + std::fabs(last);
    rounding = std::max(rounding, sizes + (share_of_motion == 1 ? 0 : std::fabs(moved)));
    anchor_[i] = frame.anchor[i];
    for (std::size_t column = 0; column < 3; ++column) {
      rows_[i][column] = placement.pose.linear(axis, static_cast<Eigen::Index>(column));
    }
  }
  // I12
  constexpr double tiny = std::numeric_limits<double>::min();
  const double error = rounding * 0x1p-52 + frame.anchor_slack + tiny;
  const double error_of_corner = frame.radius * 0x1p-49 + tiny;
  slack_ = 2 * (error + error_of_corner);
  is_usable_ = std::max({double{size_of(shape)}, rounding, slack_}) <= 0x1p400;
  // I13
  const double share = 2 * frame.inverse_error + 0x1p-48;
  for (std::size_t i = 0; i < 3; ++i) {
    const Doubles row = {frame.inverse[0][i], frame.inverse[1][i], frame.inverse[2][i]};
    Doubles sums = {0, 0};
    double sizes = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const auto axis = static_cast<Eigen::Index>(j);
      sums[0] += row[j] * start_[axis];
      sums[1] += row[j] * end_[axis];
      sizes += std::fabs(row[j]) * std::max(std::fabs(start_[axis]), std::fabs(end_[axis]));
    }
    in_mesh_.start[i] = frame.anchor[i] + sums[0];
    in_mesh_.end[i] = frame.anchor[i] + sums[1];
    const double off = sizes * share + 2 * frame.row_size[i] * error + std::fabs(frame.anchor[i]) * 0x1p-50;
    in_mesh_.half_extents[i] = (reach_along(shape, row, share) + off) * (1 + 0x1p-48) + tiny;
  }
}

template <typename Scalar>
SweptSphere<double> PlacedShape::near_anchor(const SweptSphere<Scalar>& sphere) const {
  return {start_, end_, grown(sphere.radius, slack_)};
}
template <typename Scalar>
SweptBox<double> PlacedShape::near_anchor(const SweptBox<Scalar>& box) const {
  const auto half = [&](Eigen::Index i) { return grown(box.half_extents[i], slack_); };
  return {start_, end_, {half(0), half(1), half(2)}};
}
template <typename Scalar>
SweptCapsule<double> PlacedShape::near_anchor(const SweptCapsule<Scalar>& capsule) const {
  return {start_, end_, capsule.half_axis.template cast<double>(), grown(capsule.radius, slack_)};
}

template <typename MeshScalar>
void PlacedShape::place(const MeshScalar* corners, std::size_t list_count, std::size_t count, std::size_t stride,
                        double* out) const {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const MeshScalar* const from = corners + 3 * corner * list_count;
    double* const to = out + 3 * corner * stride;
    for (std::size_t n = 0; n < count; ++n) {
      const Doubles x = {double{from[n]} - anchor_[0], double{from[list_count + n]} - anchor_[1],
                         double{from[2 * list_count + n]} - anchor_[2]};
      for (std::size_t k = 0; k < 3; ++k) {
        to[k * stride + n] = rows_[k][0] * x[0] + rows_[k][1] * x[1] + rows_[k][2] * x[2];
      }
    }
  }
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                                   \
  template PlacedShape::PlacedShape(const SweptSphere<Scalar>&, const Placement<Scalar>&, const InstanceFrame&,       \
                                    Scalar);                                                                          \
  template PlacedShape::PlacedShape(const SweptBox<Scalar>&, const Placement<Scalar>&, const InstanceFrame&, Scalar); \
  template PlacedShape::PlacedShape(const SweptCapsule<Scalar>&, const Placement<Scalar>&, const InstanceFrame&,      \
                                    Scalar);                                                                          \
  template SweptSphere<double> PlacedShape::near_anchor(const SweptSphere<Scalar>&) const;                            \
  template SweptBox<double> PlacedShape::near_anchor(const SweptBox<Scalar>&) const;                                  \
  template SweptCapsule<double> PlacedShape::near_anchor(const SweptCapsule<Scalar>&) const;                          \
  template void PlacedShape::place(const Scalar*, std::size_t, std::size_t, std::size_t, double*) const;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
