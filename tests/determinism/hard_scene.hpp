#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "answers.hpp"
#include "hard_questions.hpp"
#include "surehit/scene.hpp"

namespace surehit::test {

/// `SceneAnswers::hash` of the scene and the questions below.
template <typename Scalar>
inline constexpr std::uint64_t published_scene_hash = 0;
template <>
inline constexpr std::uint64_t published_scene_hash<float> = 0x398b2abd086fb78cu;
template <>
inline constexpr std::uint64_t published_scene_hash<double> = 0xcd0def44a09f8e30u;

/// The same of the few that `keep_few` keeps.
template <typename Scalar>
inline constexpr std::uint64_t published_scene_hash_of_few = 0;
template <>
inline constexpr std::uint64_t published_scene_hash_of_few<float> = 0xddf27c485cb5aafeu;
template <>
inline constexpr std::uint64_t published_scene_hash_of_few<double> = 0x64edf37aed6efcebu;

/// Where an instance of the hard scene is.
template <typename Scalar>
struct HardInstance {
  bool is_large = false;  ///< Whether it is of the mesh of the hard questions, or else of one triangle.
  Pose<Scalar> pose;
  Vector3<Scalar> motion{0, 0, 0};
  std::uint32_t mask = 3;
};

/// 40 instances and 4,000 paths that are hard for them, the same on every platform. The matrices are whole numbers or
/// have all bits drawn, and some are nearly singular. No step from what is drawn to a Scalar rounds.
template <typename Scalar>
class HardScene {
 public:
  static constexpr std::size_t path_count = 4'000;

  HardScene() {
    for (int i = 0; i < 40; ++i) instances.push_back(draw_instance());
    for (std::size_t i = 0; i < path_count; ++i) paths.push_back(draw_path());
  }

  /// Adds the instances in this order, and commits them. So their indices are those of the instances.
  [[nodiscard]] Scene<Scalar> scene() const {
    Scene<Scalar> result;
    std::vector<InstanceId> ids;
    for (std::size_t i = 0; i < instances.size(); ++i) {
      ids.push_back(result.try_add(collider(instances[i]), instances[i].pose, {.mask = instances[i].mask}).id());
      static_cast<void>(result.try_set_motion(ids[i], instances[i].motion));
    }
    result.commit();
    return result;
  }

  [[nodiscard]] std::shared_ptr<const Collider<Scalar>> collider(const HardInstance<Scalar>& instance) const {
    return instance.is_large ? large : small;
  }

  HardQuestions<Scalar> mesh;
  std::shared_ptr<const Collider<Scalar>> large = std::make_shared<Collider<Scalar>>(mesh.collider());
  std::shared_ptr<const Collider<Scalar>> small = small_collider();
  std::vector<HardInstance<Scalar>> instances;
  std::vector<Path<Scalar>> paths;

 private:
  static std::shared_ptr<const Collider<Scalar>> small_collider() {
    const std::array<Scalar, 9> vertices = {0, 0, 0, 4, 0, 0, 0, 4, 0};
    const std::array<std::uint32_t, 3> triangle = {0, 1, 2};
    auto collider = std::make_shared<Collider<Scalar>>();
    static_cast<void>(collider->try_build(TriangleMeshView<Scalar>(vertices, triangle)).has_value());
    return collider;
  }

  Scalar whole(std::int64_t reach) { return static_cast<Scalar>(random_.between(-reach, reach)); }
  Vector3<Scalar> whole_vector(std::int64_t reach) {
    const Scalar x = whole(reach);
    const Scalar y = whole(reach);
    return {x, y, whole(reach)};
  }
  /// In [-1, 1), all bits drawn.
  Vector3<Scalar> full_vector() {
    const Scalar x = random_.symmetric<Scalar>();
    const Scalar y = random_.symmetric<Scalar>();
    return {x, y, random_.symmetric<Scalar>()};
  }

  /// Its matrix has an entry on the diagonal that is larger than the others of its row together.
  HardInstance<Scalar> draw_instance() {
    HardInstance<Scalar> instance;
    instance.is_large = random_.one_in(4);
    instance.pose.translation = random_.one_in(2) ? whole_vector(4) : full_vector();
    switch (random_.below(4)) {
      case 0:  // a translation
        break;
      case 1:  // turned by right angles, and mirrored or not
        instance.pose.linear << 0, random_.one_in(2) ? 1 : -1, 0, 0, 0, random_.one_in(2) ? 2 : -2, 1, 0, 0;
        break;
      case 2:  // flat
        instance.pose.linear(2, 2) = Scalar{0x1p-30F};
        instance.pose.linear(1, 0) = random_.symmetric<Scalar>();
        break;
      default:
        for (int row = 0; row < 3; ++row) {
          const Vector3<Scalar> entries = full_vector();
          for (int column = 0; column < 3; ++column) {
            instance.pose.linear(row, column) = row == column ? Scalar{2} : entries[column] / 2;
          }
        }
    }
    if (random_.one_in(2)) instance.motion = random_.one_in(2) ? whole_vector(2) : full_vector();
    if (random_.one_in(4)) instance.mask = 1 + static_cast<std::uint32_t>(random_.below(2));
    return instance;
  }

