#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>

#include "support/neighbour.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/scene_oracle.hpp"
#include "surehit/scene.hpp"
#include "unit_scenes.hpp"

namespace surehit::test::invalid_instance_test {
namespace {

using Reason = InvalidInstance::Reason;

/// A scene that has an instance, and is given what it cannot take.
template <typename Scalar>
class InvalidInstanceOf : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;

  InvalidInstanceOf() {
    scene.commit();
    scene.set_pose(id, at_height<Scalar>(1));
    scene.set_motion(id, {0, 0, 1});
  }

  void expect_as_before() {
    EXPECT_EQ(scene.instance_count(), 1U);
    EXPECT_EQ(scene.pose(id).translation[2], 1);
    EXPECT_EQ(scene.motion(id)[2], 1);
    EXPECT_EQ(scene.mask(id), 3U);
    const auto path = through_stack<Scalar>(4, -4);
    const auto before = scene.first_hit(path);
    ASSERT_TRUE(before);
    EXPECT_EQ(before->t, Scalar{0.5});
  }

  static void expect_error(const InvalidInstance& error, Reason reason, std::size_t element, const std::string& named) {
    EXPECT_EQ(error.reason, reason) << error.what();
    EXPECT_EQ(error.element, element) << error.what();
    const std::string message = error.what();
    EXPECT_NE(message.find(named), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }

  /// Returned by one of a pair of functions, and thrown by the other.
  void expect_refused(const std::function<InstanceResult()>& attempt, const std::function<void()>& throwing,
                      Reason reason, std::size_t element, const std::string& named) {
    const InstanceResult result = attempt();
    ASSERT_FALSE(result);
    expect_error(result.error(), reason, element, named);
    expect_as_before();
    try {
      throwing();
      FAIL() << "accepted";
    } catch (const InvalidInstance& thrown) {
      expect_error(thrown, reason, element, named);
      EXPECT_STREQ(thrown.what(), result.error().what());
    }
    expect_as_before();
  }

  /// As the pose of a new instance, and of one that there is.
  void expect_refused(const Pose<Scalar>& pose, Reason reason, std::size_t element, const std::string& named = "") {
    expect_refused([&] { return scene.try_add(floor, pose); }, [&] { scene.add(floor, pose); }, reason, element, named);
    expect_refused([&] { return scene.try_set_pose(id, pose); }, [&] { scene.set_pose(id, pose); }, reason, element,
                   named);
  }

  void expect_accepted(const Pose<Scalar>& pose) {
    const InstanceResult result = scene.try_add(floor, pose);
    ASSERT_TRUE(result) << result.error().what();
    scene.remove(result.id());
  }

  /// Returns the name that an entry of [linear | translation] has in a message.
  static std::string name_of(int element) {
    const std::string row = std::to_string(element / 4);
    const int column = element % 4;
    return column < 3 ? "linear(" + row + ", " + std::to_string(column) + ")" : "translation[" + row + "]";
  }

  /// Returns an entry of [linear | translation].
  static Scalar& entry(Pose<Scalar>& pose, int element) {
    const int column = element % 4;
    return column < 3 ? pose.linear(element / 4, column) : pose.translation[element / 4];
  }

  /// The determinant as floating point has it.
  static Scalar rounded_determinant(const Pose<Scalar>& pose) {
    const auto& m = pose.linear;
    const Scalar x = m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1);
    const Scalar y = m(1, 2) * m(2, 0) - m(1, 0) * m(2, 2);
    const Scalar z = m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0);
    return m(0, 0) * x + m(0, 1) * y + m(0, 2) * z;
  }

  std::shared_ptr<Collider<Scalar>> floor = stack_collider<Scalar>(1);
  Scene<Scalar> scene;
  InstanceId id = scene.add(floor, {}, {.mask = 3});
};
TYPED_TEST_SUITE(InvalidInstanceOf, Scalars, ScalarNames);

