#pragma once

#include <cstdint>
#include <vector>

#include "filter/bounded_contact.hpp"
#include "placement.hpp"
#include "scene/placed_path.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/scene_hit.hpp"
#include "surehit/scene_query_options.hpp"

namespace surehit::detail {

/// An instance of a committed scene, as its narrowphase needs it.
template <typename Scalar>
struct PlacedInstance {
  InstanceFrame frame;          ///< The frame of its mesh.
  Placement<Scalar> placement;  ///< Where it is.
};

/// A triangle of an instance that a path meets.
template <typename Scalar>
struct PlacedCandidate {
  std::uint32_t instance;                ///< The index of the instance.
  std::uint32_t id;                      ///< The id of the triangle.
  Triangle<Scalar> local;                ///< The corners of the triangle in the mesh.
  const PlacedInstance<Scalar>* placed;  ///< The instance.
  BoundedContact bounded;                ///< The contact. It is undecided if exact arithmetic has found it.
};

/// Decides one path of a scene against placed triangles. The second stage works in the frame of the mesh, and the
/// later ones in that of the scene.
template <typename Scalar>
class SceneNarrowphase {
 public:
  SceneNarrowphase(const ScenePath<Scalar>& path, const SceneQueryOptions<Scalar>& options, QueryStatistics& statistics)
      : path_(path), options_(options), statistics_(statistics) {}

  /// Returns true, with the contact in the candidate, if the path meets the triangle and the options on contacts admit
  /// it. `path` is the path as the candidate's instance sees it.
  [[nodiscard]] bool find_contact(const PlacedPath<Scalar>& path, PlacedCandidate<Scalar>& candidate) const;

  /// Does the same with a path that it places carefully.
  [[nodiscard]] bool find_certain(PlacedCandidate<Scalar>& candidate) const;

  /// Returns true if x comes before y: by the exact t, then by the instance, then by the triangle.
  [[nodiscard]] bool comes_before(const PlacedCandidate<Scalar>& x, const PlacedCandidate<Scalar>& y) const;

  /// Sorts the candidates by `comes_before`, and keeps each triangle of an instance once.
  void sort(std::vector<PlacedCandidate<Scalar>>& found) const;

  /// Returns the contact as it is reported. `generation` is that of the instance.
  [[nodiscard]] SceneHit<Scalar> hit(const PlacedCandidate<Scalar>& candidate, std::uint32_t generation) const;

 private:
  [[nodiscard]] PlacedTriangle<Scalar> placed(const PlacedCandidate<Scalar>& candidate) const {
    return {candidate.local, candidate.placed->placement, path_.share};
  }
  [[nodiscard]] bool find_exactly(PlacedCandidate<Scalar>& candidate) const;
  [[nodiscard]] bool exactly_before(const PlacedCandidate<Scalar>& x, const PlacedCandidate<Scalar>& y) const;
  void round_exactly(const PlacedCandidate<Scalar>& candidate, Hit<Scalar>& hit) const;

  const ScenePath<Scalar>& path_;
  const SceneQueryOptions<Scalar>& options_;
  QueryStatistics& statistics_;
};

}  // namespace surehit::detail
