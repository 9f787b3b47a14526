#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "answers.hpp"
#include "hard_scene.hpp"
#include "support/random.hpp"
#include "surehit/scene.hpp"

namespace surehit::test {

/// `SceneShapeAnswers::hash` of the scene and the shapes below.
template <typename Scalar>
inline constexpr std::uint64_t published_scene_shape_hash = 0;
template <>
inline constexpr std::uint64_t published_scene_shape_hash<float> = 0x75336dde5f01360cu;
template <>
inline constexpr std::uint64_t published_scene_shape_hash<double> = 0xfebea5909f86f8b6u;

/// The same of the few that `keep_few` keeps.
template <typename Scalar>
inline constexpr std::uint64_t published_scene_shape_hash_of_few = 0;
template <>
inline constexpr std::uint64_t published_scene_shape_hash_of_few<float> = 0x9473d8b90c595396u;
template <>
inline constexpr std::uint64_t published_scene_shape_hash_of_few<double> = 0x171ae8662f921342u;

/// Moving balls, boxes and capsules that are hard for the scene of `HardScene`, the same on every platform. Half of
/// them go along the segments of its paths. The others end at a vertex of an instance where this is by then, at a
/// distance of exactly their size, so they graze. No step to a Scalar rounds.
template <typename Scalar>
class HardSceneShapes {
 public:
  static constexpr std::size_t shape_count = 480;

  HardSceneShapes() {
    std::size_t path = 0;
    while (shapes.size() < shape_count) add(shapes.size() % 2 == 0 ? next_segment(path) : grazing_segment());
  }

  HardScene<Scalar> hard;
  std::vector<SweptShape<Scalar>> shapes;

 private:
  /// The vertices of the ground are multiples of an eighth.
  static constexpr std::uint64_t ground_vertices = 289;

  static bool are_whole(const Vector3<Scalar>& vector) {
    return std::all_of(vector.begin(), vector.end(),
                       [](Scalar x) { return x == static_cast<Scalar>(static_cast<std::int64_t>(x)); });
  }

  Segment<Scalar> next_segment(std::size_t& path) const {
    for (;;) {
      const Path<Scalar>& next = hard.paths[path++];
      if (next.has_end()) return {next.start, next.toward};
    }
  }
  /// Returns a large instance of a matrix, a place and a motion in whole numbers.
  const HardInstance<Scalar>& whole_instance() {
    for (;;) {
      const HardInstance<Scalar>& instance = hard.instances[random_.below(hard.instances.size())];
      bool is_whole = instance.is_large && are_whole(instance.pose.translation) && are_whole(instance.motion);
      for (int row = 0; row < 3; ++row) is_whole = is_whole && are_whole(instance.pose.linear.row(row).transpose());
      if (is_whole) return instance;
    }
  }
  Segment<Scalar> grazing_segment() {
    size_ = eighths(8);
    if (!random_.one_in(3)) size_ /= 16;
    const HardInstance<Scalar>& instance = whole_instance();
    const auto& vertex = hard.mesh.vertices[random_.below(ground_vertices)];
    const Vector3<Scalar> placed =
        instance.pose.linear * Vector3<Scalar>{vertex[0], vertex[1], vertex[2]} + instance.pose.translation;
    Vector3<Scalar> end = placed + instance.motion;
    const auto axis = static_cast<Eigen::Index>(random_.below(3));
    end[axis] += random_.one_in(2) ? size_ : -size_;
    const Scalar x = eighths(16) - 1;
    const Scalar y = eighths(16) - 1;
    return {end + Vector3<Scalar>{x, y, eighths(8)}, end};
  }
  /// Up to `count` eighths.
  Scalar eighths(std::int64_t count) { return static_cast<Scalar>(random_.between(0, count)) * Scalar{0.125F}; }
  /// Most are small, because the scene is full of triangles.
  Scalar length() {
    const Scalar length = random_.one_in(3) ? random_.unit<Scalar>() : eighths(4);
    return random_.one_in(3) ? length : length / 16;
  }

  void add(const Segment<Scalar>& segment) {
    const Scalar size = shapes.size() % 2 == 0 ? length() : size_;
    const auto& [start, end] = segment;
    switch (shapes.size() % 3) {
      case 0:
        shapes.push_back(SweptSphere<Scalar>{start, end, size});
        break;
      case 1:
        // A cube is as wide on the axis on which it grazes.
        shapes.push_back(SweptBox<Scalar>{start, end, {size, size, size}});
        break;
      default: {
        Vector3<Scalar> half_axis(0, 0, 0);
        const auto axis = static_cast<Eigen::Index>(random_.below(3));
        half_axis[axis] = length();
        shapes.push_back(SweptCapsule<Scalar>{start, end, half_axis, size});
      }
    }
  }

