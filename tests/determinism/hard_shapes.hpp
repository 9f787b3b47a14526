#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "answers.hpp"
#include "hard_questions.hpp"
#include "support/random.hpp"
#include "surehit/collider.hpp"

namespace surehit::test {

/// `ShapeAnswers::hash` of the shapes below.
template <typename Scalar>
inline constexpr std::uint64_t published_shape_hash = 0;
template <>
inline constexpr std::uint64_t published_shape_hash<float> = 0xfe7398673e48f841u;
template <>
inline constexpr std::uint64_t published_shape_hash<double> = 0xcfb0416f8aec22cdu;

/// The same of the few that `keep_few` keeps.
template <typename Scalar>
inline constexpr std::uint64_t published_shape_hash_of_few = 0;
template <>
inline constexpr std::uint64_t published_shape_hash_of_few<float> = 0x958cb6e7ab66b269u;
template <>
inline constexpr std::uint64_t published_shape_hash_of_few<double> = 0x21a1f265d8417642u;

/// `ShapeContacts::hash` of the same shapes.
template <typename Scalar>
inline constexpr std::uint64_t published_shape_contact_hash = 0;
template <>
inline constexpr std::uint64_t published_shape_contact_hash<float> = 0xb2b6ba86fe1fe1a6u;
template <>
inline constexpr std::uint64_t published_shape_contact_hash<double> = 0x7a85e2f28f6f2debu;

/// The same of the few that `keep_few` keeps.
template <typename Scalar>
inline constexpr std::uint64_t published_shape_contact_hash_of_few = 0;
template <>
inline constexpr std::uint64_t published_shape_contact_hash_of_few<float> = 0x75fffbf07c6081f5u;
template <>
inline constexpr std::uint64_t published_shape_contact_hash_of_few<double> = 0x007ac70557abe169u;

/// Moving balls, boxes and capsules that are hard for the mesh of `HardQuestions`, the same on every platform. Half of
/// them go along the segments of these questions. The others rest on vertices of the ground, at a height of exactly
/// their size, so they graze. No step to a Scalar rounds.
template <typename Scalar>
class HardShapes {
 public:
  static constexpr std::size_t shape_count = 1500;

  HardShapes() {
    std::size_t question = 0;
    while (shapes.size() < shape_count) {
      const Segment<Scalar> segment = shapes.size() % 2 == 0 ? next_segment(question) : resting_segment();
      add(segment);
    }
  }

  HardQuestions<Scalar> hard;
  std::vector<SweptShape<Scalar>> shapes;

 private:
  /// The vertices of the ground have heights that are multiples of an eighth.
  static constexpr std::uint64_t ground_vertices = 289;

  Segment<Scalar> next_segment(std::size_t& question) const {
    for (;;) {
      const Path<Scalar>& path = hard.questions.all[question++].path;
      if (path.has_end()) return {path.start, path.toward};
    }
  }
  Vector3<Scalar> above_ground(Scalar height) {
    const auto& vertex = hard.vertices[random_.below(ground_vertices)];
    return {vertex[0], vertex[1], vertex[2] + height};
  }
  Segment<Scalar> resting_segment() {
    size_ = eighths(8);
    // Most of them graze what they rest on. The others are higher.
    const Scalar height = random_.one_in(3) ? size_ + eighths(16) : size_;
    const Vector3<Scalar> start = above_ground(height);
    return {start, above_ground(height)};
  }
  /// Up to `count` eighths.
  Scalar eighths(std::int64_t count) { return static_cast<Scalar>(random_.between(0, count)) * Scalar{0.125F}; }
  Scalar length() { return random_.one_in(3) ? random_.unit<Scalar>() : eighths(4); }

  void add(const Segment<Scalar>& segment) {
    const Scalar size = shapes.size() % 2 == 0 ? length() : size_;
    const auto& [start, end] = segment;
    switch (shapes.size() % 3) {
      case 0:
        shapes.push_back(SweptSphere<Scalar>{start, end, size});
        break;
      case 1: {
        const Scalar x = length();
        const Scalar y = length();
        shapes.push_back(SweptBox<Scalar>{start, end, {x, y, size}});
        break;
      }
      default: {  // A capsule that lies or stands.
        const Scalar along = length();
        const bool lies = random_.one_in(2);
        const Vector3<Scalar> half_axis(lies ? along : Scalar{0}, lies ? along : Scalar{0}, lies ? Scalar{0} : along);
        shapes.push_back(SweptCapsule<Scalar>{start, end, half_axis, size});
      }
    }
  }