TYPED_TEST(InvalidInstanceOf, null_collider) {
  const std::shared_ptr<const Collider<TypeParam>> none;
  this->expect_refused([&] { return this->scene.try_add(none); }, [&] { this->scene.add(none); }, Reason::no_collider,
                       0, "collider");
  this->expect_refused([&] { return this->scene.try_set_collider(this->id, none); },
                       [&] { this->scene.set_collider(this->id, none); }, Reason::no_collider, 0, "collider");
}

TEST(InvalidInstance, null_collider_of_floats_in_a_scene_of_doubles) {
  Scened scene;
  const auto result = scene.try_add(std::shared_ptr<const Colliderf>());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().reason, Reason::no_collider);
  const auto id = scene.add(stack_collider<float>(1));
  const auto kept = scene.try_set_collider(id, std::shared_ptr<const Colliderf>());
  ASSERT_FALSE(kept);
  EXPECT_EQ(kept.error().reason, Reason::no_collider);
  EXPECT_EQ(scene.triangle_count(id), 1U);
}

TYPED_TEST(InvalidInstanceOf, entry_of_a_pose_that_is_not_finite) {
  for (int element = 0; element < 12; ++element) {
    for (const TypeParam bad :
         {TestFixture::Limits::quiet_NaN(), TestFixture::Limits::infinity(), -TestFixture::Limits::infinity()}) {
      Pose<TypeParam> pose;
      this->entry(pose, element) = bad;
      this->expect_refused(pose, Reason::non_finite_pose, static_cast<std::size_t>(element), this->name_of(element));
    }
  }
}

TYPED_TEST(InvalidInstanceOf, first_of_several_entries_is_named) {
  Pose<TypeParam> pose;
  this->entry(pose, 9) = this->entry(pose, 6) = TestFixture::Limits::quiet_NaN();
  this->expect_refused(pose, Reason::non_finite_pose, 6);
  pose = {};
  this->entry(pose, 9) = this->entry(pose, 6) = TypeParam{0x1p65F};
  this->expect_refused(pose, Reason::pose_out_of_range, 6);
}

TYPED_TEST(InvalidInstanceOf, entry_of_a_matrix_that_is_out_of_range) {
  for (const int element : {0, 1, 2, 4, 5, 6, 8, 9, 10}) {
    for (const TypeParam size :
         {TypeParam{0x1p-65F}, TypeParam{0x1p65F}, neighbour(TypeParam{0x1p-64F}, -1), neighbour(TypeParam{0x1p64F}, 1),
          TestFixture::Limits::denorm_min(), TestFixture::Limits::max()}) {
      for (const TypeParam bad : {size, -size}) {
        Pose<TypeParam> pose;
        this->entry(pose, element) = bad;
        this->expect_refused(pose, Reason::pose_out_of_range, static_cast<std::size_t>(element),
                             this->name_of(element));
      }
    }
  }
}

TYPED_TEST(InvalidInstanceOf, ends_of_the_range_are_in_it) {
  for (const int element : {0, 1, 2, 4, 5, 6, 8, 9, 10}) {
    for (const TypeParam size : {TypeParam{0x1p-64F}, TypeParam{0x1p64F}, TypeParam{-0x1p64F}}) {
      Pose<TypeParam> pose;
      this->entry(pose, element) = size;
      this->expect_accepted(pose);
    }
  }
}

TYPED_TEST(InvalidInstanceOf, translation_has_no_range) {
  for (const TypeParam size : {TestFixture::Limits::max(), TestFixture::Limits::denorm_min(), TypeParam{-0.0}}) {
    this->expect_accepted(Pose<TypeParam>::translated({size, -size, size}));
  }
}

TYPED_TEST(InvalidInstanceOf, singular_matrix) {
  this->expect_refused(with_rows<TypeParam>({0, 0, 0}, {0, 0, 0}, {0, 0, 0}), Reason::singular_pose, 0);
  this->expect_refused(with_rows<TypeParam>({1, 0, 0}, {0, 1, 0}, {0, 0, 0}), Reason::singular_pose, 0);
  this->expect_refused(with_rows<TypeParam>({1, 2, 3}, {4, 5, 6}, {7, 8, 9}), Reason::singular_pose, 0);
}

