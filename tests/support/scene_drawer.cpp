#include "support/scene_drawer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "support/neighbour.hpp"
#include "support/pair_families.hpp"
#include "support/small_meshes.hpp"

namespace surehit::test {
namespace {

using Matrixd = Eigen::Matrix<double, 3, 3>;

constexpr std::size_t lattice_mesh_kinds[] = {12, 15, 16};
constexpr std::size_t mixed_magnitudes_kind = 13;
constexpr std::size_t max_triangles = 16;

Vector3<double> whole_vector(Random& random, std::int64_t reach) {
  const auto draw = [&] { return static_cast<double>(random.between(-reach, reach)); };
  const double x = draw();
  const double y = draw();
  return {x, y, draw()};
}

Vector3<double> symmetric_vector(Random& random) {
  const double x = random.symmetric<double>();
  const double y = random.symmetric<double>();
  return {x, y, random.symmetric<double>()};
}

Matrixd of_quaternion(double w, double x, double y, double z) {
  const double norm = w * w + x * x + y * y + z * z;
  Matrixd matrix;
  matrix << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),        //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return matrix / norm;
}

Matrixd rotation(Random& random) {
  const auto whole = [&] { return static_cast<double>(random.between(-4, 4)); };
  switch (random.below(4)) {
    case 0: {  // about an axis, with zeros in the matrix
      const double w = 1 + random.unit<double>();
      return of_quaternion(w, 0, 0, random.symmetric<double>());
    }
    case 1: {  // by right angles, or with short numbers
      const double x = whole();
      const double y = whole();
      return of_quaternion(5, x, y, whole());
    }
    case 2: {
      constexpr double quarter[] = {-1, 0, 1};
      const double x = quarter[random.below(3)];
      const double y = quarter[random.below(3)];
      return of_quaternion(1, x, y, quarter[random.below(3)]);
    }
    default: {
      const Vector3<double> axis = symmetric_vector(random);
      return of_quaternion(random.symmetric<double>() + 2, axis[0], axis[1], axis[2]);
    }
  }
}

/// Entries of at most 2^64 in magnitude stay, and what is too small becomes 0.
Matrixd kept_in_range(const Matrixd& matrix) {
  return matrix.unaryExpr([](double x) {
    if (std::abs(x) < 0x1p-64) return 0.0;
    return std::clamp(x, -0x1p64, 0x1p64);
  });
}

template <typename Scalar>
Pose<Scalar> pose_of(const Matrixd& linear, const Vector3<double>& translation) {
  return {kept_in_range(linear).template cast<Scalar>(), rounded<Scalar>(translation)};
}

/// A row is nearly a sum of the others, or the image is nearly flat.
template <typename Scalar>
Pose<Scalar> nearly_singular(Random& random) {
  if (random.one_in(2)) {
    const double thickness = std::ldexp(1.0, static_cast<int>(random.between(-50, -20)));
    const Matrixd turned = rotation(random);
    const Matrixd linear = turned * Vector3<double>(1, 1, thickness).asDiagonal() * rotation(random);
    return pose_of<Scalar>(linear, symmetric_vector(random));
  }
  const Matrixd turned = rotation(random);
  Pose<Scalar> pose = pose_of<Scalar>(turned, symmetric_vector(random));
  const auto factor = static_cast<Scalar>(random.between(-2, 2));
  pose.linear.row(2) = factor * pose.linear.row(0) + pose.linear.row(1);
  Scalar& entry = pose.linear(2, static_cast<int>(random.below(3)));
  entry = neighbour(entry, random.one_in(2) ? 1 : -1);
  return pose_of<Scalar>(pose.linear.template cast<double>(), pose.translation.template cast<double>());
}

template <typename Scalar>
Pose<Scalar> of_all_magnitudes(Random& random) {
  Matrixd linear;
  for (double& x : linear.reshaped()) {
    const auto exponent = static_cast<int>(random.between(-64, 63));
    x = random.one_in(4) ? 0 : std::ldexp(1 + random.unit<double>(), exponent);
    if (x != 0 && random.one_in(2)) x = -x;
  }
  Vector3<Scalar> translation = symmetric_vector(random).cast<Scalar>();
  for (Scalar& x : translation) {
    if (random.one_in(3)) x = random.any_finite<Scalar>();
  }
  return {kept_in_range(linear).template cast<Scalar>(), translation};
}

template <typename Scalar>
Pose<Scalar> any_pose(SceneFamily family, Random& random) {
  const auto translation = [&] { return Vector3<double>(2 * symmetric_vector(random)); };
  switch (family) {
    case SceneFamily::identity:
      return {};
    case SceneFamily::translations:
      return pose_of<Scalar>(Matrixd::Identity(), random.one_in(2) ? whole_vector(random, 3) : translation());
    case SceneFamily::integer_matrices: {
      Matrixd linear;
      for (double& x : linear.reshaped()) x = static_cast<double>(random.between(-2, 2));
      return pose_of<Scalar>(linear, whole_vector(random, 4));
    }
    case SceneFamily::rotations: {
      const Matrixd linear = rotation(random);
      return pose_of<Scalar>(linear, translation());
    }
    case SceneFamily::mirrored: {
      const Matrixd linear = rotation(random) * Vector3<double>(1, 1, -1).asDiagonal();
      return pose_of<Scalar>(linear, translation());
    }
    case SceneFamily::sheared: {
      Matrixd linear = Matrixd::Identity();
      for (double& x : linear.reshaped()) {
        if (random.one_in(2)) x += 2 * random.symmetric<double>();
      }
      return pose_of<Scalar>(linear, translation());
    }
    case SceneFamily::scaled: {
      const double scale = std::ldexp(1.0, static_cast<int>(random.between(-60, 60)));
      const Vector3<double> place = random.one_in(2) ? Vector3<double>::Zero() : translation();
      return pose_of<Scalar>(scale * rotation(random), scale * place);
    }
    case SceneFamily::nearly_singular:
      return nearly_singular<Scalar>(random);
    case SceneFamily::all_magnitudes:
      return of_all_magnitudes<Scalar>(random);
    case SceneFamily::pieces:
    case SceneFamily::mixed:
      break;
  }
  return draw_pose<Scalar>(all_scene_families[random.below(8)], random);
}

template <typename MeshScalar>
DrawnMesh small_mesh(std::size_t kind, Random& random) {
  const SmallMesh<MeshScalar> small = draw_small_mesh<MeshScalar>(kind, random);
  DrawnMesh mesh;
  mesh.is_float = std::is_same_v<MeshScalar, float>;
  for (const auto& vertex : small.vertices) mesh.vertices.push_back(vertex.template cast<double>());
  mesh.triangles = small.triangles;
  mesh.triangles.resize(std::min(mesh.triangles.size(), max_triangles));
  for (const auto& path : small.paths) {
    mesh.paths.emplace_back(path.kind, path.start.template cast<double>(), path.toward.template cast<double>());
  }
  return mesh;
}

void draw_masks(DrawnMesh& mesh, Random& random) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    mesh.masks.push_back(static_cast<std::uint32_t>(random.below(4)));
  }
}

