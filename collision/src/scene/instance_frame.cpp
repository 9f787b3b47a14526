#include "scene/instance_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "exact/exact_scale.hpp"
#include "support/exact_difference.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

constexpr double eps = 0x1p-53;

/// Returns a d - b c. It is off by at most 4 eps of itself (Jeannerod, Louvet and Muller 2013). Nothing may underflow.
double minor(double a, double b, double c, double d) {
  const double product = b * c;
  const double error = std::fma(-b, c, product);
  return std::fma(a, d, -product) + error;
}

using Matrix = std::array<Doubles, 3>;

template <typename Scalar>
Matrix to_doubles(const typename Pose<Scalar>::Matrix3& matrix) {
  Matrix m;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      m[row][column] = matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
    }
  }
  return m;
}

/// The matrix of cofactors, and the determinant with its bound.
struct Cofactors {
  explicit Cofactors(const Matrix& m) {
    for (std::size_t row = 0; row < 3; ++row) {
      const Doubles& x = m[(row + 1) % 3];
      const Doubles& y = m[(row + 2) % 3];
      of[row] = {minor(x[1], x[2], y[1], y[2]), minor(x[2], x[0], y[2], y[0]), minor(x[0], x[1], y[0], y[1])};
    }
    double sizes = 0;
    for (std::size_t column = 0; column < 3; ++column) {
      const double product = m[0][column] * of[0][column];
      det += product;
      sizes += std::fabs(product);
    }
    det_error = 9 * eps * sizes;
  }

  Matrix of;             ///< Row i, column j: the cofactor of that entry.
  double det = 0;        ///< The determinant.
  double det_error = 0;  ///< It is off by at most this: 4 + 1 + 3 roundings of the three products.
};

/// The integers of a matrix, in units of a power of two.
template <typename Scalar>
struct ExactMatrix {
  static constexpr int bits = 128 + std::numeric_limits<Scalar>::digits;
  using Cofactor = WideInt<2 * bits + 1>;

  explicit ExactMatrix(const typename Pose<Scalar>::Matrix3& matrix) {
    for (Eigen::Index column = 0; column < 3; ++column) unit.include<Scalar>(matrix.col(column));
    if (unit.is_empty()) unit.exponent = 0;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        set_integer(rows[row][column], matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)), unit);
      }
    }
  }

  /// Returns the cofactors of a row.
  [[nodiscard]] IntVector<Cofactor> cofactors(std::size_t row) const {
    IntVector<Cofactor> of;
    set_cross(of, rows[(row + 1) % 3], rows[(row + 2) % 3]);
    return of;
  }
  [[nodiscard]] WideInt<3 * bits + 3> det() const {
    WideInt<3 * bits + 3> det;
    set_dot(det, rows[0], cofactors(0));
    return det;
  }

  BinaryUnit unit;
  std::array<IntVector<WideInt<bits>>, 3> rows;
};

/// Sets the inverse to the nearest doubles.
template <typename Scalar>
SUREHIT_NOINLINE void invert_exactly(const typename Pose<Scalar>::Matrix3& matrix, Matrix& inverse) {
  const ExactMatrix<Scalar> exact_matrix(matrix);
  const auto det = exact_matrix.det();
  for (std::size_t row = 0; row < 3; ++row) {
    const auto cofactors = exact_matrix.cofactors(row);
    for (std::size_t column = 0; column < 3; ++column) {
      inverse[column][row] = rounded_quotient<double>(cofactors[column], det, -exact_matrix.unit.exponent);
    }
  }
}

/// Adds x to a sum of two doubles.
void add(DoublePair& sum, double x) {
  const auto [high, low] = exact_difference(sum[0], -x);
  sum = {high, sum[1] + low};
}

}  // namespace