  Random random_{20261126};
  Scalar size_ = 0;
};

/// All that a collider says about one moving shape.
template <typename Scalar>
struct ShapeAnswer {
  ShapeHit<Scalar> first;
  bool any = false;
  bool overlaps = false;
  std::vector<ShapeHit<Scalar>> all;
  Scalar free_t = 0;  ///< of a shape that hits

  /// Compares numbers as they are; no answer is a NaN or -0.
  friend bool operator==(const ShapeAnswer&, const ShapeAnswer&) = default;
};

template <typename Scalar>
class ShapeAnswers {
 public:
  ShapeAnswers(const Collider<Scalar>& collider, const std::vector<SweptShape<Scalar>>& shapes) {
    constexpr std::size_t every_all = 4;
    for (std::size_t id = 0; id < shapes.size(); ++id) {
      const ShapeQueryOptions<Scalar> options = options_of(id);
      ShapeAnswer<Scalar> answer;
      answer.first = collider.first_hit(shapes[id], options).value_or(ShapeHit<Scalar>{});
      answer.any = collider.any_hit(shapes[id], options);
      answer.overlaps = collider.overlaps(shapes[id], options);
      if (id % every_all == 0) collider.all_hits(shapes[id], answer.all, options);
      if (answer.any) answer.free_t = collider.last_free_t(shapes[id], answer.first);
      all.push_back(answer);
    }
  }

  [[nodiscard]] static ShapeQueryOptions<Scalar> options_of(std::size_t id) {
    if (id % 4 != 3) return {};
    return {.max_t = Scalar{0.75F}, .culling = Culling::back, .mask = 1, .ignore_start_contact = true};
  }

  [[nodiscard]] std::uint64_t hash() const {
    AnswerHash hash;
    const auto take = [&](const ShapeHit<Scalar>& hit) {
      hash.take(hit.t);
      hash.take(hit.u);
      hash.take(hit.v);
      hash.take(hit.triangle);
      hash.take(static_cast<std::uint32_t>(hit.feature));
      hash.take(std::uint32_t{hit.started_touching});
    };
    for (const ShapeAnswer<Scalar>& answer : all) {
      take(answer.first);
      hash.take(std::uint32_t{answer.any});
      hash.take(std::uint32_t{answer.overlaps});
      hash.take(static_cast<std::uint32_t>(answer.all.size()));
      for (const ShapeHit<Scalar>& hit : answer.all) take(hit);
      hash.take(answer.free_t);
    }
    return hash.value();
  }

  std::vector<ShapeAnswer<Scalar>> all;
};

/// Where moving shapes may stop in front of their first hits, where they touch, and in which direction.
template <typename Scalar>
class ShapeContacts {
 public:
  ShapeContacts(const Collider<Scalar>& collider, const std::vector<SweptShape<Scalar>>& shapes) {
    for (std::size_t id = 0; id < shapes.size(); ++id) {
      const ShapeQueryOptions<Scalar> options = ShapeAnswers<Scalar>::options_of(id);
      const auto hit = collider.first_hit(shapes[id], options);
      if (!hit) continue;
      const Triangle<Scalar> triangle = collider.triangle(hit->triangle);
      free_points.push_back(collider.last_free_point(shapes[id], *hit, options));
      points.push_back(contact_point(triangle, *hit));
      normals.push_back(contact_normal(shapes[id], triangle));
    }
  }

  [[nodiscard]] std::uint64_t hash() const {
    AnswerHash hash;
    for (const auto* const vectors : {&free_points, &points, &normals}) {
      for (const Vector3<Scalar>& vector : *vectors) {
        for (const Scalar x : vector) hash.take(x);
      }
    }
    return hash.value();
  }

  // These are for the shapes that hit, in their order.
  std::vector<Vector3<Scalar>> free_points;
  std::vector<Vector3<Scalar>> points;
  std::vector<Vector3<Scalar>> normals;
};

}  // namespace surehit::test
