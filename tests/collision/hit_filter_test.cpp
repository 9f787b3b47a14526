#include "surehit/hit_filter.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <type_traits>

#include "support/scalars.hpp"

namespace surehit::test::hit_filter_test {
namespace {

template <typename Scalar>
class HitFilterOf : public testing::Test {};
TYPED_TEST_SUITE(HitFilterOf, Scalars, ScalarNames);

TYPED_TEST(HitFilterOf, lambda_sees_the_hit) {
  const Hit<TypeParam> shown{.t = TypeParam{0.5}, .u = TypeParam{0.25}, .v = 0, .triangle = 7, .side = Side::back};
  Hit<TypeParam> seen;
  const auto remember = [&](const Hit<TypeParam>& hit) {
    seen = hit;
    return true;
  };
  EXPECT_TRUE(HitFilter<TypeParam>(remember)(shown));
  EXPECT_EQ(seen, shown);
  EXPECT_FALSE(HitFilter<TypeParam>([](const Hit<TypeParam>&) { return false; })({}));
}

TYPED_TEST(HitFilterOf, callable_is_referred_to_and_not_copied) {
  struct Counter {
    int calls = 0;
    bool operator()(const Hit<TypeParam>&) { return ++calls > 1; }
  };
  Counter counter;
  const HitFilter<TypeParam> filter(counter);
  const HitFilter<TypeParam> copy = filter;
  EXPECT_FALSE(filter({}));
  EXPECT_TRUE(copy({}));
  EXPECT_EQ(counter.calls, 2);
}

TYPED_TEST(HitFilterOf, constant_callable) {
  const std::function<bool(const Hit<TypeParam>&)> even = [](const Hit<TypeParam>& hit) {
    return hit.triangle % 2 == 0;
  };
  const HitFilter<TypeParam> filter(even);
  EXPECT_TRUE(filter({.triangle = 4}));
  EXPECT_FALSE(filter({.triangle = 5}));
}

template <typename Scalar>
bool is_front(const Hit<Scalar>& hit) {
  return hit.side == Side::front;
}

TYPED_TEST(HitFilterOf, function_pointer) {
  bool (*const pointer)(const Hit<TypeParam>&) = is_front<TypeParam>;
  const HitFilter<TypeParam> filter(pointer);
  EXPECT_TRUE(filter({.side = Side::front}));
  EXPECT_FALSE(filter({.side = Side::back}));
}

TYPED_TEST(HitFilterOf, result_that_converts_to_bool) {
  EXPECT_TRUE(HitFilter<TypeParam>([](const Hit<TypeParam>& hit) -> const Hit<TypeParam>* { return &hit; })({}));
  EXPECT_FALSE(HitFilter<TypeParam>([](const Hit<TypeParam>&) { return 0; })({}));
}

TYPED_TEST(HitFilterOf, what_cannot_be_called_with_a_hit_is_none) {
  const auto of_int = [](int*) { return true; };
  const auto of_nothing = [] { return true; };
  static_assert(!std::is_convertible_v<decltype(of_int), HitFilter<TypeParam>>);
  static_assert(!std::is_convertible_v<decltype(of_nothing), HitFilter<TypeParam>>);
  static_assert(!std::is_convertible_v<int, HitFilter<TypeParam>>);
  const auto of_hit = [](const Hit<TypeParam>&) { return true; };
  static_assert(std::is_convertible_v<decltype(of_hit), HitFilter<TypeParam>>);
  static_assert(std::is_trivially_copyable_v<HitFilter<TypeParam>>);
}

}  // namespace
}  // namespace surehit::test::hit_filter_test
