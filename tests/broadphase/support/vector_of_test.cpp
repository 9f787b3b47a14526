#include "support/vector_of.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "support/case_count.hpp"
#include "support/random.hpp"

namespace surehit::test::vector_of_test {
namespace {

using detail::PortableVector;
using detail::VectorOf;

/// Draws a number of any kind: any bits of an integer, any finite or infinite number.
template <typename T>
T draw(Random& random) {
  if constexpr (std::is_floating_point_v<T>) {
    if (random.one_in(16)) return random.one_in(2) ? std::numeric_limits<T>::infinity() : T{-0.0};
    return random.one_in(2) ? random.any_finite<T>() : random.symmetric<T>();
  } else {
    return static_cast<T>(random.bits());
  }
}

/// The portable vector and the compiler's own, with the same lanes.
template <typename T, std::size_t count>
struct Pair {
  explicit Pair(Random& random) {
    for (std::size_t lane = 0; lane < count; ++lane) portable[lane] = native[lane] = draw<T>(random);
  }
  PortableVector<T, count> portable = {};
  VectorOf<T, count> native = {};
};

/// Returns true if all bits agree. A number that is not one may have any sign and payload.
template <typename Portable, typename Native>
bool agree(const Portable& portable, const Native& native) {
  for (std::size_t lane = 0; lane < sizeof(portable) / sizeof(portable[0]); ++lane) {
    const auto x = portable[lane];
    const auto y = native[lane];
    static_assert(sizeof x == sizeof y);
    if (x != x && y != y) continue;
    if (std::memcmp(&x, &y, sizeof x) != 0) return false;
  }
  return sizeof portable == sizeof native;
}

template <typename Vector>
class VectorOfLanes : public testing::Test {
 protected:
  using T = typename Vector::Lane;
  static constexpr std::size_t count = sizeof(Vector) / sizeof(T);

