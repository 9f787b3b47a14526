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
#include "surehit/byte_sink.hpp"
#include "surehit/executor.hpp"
#include "surehit/grid_options.hpp"
#include "surehit/hit.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/load_result.hpp"
#include "surehit/path.hpp"
#include "surehit/path_span.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/shape_options.hpp"
#include "surehit/swept_shape.hpp"
#include "surehit/triangle_mesh_view.hpp"
#include "surehit/vertex_view.hpp"

namespace surehit {

namespace detail {
/// What a collider holds behind its pointer.
template <FloatOrDouble Scalar>
struct ColliderState;
/// Deletes it where its type is complete.
template <FloatOrDouble Scalar>
struct SUREHIT_API DeleteColliderState {
  /// Deletes the state, or does nothing if it is null.
  void operator()(ColliderState<Scalar>* state) const noexcept;
};
}  // namespace detail

/// How a collider is built. Only `masks` can change an answer.
struct BuildOptions {
  /// How finely the grid divides the mesh's box. A rebuild with moved vertices uses it again.
  GridOptions grid = {};
  /// One mask for each triangle, for `QueryOptions::mask`. If it is empty, all triangles have all bits. A triangle with
  /// mask 0 is never hit. The masks are copied.
  std::span<const std::uint32_t> masks = {};
  /// Spreads the build over threads. The collider has the same bits as without it. It is not used after the build.
  std::optional<Executor> executor = {};
};

/// A triangle mesh that answers where paths first meet it.
///
/// The answers are those of exact real arithmetic on the given numbers, for every finite input. t, u and v are rounded
/// once. The answers depend on the input alone. The grid, the instruction set, the batch, the thread and the caller's
/// floating-point mode do not change them. A path with a NaN or an infinity hits nothing.
///
/// Queries are const and may run in many threads at the same time. All except `all_hits` are noexcept and allocate
/// nothing. In an optimized build, a query uses less than 24 KiB of stack. A batch uses less than 48 KiB in float and
/// 64 KiB in double. No query may run while the collider changes.
///
/// A query walks through the cells of a grid along its path, and tests the triangles that they list. A path that starts
/// farther from the mesh than 2^60 times its size is tested against all triangles. `QueryStatistics::unclipped` counts
/// such paths.
///
/// A collider copies what it needs of a mesh. The mesh's arrays may change after the build.
///
/// It is not promised that `point(path, hit)` is on the triangle, because t is rounded. It is not promised that a
/// collider has the same bytes in another version.
template <FloatOrDouble Scalar>
class SUREHIT_API Collider {
 public:
  /// Makes a collider without triangles. Every query misses. Allocates nothing.
  Collider() noexcept = default;
  /// Frees all memory. No query may run.
  ~Collider() = default;
  /// Copies all of a collider. Takes time and memory linear in its memory. May throw std::bad_alloc.
  Collider(const Collider& other);
  /// Copies all of a collider, as the copy constructor does. If it throws std::bad_alloc, this collider is as before.
  Collider& operator=(const Collider& other);
  /// Takes over the other collider's mesh, in constant time. The other collider then has no triangles.
  Collider(Collider&& other) noexcept = default;
  /// Frees what this collider has, and takes over the other one's mesh. The other collider then has no triangles.
  Collider& operator=(Collider&& other) noexcept = default;

#if defined(__cpp_exceptions)
  /// Builds a collider of a mesh, see `try_build`. Throws the InvalidMesh that `try_build` would return. May throw
  /// std::bad_alloc. Without exceptions there is no such constructor.
  explicit Collider(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options = {}) {
    if (const BuildResult built = try_build(mesh, options); !built) throw built.error();
  }
  /// Moves the vertices as `try_rebuild` does. Throws the InvalidMesh that it would return.
  void rebuild(const VertexView<Scalar>& vertices, const std::optional<Executor>& executor = {}) {
    if (const BuildResult built = try_rebuild(vertices, executor); !built) throw built.error();
  }
  /// Replaces the mesh as `try_rebuild` does. Throws the InvalidMesh that it would return.
  void rebuild(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options = {}) {
    if (const BuildResult built = try_rebuild(mesh, options); !built) throw built.error();
  }
#endif

