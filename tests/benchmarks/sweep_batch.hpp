#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <surehit/swept_shape.hpp>
#include <vector>

#include "path_batch.hpp"
#include "path_set.hpp"

namespace surehit::benchmark {

/// What moves along a path.
enum class ShapeKind : std::uint8_t { sphere, box, capsule };

inline constexpr std::array all_shape_kinds = {ShapeKind::sphere, ShapeKind::box, ShapeKind::capsule};

[[nodiscard]] std::string name_of(ShapeKind kind);

/// Where shapes begin and end.
enum class SweepSet : std::uint8_t {
  long_sweeps,      ///< As the path set of that name.
  short_sweeps,     ///< As the path set of that name.
  near_sweeps,      ///< As the path set of that name.
  sight_sweeps,     ///< As the path set of that name.
  edge_sweeps,      ///< As the path set of that name.
  edge_end_sweeps,  ///< As the path set of that name.
  in_plane_sweeps,  ///< As the path set of that name.
  cell_sweeps,      ///< As the path set of that name.
  resting_sweeps,   ///< They are parallel to a triangle's plane, at a height of the shape's size above it.
};

inline constexpr std::array general_sweep_sets = {SweepSet::long_sweeps, SweepSet::short_sweeps, SweepSet::near_sweeps,
                                                  SweepSet::sight_sweeps};
/// Their decisions are close ones.
inline constexpr std::array close_sweep_sets = {SweepSet::edge_sweeps, SweepSet::edge_end_sweeps,
                                                SweepSet::in_plane_sweeps, SweepSet::cell_sweeps,
                                                SweepSet::resting_sweeps};

[[nodiscard]] std::string name_of(SweepSet set);
/// Returns the path set whose name chooses the sweeps. That of sweeps that rest is in_plane.
[[nodiscard]] PathSet path_set_of(SweepSet set);

/// Shapes of one kind and size, each on a path of its own, in the layouts that contenders take.
class SweepBatch {
 public:
  /// The size is the radius of a ball, each half extent of a box, and the radius of a capsule and its half axis, which
  /// is along z.
  SweepBatch(ShapeKind kind, float size, PathBatch paths);

  [[nodiscard]] ShapeKind kind() const { return kind_; }
  [[nodiscard]] float size() const { return size_; }
  [[nodiscard]] const PathBatch& paths() const { return paths_; }
  /// Returns the first ones.
  [[nodiscard]] SweptShapeSpanf shapes(std::size_t count) const;
  /// Returns one of them.
  [[nodiscard]] SweptShapef shape(std::size_t index) const;

 private:
  ShapeKind kind_;
  float size_;
  PathBatch paths_;
  std::vector<SweptSpheref> spheres_;
  std::vector<SweptBoxf> boxes_;
  std::vector<SweptCapsulef> capsules_;
};

/// In random order, the same every time for the same seed. `count` is rounded up to whole octets.
[[nodiscard]] PathBatch draw_sweeps(SweepSet set, const NamedMesh& named, float size, std::size_t count,
                                    std::uint64_t seed);

/// Returns the same paths with both ends moved at random by up to this distance. If it is small, they meet nearly the
/// same triangles. Their decisions are no longer close ones.
[[nodiscard]] PathBatch moved_a_bit(const PathBatch& paths, double distance, std::uint64_t seed);

}  // namespace surehit::benchmark
