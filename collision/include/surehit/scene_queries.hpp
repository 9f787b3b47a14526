#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "surehit/attributes.hpp"
#include "surehit/box.hpp"
#include "surehit/path.hpp"
#include "surehit/path_span.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/scene_hit.hpp"
#include "surehit/scene_query_options.hpp"
#include "surehit/scene_shape_hit.hpp"
#include "surehit/scene_shape_options.hpp"
#include "surehit/swept_shape.hpp"

namespace surehit {

namespace detail {
/// What a commit leaves for queries.
template <FloatOrDouble Scalar>
struct CommittedScene;

/// A share of a committed scene, or of nothing. Whoever gives up the last share frees it. Different shares may be
/// copied and given up in different threads at the same time.
template <FloatOrDouble Scalar>
class SUREHIT_API CommittedShare {
 public:
  /// Has a share of nothing.
  CommittedShare() noexcept = default;
  /// Takes over the share that a new committed scene begins with.
  explicit CommittedShare(CommittedScene<Scalar>* made) noexcept : shared_(made) {}
  /// Shares what the other one shares.
  CommittedShare(const CommittedShare& other) noexcept;
  /// Takes over the other one's share.
  CommittedShare(CommittedShare&& other) noexcept : shared_(std::exchange(other.shared_, nullptr)) {}
  /// Gives up the share.
  ~CommittedShare();
  /// Gives up what it has, and takes over the other one's share.
  CommittedShare& operator=(CommittedShare other) noexcept {
    std::swap(shared_, other.shared_);
    return *this;
  }
  /// Returns what is shared, or null.
  [[nodiscard]] CommittedScene<Scalar>* get() const noexcept { return shared_; }

 private:
  CommittedScene<Scalar>* shared_ = nullptr;
};

extern template class SUREHIT_API CommittedShare<float>;
extern template class SUREHIT_API CommittedShare<double>;
}  // namespace detail

/// The queries that scenes and their snapshots answer. All but `all_hits` are noexcept and allocate nothing. They may
/// run in many threads at the same time.
///
/// In an optimized build, queries and batches of paths use less than 64 KiB of stack.
template <FloatOrDouble Scalar>
class SUREHIT_API SceneQueries {
 public:
  /// Returns a box around all committed instances, and around their ways during the step. It holds the images of their
  /// meshes' boxes, so it may be larger than needed for turned instances. It is empty if there are no triangles.
  [[nodiscard]] Box<Scalar> box() const noexcept;