  template <typename Check>
  void for_each_pair(Check&& check) {
    Random random(5);
    for (std::size_t i = case_count(2'000); i > 0 && !this->HasFailure(); --i) {
      Pair<T, count> x(random);
      const Pair<T, count> y(random);
      if (random.one_in(4)) x.portable[0] = x.native[0] = y.portable[0];
      check(x, y);
    }
  }
};

using Vectors =
    testing::Types<PortableVector<float, 4>, PortableVector<double, 4>, PortableVector<std::int32_t, 4>,
                   PortableVector<std::int64_t, 4>, PortableVector<std::uint8_t, 16>, PortableVector<std::uint64_t, 2>>;
TYPED_TEST_SUITE(VectorOfLanes, Vectors);

TYPED_TEST(VectorOfLanes, compare_and_choose) {
  this->for_each_pair([](const auto& x, const auto& y) {
    EXPECT_TRUE(agree(x.portable < y.portable, x.native < y.native));
    EXPECT_TRUE(agree(x.portable > y.portable, x.native > y.native));
    EXPECT_TRUE(agree(x.portable <= y.portable, x.native <= y.native));
    EXPECT_TRUE(agree(x.portable >= y.portable, x.native >= y.native));
    EXPECT_TRUE(agree(x.portable == y.portable, x.native == y.native));
    EXPECT_TRUE(agree(x.portable != y.portable, x.native != y.native));
    EXPECT_TRUE(agree(choose(x.portable < y.portable, x.portable, y.portable),
                      detail::choose(x.native < y.native, x.native, y.native)));
    EXPECT_TRUE(agree(lesser(x.portable, y.portable), detail::lesser(x.native, y.native)));
    EXPECT_TRUE(agree(greater(x.portable, y.portable), detail::greater(x.native, y.native)));
  });
}

TYPED_TEST(VectorOfLanes, add_and_multiply) {
  this->for_each_pair([](auto& x, const auto& y) {
    using T = typename TypeParam::Lane;
    EXPECT_TRUE(agree(x.portable + y.portable, x.native + y.native));
    EXPECT_TRUE(agree(x.portable - y.portable, x.native - y.native));
    EXPECT_TRUE(agree(x.portable * y.portable, x.native * y.native));
    EXPECT_TRUE(agree(-x.portable, -x.native));
    EXPECT_TRUE(agree(x.portable + T{3}, x.native + T{3}));
    EXPECT_TRUE(agree(T{3} - x.portable, T{3} - x.native));
    if constexpr (std::is_floating_point_v<T>) {
      EXPECT_TRUE(agree(x.portable / y.portable, x.native / y.native));
      EXPECT_TRUE(agree(1 / x.portable, 1 / x.native));
    }
    x.portable += y.portable;
    x.native += y.native;
    EXPECT_TRUE(agree(x.portable, x.native));
    x.portable *= T{3};
    x.native *= T{3};
    EXPECT_TRUE(agree(x.portable, x.native));
    x.portable -= y.portable;
    x.native -= y.native;
    EXPECT_TRUE(agree(x.portable, x.native));
  });
}

TYPED_TEST(VectorOfLanes, combine_bits) {
  if constexpr (std::is_integral_v<typename TypeParam::Lane>) {
    this->for_each_pair([](const auto& x, const auto& y) {
      using T = typename TypeParam::Lane;
      EXPECT_TRUE(agree(x.portable & y.portable, x.native & y.native));
      EXPECT_TRUE(agree(x.portable | y.portable, x.native | y.native));
      EXPECT_TRUE(agree(x.portable ^ y.portable, x.native ^ y.native));
      EXPECT_TRUE(agree(~x.portable, ~x.native));
      EXPECT_TRUE(agree(x.portable & T{5}, x.native & T{5}));
      const auto counts = y.portable & T{7};
      const auto native_counts = y.native & T{7};
      EXPECT_TRUE(agree(x.portable << counts, x.native << native_counts));
      EXPECT_TRUE(agree(x.portable >> counts, x.native >> native_counts));
      EXPECT_TRUE(agree(x.portable << T{4}, x.native << T{4}));
      EXPECT_TRUE(agree(x.portable >> T{4}, x.native >> T{4}));
    });
  }
}

TEST(VectorOf, lanes_are_shuffled_and_converted) {
  Random random(6);
  for (std::size_t i = case_count(2'000); i > 0; --i) {
    const Pair<float, 4> x(random);
    const Pair<float, 4> y(random);
    ASSERT_TRUE(
        agree(detail::shuffled<3, 4, 0, 6>(x.portable, y.portable), detail::shuffled<3, 4, 0, 6>(x.native, y.native)));
    ASSERT_TRUE(agree(detail::converted<PortableVector<double, 4>>(x.portable),
                      detail::converted<VectorOf<double, 4>>(x.native)));
    ASSERT_TRUE(agree(detail::with_bits_of<PortableVector<std::uint8_t, 16>>(x.portable),
                      detail::with_bits_of<VectorOf<std::uint8_t, 16>>(x.native)));
    const Pair<std::int32_t, 4> whole(random);
    ASSERT_TRUE(agree(detail::converted<PortableVector<float, 4>>(whole.portable),
                      detail::converted<VectorOf<float, 4>>(whole.native)));
    const PortableVector<float, 4> moderate = detail::converted<PortableVector<float, 4>>(whole.portable) / 2.5F;
    const auto native_moderate = detail::converted<VectorOf<float, 4>>(whole.native) / 2.5F;
    ASSERT_TRUE(agree(detail::converted<PortableVector<std::int32_t, 4>>(moderate),
                      detail::converted<VectorOf<std::int32_t, 4>>(native_moderate)));
    const Pair<double, 4> wide(random);
    ASSERT_TRUE(agree(detail::converted<PortableVector<float, 4>>(wide.portable),
                      detail::converted<VectorOf<float, 4>>(wide.native)));
  }
}

}  // namespace
}  // namespace surehit::test::vector_of_test
