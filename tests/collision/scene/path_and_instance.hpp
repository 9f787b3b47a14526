#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <vector>

#include "collision/filter/coordinate_changes.hpp"
#include "exact_path.hpp"
#include "path_range.hpp"
#include "placement.hpp"
#include "scene/instance_frame.hpp"
#include "scene/instance_tree.hpp"
#include "support/random.hpp"
#include "support/scene_drawer.hpp"
#include "surehit/box.hpp"
#include "surehit/path.hpp"

namespace surehit::test {

/// A path, an instance and the box of its mesh. All of their numbers are exact.
template <typename Scalar>
struct PathAndInstance {
  detail::Placement<Scalar> placement = {};
  Box<double> box = {};
  Path<Scalar> path = Line<Scalar>{Vector3<Scalar>::Zero(), Vector3<Scalar>::Zero()};
  detail::PathRange<Scalar> range = {0, 1};
  Scalar share = 1;

  ExactMatrix matrix = {};
  ExactMatrix inverse_matrix = {};
  ExactVector direction = {};  ///< D in the frame of the scene.

  void set_exact() {
    for (Eigen::Index i = 0; i < 3; ++i) matrix[static_cast<std::size_t>(i)] = exact(placement.pose.linear.row(i));
    inverse_matrix = inverse(matrix);
    direction = exact_direction(path);
    if (path.has_end()) direction = direction - mpq_class(double{share}) * exact(placement.motion);
  }
  /// Returns the path at t in the frame of the mesh.
  [[nodiscard]] ExactVector local_at(const mpq_class& t) const {
    return inverse_matrix * (exact(path.start) + t * direction - exact(placement.pose.translation));
  }
  /// Returns the part of the range in which the path is in the box.
  [[nodiscard]] std::optional<std::array<mpq_class, 2>> in_box() const {
    const detail::InstanceBox sides = {{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}};
    const auto inside = exact_range_in(sides, local_at(0), inverse_matrix * direction, range);
    if (!inside || !inside->first || !inside->last) return std::nullopt;
    return std::array{*inside->first, *inside->last};
  }
};

/// Returns a number of [low, high).
inline double real(Random& random, double low, double high) { return low + (high - low) * random.unit<double>(); }

/// Draws an instance near the origin or far away, and a path that comes near it in half of all cases.
template <typename Scalar>
PathAndInstance<Scalar> draw_path_and_instance(Random& random) {
  const auto number = [&](double size) { return static_cast<Scalar>(real(random, -size, size)); };
  const auto vector = [&](double size) { return Vector3<Scalar>(number(size), number(size), number(size)); };
  const double far = random.one_in(3) ? std::exp2(real(random, 0, std::is_same_v<Scalar, float> ? 20 : 40)) : 0;
  SceneFamily family = all_scene_families[random.below(all_scene_families.size() - 1)];
  PathAndInstance<Scalar> drawn;
  drawn.placement.pose = draw_pose<Scalar>(family, random);
  drawn.placement.pose.translation += vector(far);
  if (random.one_in(2)) {
    drawn.placement.motion = vector(random.one_in(2) ? 1 : 1 + far);
    drawn.placement.moves = true;
    if (random.one_in(3)) drawn.share = static_cast<Scalar>(std::exp2(-real(random, 0, 140)));
  }
  const double size = std::exp2(real(random, -10, 10));
  const Vector3<Scalar> middle = vector(random.one_in(2) ? 0 : 100 * size);
  const Vector3<Scalar> one = middle + vector(size);
  const Vector3<Scalar> other = random.one_in(8) ? one : Vector3<Scalar>(middle + vector(size));
  drawn.box.extend(one.template cast<double>());
  drawn.box.extend(other.template cast<double>());
  // The path leads through a point near the mesh.
  const Vector3<double> inside = (drawn.box.low + drawn.box.high) / 2 + vector(size).template cast<double>();
  const Vector3<double> target = drawn.placement.pose.linear.template cast<double>() * inside +
                                 drawn.placement.pose.translation.template cast<double>();
  const double reach = size * std::exp2(real(random, -5, 25));
  const Vector3<double> way = vector(reach).template cast<double>();
  const double before = real(random, -0.5, 1.5);
  const Vector3<Scalar> start = (target - before * way).template cast<Scalar>();
  const Vector3<Scalar> end = (target + (1 - before) * way).template cast<Scalar>();
  const std::size_t kind = random.below(3);
  if (kind == 0) drawn.path = Segment<Scalar>{start, random.one_in(20) ? start : end};
  if (kind == 1) drawn.path = Ray<Scalar>{start, end - start};
  if (kind == 2) drawn.path = Line<Scalar>{start, end - start};
  drawn.range = detail::PathRange<Scalar>(drawn.path, QueryOptions<Scalar>{});
  if (random.one_in(4)) drawn.range.last = static_cast<Scalar>(real(random, 0, 1));
  drawn.set_exact();
  return drawn;
}

/// Returns a case with another number. Its matrix has an inverse. An instance that is only translated stays so, and the
/// middle of a mesh stays at the origin.
template <typename Scalar>
PathAndInstance<Scalar> changed(const PathAndInstance<Scalar>& drawn, Random& random) {
  const bool is_turned = drawn.placement.pose.linear != Pose<Scalar>::Matrix3::Identity();
  for (;;) {
    PathAndInstance<Scalar> next = drawn;
    if (random.one_in(5)) {
      const auto axis = static_cast<Eigen::Index>(random.below(3));
      double low = drawn.box.low[axis];
      double high = drawn.box.high[axis];
      const bool is_centred = low == -high;
      double& side = random.one_in(2) ? low : high;
      side = changed_coordinate(random, side);
      if (is_centred) (&side == &low ? high : low) = -side;
      next.box.low[axis] = std::min(low, high);
      next.box.high[axis] = std::max(low, high);
    } else {
      std::vector<Scalar*> numbers;
      const auto add = [&](auto& matrix) {
        for (Eigen::Index i = 0; i < matrix.size(); ++i) numbers.push_back(matrix.data() + i);
      };
      if (is_turned) add(next.placement.pose.linear);
      add(next.placement.pose.translation);
      if (next.placement.moves) add(next.placement.motion);
      add(next.path.start);
      add(next.path.toward);
      Scalar& number = *numbers[random.below(numbers.size())];
      number = changed_coordinate(random, number);
    }
    const auto is_valid = [](Scalar x) { return x == 0 || (std::fabs(x) >= 0x1p-64F && std::fabs(x) <= 0x1p64F); };
    const auto& linear = next.placement.pose.linear;
    if (!std::all_of(linear.data(), linear.data() + linear.size(), is_valid)) continue;
    if (!detail::is_finite(next.path)) continue;
    if (is_turned && exact_determinant(next.placement.pose) == 0) continue;
    next.set_exact();
    return next;
  }
}

}  // namespace surehit::test
