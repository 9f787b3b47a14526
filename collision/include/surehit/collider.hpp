#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surehit/attributes.hpp"
#include "surehit/batch_options.hpp"
#include "surehit/box.hpp"
#include "surehit/build_result.hpp"
#include "surehit/executor.hpp"
#include "surehit/grid_options.hpp"
#include "surehit/hit.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/path.hpp"
#include "surehit/path_span.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/triangle_mesh_view.hpp"
#include "surehit/vertex_view.hpp"

namespace surehit {

namespace detail {
template <FloatOrDouble Scalar>
struct ColliderState;
template <FloatOrDouble Scalar>
struct SUREHIT_API DeleteColliderState {
  void operator()(ColliderState<Scalar>* state) const noexcept;
};
}  // namespace detail

/// How a collider is built. No setting changes an answer.
struct BuildOptions {
  GridOptions grid = {};
  /// One mask for each triangle, for `QueryOptions::mask`. Empty: all bits are set for every triangle.
  std::span<const std::uint32_t> masks = {};
  /// Spreads the build over threads. What is built is the same to the bit.
  std::optional<Executor> executor = {};
};

/// A triangle mesh made ready to be asked where paths first meet it.
///
/// Answers are those of exact real arithmetic on the numbers given, for every finite input; t, u and v are rounded
/// once. They depend on the input alone: not on the grid, the instruction set, the floating-point mode of the caller,
/// the batch or the thread. A path with a NaN or an infinity misses everything.
///
/// Queries are const and noexcept, and may run in many threads at once. Only `all_hits` allocates. In an optimized
/// build, a query uses less than 16 KiB of stack. A batch uses less than 32 KiB in float and 48 KiB in double. No query
/// may run while the collider changes. A collider copies what it needs of the mesh. A copy of a collider copies all of
/// it.
///
/// What is not promised: that `point(path, hit)` lies on the triangle (t is rounded), and that a collider is the same
/// bytes from one version to the next.
template <FloatOrDouble Scalar>
class SUREHIT_API Collider {
 public:
  /// A mesh of no triangles: every query misses.
  Collider() noexcept = default;
  ~Collider() = default;
  /// May throw std::bad_alloc.
  Collider(const Collider& other);
  Collider& operator=(const Collider& other);
  /// What is moved from has no triangles.
  Collider(Collider&& other) noexcept = default;
  Collider& operator=(Collider&& other) noexcept = default;

#if defined(__cpp_exceptions)
  /// Throws InvalidMesh, which names the first offending element, and std::bad_alloc.
  explicit Collider(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options = {}) {
    if (const BuildResult built = try_build(mesh, options); !built) throw built.error();
  }
  /// Throws what `try_rebuild` returns.
  void rebuild(const VertexView<Scalar>& vertices, const std::optional<Executor>& executor = {}) {
    if (const BuildResult built = try_rebuild(vertices, executor); !built) throw built.error();
  }
  /// Throws what `try_rebuild` returns.
  void rebuild(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options = {}) {
    if (const BuildResult built = try_rebuild(mesh, options); !built) throw built.error();
  }
#endif

  /// Replaces the mesh. Takes time and memory linear in the triangles. After a failure, std::bad_alloc included, the
  /// collider is as before.
  BuildResult try_build(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options = {});

  /// Replaces the mesh, masks and options in the memory of the builds before: for a mesh whose triangles change often.
  /// The first time allocates as a build does, and both meshes' memory is kept from then on. Fails as `try_build` does.
  BuildResult try_rebuild(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options = {});

  /// Moves the vertices, for a mesh that deforms each tick. Triangles, masks and options stay. Costs as much as a
  /// build, but allocates nothing from the third time on. It does not prepare smooth meshes as a build does, so that
  /// queries may take longer there. Fails, and keeps the state from before, unless the vertices are finite and as many
  /// as the mesh has.
  BuildResult try_rebuild(const VertexView<Scalar>& vertices, const std::optional<Executor>& executor = {});

  /// Changes the mask of one triangle, such as a door that opens. No query may run meanwhile. The first time allocates
  /// the masks, if the mesh was built without any, and may throw std::bad_alloc.
  void set_mask(std::uint32_t triangle, std::uint32_t mask);
  /// Changes the masks of all triangles, as `BuildOptions::masks` has them. Fails unless there is one for each triangle
  /// or none at all.
  BuildResult try_set_masks(std::span<const std::uint32_t> masks);
  /// The mask of a triangle.
  [[nodiscard]] std::uint32_t mask(std::uint32_t triangle) const noexcept;

