#include <gtest/gtest.h>

#include <cstdint>

#include "hard_prop.hpp"
#include "hard_questions.hpp"
#include "hard_scene.hpp"
#include "saved_hash.hpp"
#include "support/instruction_sets.hpp"
#include "support/scalars.hpp"

namespace surehit::test::saved_determinism_test {
namespace {

/// The bytes of saved colliders and scenes.
template <typename Scalar>
class SavedDeterminism : public testing::Test {};
TYPED_TEST_SUITE(SavedDeterminism, Scalars, ScalarNames);

TYPED_TEST(SavedDeterminism, bytes_are_the_published_ones_on_every_instruction_set) {
  for (const std::int64_t target : instruction_sets()) {
    SCOPED_TRACE(name_of_instruction_set(target));
    const ForcedInstructionSet forced(target);
    EXPECT_EQ(saved_hash(HardQuestions<TypeParam>().collider()), published_saved_hash<TypeParam>);
    EXPECT_EQ(saved_hash(HardProp<TypeParam>().collider()), published_saved_prop_hash<TypeParam>);
    EXPECT_EQ(saved_hash(HardScene<TypeParam>().scene()), published_saved_scene_hash<TypeParam>);
  }
}

}  // namespace
}  // namespace surehit::test::saved_determinism_test