template <typename Scalar>
InstanceFrame InstanceFrame::of(const Placement<Scalar>& placement, const Box<double>& mesh_box) {
  InstanceFrame frame;
  const Matrix m = to_doubles<Scalar>(placement.pose.linear);
  const Cofactors cofactors(m);
  // I1
  const double det_share = cofactors.det_error / std::fabs(cofactors.det);
  const bool is_accurate = det_share <= 0x1p-45;
  frame.is_usable = true;
  frame.moves = placement.moves;
  frame.is_turned = placement.pose.linear != Pose<Scalar>::Matrix3::Identity();
  frame.inverse_error = is_accurate ? 8 * eps + 2 * det_share : eps;
  if (!frame.is_turned) frame.inverse_error = 0;
  Matrix inverse;
  if (is_accurate) {
    frame.is_mirrored = cofactors.det < 0;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column)
        inverse[row][column] = cofactors.of[column][row] / cofactors.det;
    }
  } else {
    frame.is_mirrored = ExactMatrix<Scalar>(placement.pose.linear).det().sign() < 0;
    invert_exactly<Scalar>(placement.pose.linear, inverse);
  }
  std::array<double, 3> reaches = {};
  for (std::size_t row = 0; row < 3; ++row) {
    const Doubles& entries = inverse[row];
    for (std::size_t column = 0; column < 3; ++column) frame.inverse[column][row] = entries[column];
    frame.row_size[row] = (std::fabs(entries[0]) + std::fabs(entries[1]) + std::fabs(entries[2])) * (1 + 0x1p-50);
    frame.largest_row_size = std::max(frame.largest_row_size, frame.row_size[row]);
    const auto i = static_cast<Eigen::Index>(row);
    frame.anchor[row] = mesh_box.low[i] / 2 + mesh_box.high[i] / 2;
    frame.anchor_size = std::max(frame.anchor_size, std::fabs(frame.anchor[row]));
    const double half = std::max(mesh_box.high[i] - frame.anchor[row], frame.anchor[row] - mesh_box.low[i]);
    frame.half_size[row] = half * (1 + 0x1p-50) + std::numeric_limits<double>::denorm_min();
    frame.largest_half_size = std::max(frame.largest_half_size, frame.half_size[row]);
  }
  // I2
  for (std::size_t row = 0; row < 3; ++row) {
    const auto i = static_cast<Eigen::Index>(row);
    const double translation = placement.pose.translation[i];
    DoublePair sum = {translation, 0};
    double size = std::fabs(translation);
    double reach = 0;
    for (std::size_t column = 0; column < 3; ++column) {
      const double product = m[row][column] * frame.anchor[column];
      add(sum, product);
      sum[1] += std::fma(m[row][column], frame.anchor[column], -product);
      size += std::fabs(product);
      reach += std::fabs(m[row][column]) * frame.half_size[column];
    }
    sum = exact_difference(sum[0], -sum[1]);
    frame.placed_anchor[row] = sum[0];
    frame.placed_anchor_rest[row] = sum[1];
    const double error = size * 0x1p-100 + 0x1p-1000;
    frame.anchor_slack += std::fabs(sum[0]) * 0x1p-50 + error;
    frame.near_rest[row] = std::fabs(sum[1]) < 0x1p100 ? static_cast<float>(sum[1]) : 0;
    frame.near_slack += (std::fabs(sum[1] - frame.near_rest[row]) + error) * (1 + 0x1p-50);
    frame.largest_placed_anchor_error = std::max(frame.largest_placed_anchor_error, error);
    // I3
    reach = (reach + error) * (1 + 0x1p-48) + std::numeric_limits<double>::min();
    reaches[row] = reach;
    const double motion = placement.moves ? double{placement.motion[i]} : 0;
    const double margin = (size + reach + std::fabs(motion)) * 0x1p-50;
    frame.low[row] = frame.placed_anchor[row] - reach - margin + std::min(motion, 0.0);
    frame.high[row] = frame.placed_anchor[row] + reach + margin + std::max(motion, 0.0);
    frame.is_usable &= std::isfinite(frame.low[row]) && std::isfinite(frame.high[row]);
  }
  // In units of the largest one, no square underflows that counts.
  const double largest = std::max({reaches[0], reaches[1], reaches[2]});
  double squares = 0;
  for (const double reach : reaches) squares += reach / largest * (reach / largest);
  frame.radius = largest * std::sqrt(squares) * (1 + 0x1p-48);
  frame.is_usable &= frame.radius <= 0x1p400;
  if (!frame.is_usable) {
    for (std::size_t row = 0; row < 3; ++row) {
      const double infinity = std::numeric_limits<double>::infinity();
      if (!std::isfinite(frame.low[row])) frame.low[row] = -infinity;
      if (!std::isfinite(frame.high[row])) frame.high[row] = infinity;
    }
  }
  return frame;
}

template <typename Scalar>
bool is_singular(const typename Pose<Scalar>::Matrix3& matrix) {
  const Cofactors cofactors(to_doubles<Scalar>(matrix));
  if (std::fabs(cofactors.det) > cofactors.det_error) return false;
  return ExactMatrix<Scalar>(matrix).det().is_zero();
}

template InstanceFrame InstanceFrame::of(const Placement<float>&, const Box<double>&);
template InstanceFrame InstanceFrame::of(const Placement<double>&, const Box<double>&);
template bool is_singular<float>(const Pose<float>::Matrix3&);
template bool is_singular<double>(const Pose<double>::Matrix3&);

}  // namespace surehit::detail