/// Returns options for a few cells. Most of them are divided. A small mesh would have one cell by itself.
GridOptions draw_grid(Random& random) {
  GridOptions grid;
  for (std::uint32_t& cells : grid.resolution) cells = static_cast<std::uint32_t>(random.between(1, 4));
  grid.crowded = static_cast<std::uint32_t>(random.below(6));
  return grid;
}

DrawnMesh draw_mesh(SceneFamily family, bool is_float, Random& random) {
  std::size_t kind = random.below(small_mesh_kind_count);
  if (kind == mixed_magnitudes_kind && family != SceneFamily::all_magnitudes) ++kind;
  if (family == SceneFamily::integer_matrices) kind = lattice_mesh_kinds[random.below(3)];
  // Now and then a mesh has so many triangles that its grid has cells anyway, or an inner grid.
  const bool is_large = random.one_in(8);
  const bool has_prop = is_large && family != SceneFamily::pieces && random.one_in(2);
  DrawnMesh mesh;
  if (has_prop) {
    mesh = ground_with_prop(is_float, random);
    // The other families have meshes of about this size.
    const double size = family == SceneFamily::integer_matrices ? 1 : 0x1p-10;
    for (Vector3<double>& vertex : mesh.vertices) vertex *= size;
  } else if (family == SceneFamily::pieces || is_large) {
    mesh = ground_piece(is_large ? 12 : static_cast<std::uint32_t>(random.between(1, 2)), is_float, random);
  } else {
    mesh = is_float ? small_mesh<float>(kind, random) : small_mesh<double>(kind, random);
  }
  if (is_large && family == SceneFamily::integer_matrices) {
    for (Vector3<double>& vertex : mesh.vertices) vertex[2] = std::round(vertex[2]);
  }
  if (!has_prop && random.one_in(2)) mesh.grid = draw_grid(random);
  if (random.one_in(2)) draw_masks(mesh, random);
  return mesh;
}

