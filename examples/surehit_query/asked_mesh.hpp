#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <surehit/collider.hpp>
#include <vector>

#include "surehit_query/query_request.hpp"

namespace surehit::example {

/// A mesh file made ready to be asked.
template <typename Scalar>
struct ReadCollider {
  Collider<Scalar> collider;
  std::vector<std::uint32_t> ids;  ///< what the output calls each triangle; empty where that is its own id

  [[nodiscard]] std::uint32_t id_of(std::uint32_t triangle) const { return ids.empty() ? triangle : ids[triangle]; }
};

/// Reads the mesh file or the saved collider that a request names, and says its warnings. Throws InputError.
template <typename Scalar>
[[nodiscard]] ReadCollider<Scalar> read_collider(const QueryRequest& request);

/// Returns what the output calls the ids of triangles.
[[nodiscard]] inline std::string id_column(const QueryRequest& request) {
  return request.ids == IdKind::face ? "face" : "triangle";
}

/// The mesh that a request asks.
template <typename Scalar>
class AskedMesh {
 public:
  using Target = Collider<Scalar>;
  using Answer = Hit<Scalar>;
  using Options = QueryOptions<Scalar>;
  using ShapeAnswer = ShapeHit<Scalar>;
  using ShapeOptions = ShapeQueryOptions<Scalar>;

  /// Reads it. Throws InputError.
  explicit AskedMesh(const QueryRequest& request);

  [[nodiscard]] const Collider<Scalar>& target() const { return mesh_.collider; }
  [[nodiscard]] const Options& options() const { return options_; }
  /// Returns the names of the columns with ids.
  [[nodiscard]] std::string id_columns() const { return id_column_; }
  /// Returns what these columns have for a miss.
  [[nodiscard]] static const char* no_ids() { return "-1"; }
  /// Appends the ids of the hit of a path or a shape.
  void append_ids(const auto& hit, std::string& text) const { append_id(hit.triangle, text); }
  void append_id(std::uint32_t triangle, std::string& text) const;
  [[nodiscard]] Vector3<Scalar> normal(const Answer& hit) const { return mesh_.collider.normal(hit.triangle); }
  /// Returns 1 for each hit that ties. The hits are all those of the path, in order.
  [[nodiscard]] std::vector<std::uint8_t> ties(const Path<Scalar>& path, const std::vector<Answer>& hits) const;

 private:
  /// See `exact_ties`.
  [[nodiscard]] std::vector<std::uint32_t> turned_order(const Path<Scalar>& path, std::span<const Answer> hits) const;

  Options options_;
  std::string id_column_;
  ReadCollider<Scalar> mesh_;
};

}  // namespace surehit::example