  Random random_{20261128};
  Scalar size_ = 0;
};

/// What a scene says about some moving shapes.
template <typename Scalar>
class SceneShapeAnswers {
 public:
  SceneShapeAnswers(const Scene<Scalar>& scene, const std::vector<SweptShape<Scalar>>& shapes,
                    const std::optional<Executor>& executor = {}, std::size_t batch = std::size_t{1} << 30)
      : answers_(shapes.size()) {
    for (std::size_t i = 0; i < shapes.size(); ++i) ask(scene, shapes[i], options_of(i), answers_[i]);
    ask_batches<SweptSphere<Scalar>>(scene, shapes, executor, batch);
    ask_batches<SweptBox<Scalar>>(scene, shapes, executor, batch);
    ask_batches<SweptCapsule<Scalar>>(scene, shapes, executor, batch);
  }

  [[nodiscard]] std::uint64_t hash() const {
    AnswerHash hash;
    for (const Answer& answer : answers_) {
      take(hash, answer.first);
      hash.take(std::uint32_t{answer.any});
      hash.take(std::uint32_t{answer.overlaps});
      hash.take(static_cast<std::uint32_t>(answer.all.size()));
      for (const auto& hit : answer.all) take(hash, hit);
      hash.take(answer.free_t);
      hash.take(answer.share);
      for (const auto& vector : {answer.free_point, answer.contact_point, answer.contact_normal}) {
        for (const Scalar x : vector) hash.take(x);
      }
      take(hash, answer.first_of_batch);
      hash.take(std::uint32_t{answer.any_of_batch});
    }
    return hash.value();
  }
  [[nodiscard]] std::size_t hit_count() const {
    return static_cast<std::size_t>(
        std::count_if(answers_.begin(), answers_.end(), [](const Answer& answer) { return answer.any; }));
  }
  /// Returns the number of hits that are not at the start.
  [[nodiscard]] std::size_t later_hit_count() const {
    return static_cast<std::size_t>(std::count_if(answers_.begin(), answers_.end(), [](const Answer& answer) {
      return answer.any && !answer.first.started_touching;
    }));
  }

 private:
  struct Answer {
    SceneShapeHit<Scalar> first;
    bool any = false;
    bool overlaps = false;
    std::vector<SceneShapeHit<Scalar>> all;
    // These are for a shape that hits.
    Scalar free_t = 0;
    Vector3<Scalar> free_point{0, 0, 0};
    Scalar share = 0;  ///< That of the free point.
    Vector3<Scalar> contact_point{0, 0, 0};
    Vector3<Scalar> contact_normal{0, 0, 0};
    SceneShapeHit<Scalar> first_of_batch;
    std::uint8_t any_of_batch = 0;
  };

  static SceneShapeQueryOptions<Scalar> options_of(std::size_t shape) {
    if (shape % 4 != 3) return {};
    return {.max_t = Scalar{0.75F},
            .culling = shape % 8 == 3 ? Culling::back : Culling::none,
            .instance_mask = 1,
            .ignore_start_contact = true};
  }

  static void take(AnswerHash& hash, const SceneShapeHit<Scalar>& hit) {
    hash.take(hit.t);
    hash.take(hit.u);
    hash.take(hit.v);
    hash.take(hit.triangle);
    hash.take(static_cast<std::uint32_t>(hit.feature));
    hash.take(std::uint32_t{hit.started_touching});
    hash.take(hit.instance.index);
  }

  static void ask(const Scene<Scalar>& scene, const SweptShape<Scalar>& shape,
                  const SceneShapeQueryOptions<Scalar>& options, Answer& answer) {
    const auto first = scene.first_hit(shape, options);
    answer.any = scene.any_hit(shape, options);
    answer.overlaps = scene.overlaps(shape);
    scene.all_hits(shape, answer.all, options);
    if (!first) return;
    answer.first = *first;
    answer.free_t = scene.last_free_t(shape, *first);
    answer.free_point = scene.last_free_point(shape, *first, options, &answer.share);
    answer.contact_point = scene.contact_point(*first);
    answer.contact_normal = scene.contact_normal(shape, *first);
  }

  template <typename Shape>
  void ask_batches(const Scene<Scalar>& scene, const std::vector<SweptShape<Scalar>>& shapes,
                   const std::optional<Executor>& executor, std::size_t batch) {
    std::vector<std::size_t> ids;
    std::vector<Shape> asked;
    std::vector<SceneShapeQueryOptions<Scalar>> options;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const auto* const shape = std::get_if<Shape>(&shapes[i]);
      if (shape == nullptr) continue;
      ids.push_back(i);
      asked.push_back(*shape);
      options.push_back(options_of(i));
    }
    std::vector<SceneShapeHit<Scalar>> first(ids.size());
    std::vector<std::uint8_t> any(ids.size());
    for (std::size_t begin = 0; begin < ids.size(); begin += batch) {
      const std::size_t count = std::min(batch, ids.size() - begin);
      const SceneShapeBatchOptions<Scalar> with{.path_options = std::span(options).subspan(begin, count),
                                                .executor = executor};
      const auto some = std::span<const Shape>(asked).subspan(begin, count);
      scene.first_hits(some, std::span(first).subspan(begin, count), with);
      scene.any_hits(some, std::span(any).subspan(begin, count), with);
    }
    for (std::size_t i = 0; i < ids.size(); ++i) {
      answers_[ids[i]].first_of_batch = first[i];
      answers_[ids[i]].any_of_batch = any[i];
    }
  }

  std::vector<Answer> answers_;
};

}  // namespace surehit::test