/// Draws an offset of whole numbers, so that a scene of whole numbers stays one. The first `count` distances are
/// allowed.
template <typename Scalar>
Vector3<Scalar> draw_offset(Random& random, std::size_t count = std::is_same_v<Scalar, float> ? 4 : 5) {
  constexpr double distances[] = {0, 0, 1e5, 1e7, 1e9};
  const double distance = distances[random.below(count)];
  return Vector3<double>(distance, -distance / 4, random.one_in(2) ? 0 : distance / 2).cast<Scalar>();
}

template <typename Scalar>
Vector3<Scalar> draw_motion(SceneFamily family, const Pose<Scalar>& pose, Random& random) {
  if (family == SceneFamily::all_magnitudes && random.one_in(2)) {
    const Scalar x = random.any_finite<Scalar>();
    return {x, 0, random.any_finite<Scalar>()};
  }
  switch (random.below(6)) {
    case 0:
      return Vector3<Scalar>::Zero();
    case 1:
      return whole_vector(random, 3).cast<Scalar>();
    case 2:  // as large as the image is
      return pose.linear * symmetric_vector(random).cast<Scalar>();
    case 3: {
      const Vector3<double> motion = symmetric_vector(random);
      return Vector3<double>(motion * (random.one_in(2) ? 0x1p50 : 0x1p-50)).cast<Scalar>();
    }
    default:
      return symmetric_vector(random).cast<Scalar>();
  }
}

template <typename Scalar>
void place_pieces(DrawnScene<Scalar>& scene, Random& random) {
  const double side = scene.meshes[0].vertices.back()[0];
  const Eigen::Matrix<Scalar, 3, 3> linear = random.one_in(4)
                                                 ? Eigen::Matrix<Scalar, 3, 3>(Eigen::Matrix<Scalar, 3, 3>::Identity())
                                                 : matrix_of_eighths<Scalar>(random);
  // Far away, floats are too coarse for eighths.
  const Vector3<Scalar> offset = draw_offset<Scalar>(random, std::is_same_v<Scalar, float> ? 3 : 5);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      const Vector3<Scalar> place = Vector3<double>(side * x, side * y, 0).cast<Scalar>();
      scene.instances.push_back({0, {{linear, linear * place + offset}, Vector3<Scalar>::Zero()}});
    }
  }
  for (std::size_t i = scene.instances.size(); i > 1; --i) {
    std::swap(scene.instances[i - 1], scene.instances[random.below(i)]);
  }
}

}  // namespace

std::string name_of(SceneFamily family) {
  constexpr const char* names[] = {"identity", "translations", "integer_matrices", "rotations",
                                   "mirrored", "sheared",      "scaled",           "nearly_singular",
                                   "pieces",   "mixed",        "all_magnitudes"};
  return names[static_cast<std::size_t>(family)];
}

DrawnMesh ground_piece(std::uint32_t side, bool is_float, Random& random) {
  DrawnMesh mesh;
  mesh.is_float = is_float;
  std::vector<double> heights;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    heights.push_back(is_float ? double{random.symmetric<float>()} : random.symmetric<double>());
  }
  for (std::uint32_t y = 0; y <= side; ++y) {
    for (std::uint32_t x = 0; x <= side; ++x) {
      mesh.vertices.emplace_back(x, y, heights[y % side * side + x % side]);
    }
  }
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t corner = y * (side + 1) + x;
      mesh.triangles.push_back({corner, corner + 1, corner + side + 1});
      mesh.triangles.push_back({corner + 1, corner + side + 2, corner + side + 1});
    }
  }
  return mesh;
}

DrawnMesh ground_with_prop(bool is_float, Random& random) {
  constexpr double square = 1024;
  DrawnMesh mesh = ground_piece(2, is_float, random);
  for (Vector3<double>& vertex : mesh.vertices) {
    for (double& x : vertex) x = std::round(square * x);
  }
  // Not where planes between cells are, so that one cell has all of it.
  const Vector3<double> place(307, 276, std::round(square / 8 * random.symmetric<double>()));
  for (int i = 0; i < 72; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int corner = 0; corner < 3; ++corner) mesh.vertices.push_back(place + whole_vector(random, 4));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  mesh.grid.resolution = {static_cast<std::uint32_t>(random.between(1, 2)), 2, 1};
  mesh.grid.crowded = random.one_in(2) ? 2 : 30;
  return mesh;
}

