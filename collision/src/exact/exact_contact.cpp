#include "exact/exact_contact.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

#include "exact/exact_pair.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// Returns whether compact integers hold a path, its triangles and the begin of its range.
template <typename Scalar>
bool are_compact(const Scale<Scalar>& scale, const PathRange<Scalar>& range) {
  return scale.is_compact() &&
         (range.first == -PathRange<Scalar>::infinity || Limit<Scalar>(range.first, scale.t_exponent).is_compact());
}

template <typename Size, typename Scalar, typename AnyTriangle>
SUREHIT_NOINLINE std::optional<Contact> find_contact(const Path<Scalar>& path, const AnyTriangle& triangle,
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

template <typename Size, typename Scalar, typename AnyTriangle>
SUREHIT_NOINLINE void round_hit(const Path<Scalar>& path, const AnyTriangle& triangle, const Scale<Scalar>& scale,
                                const PathRange<Scalar>& range, Hit<Scalar>& hit) {
  typename ExactPair<Scalar, Size>::Parameter t;
  Weights<Scalar> weights;
  if (!ExactPair<Scalar, Size>(path, triangle, scale).find(range, t, &weights)) return;
  hit.t = rounded_quotient<Scalar>(t.num, t.den, scale.t_exponent);
  hit.u = weights.u;
  hit.v = weights.v;
}

template <typename Size, typename Scalar, typename AnyTriangle>
SUREHIT_NOINLINE void find_parameter(const Path<Scalar>& path, const AnyTriangle& triangle, const Scale<Scalar>& scale,
                                     const PathRange<Scalar>& range, typename ExactPair<Scalar, Size>::Parameter& t) {
  static_cast<void>(ExactPair<Scalar, Size>(path, triangle, scale).find(range, t, nullptr));
}

template <typename Size, typename Scalar, typename AnyTriangle>
SUREHIT_NOINLINE int compare_contacts(const Path<Scalar>& path, const AnyTriangle& triangle, const AnyTriangle& other,
                                      const Scale<Scalar>& scale, const PathRange<Scalar>& range) {
  typename ExactPair<Scalar, Size>::Parameter t;
  typename ExactPair<Scalar, Size>::Parameter other_t;
  find_parameter<Size>(path, triangle, scale, range, t);
  find_parameter<Size>(path, other, scale, range, other_t);
  return compare(t, other_t);
}

/// The integers for any triangle of a type.
template <typename AnyTriangle>
struct SizeFor;
template <typename Scalar>
struct SizeFor<Triangle<Scalar>> {
  using Type = AnySize<Scalar>;
};
template <typename Scalar>
struct SizeFor<PlacedTriangle<Scalar>> {
  using Type = PlacedSize<Scalar>;
};
template <typename AnyTriangle>
using LargeSize = typename SizeFor<AnyTriangle>::Type;

}  // namespace

template <typename Scalar, typename AnyTriangle>
std::optional<Contact> exact_contact(const Path<Scalar>& path, const AnyTriangle& triangle,
                                     const PathRange<Scalar>& range) {
  const Scale<Scalar> scale(path, triangle);
  return are_compact(scale, range) ? find_contact<CompactSize>(path, triangle, scale, range)
                                   : find_contact<LargeSize<AnyTriangle>>(path, triangle, scale, range);
}

template <typename Scalar, typename AnyTriangle>
bool try_compact_contact(const Path<Scalar>& path, const AnyTriangle& triangle, const PathRange<Scalar>& range,
                         std::optional<Contact>& contact) {
  const Scale<Scalar> scale(path, triangle);
  if (!are_compact(scale, range)) return false;
  contact = find_contact<CompactSize>(path, triangle, scale, range);
  return true;
}

template <typename Scalar, typename AnyTriangle>
void exact_rounding(const Path<Scalar>& path, const AnyTriangle& triangle, const PathRange<Scalar>& range,
                    Hit<Scalar>& hit) {
  const Scale<Scalar> scale(path, triangle);
  if (are_compact(scale, range)) {
    round_hit<CompactSize>(path, triangle, scale, range, hit);
  } else {
    round_hit<LargeSize<AnyTriangle>>(path, triangle, scale, range, hit);
  }
}