  /// Replaces the mesh, the masks and the options.
  ///
  /// Fails if `find_invalid` finds something in the mesh, or if there are masks but not one for each triangle. May
  /// throw std::bad_alloc. After any failure, the collider is as before. Takes time and memory linear in the triangles
  /// and vertices. Uses the old memory and the new memory at the same time.
  BuildResult try_build(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options = {});

  /// Replaces the mesh, the masks and the options, for a mesh whose triangles change often. The result is that of
  /// `try_build`, and it fails as `try_build` does.
  ///
  /// It reuses the memory of the builds before. The first rebuild allocates as much as a build. From then on, the
  /// collider keeps the memory of two meshes.
  BuildResult try_rebuild(const TriangleMeshView<Scalar>& mesh, const BuildOptions& options = {});

  /// Moves the vertices, for a mesh that deforms each tick. Triangles, masks and options stay. The executor spreads the
  /// work over threads, and the result is the same.
  ///
  /// Fails unless there are as many vertices as before, in a valid view, and all are finite. May throw std::bad_alloc.
  /// After any failure, the collider is as before.
  ///
  /// Takes about as long as a build. The first two rebuilds may allocate, and the collider then keeps the memory of two
  /// meshes. Later ones allocate only if the grid, or the work on it, needs more memory than before.
  ///
  /// It does not prepare a smooth mesh as a build does, so queries of one may take longer.
  BuildResult try_rebuild(const VertexView<Scalar>& vertices, const std::optional<Executor>& executor = {});

  /// Sets the mask of one triangle, such as a door that opens. `triangle` must be below `triangle_count()`. No query
  /// may run at the same time.
  ///
  /// Takes constant time, except for the first time after a build without masks. Then it allocates the masks, and may
  /// throw std::bad_alloc.
  void set_mask(std::uint32_t triangle, std::uint32_t mask);
  /// Sets the masks of all triangles. They are copied. No masks means that all triangles have all bits. No query may
  /// run at the same time.
  ///
  /// Fails, and changes nothing, if there are masks but not one for each triangle. May throw std::bad_alloc. Takes
  /// linear time.
  BuildResult try_set_masks(std::span<const std::uint32_t> masks);
  /// Returns the mask of a triangle. `triangle` must be below `triangle_count()`.
  [[nodiscard]] std::uint32_t mask(std::uint32_t triangle) const noexcept;

  /// Writes the mesh, the masks, the options and the grid to a sink. `collision/FORMAT.md` describes each byte.
  ///
  /// The bytes are the same on every platform, instruction set and number of threads, and after a rebuild as after a
  /// build. Returns false if the sink did not take all of them. Allocates nothing, and throws what the sink throws.
  [[nodiscard]] bool save(const ByteSink& sink) const;
  /// Becomes the collider that was saved in these bytes. The answers have the same bits.
  ///
  /// The bytes may come from anyone. Whatever they are, the result is an error that says where the fault is, or a
  /// collider whose answers are those of its mesh. For this, all cells of all triangles are found anew, so a load takes
  /// about as long as a build. `LoadOptions::is_trusted` leaves this out.
  ///
  /// Fails for anything that `save` does not write. May throw std::bad_alloc. After any failure, the collider is as
  /// before. Takes time and memory linear in the bytes. The bytes may change after the load.
  LoadResult try_load(std::span<const std::byte> bytes, const LoadOptions& options = {});
#if defined(__cpp_exceptions)
  /// Returns the collider that was saved in these bytes, as `try_load` reads it. Throws the InvalidFile that it would
  /// return.
  [[nodiscard]] static Collider load(std::span<const std::byte> bytes, const LoadOptions& options = {}) {
    Collider collider;
    if (const LoadResult loaded = collider.try_load(bytes, options); !loaded) throw loaded.error();
    return collider;
  }
#endif

