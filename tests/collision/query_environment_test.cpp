#include <gtest/gtest.h>

#include <cfenv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "support/floating_point_mode.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"
#include "unit_triangles.hpp"

namespace surehit::test::query_environment_test {
namespace {

/// Bytes of every answer that every entry point gives on numbers that underflow, cancel and tie.
template <typename Scalar>
class EntryPoints {
 public:
  EntryPoints() {
    using Limits = std::numeric_limits<Scalar>;
    mesh_ = stack_of_triangles<Scalar>(4);
    mesh_.add({{0, 0, 0}, {7 * Limits::denorm_min(), 0, 0}, {0, 5 * Limits::denorm_min(), 0}});
    mesh_.add({{-1, -1, Limits::min()}, {1, -1, Limits::min()}, {0, 1, 3 * Limits::denorm_min()}});
    mesh_.add({{-1, Scalar(0.1), 0}, {1, Scalar(0.1), 0}, {0, Scalar(0.1), Scalar(0.3)}});
    const Scalar third = Scalar{1} / 3;
    const Scalar tiny = Limits::denorm_min();
    segments_ = {{{third, third / 7, -1}, {third / 3, third, 5}},
                 {{tiny, 2 * tiny, 1}, {2 * tiny, tiny, -1}},
                 {{tiny, tiny, -3 * tiny}, {tiny, tiny, 4 * tiny}},
                 {{-1, third, 2}, {2, third / 5, 2}},
                 {{Scalar(0.1), Scalar(0.1), -tiny}, {Scalar(0.7), Scalar(0.1), 3}},
                 {{0, 0, Limits::min()}, {tiny, Limits::min(), -tiny}}};
    for (const auto& segment : segments_) {
      rays_.push_back({segment.start, segment.end});
      lines_.push_back({segment.end, segment.start});
    }
  }

  [[nodiscard]] std::vector<std::uint8_t> build_and_ask() const {
    std::vector<std::uint8_t> bytes;
    Collider<Scalar> collider;
    add(bytes, !collider.try_build(mesh_.view()).has_value());
    for (const auto& segment : segments_) add_single(bytes, collider, segment);
    for (const auto& ray : rays_) add_single(bytes, collider, ray);
    for (const auto& line : lines_) add_single(bytes, collider, line);
    for (const auto& segment : segments_) {
      const auto hit = collider.first_hit(segment);
      if (!hit) continue;
      add(bytes, collider.last_free_point(segment, *hit));
      add(bytes, collider.last_free_point(segment, *hit, [](const Hit<Scalar>& shown) { return shown.u > 0; }));
    }
    add_batch<Segment<Scalar>>(bytes, collider, segments_);
    add_batch<Ray<Scalar>>(bytes, collider, rays_);
    add_batch<Line<Scalar>>(bytes, collider, lines_);
    for (std::uint32_t id = 0; id < collider.triangle_count(); ++id) add(bytes, normal(mesh_.view(), id));
    return bytes;
  }

 private:
  template <typename Number>
  static void add_bytes(std::vector<std::uint8_t>& bytes, const Number& number) {
    const std::size_t size = bytes.size();
    bytes.resize(size + sizeof number);
    std::memcpy(bytes.data() + size, &number, sizeof number);
  }
  static void add(std::vector<std::uint8_t>& bytes, bool answer) { bytes.push_back(answer ? 1 : 0); }
  static void add(std::vector<std::uint8_t>& bytes, const Vector3<Scalar>& vector) {
    for (int axis = 0; axis < 3; ++axis) add_bytes(bytes, vector[axis]);
  }
  static void add(std::vector<std::uint8_t>& bytes, const Hit<Scalar>& hit) {
    add_bytes(bytes, hit.t);
    add_bytes(bytes, hit.u);
    add_bytes(bytes, hit.v);
    add_bytes(bytes, hit.triangle);
    add_bytes(bytes, hit.side);
  }
  static void add(std::vector<std::uint8_t>& bytes, const std::optional<Hit<Scalar>>& hit) {
    add(bytes, hit.value_or(Hit<Scalar>{}));
  }