template <typename Scalar, typename AnyTriangle>
std::strong_ordering exact_order(const Path<Scalar>& path, const AnyTriangle& triangle, const AnyTriangle& other,
                                 const PathRange<Scalar>& range) {
  const Scale<Scalar> scale(path, triangle, other);
  return (are_compact(scale, range)
              ? compare_contacts<CompactSize>(path, triangle, other, scale, range)
              : compare_contacts<LargeSize<AnyTriangle>>(path, triangle, other, scale, range)) <=> 0;
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

namespace {

/// Returns a path that is a point, for a scale of a triangle alone.
template <typename Scalar>
Path<Scalar> no_path() {
  return Ray<Scalar>{Vector3<Scalar>::Zero(), Vector3<Scalar>::Zero()};
}

template <typename Scalar>
const Scalar& scalar_of(const Triangle<Scalar>& triangle) {
  return triangle.a[0];
}
template <typename Scalar>
const Scalar& scalar_of(const PlacedTriangle<Scalar>& triangle) {
  return triangle.local.a[0];
}

}  // namespace

template <typename AnyTriangle>
Vector3<double> exact_cross(const AnyTriangle& triangle) {
  using Scalar = std::remove_cvref_t<decltype(scalar_of(triangle))>;
  using Size = LargeSize<AnyTriangle>;
  const Path<Scalar> path = no_path<Scalar>();
  Differences<Size> s;
  Differences<Size> d;
  Differences<Size> e1;
  Differences<Size> e2;
  set_vectors(path, triangle, Scale<Scalar>(path, triangle), s, d, e1, e2);
  IntVector<WideInt<Bits<Size>::cross>> cross;
  set_cross(cross, e1, e2);
  const int exponent = -std::max({cross[0].bit_length(), cross[1].bit_length(), cross[2].bit_length()});
  const auto one = WideInt<1>::power_of_two(0);
  return {rounded_quotient<double>(cross[0], one, exponent), rounded_quotient<double>(cross[1], one, exponent),
          rounded_quotient<double>(cross[2], one, exponent)};
}

template <typename Scalar>
Triangle<Scalar> exact_corners(const PlacedTriangle<Scalar>& triangle) {
  const Path<Scalar> path = no_path<Scalar>();
  const Scale<Scalar> scale(path, triangle);
  const auto one = WideInt<1>::power_of_two(0);
  const auto corner = [&](const Vector3<Scalar>& local) -> Vector3<Scalar> {
    // S is the start less the first corner, and the start is zero here.
    const PlacedTriangle<Scalar> from{{local, triangle.local.b, triangle.local.c}, triangle.placement};
    Differences<PlacedSize<Scalar>> s;
    Differences<PlacedSize<Scalar>> d;
    Differences<PlacedSize<Scalar>> e1;
    Differences<PlacedSize<Scalar>> e2;
    set_vectors(path, from, scale, s, d, e1, e2);
    for (auto& x : s) x.negate();
    const int exponent = scale.points.exponent;
    return {rounded_quotient<Scalar>(s[0], one, exponent), rounded_quotient<Scalar>(s[1], one, exponent),
            rounded_quotient<Scalar>(s[2], one, exponent)};
  };
  return {corner(triangle.local.a), corner(triangle.local.b), corner(triangle.local.c)};
}

#define SUREHIT_INSTANTIATE(Scalar, AnyTriangle)                                                                    \
  template std::optional<Contact> exact_contact(const Path<Scalar>&, const AnyTriangle&, const PathRange<Scalar>&); \
  template bool try_compact_contact(const Path<Scalar>&, const AnyTriangle&, const PathRange<Scalar>&,              \
                                    std::optional<Contact>&);                                                       \
  template void exact_rounding(const Path<Scalar>&, const AnyTriangle&, const PathRange<Scalar>&, Hit<Scalar>&);    \
  template std::strong_ordering exact_order(const Path<Scalar>&, const AnyTriangle&, const AnyTriangle&,            \
                                            const PathRange<Scalar>&);                                              \
  template Vector3<double> exact_cross(const AnyTriangle&);
SUREHIT_INSTANTIATE(float, Triangle<float>)
SUREHIT_INSTANTIATE(double, Triangle<double>)
SUREHIT_INSTANTIATE(float, PlacedTriangle<float>)
SUREHIT_INSTANTIATE(double, PlacedTriangle<double>)
#undef SUREHIT_INSTANTIATE

template Vector3<float> exact_point(const Path<float>&, float);
template Vector3<double> exact_point(const Path<double>&, double);
template Triangle<float> exact_corners(const PlacedTriangle<float>&);
template Triangle<double> exact_corners(const PlacedTriangle<double>&);

}  // namespace surehit::detail
