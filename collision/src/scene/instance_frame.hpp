#pragma once

#include <array>

#include "scene/placement.hpp"
#include "surehit/box.hpp"

namespace surehit::detail {

/// A vector of doubles.
using Doubles = std::array<double, 3>;

/// The mesh's frame of an instance, as paths need it. It holds numbers of double with error bounds. POSES.md derives
/// them, and the code cites its lemmas.
struct InstanceFrame {
  // Most paths that come to an instance pass beside it, and they need no more than this.
  Doubles placed_anchor = {};  ///< Where the anchor is at t = 0.
  double radius = 0;           ///< No point of the instance is farther than this from the placed anchor.
  double anchor_slack = 0;     ///< More than the sum of all components of `placed_anchor_rest`.
  bool is_usable = false;      ///< If false, each triangle of the instance must be decided exactly.
  bool is_mirrored = false;    ///< True if the determinant of the pose's matrix is negative.
  bool moves = false;          ///< True if the instance has a motion.

  std::array<Doubles, 3> inverse = {};  ///< The rows of the inverse of the pose's matrix.
  Doubles row_size = {};                ///< The sum of the sizes of each row of `inverse`, rounded up.
  double inverse_error = 0;             ///< No entry of `inverse` is off by more than this share of itself.
  Doubles anchor = {};                  ///< The middle of the mesh's box.
  Doubles half_size = {};               ///< Half of the mesh's box, rounded up.
  double largest_half_size = 0;         ///< The largest component of `half_size`.
  Doubles placed_anchor_rest = {};      ///< What `placed_anchor` leaves out.
  Doubles placed_anchor_error = {};     ///< The sum of both is off by at most this.
  Doubles low = {};                     ///< The low corner of a box around the instance and its way.
  Doubles high = {};                    ///< The high corner.

  /// Computes all of it. The mesh's box must not be empty, and the pose must be valid.
  template <typename Scalar>
  static InstanceFrame of(const Placement<Scalar>& placement, const Box<double>& mesh_box);
};

/// Returns true if the exact determinant of the matrix is 0. Each entry must be 0, or between 2^-64 and 2^64 in size.
template <typename Scalar>
[[nodiscard]] bool is_singular(const typename Pose<Scalar>::Matrix3& matrix);

}  // namespace surehit::detail
