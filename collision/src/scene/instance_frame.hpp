#pragma once

#include <array>

#include "placement.hpp"
#include "support/double4.hpp"
#include "surehit/box.hpp"

namespace surehit::detail {

/// A vector of doubles.
using Doubles = std::array<double, 3>;

/// The mesh's frame of an instance, as paths need it. It holds numbers of double with error bounds. POSES.md derives
/// them, and the code cites its lemmas.
struct InstanceFrame {
  // Most paths that come to an instance pass beside it, and they need no more than this.
  Double4 placed_anchor = {};           ///< Where the anchor is at t = 0.
  double radius = 0;                    ///< No point of the instance is farther than this from the placed anchor.
  double near_slack = 0;                ///< The sum of the anchor and `near_rest` is off by less. All axes are added.
  std::array<float, 3> near_rest = {};  ///< What `placed_anchor` leaves out, rounded, or 0 if that is large.
  bool is_usable = false;               ///< If false, each triangle of the instance must be decided exactly.
  bool is_mirrored = false;             ///< True if the determinant of the pose's matrix is negative.
  bool moves = false;                   ///< True if the instance has a motion.
  bool is_turned = true;                ///< False if the pose only translates.

  std::array<Double4, 3> inverse = {};  ///< The columns of the inverse of the pose's matrix.
  Double4 anchor = {};                  ///< The middle of the mesh's box.
  Double4 row_size = {};                ///< The sum of the sizes of each row of `inverse`, rounded up.
  double largest_row_size = 0;          ///< The largest component of `row_size`.
  double inverse_error = 0;             ///< No entry of `inverse` is off by more than this share of itself.
  double anchor_size = 0;               ///< The largest component of `anchor`.
  double largest_half_size = 0;         ///< The largest component of `half_size`.
  Double4 half_size = {};               ///< Half of the mesh's box, rounded up.

  // These are for paths that need more than double.
  Double4 placed_anchor_rest = {};         ///< What `placed_anchor` leaves out.
  double anchor_slack = 0;                 ///< The placed anchor alone is off by less. All axes are added.
  double largest_placed_anchor_error = 0;  ///< No component of the sum of both is off by more than this.

  Doubles low = {};   ///< The low corner of a box around the instance and its way.
  Doubles high = {};  ///< The high corner.

  /// Computes all of it. The mesh's box must not be empty, and the pose must be valid.
  template <typename Scalar>
  static InstanceFrame of(const Placement<Scalar>& placement, const Box<double>& mesh_box);
};

/// Returns true if the exact determinant of the matrix is 0. Each entry must be 0, or between 2^-64 and 2^64 in size.
template <typename Scalar>
[[nodiscard]] bool is_singular(const typename Pose<Scalar>::Matrix3& matrix);

}  // namespace surehit::detail