TYPED_TEST(InvalidInstanceOf, singular_matrix_whose_rounded_determinant_is_not_zero) {
  Random random(3);
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    // A row is the sum of the others. None of these numbers is rounded, as they have some bits to spare.
    const auto draw = [&] { return static_cast<TypeParam>(random.between(-(1 << 21), 1 << 21)) / (1 << 20); };
    Pose<TypeParam> pose;
    for (int column = 0; column < 3; ++column) {
      pose.linear(0, column) = std::is_same_v<TypeParam, float> ? draw() : draw() + draw() * TypeParam{0x1p-28F};
      pose.linear(1, column) = std::is_same_v<TypeParam, float> ? draw() : draw() + draw() * TypeParam{0x1p-28F};
    }
    pose.linear.row(2) = pose.linear.row(0) + pose.linear.row(1);
    ASSERT_EQ(exact_determinant(pose), 0);
    if (this->rounded_determinant(pose) == 0) continue;
    this->expect_refused(pose, Reason::singular_pose, 0);
    ++found;
  }
  EXPECT_GE(found, 50);
}

TYPED_TEST(InvalidInstanceOf, matrix_whose_rounded_determinant_is_zero_but_not_the_exact_one) {
  const TypeParam above = neighbour(TypeParam{1}, 1);
  const TypeParam below = 2 - above;
  // (1 + ulp)(1 - ulp) - 1
  const auto pose = with_rows<TypeParam>({above, 1, 0}, {1, below, 0}, {0, 0, 1});
  ASSERT_EQ(this->rounded_determinant(pose), 0);
  this->expect_accepted(pose);
  // Its determinant is 2^-192, which is no float that is not 0.
  const TypeParam tiny{0x1p-64F};
  this->expect_accepted(with_rows<TypeParam>({tiny, 0, 0}, {0, tiny, 0}, {0, 0, tiny}));
  // Its determinant is 2^192.
  const TypeParam huge{0x1p64F};
  this->expect_accepted(with_rows<TypeParam>({huge, 0, 0}, {0, huge, 0}, {0, 0, huge}));
  // The products cancel, except for the smallest.
  this->expect_accepted(with_rows<TypeParam>({huge, huge, 0}, {huge, huge, tiny}, {tiny, 0, 0}));
}

TYPED_TEST(InvalidInstanceOf, motion_that_is_not_finite) {
  for (int axis = 0; axis < 3; ++axis) {
    Vector3<TypeParam> motion{0, 0, 0};
    motion[axis] = TestFixture::Limits::infinity();
    motion[2] = TestFixture::Limits::quiet_NaN();
    this->expect_refused([&] { return this->scene.try_set_motion(this->id, motion); },
                         [&] { this->scene.set_motion(this->id, motion); }, Reason::non_finite_motion,
                         static_cast<std::size_t>(axis), "motion");
  }
}

TYPED_TEST(InvalidInstanceOf, stale_id) {
  const InstanceId stale{this->id.index, this->id.generation + 1};
  this->expect_refused([&] { return this->scene.try_remove(stale); }, [&] { this->scene.remove(stale); },
                       Reason::stale_id, stale.index, std::to_string(stale.index));
  const InstanceId unknown{1234, 0};
  this->expect_refused([&] { return this->scene.try_set_mask(unknown, 1); }, [&] { this->scene.set_mask(unknown, 1); },
                       Reason::stale_id, 1234, "1234");
}

TYPED_TEST(InvalidInstanceOf, committed_state_stays_through_failures) {
  this->scene.commit();
  const auto path = through_stack<TypeParam>(4, -4);
  const auto before = this->scene.first_hit(path);
  Pose<TypeParam> pose;
  pose.linear.setZero();
  EXPECT_FALSE(this->scene.try_add(this->floor, pose));
  EXPECT_FALSE(this->scene.try_set_pose(this->id, pose));
  this->scene.commit();
  EXPECT_EQ(this->scene.first_hit(path), before);
  EXPECT_EQ(this->scene.instance_count(), 1U);
}

}  // namespace
}  // namespace surehit::test::invalid_instance_test