  template <typename AnyPath>
  void add_single(std::vector<std::uint8_t>& bytes, const Collider<Scalar>& collider, const AnyPath& path) const {
    const auto odd = [](const Hit<Scalar>& hit) { return hit.triangle % 2 == 1; };
    const std::optional<Hit<Scalar>> first = collider.first_hit(path);
    add(bytes, first);
    add(bytes, collider.first_hit(path, odd));
    add(bytes, collider.any_hit(path));
    add(bytes, collider.any_hit(path, odd));
    std::vector<Hit<Scalar>> hits;
    collider.all_hits(path, hits);
    for (const auto& hit : hits) add(bytes, hit);
    collider.all_hits(path, hits, odd);
    for (const auto& hit : hits) add(bytes, hit);
    if (first) {
      add(bytes, point(path, *first));
      add_bytes(bytes, distance(path, *first));
      add_bytes(bytes, collider.max_t_keeping(path, *first));
      add(bytes, collider.normal(first->triangle));
    }
    for (int i = 1; i < 40; ++i) add_bytes(bytes, distance(path, Hit<Scalar>{.t = Scalar(i) / 64}));
    for (std::uint32_t id = 0; id < collider.triangle_count(); ++id) add(bytes, intersect(path, collider.triangle(id)));
  }

  template <typename AnyPath>
  void add_batch(std::vector<std::uint8_t>& bytes, const Collider<Scalar>& collider,
                 std::span<const AnyPath> paths) const {
    std::vector<Hit<Scalar>> hits(paths.size());
    std::vector<std::uint8_t> blocked(paths.size());
    collider.first_hits(paths, hits);
    collider.any_hits(paths, blocked);
    for (const auto& hit : hits) add(bytes, hit);
    bytes.insert(bytes.end(), blocked.begin(), blocked.end());
  }

  GeneratedMesh<Scalar> mesh_;
  std::vector<Segment<Scalar>> segments_;
  std::vector<Ray<Scalar>> rays_;
  std::vector<Line<Scalar>> lines_;
};

template <typename Scalar>
class QueryEnvironment : public testing::Test {
 protected:
  EntryPoints<Scalar> entry_points;
  std::vector<std::uint8_t> expected = entry_points.build_and_ask();
};
TYPED_TEST_SUITE(QueryEnvironment, Scalars, ScalarNames);

TYPED_TEST(QueryEnvironment, answers_have_the_same_bits_in_every_mode) {
  for (const FloatingPointMode& mode : floating_point_modes) {
    std::vector<std::uint8_t> answers;
    {
      const FloatingPointModeScope scope(mode);
      answers = this->entry_points.build_and_ask();
    }
    EXPECT_EQ(answers, this->expected) << mode.name;
  }
}

TYPED_TEST(QueryEnvironment, mode_is_left_as_it_was) {
  for (const FloatingPointMode& mode : floating_point_modes) {
    if (mode.rounding == FE_TONEAREST && !mode.flushes_denormals) continue;  // sticky flags are the hardware's there
    std::uint64_t before = 0;
    std::uint64_t after = 0;
    {
      const FloatingPointModeScope scope(mode);
      std::feclearexcept(FE_ALL_EXCEPT);
      before = control_word();
      const Collider<TypeParam> collider(stack_of_triangles<TypeParam>(3).view());
      static_cast<void>(collider.first_hit(Segment<TypeParam>{{-1, TypeParam{0.25}, 1}, {1, TypeParam{0.125}, 1}}));
      after = control_word();
    }
    EXPECT_EQ(before, after) << mode.name;
  }
}

#if defined(__SSE2__)

TYPED_TEST(QueryEnvironment, unmasked_exceptions_do_not_trap) {
  // Nearly every operation is inexact, so that an entry point which does not hold its environment ends the program
  // here. Nothing but the library computes in between.
  constexpr unsigned all_unmasked = 0;
  const unsigned caller = _mm_getcsr();
  _mm_setcsr(all_unmasked);
  const std::vector<std::uint8_t> answers = this->entry_points.build_and_ask();
  const unsigned after = _mm_getcsr();
  _mm_setcsr(caller);
  EXPECT_EQ(answers, this->expected);
  EXPECT_EQ(after, all_unmasked);
}

#endif

}  // namespace
}  // namespace surehit::test::query_environment_test
