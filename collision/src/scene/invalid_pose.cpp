#include "scene/invalid_pose.hpp"

#include <cmath>
#include <cstddef>
#include <string>

#include "scene/instance_frame.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// Returns the name of an entry of [linear | translation].
std::string name_of_entry(std::size_t row, std::size_t column) {
  return column == 3 ? "translation[" + std::to_string(row) + "]"
                     : "linear(" + std::to_string(row) + ", " + std::to_string(column) + ")";
}

}  // namespace

template <typename Scalar>
std::optional<InvalidInstance> find_invalid(const Pose<Scalar>& pose) {
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      const auto i = static_cast<Eigen::Index>(row);
      const Scalar entry = column == 3 ? pose.translation[i] : pose.linear(i, static_cast<Eigen::Index>(column));
      const auto invalid = [&](InvalidInstance::Reason reason, const char* what) {
        return InvalidInstance(reason, 4 * row + column, "pose: " + name_of_entry(row, column) + " " + what);
      };
      if (!std::isfinite(entry)) return invalid(InvalidInstance::Reason::non_finite_pose, "is not finite");
      const Scalar size = std::fabs(entry);
      if (column < 3 && size != 0 && !(size >= Scalar(0x1p-64) && size <= Scalar(0x1p64))) {
        return invalid(InvalidInstance::Reason::pose_out_of_range, "is neither 0 nor between 2^-64 and 2^64 in size");
      }
    }
  }
  if (is_singular<Scalar>(pose.linear)) {
    return InvalidInstance(InvalidInstance::Reason::singular_pose, 0, "pose: the determinant of linear is 0");
  }
  return std::nullopt;
}

template std::optional<InvalidInstance> find_invalid(const Pose<float>&);
template std::optional<InvalidInstance> find_invalid(const Pose<double>&);

}  // namespace surehit::detail
