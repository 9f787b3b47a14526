// The last step to a hit, for the instruction set that Highway compiles this for.

#if defined(SUREHIT_HIT_ROUNDING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_HIT_ROUNDING_INL
#undef SUREHIT_HIT_ROUNDING_INL
#else
#define SUREHIT_HIT_ROUNDING_INL
#endif

#include <cstdint>

#include "double_kernel-inl.hpp"
#include "lane_bits-inl.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Hits of triangles that the paths are known to meet, one in each lane: t, u and v each in an interval, and rounded if
/// all of it rounds to the same float (Ziv 1991).
template <class D>
struct RoundedHits {
  using FloatTag = hn::Rebind<float, D>;
  using Floats = hn::Vec<FloatTag>;

  HWY_INLINE RoundedHits(D d, const Vectors<D>& start, const Vectors<D>& direction, const Vectors<D>& a,
                         const Vectors<D>& b, const Vectors<D>& c) {
    const DoubleDeterminants<D> of(d, start, direction, a, b, c);
    const auto det_radius = of.radius(of.det_size);
    const auto by_det = Quotients<D>::by(d, of.det, det_radius);
    rounded = bits_of(d, hn::Gt(hn::Abs(of.det), det_radius));
    front = bits_of(d, hn::Gt(of.det, hn::Zero(d)));
    const auto round = [&](hn::Vec<D> numerator, hn::Vec<D> sizes) {
      const FloatTag df;
      const auto interval = by_det.of(numerator, of.radius(sizes));
      const Floats upper = hn::Add(hn::DemoteTo(df, interval.upper), hn::Zero(df));  // a zero is +0
      rounded &= bits_of(df, hn::Eq(hn::DemoteTo(df, interval.lower), upper));
      return upper;
    };
    t = round(of.height, of.height_size);
    u = round(of.u, of.u_size);
    v = round(of.v, of.v_size);
  }

  Floats t, u, v;
  std::uint64_t rounded;  ///< lanes in which these are right
  std::uint64_t front;    ///< lanes whose path arrives in front
};

/// Of a triangle that the path is known to meet. All but its id.
HWY_INLINE bool try_round(const Path<float>& path, const Triangle<float>& triangle, Hit<float>& hit) {
  using Tag = hn::CappedTag<double, 1>;
  const Tag d;
  const auto lane_of = [&](const Vector3<float>& x) -> Vectors<Tag> {
    return {hn::Set(d, double{x[0]}), hn::Set(d, double{x[1]}), hn::Set(d, double{x[2]})};
  };
  const auto start = lane_of(path.start);
  auto direction = lane_of(path.toward);
  if (path.has_end()) {
    direction = {hn::Sub(direction.x, start.x), hn::Sub(direction.y, start.y), hn::Sub(direction.z, start.z)};
  }
  const RoundedHits<Tag> hits(d, start, direction, lane_of(triangle.a), lane_of(triangle.b), lane_of(triangle.c));
  hit.t = hn::GetLane(hits.t);
  hit.u = hn::GetLane(hits.u);
  hit.v = hn::GetLane(hits.v);
  hit.side = (hits.front & 1) != 0 ? Side::front : Side::back;
  return (hits.rounded & 1) != 0;
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
