#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <type_traits>

#include "support/inlining.hpp"

namespace surehit::detail {

// Vectors with a fixed number of lanes: GNU's, which GCC and Clang compile for the vectors of any target, or a class
// that does the same lane by lane. SUREHIT_PORTABLE_CODE chooses the class everywhere, for the tests.

/// A vector with the operators of GNU's vectors. Integers wrap round. A comparison returns a mask, whose lanes are all
/// ones or zero.
template <typename T, std::size_t lane_count>
struct alignas(lane_count * sizeof(T)) PortableVector {
  using Lane = T;
  using Mask = PortableVector<
      std::conditional_t<sizeof(T) == 1, std::int8_t, std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>>,
      lane_count>;

  T lanes[lane_count];

  template <typename Index>
  [[nodiscard]] constexpr T& operator[](Index lane) {
    return lanes[static_cast<std::size_t>(lane)];
  }
  template <typename Index>
  [[nodiscard]] constexpr const T& operator[](Index lane) const {
    return lanes[static_cast<std::size_t>(lane)];
  }

  /// Returns f of each lane of x and the same lane of y.
  template <typename Result = PortableVector, typename F>
  [[nodiscard]] static constexpr Result of_lanes(const PortableVector& x, const PortableVector& y, F f) {
    Result result = {};
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      result.lanes[lane] = static_cast<typename Result::Lane>(f(x.lanes[lane], y.lanes[lane]));
    }
    return result;
  }
  [[nodiscard]] static constexpr PortableVector all(T x) {
    PortableVector result = {};
    for (T& lane : result.lanes) lane = x;
    return result;
  }

#define SUREHIT_LANE_OPERATOR(sign, Result, f)                                                  \
  friend constexpr Result operator sign(const PortableVector& x, const PortableVector& y) {     \
    return of_lanes<Result>(x, y, f);                                                           \
  }                                                                                             \
  friend constexpr Result operator sign(const PortableVector& x, T y) { return x sign all(y); } \
  friend constexpr Result operator sign(T x, const PortableVector& y) { return all(x) sign y; }

  SUREHIT_LANE_OPERATOR(+, PortableVector, [](T a, T b) { return Wrapping(a) + Wrapping(b); })
  SUREHIT_LANE_OPERATOR(-, PortableVector, [](T a, T b) { return Wrapping(a) - Wrapping(b); })
  SUREHIT_LANE_OPERATOR(*, PortableVector, [](T a, T b) { return Wrapping(a) * Wrapping(b); })
  SUREHIT_LANE_OPERATOR(/, PortableVector, [](T a, T b) { return a / b; })
  SUREHIT_LANE_OPERATOR(&, PortableVector, std::bit_and<T>())
  SUREHIT_LANE_OPERATOR(|, PortableVector, std::bit_or<T>())
  SUREHIT_LANE_OPERATOR(^, PortableVector, std::bit_xor<T>())
  SUREHIT_LANE_OPERATOR(<<, PortableVector, [](T a, T b) { return Wrapping(a) << b; })
  SUREHIT_LANE_OPERATOR(>>, PortableVector, [](T a, T b) { return a >> b; })
  SUREHIT_LANE_OPERATOR(<, Mask, [](T a, T b) { return a < b ? -1 : 0; })
  SUREHIT_LANE_OPERATOR(>, Mask, [](T a, T b) { return a > b ? -1 : 0; })
  SUREHIT_LANE_OPERATOR(<=, Mask, [](T a, T b) { return a <= b ? -1 : 0; })
  SUREHIT_LANE_OPERATOR(>=, Mask, [](T a, T b) { return a >= b ? -1 : 0; })
  SUREHIT_LANE_OPERATOR(==, Mask, [](T a, T b) { return a == b ? -1 : 0; })
  SUREHIT_LANE_OPERATOR(!=, Mask, [](T a, T b) { return a != b ? -1 : 0; })
#undef SUREHIT_LANE_OPERATOR

  friend constexpr PortableVector operator-(const PortableVector& x) {
    return of_lanes(x, x, [](T a, T) { return -Wrapping(a); });
  }
  friend constexpr PortableVector operator~(const PortableVector& x) {
    return of_lanes(x, x, [](T a, T) { return ~a; });
  }
  template <typename Other>
  constexpr PortableVector& operator+=(const Other& other) {
    return *this = *this + other;
  }
  template <typename Other>
  constexpr PortableVector& operator-=(const Other& other) {
    return *this = *this - other;
  }
  template <typename Other>
  constexpr PortableVector& operator*=(const Other& other) {
    return *this = *this * other;
  }