  /// The hit of least t; among equal exact t, of the least triangle. `statistics`, where given, are added to.
  [[nodiscard]] std::optional<Hit<Scalar>> first_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options = {},
                                                     QueryStatistics* statistics = nullptr) const noexcept;
  /// The same among the hits that the filter accepts.
  [[nodiscard]] std::optional<Hit<Scalar>> first_hit(const Path<Scalar>& path, HitFilter<Scalar> filter,
                                                     const QueryOptions<Scalar>& options = {},
                                                     QueryStatistics* statistics = nullptr) const noexcept;

  /// Whether the path meets any triangle at all: a line of sight is blocked. Cheaper than `first_hit`.
  [[nodiscard]] bool any_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options = {},
                             QueryStatistics* statistics = nullptr) const noexcept;
  [[nodiscard]] bool any_hit(const Path<Scalar>& path, HitFilter<Scalar> filter,
                             const QueryOptions<Scalar>& options = {},
                             QueryStatistics* statistics = nullptr) const noexcept;

  /// Every triangle that the path meets, once, in the order of `first_hit`. Clears `hits` first and keeps its capacity;
  /// may throw std::bad_alloc.
  void all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits, const QueryOptions<Scalar>& options = {},
                QueryStatistics* statistics = nullptr) const;
  void all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits, HitFilter<Scalar> filter,
                const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const;

  /// Sets `hits[i]` to the first hit of path i, to the same bits as the single call. A miss has `triangle ==
  /// no_triangle`. Paths, hits and `path_options` have the same length; what lies beyond the shortest is left alone.
  ///
  /// Much faster than single calls where there are some dozen paths or more.
  void first_hits(const PathSpan<Scalar>& paths, std::span<Hit<Scalar>> hits,
                  const BatchOptions<Scalar>& options = {}) const noexcept;

  /// Sets `blocked[i]` to 1 if path i meets anything, else to 0. Lengths are as in `first_hits`.
  void any_hits(const PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked,
                const BatchOptions<Scalar>& options = {}) const noexcept;

  /// Where a point that moves along the segment may stop so that it has touched nothing: a step that ends there never
  /// tunnels.
  ///
  /// `hit` is the segment's first hit under the same options. Tried in turn are round(start + s (end - start)) for
  /// s = t - 2^k ulp(t), k = 0, 1, … while s > 0, with ulp(t) the gap from t to the next greater Scalar; the answer is
  /// the first of them that the segment from the start reaches without touching anything, by an exact query under the
  /// same options, else the start itself. The limits keep their places on the whole segment: a positive min_t becomes
  /// the Scalar next below fl(min_t / s) on the shorter one, and max_t, which does not lie before t, admits all of it.
  /// `ignore_end_contact` speaks of the shorter segment's end: with it, the point may come to rest exactly on a
  /// surface.
  [[nodiscard]] Vector3<Scalar> last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                const QueryOptions<Scalar>& options = {}) const noexcept;
  [[nodiscard]] Vector3<Scalar> last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                HitFilter<Scalar> filter,
                                                const QueryOptions<Scalar>& options = {}) const noexcept;

  /// The limit that keeps a hit: the least Scalar that is not below its exact t. `max_t = hit.t` would lose the hit in
  /// half of all cases, where t was rounded down. `hit` is one of the path's hits in this collider.
  [[nodiscard]] Scalar max_t_keeping(const Path<Scalar>& path, const Hit<Scalar>& hit) const noexcept;

  [[nodiscard]] std::size_t triangle_count() const noexcept;
  /// The corners as they were given.
  [[nodiscard]] Triangle<Scalar> triangle(std::uint32_t id) const noexcept;
  /// The unit normal of a triangle, as `normal(triangle)` gives it.
  [[nodiscard]] Vector3<Scalar> normal(std::uint32_t id) const noexcept;
  /// Around all triangles.
  [[nodiscard]] const Box<Scalar>& box() const noexcept;
  /// What the grid came to.
  [[nodiscard]] GridSummary grid_summary() const noexcept;
  /// Of the grid, the copied mesh and the masks, as they were allocated; once rebuilt, also of what the next rebuild
  /// uses.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  friend struct detail::ColliderState<Scalar>;

  [[nodiscard]] const detail::ColliderState<Scalar>& state() const noexcept;

  using StatePointer = std::unique_ptr<detail::ColliderState<Scalar>, detail::DeleteColliderState<Scalar>>;
  StatePointer state_;  ///< none before a build, and where it was moved from
};

extern template class SUREHIT_API Collider<float>;
extern template class SUREHIT_API Collider<double>;

using Colliderf = Collider<float>;
using Colliderd = Collider<double>;

}  // namespace surehit