template <typename Scalar>
Eigen::Matrix<Scalar, 3, 3> matrix_of_eighths(Random& random) {
  Pose<Scalar> pose;
  do {
    for (Scalar& x : pose.linear.reshaped()) x = static_cast<Scalar>(random.between(-16, 16)) / 8;
  } while (exact_determinant(pose) == 0);
  return pose.linear;
}

template <typename MeshScalar>
std::shared_ptr<Collider<MeshScalar>> collider_of(const DrawnMesh& mesh) {
  std::vector<Vector3<MeshScalar>> vertices;
  for (const auto& vertex : mesh.vertices) vertices.push_back(vertex.template cast<MeshScalar>());
  return std::make_shared<Collider<MeshScalar>>(TriangleMeshView<MeshScalar>(vertices, mesh.triangles),
                                                BuildOptions{mesh.grid, mesh.masks});
}

template <typename Scalar>
Pose<Scalar> draw_pose(SceneFamily family, Random& random) {
  Pose<Scalar> pose;
  do {
    pose = any_pose<Scalar>(family, random);
  } while (exact_determinant(pose) == 0);
  return pose;
}

template <typename Scalar>
DrawnScene<Scalar> draw_scene(SceneFamily family, Random& random) {
  DrawnScene<Scalar> scene;
  for (std::uint64_t i = family == SceneFamily::pieces ? 1 : 1 + random.below(3); i > 0; --i) {
    const bool is_float = std::is_same_v<Scalar, float> || random.one_in(2);
    scene.meshes.push_back(draw_mesh(family, is_float, random));
  }
  if (scene.meshes.size() > 1 && random.one_in(8)) {
    scene.meshes.back().triangles.clear();
    scene.meshes.back().masks.clear();
  }

  if (family == SceneFamily::pieces) {
    place_pieces(scene, random);
  } else {
    const bool has_offset = family != SceneFamily::scaled && family != SceneFamily::all_magnitudes;
    const Vector3<Scalar> offset = has_offset ? draw_offset<Scalar>(random) : Vector3<Scalar>(Vector3<Scalar>::Zero());
    for (std::uint64_t i = 1 + random.below(random.one_in(16) ? 60 : 6); i > 0; --i) {
      Placement<Scalar> placement{draw_pose<Scalar>(family, random)};
      if (family != SceneFamily::identity) placement.pose.translation += offset;
      scene.instances.push_back({random.below(scene.meshes.size()), placement});
    }
    scene.instances[0].mesh = 0;
  }

  const bool has_motion = random.one_in(2);
  const bool has_masks = random.one_in(3);
  const bool has_one_motion = random.one_in(4) || (family == SceneFamily::pieces && random.one_in(2));
  for (auto& [mesh, placement] : scene.instances) {
    if (has_motion) placement.motion = draw_motion(family, placement.pose, random);
    if (has_one_motion) placement.motion = scene.instances[0].placement.motion;
    if (has_masks) placement.mask = static_cast<std::uint32_t>(random.below(4));
  }
  return scene;
}

template <typename Scalar>
JudgedScene<Scalar>::JudgedScene(const DrawnScene<Scalar>& drawn) {
  std::vector<std::shared_ptr<Collider<Scalar>>> colliders;
  std::vector<std::shared_ptr<Collider<float>>> float_colliders;
  for (const DrawnMesh& mesh : drawn.meshes) {
    colliders.push_back(mesh.is_float && !std::is_same_v<Scalar, float> ? nullptr : collider_of<Scalar>(mesh));
    float_colliders.push_back(mesh.is_float ? collider_of<float>(mesh) : nullptr);
  }
  for (const auto& [index, placement] : drawn.instances) {
    const DrawnMesh& mesh = drawn.meshes[index];
    const InstanceOptions options{.mask = placement.mask, .user_data = ids.size()};
    ids.push_back(mesh.is_float ? scene.add(float_colliders[index], placement.pose, options)
                                : scene.add(colliders[index], placement.pose, options));
    if (!placement.motion.isZero(0)) scene.set_motion(ids.back(), placement.motion);
    oracle.add(ids.back(), mesh.view(), mesh.masks, placement);
  }
  scene.commit();
}

template std::shared_ptr<Collider<float>> collider_of(const DrawnMesh&);
template std::shared_ptr<Collider<double>> collider_of(const DrawnMesh&);

#define SUREHIT_INSTANTIATE(Scalar)                                \
  template Eigen::Matrix<Scalar, 3, 3> matrix_of_eighths(Random&); \
  template Pose<Scalar> draw_pose(SceneFamily, Random&);           \
  template DrawnScene<Scalar> draw_scene(SceneFamily, Random&);    \
  template struct JudgedScene<Scalar>;
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
