#include <gtest/gtest.h>

#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "collision/shape/crowded_ground.hpp"
#include "support/floating_point_mode.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::shape_environment_test {
namespace {

/// Bytes of every answer that every query of moving shapes gives, in crowded cells and on numbers that underflow,
/// cancel and tie.
template <typename Shape>
class ShapeEntryPoints {
  using Scalar = ScalarOfShape<Shape>;

 public:
  ShapeEntryPoints() {
    using Limits = std::numeric_limits<Scalar>;
    const Scalar tiny = Limits::denorm_min();
    const Scalar third = Scalar{1} / 3;
    mesh_ = ground_.mesh;
    mesh_.add({{0, 0, 0}, {7 * tiny, 0, 0}, {0, 5 * tiny, 0}});
    mesh_.add({{-1, -1, Limits::min()}, {1, -1, Limits::min()}, {0, 1, 3 * tiny}});
    mesh_.add({{-1, Scalar(0.1), 0}, {1, Scalar(0.1), 0}, {0, Scalar(0.1), Scalar(0.3)}});
    shapes_ = ground_.template shapes<Shape>(24);
    for (const Scalar size : {Scalar{0}, 5 * Limits::min(), third / 16}) {
      const auto add_shape = [&](const Vector3<Scalar>& start, const Vector3<Scalar>& end) {
        shapes_.push_back(shape_of_size<Shape, Scalar>(start, end, size));
      };
      add_shape({third, third / 7, -1}, {third / 3, third, 5});
      add_shape({tiny, 2 * tiny, 1}, {2 * tiny, tiny, -1});
      add_shape({tiny, tiny, -3 * tiny}, {tiny, tiny, 4 * tiny});
      add_shape({0, 0, Limits::min()}, {tiny, Limits::min(), -tiny});
      add_shape({third, Scalar(0.1), size}, {-third, Scalar(0.1), size});
    }
    options_.resize(shapes_.size());
    for (std::size_t i = 0; i < options_.size(); i += 3) {
      options_[i] = {.max_t = third, .culling = Culling::back, .ignore_start_contact = i % 2 == 0};
    }
  }

  [[nodiscard]] std::vector<std::uint8_t> build_and_ask() const {
    std::vector<std::uint8_t> bytes;
    Collider<Scalar> collider;
    add(bytes, !collider.try_build(mesh_.view(), CrowdedGround<Scalar>::options()).has_value());
    for (std::size_t i = 0; i < shapes_.size(); ++i) add_single(bytes, collider, shapes_[i], options_[i]);
    std::vector<ShapeHit<Scalar>> hits(shapes_.size());
    std::vector<std::uint8_t> blocked(shapes_.size());
    for (const bool has_options : {false, true}) {
      ShapeBatchOptions<Scalar> batch;
      if (has_options) batch = {.path_options = options_, .filter = is_odd};
      collider.first_hits(shapes_, hits, batch);
      collider.any_hits(shapes_, blocked, batch);
      for (const auto& hit : hits) add(bytes, hit);
      bytes.insert(bytes.end(), blocked.begin(), blocked.end());
    }
    return bytes;
  }

 private:
  static bool is_odd(const ShapeHit<Scalar>& hit) { return hit.triangle % 2 == 1; }

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
  static void add(std::vector<std::uint8_t>& bytes, const ShapeHit<Scalar>& hit) {
    add_bytes(bytes, hit.t);
    add_bytes(bytes, hit.u);
    add_bytes(bytes, hit.v);
    add_bytes(bytes, hit.triangle);
    add_bytes(bytes, hit.feature);
    add(bytes, hit.started_touching);
  }

  static void add_single(std::vector<std::uint8_t>& bytes, const Collider<Scalar>& collider, const Shape& shape,
                         const ShapeQueryOptions<Scalar>& options) {
    const auto first = collider.first_hit(shape, options);
    add(bytes, first.value_or(ShapeHit<Scalar>{}));
    add(bytes, collider.first_hit(shape, is_odd, options).value_or(ShapeHit<Scalar>{}));
    add(bytes, collider.any_hit(shape, options));
    add(bytes, collider.any_hit(shape, is_odd, options));
    add(bytes, collider.overlaps(shape));
    add(bytes, collider.overlaps(shape, is_odd));
    std::vector<ShapeHit<Scalar>> hits;
    collider.all_hits(shape, hits, options);
    for (const auto& hit : hits) add(bytes, hit);
    if (!first) return;
    add_bytes(bytes, collider.last_free_t(shape, *first));
    add(bytes, collider.last_free_point(shape, *first, options));
    const Triangle<Scalar> triangle = collider.triangle(first->triangle);
    add(bytes, intersect(shape, triangle, options).value_or(ShapeHit<Scalar>{}));
    add(bytes, contact_point(triangle, *first));
    add(bytes, contact_normal<Scalar>(shape, triangle));
  }

  CrowdedGround<Scalar> ground_;
  GeneratedMesh<Scalar> mesh_;
  std::vector<Shape> shapes_;
  std::vector<ShapeQueryOptions<Scalar>> options_;
};

template <typename Shape>
class ShapeEnvironment : public testing::Test {
 protected:
  ShapeEntryPoints<Shape> entry_points;
  std::vector<std::uint8_t> expected = entry_points.build_and_ask();
};
TYPED_TEST_SUITE(ShapeEnvironment, MovingShapes, MovingShapeNames);

TYPED_TEST(ShapeEnvironment, answers_have_the_same_bits_in_every_mode) {
  for (const FloatingPointMode& mode : floating_point_modes) {
    std::vector<std::uint8_t> answers;
    {
      const FloatingPointModeScope scope(mode);
      answers = this->entry_points.build_and_ask();
    }
    EXPECT_TRUE(answers == this->expected) << mode.name;
  }
}

TYPED_TEST(ShapeEnvironment, mode_is_left_as_it_was) {
  for (const FloatingPointMode& mode : floating_point_modes) {
    if (mode.rounding == FE_TONEAREST && !mode.flushes_denormals) continue;  // sticky flags are the hardware's there
    std::uint64_t before = 0;
    std::uint64_t after = 0;
    {
      const FloatingPointModeScope scope(mode);
      std::feclearexcept(FE_ALL_EXCEPT);
      before = control_word();
      static_cast<void>(this->entry_points.build_and_ask());
      after = control_word();
    }
    EXPECT_EQ(before, after) << mode.name;
  }
}

#if defined(__SSE2__)

TYPED_TEST(ShapeEnvironment, unmasked_exceptions_do_not_trap) {
  // Nearly every operation is inexact, so that an entry point which does not hold its environment ends the program
  // here. Nothing but the library computes in between.
  constexpr unsigned all_unmasked = 0;
  const unsigned caller = _mm_getcsr();
  _mm_setcsr(all_unmasked);
  const std::vector<std::uint8_t> answers = this->entry_points.build_and_ask();
  const unsigned after = _mm_getcsr();
  _mm_setcsr(caller);
  EXPECT_TRUE(answers == this->expected);
  EXPECT_EQ(after, all_unmasked);
}

#endif

}  // namespace
}  // namespace surehit::test::shape_environment_test
