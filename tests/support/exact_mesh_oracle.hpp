#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::test {

/// The answers of a whole mesh by asking the oracle about every triangle: no grid, no order but that of rationals. Call
/// it in the default floating-point environment.
template <typename Scalar>
class ExactMeshOracle {
 public:
  /// One mask a triangle, or none. Copies neither; both must outlive it.
  ExactMeshOracle(const TriangleMeshView<Scalar>& mesh, std::span<const std::uint32_t> masks)
      : mesh_(mesh), masks_(masks) {}

  [[nodiscard]] std::vector<Hit<Scalar>> all_hits(const Path<Scalar>& path, const QueryOptions<Scalar>& options) const;

  [[nodiscard]] Vector3<Scalar> last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                const QueryOptions<Scalar>& options) const;

 private:
  [[nodiscard]] bool takes_part(std::uint32_t triangle, const QueryOptions<Scalar>& options) const;

  TriangleMeshView<Scalar> mesh_;
  std::span<const std::uint32_t> masks_;
};

}  // namespace surehit::test
