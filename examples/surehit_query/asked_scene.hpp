#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <surehit/scene.hpp>
#include <vector>

#include "surehit_query/asked_mesh.hpp"
#include "surehit_query/query_request.hpp"
#include "surehit_query/read_scene.hpp"

namespace surehit::example {

/// The scene that a request asks. Has the interface of `AskedMesh`.
///
/// The number of an instance is its place among the lines that place a mesh, from 0. Each mesh file is read once, and
/// the instances share it.
template <typename Scalar>
class AskedScene {
 public:
  using Target = Scene<Scalar>;
  using Answer = SceneHit<Scalar>;
  using Options = SceneQueryOptions<Scalar>;
  using ShapeAnswer = SceneShapeHit<Scalar>;
  using ShapeOptions = SceneShapeQueryOptions<Scalar>;

  /// Reads it, and says the warnings of its meshes. Throws InputError.
  explicit AskedScene(const QueryRequest& request);

  [[nodiscard]] const Scene<Scalar>& target() const { return scene_; }
  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] std::string id_columns() const { return "instance," + id_column_; }
  [[nodiscard]] static const char* no_ids() { return "-1,-1"; }
  void append_ids(const auto& hit, std::string& text) const { append_ids(hit.instance, hit.triangle, text); }
  [[nodiscard]] Vector3<Scalar> normal(const Answer& hit) const { return scene_.normal(hit.instance, hit.triangle); }
  [[nodiscard]] std::vector<std::uint8_t> ties(const Path<Scalar>& path, const std::vector<Answer>& hits) const;

 private:
  using SharedMesh = std::shared_ptr<const ReadCollider<Scalar>>;

  /// An instance, by its number.
  struct Placed {
    InstanceId id;
    SharedMesh mesh;
  };

  /// Returns the mesh of an instance. Reads it if no instance before has it.
  SharedMesh mesh_of(const PlacedMesh<Scalar>& placed, const QueryRequest& request);
  void add(const PlacedMesh<Scalar>& placed, const QueryRequest& request);
  [[nodiscard]] Options options_of(const QueryRequest& request) const;
  [[nodiscard]] const Placed& placed_of(InstanceId instance) const;
  void append_ids(InstanceId instance, std::uint32_t triangle, std::string& text) const;
  /// See `exact_ties`.
  [[nodiscard]] std::vector<std::uint32_t> turned_order(const Path<Scalar>& path, std::span<const Answer> hits) const;

  std::string id_column_;
  std::map<std::string, SharedMesh> meshes_;  ///< by the path of the file
  std::vector<Placed> instances_;
  Scene<Scalar> scene_;  ///< `user_data` is the number of the instance
  Options options_;
};

}  // namespace surehit::example