 private:
  /// Integers without a sign wrap round.
  struct Unsigned {
    using type = std::make_unsigned_t<std::conditional_t<std::is_integral_v<T>, T, int>>;
  };
  using Wrapping = std::conditional_t<std::is_integral_v<T>, typename Unsigned::type, T>;
};

/// Returns x where the mask's lanes are all ones, and y elsewhere.
template <typename T, std::size_t lane_count>
[[nodiscard]] constexpr PortableVector<T, lane_count> choose(const typename PortableVector<T, lane_count>::Mask& mask,
                                                             const PortableVector<T, lane_count>& x,
                                                             const PortableVector<T, lane_count>& y) {
  PortableVector<T, lane_count> result = y;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if (mask[lane] != 0) result[lane] = x[lane];
  }
  return result;
}

/// Returns the lesser of two lanes, in each lane. It is y's if they are not ordered.
template <typename T, std::size_t lane_count>
[[nodiscard]] constexpr PortableVector<T, lane_count> lesser(const PortableVector<T, lane_count>& x,
                                                             const PortableVector<T, lane_count>& y) {
  return choose(x < y, x, y);
}

/// Returns the greater of two lanes, in each lane. It is y's if they are not ordered.
template <typename T, std::size_t lane_count>
[[nodiscard]] constexpr PortableVector<T, lane_count> greater(const PortableVector<T, lane_count>& x,
                                                              const PortableVector<T, lane_count>& y) {
  return choose(x > y, x, y);
}

/// Returns the lanes with these indices. The lanes of y follow those of x.
template <int... indices, typename T, std::size_t lane_count>
[[nodiscard]] constexpr PortableVector<T, lane_count> shuffled(const PortableVector<T, lane_count>& x,
                                                               const PortableVector<T, lane_count>& y) {
  constexpr int count = static_cast<int>(lane_count);
  return {{(indices < count ? x[indices % count] : y[indices % count])...}};
}

/// Returns each lane as a lane of the other type. An integer is rounded toward zero, and is any integer for a number
/// that no integer can hold.
template <typename To, typename T, std::size_t lane_count>
[[nodiscard]] constexpr To converted(const PortableVector<T, lane_count>& x) {
  using Lane = typename To::Lane;
  To result = {};
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if constexpr (std::is_integral_v<Lane> && std::is_floating_point_v<T>) {
      constexpr T limit = -static_cast<T>(std::numeric_limits<Lane>::min());
      if (!(-limit <= x[lane] && x[lane] < limit)) continue;
    }
    result[lane] = static_cast<Lane>(x[lane]);
  }
  return result;
}

/// Returns the vector of the other type that has the same bits.
template <typename To, typename T, std::size_t lane_count>
[[nodiscard]] constexpr To with_bits_of(const PortableVector<T, lane_count>& x) {
  return std::bit_cast<To>(x);
}

#if defined(__GNUC__) && !defined(SUREHIT_PORTABLE_CODE)
#define SUREHIT_HAS_GNU_VECTORS 1

template <typename T, std::size_t lane_count>
struct GnuVector {
  typedef T Type __attribute__((vector_size(lane_count * sizeof(T))));
};
template <typename T, std::size_t lane_count>
using VectorOf = typename GnuVector<T, lane_count>::Type;

template <typename Mask, typename Vector>
SUREHIT_ALWAYS_INLINE inline Vector choose(Mask mask, Vector x, Vector y) {
  return mask ? x : y;
}

// A comparison that stays in one expression with the choice becomes one instruction.
template <typename Vector>
SUREHIT_ALWAYS_INLINE inline Vector lesser(Vector x, Vector y) {
  return x < y ? x : y;
}
template <typename Vector>
SUREHIT_ALWAYS_INLINE inline Vector greater(Vector x, Vector y) {
  return x > y ? x : y;
}

template <int... indices, typename Vector>
SUREHIT_ALWAYS_INLINE inline Vector shuffled(Vector x, Vector y) {
  return __builtin_shufflevector(x, y, indices...);
}

template <typename To, typename Vector>
SUREHIT_ALWAYS_INLINE inline To converted(Vector x) {
  return __builtin_convertvector(x, To);
}

template <typename To, typename Vector>
SUREHIT_ALWAYS_INLINE inline To with_bits_of(Vector x) {
  return reinterpret_cast<To>(x);
}

#else

template <typename T, std::size_t lane_count>
using VectorOf = PortableVector<T, lane_count>;

#endif

}  // namespace surehit::detail