  /// Returns the hit with the lowest exact t, or nothing if the path misses.
  ///
  /// Adds its work to `statistics`, unless this is null.
  [[nodiscard]] std::optional<SceneHit<Scalar>> first_hit(const Path<Scalar>& path,
                                                          const SceneQueryOptions<Scalar>& options = {},
                                                          QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns the first hit among those that the filter accepts.
  [[nodiscard]] std::optional<SceneHit<Scalar>> first_hit(const Path<Scalar>& path, SceneHitFilter<Scalar> filter,
                                                          const SceneQueryOptions<Scalar>& options = {},
                                                          QueryStatistics* statistics = nullptr) const noexcept;

  /// Returns true if the path meets any triangle.
  [[nodiscard]] bool any_hit(const Path<Scalar>& path, const SceneQueryOptions<Scalar>& options = {},
                             QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns true if the filter accepts any hit of the path.
  [[nodiscard]] bool any_hit(const Path<Scalar>& path, SceneHitFilter<Scalar> filter,
                             const SceneQueryOptions<Scalar>& options = {},
                             QueryStatistics* statistics = nullptr) const noexcept;

  /// Sets `hits` to one hit for each placed triangle that the path meets, in order. May throw std::bad_alloc, see
  /// `Collider::all_hits`.
  void all_hits(const Path<Scalar>& path, std::vector<SceneHit<Scalar>>& hits,
                const SceneQueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const;
  /// Sets `hits` to all hits that the filter accepts, in the same order.
  void all_hits(const Path<Scalar>& path, std::vector<SceneHit<Scalar>>& hits, SceneHitFilter<Scalar> filter,
                const SceneQueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const;

  /// Sets `hits[i]` to the first hit of path i, with the same bits as `first_hit`. A miss is a default hit. Lengths are
  /// as in `Collider::first_hits`.
  void first_hits(const PathSpan<Scalar>& paths, std::span<SceneHit<Scalar>> hits,
                  const SceneBatchOptions<Scalar>& options = {}) const noexcept;
  /// Sets `blocked[i]` to 1 if path i has a hit, and to 0 otherwise.
  void any_hits(const PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked,
                const SceneBatchOptions<Scalar>& options = {}) const noexcept;

  /// Returns where a point that moves along the segment may stop, in front of the hit, see `Collider::last_free_point`.
  /// A moving instance goes the same share of its way: it moves by s times its motion while the point moves to s.
  ///
  /// Sets `share` to this s, unless `share` is null. It is the parameter of the point before it is rounded, and 0 if no
  /// candidate passes.
  [[nodiscard]] Vector3<Scalar> last_free_point(const Segment<Scalar>& segment, const SceneHit<Scalar>& hit,
                                                const SceneQueryOptions<Scalar>& options = {},
                                                Scalar* share = nullptr) const noexcept;
  /// Returns the same for the hits that the filter accepts.
  [[nodiscard]] Vector3<Scalar> last_free_point(const Segment<Scalar>& segment, const SceneHit<Scalar>& hit,
                                                SceneHitFilter<Scalar> filter,
                                                const SceneQueryOptions<Scalar>& options = {},
                                                Scalar* share = nullptr) const noexcept;

  // Shapes that move. Distances are those of the scene, whatever the poses are. While a shape moves, instances with a
  // motion move too. Order, ids and options are those of paths. In an optimized build, a query or a batch uses less
  // than 64 KiB of stack in float, and less than 320 KiB in double.

  /// Returns the hit with the lowest exact t, or nothing if the shape touches nothing.
  ///
  /// Adds its work to `statistics`, unless this is null.
  [[nodiscard]] std::optional<SceneShapeHit<Scalar>> first_hit(const SweptShape<Scalar>& shape,
                                                               const SceneShapeQueryOptions<Scalar>& options = {},
                                                               QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns the first hit among those that the filter accepts.
  [[nodiscard]] std::optional<SceneShapeHit<Scalar>> first_hit(const SweptShape<Scalar>& shape,
                                                               SceneShapeHitFilter<Scalar> filter,
                                                               const SceneShapeQueryOptions<Scalar>& options = {},
                                                               QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns true if the shape touches any triangle.
  [[nodiscard]] bool any_hit(const SweptShape<Scalar>& shape, const SceneShapeQueryOptions<Scalar>& options = {},
                             QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns true if the filter accepts any hit of the shape.
  [[nodiscard]] bool any_hit(const SweptShape<Scalar>& shape, SceneShapeHitFilter<Scalar> filter,
                             const SceneShapeQueryOptions<Scalar>& options = {},
                             QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns true if the shape touches any triangle at its start, see `Collider::overlaps`.
  [[nodiscard]] bool overlaps(const SweptShape<Scalar>& shape, const SceneShapeQueryOptions<Scalar>& options = {},
                              QueryStatistics* statistics = nullptr) const noexcept;
  /// Returns true if the filter accepts any contact at the start.
  [[nodiscard]] bool overlaps(const SweptShape<Scalar>& shape, SceneShapeHitFilter<Scalar> filter,
                              const SceneShapeQueryOptions<Scalar>& options = {},
                              QueryStatistics* statistics = nullptr) const noexcept;
  /// Sets `hits` to one hit for each placed triangle that the shape touches, in order. May throw std::bad_alloc.
  void all_hits(const SweptShape<Scalar>& shape, std::vector<SceneShapeHit<Scalar>>& hits,
                const SceneShapeQueryOptions<Scalar>& options = {}, QueryStatistics* statistics = nullptr) const;
  /// Sets `hits` to all hits that the filter accepts, in the same order.
  void all_hits(const SweptShape<Scalar>& shape, std::vector<SceneShapeHit<Scalar>>& hits,
                SceneShapeHitFilter<Scalar> filter, const SceneShapeQueryOptions<Scalar>& options = {},
                QueryStatistics* statistics = nullptr) const;
  /// Sets `hits[i]` to the first hit of shape i. A miss is a default hit. Lengths are as in `Collider::first_hits`.
  void first_hits(const SweptShapeSpan<Scalar>& shapes, std::span<SceneShapeHit<Scalar>> hits,
                  const SceneShapeBatchOptions<Scalar>& options = {}) const noexcept;
  /// Sets `blocked[i]` to 1 if shape i has a hit, and to 0 otherwise.
  void any_hits(const SweptShapeSpan<Scalar>& shapes, std::span<std::uint8_t> blocked,
                const SceneShapeBatchOptions<Scalar>& options = {}) const noexcept;
  /// Returns the max t at which the shape has not touched the triangle of a hit, see `Collider::last_free_t`. If
  /// the instance moves, it is then at its pose plus t times its motion. `hit` must be one of the shape's hits in this
  /// scene. The result is 0 if its instance is not committed.
  [[nodiscard]] Scalar last_free_t(const SweptShape<Scalar>& shape, const SceneShapeHit<Scalar>& hit) const noexcept;
  /// Returns where the centre of the shape may stop, in front of the hit, see `Collider::last_free_point`. A moving
  /// instance goes the same share of its way, which is in `share` as it is for segments.
  [[nodiscard]] Vector3<Scalar> last_free_point(const SweptShape<Scalar>& shape, const SceneShapeHit<Scalar>& hit,
                                                const SceneShapeQueryOptions<Scalar>& options = {},
                                                Scalar* share = nullptr) const noexcept;
  /// Returns the same for the hits that the filter accepts.
  [[nodiscard]] Vector3<Scalar> last_free_point(const SweptShape<Scalar>& shape, const SceneShapeHit<Scalar>& hit,
                                                SceneShapeHitFilter<Scalar> filter,
                                                const SceneShapeQueryOptions<Scalar>& options = {},
                                                Scalar* share = nullptr) const noexcept;

  /// Returns the touched point of a hit, where the instance is at `hit.t`. This is M (a + u (b - a) + v (c - a)) + m +
  /// t d. The corners a, b and c are those of the mesh, M and m are the pose, and d is the motion.
  ///
  /// Each coordinate is the exact one for the t, u and v of the hit, rounded once to nearest. They are rounded too, so
  /// each adds at most half an ulp of 1: u and v times a placed edge, and t times the motion.
  ///
  /// `hit` must be one of the hits in this scene. The result is zero if its instance is not committed. Allocates
  /// nothing.
  [[nodiscard]] Vector3<Scalar> contact_point(const SceneShapeHit<Scalar>& hit) const noexcept;
  /// Returns the unit normal of the contact of a shape with the triangle of a hit, see `surehit::contact_normal`. It is
  /// that of the exact image, before any corner is rounded, and its error is the same. If the instance moves, steps are
  /// as the instance sees them: that of the shape less the motion.
  ///
  /// `hit` must be one of the shape's hits in this scene. Only its ids are used. The result is zero if its instance is
  /// not committed. Decides the pair again, which takes some ten microseconds. Allocates nothing.
  [[nodiscard]] Vector3<Scalar> contact_normal(const SweptShape<Scalar>& shape,
                                               const SceneShapeHit<Scalar>& hit) const noexcept;

 protected:
  /// Answers as an empty scene does.
  SceneQueries() noexcept = default;
  /// Answers as this committed scene does.
  explicit SceneQueries(const detail::CommittedShare<Scalar>& committed) noexcept : committed_(committed) {}
  SceneQueries(const SceneQueries&) noexcept = default;             ///< Is for those who derive from it.
  SceneQueries(SceneQueries&&) noexcept = default;                  ///< Is for those who derive from it.
  SceneQueries& operator=(const SceneQueries&) noexcept = default;  ///< Is for those who derive from it.
  SceneQueries& operator=(SceneQueries&&) noexcept = default;       ///< Is for those who derive from it.
  ~SceneQueries() = default;                                        ///< Is for those who derive from it.

  /// Returns what queries see, which may be an empty scene.
  [[nodiscard]] const detail::CommittedScene<Scalar>& committed() const noexcept;

  detail::CommittedShare<Scalar> committed_;  ///< It is null if nothing was ever committed.

 private:
  friend struct detail::CommittedScene<Scalar>;
};

extern template class SUREHIT_API SceneQueries<float>;
extern template class SUREHIT_API SceneQueries<double>;

}  // namespace surehit
