#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surehit/box.hpp"
#include "surehit/executor.hpp"
#include "surehit/grid_options.hpp"
#include "surehit/hit.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/triangle_mesh_view.hpp"
#include "surehit/vertex_view.hpp"

namespace surehit {

namespace detail {
template <typename Scalar>
struct ColliderState;
template <typename Scalar>
struct DeleteColliderState {
  void operator()(ColliderState<Scalar>* state) const noexcept;
};
}  // namespace detail

/// How a collider is built. No setting changes an answer.
struct BuildOptions {
  GridOptions grid = {};
  /// One 32-bit mask a triangle, for `QueryOptions::mask`; none at all means all bits set for every triangle.
  std::span<const std::uint32_t> masks = {};
};

/// A triangle mesh made ready to be asked where paths first meet it.
///
/// Answers are those of exact real arithmetic on the numbers given, for every finite input; t, u and v are rounded
/// once. They depend on the input alone: not on the grid, the instruction set, the floating-point mode of the caller,
/// the batch or the thread. A path with a NaN or an infinity misses everything.
///
/// Queries are const, noexcept, allocate nothing (`all_hits` aside), use under 16 KiB of stack in an optimized build,
/// batches of floats under 32 KiB, and may run in many threads at once. No query may run during a rebuild. A collider
/// copies what it needs of the mesh; copying a collider copies all of it.
///
/// What is not promised: that `point(path, hit)` lies on the triangle (t is rounded), and that a collider is the same
/// bytes from one version to the next.
template <typename Scalar>
class Collider {
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
    if (auto invalid = try_build(mesh, options)) throw *std::move(invalid);
  }
  Collider(const TriangleMeshView<Scalar>& mesh, Executor executor, const BuildOptions& options = {}) {
    if (auto invalid = try_build(mesh, executor, options)) throw *std::move(invalid);
  }
#endif

  /// Replaces the mesh, or says why it cannot and keeps the state from before. Time and memory are linear in the
  /// triangles.
  [[nodiscard]] std::optional<InvalidMesh> try_build(const TriangleMeshView<Scalar>& mesh,
                                                     const BuildOptions& options = {}) {
    return build(mesh, nullptr, options);
  }
  /// The same by an executor's tasks. What is built is the same to the bit.
  [[nodiscard]] std::optional<InvalidMesh> try_build(const TriangleMeshView<Scalar>& mesh, Executor executor,
                                                     const BuildOptions& options = {}) {
    return build(mesh, &executor, options);
  }

#if defined(__cpp_exceptions)
  /// Throws what `try_rebuild` returns.
  void rebuild(const VertexView<Scalar>& vertices) {
    if (auto invalid = try_rebuild(vertices)) throw *std::move(invalid);
  }
  void rebuild(const VertexView<Scalar>& vertices, Executor executor) {
    if (auto invalid = try_rebuild(vertices, executor)) throw *std::move(invalid);
  }
#endif

  /// Moves the vertices, for a mesh that deforms each tick: the same triangles, masks and options. Takes the time of a
  /// build, but no memory after the first two times. In a smooth mesh paths then take up to 1.7 times as long as in a
  /// collider that is built anew, which is prepared for more of them. Says why it cannot, and keeps the state from
  /// before, if the vertices are not as many as the mesh has or not finite; so does std::bad_alloc.
  [[nodiscard]] std::optional<InvalidMesh> try_rebuild(const VertexView<Scalar>& vertices) {
    return move_vertices(vertices, nullptr);
  }
  [[nodiscard]] std::optional<InvalidMesh> try_rebuild(const VertexView<Scalar>& vertices, Executor executor) {
    return move_vertices(vertices, &executor);
  }

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

  /// `hits[i]` becomes the first hit of path i; a miss has `triangle == no_triangle`. Both spans have the same length;
  /// where they do not, the paths and places beyond the shorter one are left alone. The same bits as the single calls
  /// give.
  void first_hits(std::span<const Segment<Scalar>> segments, std::span<Hit<Scalar>> hits,
                  const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;
  void first_hits(std::span<const Ray<Scalar>> rays, std::span<Hit<Scalar>> hits,
                  const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;
  void first_hits(std::span<const Line<Scalar>> lines, std::span<Hit<Scalar>> hits,
                  const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;

  /// The same, spread over the executor's threads in tasks of some thousand paths.
  void first_hits(std::span<const Segment<Scalar>> segments, std::span<Hit<Scalar>> hits, Executor executor,
                  const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;
  void first_hits(std::span<const Ray<Scalar>> rays, std::span<Hit<Scalar>> hits, Executor executor,
                  const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;
  void first_hits(std::span<const Line<Scalar>> lines, std::span<Hit<Scalar>> hits, Executor executor,
                  const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;

  /// `blocked[i]` becomes 1 if path i meets anything, else 0. Lengths as in `first_hits`.
  void any_hits(std::span<const Segment<Scalar>> segments, std::span<std::uint8_t> blocked,
                const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;
  void any_hits(std::span<const Ray<Scalar>> rays, std::span<std::uint8_t> blocked,
                const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;
  void any_hits(std::span<const Line<Scalar>> lines, std::span<std::uint8_t> blocked,
                const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;

  void any_hits(std::span<const Segment<Scalar>> segments, std::span<std::uint8_t> blocked, Executor executor,
                const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;
  void any_hits(std::span<const Ray<Scalar>> rays, std::span<std::uint8_t> blocked, Executor executor,
                const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;
  void any_hits(std::span<const Line<Scalar>> lines, std::span<std::uint8_t> blocked, Executor executor,
                const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const noexcept;

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

  [[nodiscard]] std::size_t triangle_count() const noexcept;
  /// The corners as they were given.
  [[nodiscard]] Triangle<Scalar> triangle(std::uint32_t id) const noexcept;
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
  std::optional<InvalidMesh> build(const TriangleMeshView<Scalar>&, const Executor*, const BuildOptions&);
  std::optional<InvalidMesh> move_vertices(const VertexView<Scalar>&, const Executor*);

  using StatePointer = std::unique_ptr<detail::ColliderState<Scalar>, detail::DeleteColliderState<Scalar>>;
  StatePointer state_;  ///< none before a build, and where it was moved from
};

using Colliderf = Collider<float>;
using Colliderd = Collider<double>;

}  // namespace surehit
