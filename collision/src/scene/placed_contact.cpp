#include "scene/placed_contact.hpp"

#include <cmath>

#include "filter/double_kernel-inl.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// A vector of one lane, since a scene has one pair at a time here.
using PairLane = hn::CappedTag<double, 1>;

/// Returns a vector of three doubles, or of three Scalars.
template <typename Vector>
HWY_NAMESPACE::Vectors<PairLane> in_pair_lane(const Vector& x) {
  const PairLane d;
  return {hn::Set(d, double{x[0]}), hn::Set(d, double{x[1]}), hn::Set(d, double{x[2]})};
}

}  // namespace

template <typename Scalar>
BoundedContact placed_contact(const PlacedPath<Scalar>& path, bool is_mirrored, const Triangle<Scalar>& local) {
  BoundedContact result;
  if (path.status != PlacedPath<Scalar>::Status::near) return result;
  const PairLane d;
  constexpr double eps = 0x1p-53;
  const double moved_t = path.moved.moved_t;
  const HWY_NAMESPACE::PathSlack<PairLane> slack{hn::Set(d, path.start_error / (8 * eps)),
                                                 hn::Set(d, path.direction_error / (8 * eps))};
  const HWY_NAMESPACE::DoubleDeterminants<PairLane> of(d, in_pair_lane(path.moved.start),
                                                       in_pair_lane(path.moved.direction), in_pair_lane(local.a),
                                                       in_pair_lane(local.b), in_pair_lane(local.c), slack);
  const auto number = [](auto lane) { return hn::GetLane(lane); };
  const auto bounded = [&](double value, double sizes) { return Bounded{value, number(of.radius(hn::Set(d, sizes)))}; };
  const double det = number(of.det), u = number(of.u), v = number(of.v);
  const double det_size = number(of.det_size), u_size = number(of.u_size), v_size = number(of.v_size);
  const Bounded bounded_det = bounded(det, det_size);
  const Bounded w = bounded(det - u - v, det_size + u_size + v_size);
  result.u_scaled = bounded(u, u_size);
  result.v_scaled = bounded(v, v_size);
  bool any_positive = false;
  bool any_negative = false;
  bool all_certain = true;
  for (const Bounded& side : {result.u_scaled, result.v_scaled, w}) {
    any_positive |= side.value > side.radius;
    any_negative |= side.value < -side.radius;
    all_certain &= std::fabs(side.value) > side.radius;
  }
  if (any_positive && any_negative) {  // BN5
    result.verdict = Verdict::miss;
    return result;
  }
  if (!all_certain || !(std::fabs(det) > bounded_det.radius)) return result;
  // By BN6, the path's line meets the inside of the triangle. The interval of t decides the rest.
  result.by_det = BoundedQuotients(bounded_det);
  auto [lower, upper] = result.by_det.of(bounded(number(of.height), number(of.height_size)));
  const auto rounding = [&](double t) { return (std::fabs(t) + std::fabs(moved_t)) * 0x1p-51; };
  lower += moved_t - rounding(lower);
  upper += moved_t + rounding(upper);
  if (!std::isfinite(lower) || !std::isfinite(upper)) return result;
  const PathRange<Scalar>& range = path.scene_path.range;
  if (lower > double{range.last} || upper < double{range.first}) {
    result.verdict = Verdict::miss;
    return result;
  }
  if (lower < double{range.first} || upper > double{range.last}) return result;
  const Path<Scalar>& scene_path = path.scene_path.path;
  if ((scene_path.has_start() && !(lower > 0)) || (scene_path.has_end() && !(upper < 1))) return result;
  result.verdict = Verdict::hit;
  result.contact.t_lower = lower;
  result.contact.t_upper = upper;
  result.contact.side = (det > 0) != is_mirrored ? Side::front : Side::back;
  return result;
}

template BoundedContact placed_contact(const PlacedPath<float>&, bool, const Triangle<float>&);
template BoundedContact placed_contact(const PlacedPath<double>&, bool, const Triangle<double>&);

}  // namespace surehit::detail