  /// Between whole numbers, between points with all bits drawn, or from far away. Some have no length.
  Path<Scalar> draw_path() {
    const Vector3<Scalar> start = random_.one_in(2) ? whole_vector(6) : full_vector();
    Vector3<Scalar> toward = random_.one_in(2) ? whole_vector(6) : full_vector();
    if (random_.one_in(16)) toward = start;
    if (random_.one_in(16)) {
      for (Scalar& x : toward) x *= Scalar{0x1p40F};
    }
    return {static_cast<PathKind>(random_.below(5) % 3), start, toward};
  }

  Random random_{20261125};
};

/// What a scene says about some paths.
template <typename Scalar>
class SceneAnswers {
 public:
  SceneAnswers(const Scene<Scalar>& scene, std::span<const Path<Scalar>> paths,
               const std::optional<Executor>& executor = {}, std::size_t batch = std::size_t{1} << 30)
      : SceneAnswers(scene, scene, paths, executor, batch) {}

  /// Asks `batched` in batches: the same scene elsewhere, such as on a GPU.
  template <typename Batched>
  SceneAnswers(const Scene<Scalar>& scene, const Batched& batched, std::span<const Path<Scalar>> paths,
               const std::optional<Executor>& executor = {}, std::size_t batch = std::size_t{1} << 30)
      : first_(paths.size()), any_(paths.size()) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const SceneQueryOptions<Scalar> options = options_of(i);
      scene.all_hits(paths[i], all_.emplace_back(), options);
      const auto hit = scene.first_hit(paths[i], options);
      const bool is_segment = hit && paths[i].has_end();
      free_.push_back(is_segment ? scene.last_free_point({paths[i].start, paths[i].toward}, *hit, options)
                                 : Vector3<Scalar>(0, 0, 0));
    }
    ask_batches<Segment<Scalar>>(batched, paths, PathKind::segment, executor, batch);
    ask_batches<Ray<Scalar>>(batched, paths, PathKind::ray, executor, batch);
    ask_batches<Line<Scalar>>(batched, paths, PathKind::line, executor, batch);
  }

  [[nodiscard]] std::uint64_t hash() const {
    AnswerHash hash;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      hash.take(static_cast<std::uint32_t>(all_[i].size()));
      for (const auto& hit : all_[i]) take(hash, hit);
      take(hash, first_[i]);
      hash.take(std::uint32_t{any_[i]});
      for (const Scalar x : free_[i]) hash.take(x);
    }
    return hash.value();
  }
  [[nodiscard]] std::size_t hit_count() const {
    std::size_t count = 0;
    for (const std::uint8_t any : any_) count += any;
    return count;
  }

 private:
  static SceneQueryOptions<Scalar> options_of(std::size_t path) {
    if (path % 4 != 0) return {};
    return {.min_t = Scalar{0.125}, .culling = path % 8 == 0 ? Culling::back : Culling::none, .instance_mask = 1};
  }

  static void take(AnswerHash& hash, const SceneHit<Scalar>& hit) {
    hash.take(static_cast<const Hit<Scalar>&>(hit));
    hash.take(hit.instance.index);
  }

  template <typename AnyPath, typename Batched>
  void ask_batches(const Batched& batched, std::span<const Path<Scalar>> paths, PathKind kind,
                   const std::optional<Executor>& executor, std::size_t batch) {
    std::vector<std::size_t> ids;
    std::vector<AnyPath> asked;
    std::vector<SceneQueryOptions<Scalar>> options;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (paths[i].kind != kind) continue;
      ids.push_back(i);
      asked.push_back({paths[i].start, paths[i].toward});
      options.push_back(options_of(i));
    }
    std::vector<SceneHit<Scalar>> first(ids.size());
    std::vector<std::uint8_t> any(ids.size());
    for (std::size_t begin = 0; begin < ids.size(); begin += batch) {
      const std::size_t count = std::min(batch, ids.size() - begin);
      const SceneBatchOptions<Scalar> with{.path_options = std::span(options).subspan(begin, count),
                                           .executor = executor};
      const auto some = std::span<const AnyPath>(asked).subspan(begin, count);
      static_cast<void>(batched.first_hits(some, std::span(first).subspan(begin, count), with));
      static_cast<void>(batched.any_hits(some, std::span(any).subspan(begin, count), with));
    }
    for (std::size_t i = 0; i < ids.size(); ++i) {
      first_[ids[i]] = first[i];
      any_[ids[i]] = any[i];
    }
  }

  std::vector<std::vector<SceneHit<Scalar>>> all_;
  std::vector<SceneHit<Scalar>> first_;
  std::vector<std::uint8_t> any_;
  std::vector<Vector3<Scalar>> free_;  ///< The last free points of segments that hit.
};

}  // namespace surehit::test