  /// Returns the hit with the lowest exact t, or nothing if the path misses. Among hits with equal exact t, it returns
  /// the one with the lowest triangle id.
  ///
  /// Adds its work to `statistics`, unless this is null.
  [[nodiscard]] std::optional<Hit<Scalar>> first_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options = {},
                                                     QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns the first hit among those that the filter accepts.
  [[nodiscard]] std::optional<Hit<Scalar>> first_hit(const Path<Scalar>& path, HitFilter<Scalar> filter,
                                                     const QueryOptions<Scalar>& options = {},
                                                     QueryStatistics* statistics = nullptr) const noexcept;

  /// Returns true if the path meets any triangle, such as a blocked line of sight. Cheaper than `first_hit`.
  [[nodiscard]] bool any_hit(const Path<Scalar>& path, const QueryOptions<Scalar>& options = {},
                             QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns true if the filter accepts any hit of the path.
  [[nodiscard]] bool any_hit(const Path<Scalar>& path, HitFilter<Scalar> filter,
                             const QueryOptions<Scalar>& options = {},
                             QueryStatistics* statistics = nullptr) const noexcept;

  /// Sets `hits` to one hit for each triangle that the path meets, in the order of exact t, and then of triangle ids.
  ///
  /// It clears `hits` first and keeps its capacity. It allocates temporary memory for what it finds, and room in `hits`
  /// if there is too little. May throw std::bad_alloc. The contents of `hits` are then not specified.
  void all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits, const QueryOptions<Scalar>& options = {},
                QueryStatistics* statistics = nullptr) const;
  /// Sets `hits` to all hits that the filter accepts, in the same order.
  void all_hits(const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits, HitFilter<Scalar> filter,
                const QueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const;

  /// Sets `hits[i]` to the first hit of path i, with the same bits as `first_hit`. A miss has `no_triangle` as its
  /// triangle.
  ///
  /// There should be as many hits as paths, and as many `path_options` or none. Otherwise the batch ends with the
  /// shortest of them, and does not change the hits after it. The hits must not overlap the paths in memory.
  ///
  /// A batch of some dozen paths or more is much faster than single calls. It allocates nothing itself. An executor
  /// may.
  void first_hits(const PathSpan<Scalar>& paths, std::span<Hit<Scalar>> hits,
                  const BatchOptions<Scalar>& options = {}) const noexcept;

  /// Sets `blocked[i]` to 1 if path i has a hit, and to 0 otherwise. It gives the same answers as `any_hit`. Lengths
  /// and cost are as in `first_hits`.
  void any_hits(const PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked,
                const BatchOptions<Scalar>& options = {}) const noexcept;

  /// Returns where a point that moves along the segment may stop, in front of the hit. The way from the start to it
  /// has no hit under these options, so a step that ends there never tunnels. `hit` must be the segment's first hit
  /// under the same options.
  ///
  /// The candidates are round(start + s (end - start)) with s = t - 2^k ulp(t), for k = 0, 1, and so on, while s > 0.
  /// Here ulp(t) is the gap from t to the next greater Scalar. The result is the first candidate that passes an exact
  /// query under the same options: the segment from the start to it has no hit. If no candidate passes, the result is
  /// the start, which may itself touch a triangle. It is also the start if t or the segment is not finite, or if t is
  /// above 1.
  ///
  /// The limits keep their positions on the whole segment. On the shorter one, a positive min_t becomes the Scalar next
  /// below fl(min_t / s). max_t is not before the hit, so it admits all of the shorter segment. `ignore_end_contact` is
  /// about the shorter segment's end. With it, the point may stop exactly on a surface.
  ///
  /// Takes at most 24 queries for any hit in float, and 53 in double. Allocates nothing.
  [[nodiscard]] Vector3<Scalar> last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                const QueryOptions<Scalar>& options = {}) const noexcept;
  /// Returns the same for the hits that the filter accepts. The filter is given hits of the shorter segments, and their
  /// t counts on these.
  [[nodiscard]] Vector3<Scalar> last_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit,
                                                HitFilter<Scalar> filter,
                                                const QueryOptions<Scalar>& options = {}) const noexcept;

