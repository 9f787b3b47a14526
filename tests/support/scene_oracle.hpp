#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "support/dyadic.hpp"
#include "support/integer_pair.hpp"
#include "surehit/instance.hpp"
#include "surehit/path.hpp"
#include "surehit/pose.hpp"
#include "surehit/scene_hit.hpp"
#include "surehit/scene_query_options.hpp"
#include "surehit/scene_shape_hit.hpp"
#include "surehit/scene_shape_options.hpp"
#include "surehit/swept_shape.hpp"
#include "surehit/triangle.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::test {

/// Where an instance is, and who sees it.
template <typename Scalar>
struct Placement {
  Pose<Scalar> pose = {};
  Vector3<Scalar> motion = Vector3<Scalar>::Zero();
  std::uint32_t mask = ~std::uint32_t{0};
};

/// Returns the exact determinant of a pose's matrix.
template <typename Scalar>
[[nodiscard]] mpq_class exact_determinant(const Pose<Scalar>& pose);

/// The answers of a scene by asking about each triangle of each instance. Its corners are the exact images. It shares
/// nothing with the library but the types of its arguments. Call it in the default floating-point environment.
template <typename Scalar>
class SceneOracle {
 public:
  using Hits = std::vector<SceneHit<Scalar>>;
  using Filter = std::function<bool(const SceneHit<Scalar>&)>;

  /// Adds an instance of a mesh, of floats or doubles. There is one mask a triangle, or none. Copies what it needs.
  template <typename MeshScalar>
  void add(InstanceId id, const TriangleMeshView<MeshScalar>& mesh, std::span<const std::uint32_t> masks,
           const Placement<Scalar>& placement);

  /// Returns one hit for each triangle that the path meets, in the order of exact t, instance and triangle.
  [[nodiscard]] Hits all_hits(const Path<Scalar>& path, const SceneQueryOptions<Scalar>& options = {}) const;

  /// Returns the first candidate that is free, as the headers define it. No filter accepts all hits.
  [[nodiscard]] Vector3<Scalar> last_free_point(const Segment<Scalar>& segment, const SceneHit<Scalar>& hit,
                                                const SceneQueryOptions<Scalar>& options = {},
                                                const Filter& filter = {}) const;

  /// Says what is wrong with the hits of a moving shape, which are to be all of them in order. Returns nothing if they
  /// are right in every field. `swept_truth` judges each pair.
  [[nodiscard]] std::optional<std::string> find_error(const SweptShape<Scalar>& shape,
                                                      const SceneShapeQueryOptions<Scalar>& options,
                                                      const std::vector<SceneShapeHit<Scalar>>& hits) const;

  /// Returns the exact corners of a placed triangle at t = 0.
  [[nodiscard]] std::array<std::array<mpq_class, 3>, 3> corners(InstanceId id, std::uint32_t triangle) const;
  /// Returns them rounded once to nearest.
  [[nodiscard]] Triangle<Scalar> triangle(InstanceId id, std::uint32_t triangle) const;

 private:
  struct PlacedMesh {
    InstanceId id;
    std::uint32_t mask;
    std::vector<std::uint32_t> masks;
    DyadicVector motion;
    long exponent;                                             ///< Coordinates are whole numbers of 2^exponent.
    std::vector<std::array<ExactIntegerVector, 3>> triangles;  ///< At t = 0.
    ExactIntegerVector low;                                    ///< The box around all triangles.
    ExactIntegerVector high;
  };
  struct OrderedHit {
    mpq_class t;
    SceneHit<Scalar> hit;
  };

  /// While t goes from 0 to 1, instances move by `share` times their motion.
  [[nodiscard]] std::vector<OrderedHit> ordered_hits(const Path<Scalar>& path, const Dyadic& share,
                                                     const SceneQueryOptions<Scalar>& options) const;
  static void add_hits(const PlacedMesh& mesh, const Path<Scalar>& path, const Dyadic& share,
                       const SceneQueryOptions<Scalar>& options, std::vector<OrderedHit>& hits);
  [[nodiscard]] const PlacedMesh& of(InstanceId id) const;

  std::vector<PlacedMesh> meshes_;
};

}  // namespace surehit::test
