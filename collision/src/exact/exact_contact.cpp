#include "exact/exact_contact.hpp"

#include <cmath>
#include <limits>

#include "exact/exact_pair.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// Returns whether compact integers hold a path, its triangles and the begin of its range.
template <typename Scalar>
bool are_compact(const Scale<Scalar>& scale, const PathRange<Scalar>& range) {
  return scale.is_compact() &&
         (range.first == -PathRange<Scalar>::infinity || Limit<Scalar>(range.first, scale.t_exponent).is_compact());
}

template <typename Size, typename Scalar>
[[gnu::noinline]] std::optional<Contact> find_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                                      const Scale<Scalar>& scale, const PathRange<Scalar>& range) {
  typename ExactPair<Scalar, Size>::Parameter t;
  std::optional<Contact> contact = ExactPair<Scalar, Size>(path, triangle, scale).find(range, t, nullptr);
  if (contact) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    // The nearest double is at most half an ulp from the exact t, so its neighbours enclose it.
    const double nearest = rounded_quotient<double>(t.num, t.den, scale.t_exponent);
    contact->t_lower = std::nextafter(nearest, -infinity);
    contact->t_upper = std::nextafter(nearest, infinity);
  }
  return contact;
}

template <typename Size, typename Scalar>
[[gnu::noinline]] void round_hit(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const Scale<Scalar>& scale,
                                 const PathRange<Scalar>& range, Hit<Scalar>& hit) {
  typename ExactPair<Scalar, Size>::Parameter t;
  Weights<Scalar> weights;
  if (!ExactPair<Scalar, Size>(path, triangle, scale).find(range, t, &weights)) return;
  hit.t = rounded_quotient<Scalar>(t.num, t.den, scale.t_exponent);
  hit.u = weights.u;
  hit.v = weights.v;
}

template <typename Size, typename Scalar>
[[gnu::noinline]] void find_parameter(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                      const Scale<Scalar>& scale, const PathRange<Scalar>& range,
                                      typename ExactPair<Scalar, Size>::Parameter& t) {
  static_cast<void>(ExactPair<Scalar, Size>(path, triangle, scale).find(range, t, nullptr));
}

template <typename Size, typename Scalar>
[[gnu::noinline]] int compare_contacts(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                       const Triangle<Scalar>& other, const Scale<Scalar>& scale,
                                       const PathRange<Scalar>& range) {
  typename ExactPair<Scalar, Size>::Parameter t;
  typename ExactPair<Scalar, Size>::Parameter other_t;
  find_parameter<Size>(path, triangle, scale, range, t);
  find_parameter<Size>(path, other, scale, range, other_t);
  return compare(t, other_t);
}

}  // namespace

template <typename Scalar>
std::optional<Contact> exact_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                     const PathRange<Scalar>& range) {
  const Scale<Scalar> scale(path, triangle);
  return are_compact(scale, range) ? find_contact<CompactSize>(path, triangle, scale, range)
                                   : find_contact<AnySize<Scalar>>(path, triangle, scale, range);
}

template <typename Scalar>
bool try_compact_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const PathRange<Scalar>& range,
                         std::optional<Contact>& contact) {
  const Scale<Scalar> scale(path, triangle);
  if (!are_compact(scale, range)) return false;
  contact = find_contact<CompactSize>(path, triangle, scale, range);
  return true;
}

template <typename Scalar>
void exact_rounding(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const PathRange<Scalar>& range,
                    Hit<Scalar>& hit) {
  const Scale<Scalar> scale(path, triangle);
  if (are_compact(scale, range)) {
    round_hit<CompactSize>(path, triangle, scale, range, hit);
  } else {
    round_hit<AnySize<Scalar>>(path, triangle, scale, range, hit);
  }
}

template <typename Scalar>
std::strong_ordering exact_order(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                 const Triangle<Scalar>& other, const PathRange<Scalar>& range) {
  const Scale<Scalar> scale(path, triangle, other);
  return (are_compact(scale, range) ? compare_contacts<CompactSize>(path, triangle, other, scale, range)
                                    : compare_contacts<AnySize<Scalar>>(path, triangle, other, scale, range)) <=> 0;
}

template <typename Scalar>
Vector3<Scalar> exact_point(const Path<Scalar>& path, Scalar t) {
  using B = Bits<AnySize<Scalar>>;
  Vector3<Scalar> result;
  const Decomposed<Scalar> parts(t);
  for (int i = 0; i < 3; ++i) {
    // Let t = m 2^k. If k < 0, the point is (start 2^-k + m d) / 2^-k. Otherwise it is start + m 2^k d.
    // All coordinates are integers here, so each numerator is exact.
    BinaryUnit unit;
    unit.include(path.start);
    unit.include(path.toward);
    if (unit.exponent == std::numeric_limits<int>::max()) unit.exponent = 0;
    WideInt<B::difference> start;
    WideInt<B::difference> d;
    set_integer(start, path.start[i], unit);
    set_integer(d, path.toward[i], unit);
    if (path.kind == PathKind::segment) d.add(start, true);
    WideInt<2 * B::difference + 64> sum =
        d * WideInt<B::coordinate>::shifted(parts.significand, std::max(parts.exponent, 0), parts.negative);
    const auto scale = WideInt<B::coordinate>::power_of_two(std::max(-parts.exponent, 0));
    sum.add(start * scale);
    result[i] = rounded_quotient<Scalar>(sum, scale, unit.exponent);
  }
  return result;
}

template <typename Scalar>
Vector3<double> exact_cross(const Triangle<Scalar>& triangle) {
  using B = Bits<AnySize<Scalar>>;
  BinaryUnit unit;
  unit.include(triangle);
  if (unit.exponent == std::numeric_limits<int>::max()) unit.exponent = 0;
  Differences<AnySize<Scalar>> e1;
  Differences<AnySize<Scalar>> e2;
  set_difference(e1, triangle.b, triangle.a, unit);
  set_difference(e2, triangle.c, triangle.a, unit);
  IntVector<WideInt<B::cross>> cross;
  set_cross(cross, e1, e2);
  const int exponent = -std::max({cross[0].bit_length(), cross[1].bit_length(), cross[2].bit_length()});
  const auto one = WideInt<1>::power_of_two(0);
  return {rounded_quotient<double>(cross[0], one, exponent), rounded_quotient<double>(cross[1], one, exponent),
          rounded_quotient<double>(cross[2], one, exponent)};
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                                   \
  template std::optional<Contact> exact_contact(const Path<Scalar>&, const Triangle<Scalar>&,                         \
                                                const PathRange<Scalar>&);                                            \
  template bool try_compact_contact(const Path<Scalar>&, const Triangle<Scalar>&, const PathRange<Scalar>&,           \
                                    std::optional<Contact>&);                                                         \
  template void exact_rounding(const Path<Scalar>&, const Triangle<Scalar>&, const PathRange<Scalar>&, Hit<Scalar>&); \
  template std::strong_ordering exact_order(const Path<Scalar>&, const Triangle<Scalar>&, const Triangle<Scalar>&,    \
                                            const PathRange<Scalar>&);                                                \
  template Vector3<Scalar> exact_point(const Path<Scalar>&, Scalar);                                                  \
  template Vector3<double> exact_cross(const Triangle<Scalar>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