  /// Returns the limit that keeps a hit: the smallest Scalar that is not below its exact t. `max_t = hit.t` would lose
  /// the hit in half of all cases, because t was rounded down there.
  ///
  /// `hit` must be one of the path's hits in this collider. Decides one pair of a path and a triangle, and allocates
  /// nothing.
  [[nodiscard]] Scalar max_t_keeping(const Path<Scalar>& path, const Hit<Scalar>& hit) const noexcept;

  // Moving shapes. Their hits are exact too. They take more time than those of points. In an optimized build, they use
  // less than 48 KiB of stack in float and 256 KiB in double.

  /// Returns the hit of a moving shape with the lowest exact t, and then with the lowest triangle id. Returns nothing
  /// if the shape touches no triangle. Adds its work to `statistics`, unless this is null.
  ///
  /// Goes through the cells that the box around the shape comes to. If the step or the box is more than 2^300 cells
  /// long, the shape is tested against all triangles. Allocates nothing.
  [[nodiscard]] std::optional<ShapeHit<Scalar>> first_hit(const SweptShape<Scalar>& shape,
                                                          const ShapeQueryOptions<Scalar>& options = {},
                                                          QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns the first hit among those that the filter accepts.
  [[nodiscard]] std::optional<ShapeHit<Scalar>> first_hit(const SweptShape<Scalar>& shape,
                                                          ShapeHitFilter<Scalar> filter,
                                                          const ShapeQueryOptions<Scalar>& options = {},
                                                          QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns true if the shape touches any triangle. Cheaper than `first_hit`.
  [[nodiscard]] bool any_hit(const SweptShape<Scalar>& shape, const ShapeQueryOptions<Scalar>& options = {},
                             QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns true if the filter accepts any hit of the shape.
  [[nodiscard]] bool any_hit(const SweptShape<Scalar>& shape, ShapeHitFilter<Scalar> filter,
                             const ShapeQueryOptions<Scalar>& options = {},
                             QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns true if the shape touches any triangle at its start. Its end plays no part, and neither do `max_t`,
  /// `culling` and `ignore_start_contact`. To learn which triangles, ask for `all_hits` with a `max_t` of 0.
  [[nodiscard]] bool overlaps(const SweptShape<Scalar>& shape, const ShapeQueryOptions<Scalar>& options = {},
                              QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns true if the filter accepts any contact at the start. It is given the hits of the shape at rest.
  [[nodiscard]] bool overlaps(const SweptShape<Scalar>& shape, ShapeHitFilter<Scalar> filter,
                              const ShapeQueryOptions<Scalar>& options = {},
                              QueryStatistics* statistics = nullptr) const noexcept;
  /// Sets `hits` to one hit for each triangle that the shape touches, in the order of exact t, and then of triangle
  /// ids. Memory is as for the `all_hits` of paths.
  void all_hits(const SweptShape<Scalar>& shape, std::vector<ShapeHit<Scalar>>& hits,
                const ShapeQueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const;
  /// Sets `hits` to all hits that the filter accepts, in the same order.
  void all_hits(const SweptShape<Scalar>& shape, std::vector<ShapeHit<Scalar>>& hits, ShapeHitFilter<Scalar> filter,
                const ShapeQueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const;
  /// Sets `hits[i]` to the first hit of shape i. A miss has `no_triangle` as its triangle. Lengths are as in the
  /// `first_hits` of paths. Allocates nothing itself.
  void first_hits(const SweptShapeSpan<Scalar>& shapes, std::span<ShapeHit<Scalar>> hits,
                  const ShapeBatchOptions<Scalar>& options = {}) const noexcept;
  /// Sets `blocked[i]` to 1 if shape i has a hit, and to 0 otherwise.
  void any_hits(const SweptShapeSpan<Scalar>& shapes, std::span<std::uint8_t> blocked,
                const ShapeBatchOptions<Scalar>& options = {}) const noexcept;
  /// Returns the max t at which the shape has not touched the triangle of a hit: the Scalar next below the
  /// exact t. For the first hit, the shape has touched nothing until then, except what the options left out. `hit` must
  /// be one of the shape's hits in this collider. The result is 0 if they touch at the start, or if no Scalar is
  /// between 0 and t. Decides one pair of a shape and a triangle. Allocates nothing.
  [[nodiscard]] Scalar last_free_t(const SweptShape<Scalar>& shape, const ShapeHit<Scalar>& hit) const noexcept;
  /// Returns where the centre of the shape may stop, in front of the hit. The way from the start to it has no hit under
  /// these options. So the shape touches nothing there, except what `ignore_start_contact` and the other options leave
  /// out. `hit` must be the shape's first hit under the same options.
  ///
  /// The candidates are those of the `last_free_point` of a segment: round(start + s (end - start)), where s is below t
  /// and at least 2^-64. The result is the first one that passes an exact query. If none does, or if the shape touches
  /// something at its start, it is the start. It is also the start if t or a centre is not finite, or t is above 1.
  ///
  /// Takes at most 24 queries in float, and 53 in double. Allocates nothing.
  [[nodiscard]] Vector3<Scalar> last_free_point(const SweptShape<Scalar>& shape, const ShapeHit<Scalar>& hit,
                                                const ShapeQueryOptions<Scalar>& options = {}) const noexcept;
  /// Returns the same for the hits that the filter accepts. The filter is given hits of the shorter steps, and their t
  /// counts on these.
  [[nodiscard]] Vector3<Scalar> last_free_point(const SweptShape<Scalar>& shape, const ShapeHit<Scalar>& hit,
                                                ShapeHitFilter<Scalar> filter,
                                                const ShapeQueryOptions<Scalar>& options = {}) const noexcept;

  /// Returns the number of triangles.
  [[nodiscard]] std::size_t triangle_count() const noexcept;
  /// Returns the corners of a triangle as they were given. `id` must be below `triangle_count()`.
  [[nodiscard]] Triangle<Scalar> triangle(std::uint32_t id) const noexcept;
  /// Returns the unit normal of a triangle, as `surehit::normal` computes it. `id` must be below `triangle_count()`.
  [[nodiscard]] Vector3<Scalar> normal(std::uint32_t id) const noexcept;
  /// Returns the smallest box around all triangles. It is empty if there are none. The reference is valid until the
  /// collider changes.
  [[nodiscard]] const Box<Scalar>& box() const noexcept;
  /// Returns the size of the grid.
  [[nodiscard]] GridSummary grid_summary() const noexcept;
  /// Returns the memory that is allocated for the grid, the copied mesh and the masks, in bytes. After a rebuild, it
  /// includes the memory that the next rebuild will use.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  friend struct detail::ColliderState<Scalar>;

  /// Returns the state, or that of a collider without triangles.
  [[nodiscard]] const detail::ColliderState<Scalar>& state() const noexcept;

  using StatePointer = std::unique_ptr<detail::ColliderState<Scalar>, detail::DeleteColliderState<Scalar>>;
  StatePointer state_;  ///< Null before a build, and after a move from this collider.
};

extern template class SUREHIT_API Collider<float>;
extern template class SUREHIT_API Collider<double>;

using Colliderf = Collider<float>;   ///< A collider of a mesh in float.
using Colliderd = Collider<double>;  ///< A collider of a mesh in double.

}  // namespace surehit
