#include "kernel_on_targets.hpp"

// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collision/filter/kernel_on_targets.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.h.
#include "filter/block_kernel-inl.hpp"
#include "filter/classify_in_double-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

template <typename Scalar>
TriangleList<Scalar> list_of(const test::KernelTriangles<Scalar>& list) {
  return {list.corners, list.count, 0, list.edge_size};
}

template <typename Scalar>
Verdicts verdicts_of(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,
                     const TriangleList<Scalar>& list, std::size_t from) {
  using Kernel = BlockKernel<Scalar>;
  return classify<Kernel>(path, range, list, Kernel::bounds(path, range, list), from);
}

template <typename Scalar>
FirstLanes<Scalar> first_lanes_of(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,
                                  const TriangleList<Scalar>& list, std::size_t from, std::uint64_t certain,
                                  Scalar limit) {
  using Kernel = BlockKernel<Scalar>;
  return Kernel::first_of(Kernel::bounds(path, range, list), Kernel(path, list, from).crossing(), certain, limit);
}

template <typename Scalar>
FirstLanes<Scalar> first_of_one_on(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,
                                   const TriangleList<Scalar>& list, std::size_t from, std::size_t lane) {
  using Kernel = BlockKernel<Scalar>;
  const typename Kernel::Crossing crossing = Kernel(path, list, from).crossing();
  return Kernel::first_of_one(Kernel::bounds(path, range, list), hn::ExtractLane(crossing.height, lane),
                              hn::ExtractLane(crossing.det, lane), std::uint64_t{1} << lane);
}

test::KernelInDouble<float> in_double(const KernelPath<double>& path, const PathRange<float>& range,
                                      const test::KernelTriangles<float>& list, std::size_t from, std::uint64_t lanes,
                                      double limit) {
  FirstLanes<float> first;
  const Verdicts verdicts = classify_in_double(path, range, list_of(list), from, lanes, limit, first);
  return {{verdicts.possible, verdicts.certain}, {first.lanes, first.t_lower, first.t_upper}};
}

#define SUREHIT_DEFINE(Scalar)                                                                                       \
  test::KernelVerdicts verdicts_##Scalar(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,          \
                                         const test::KernelTriangles<Scalar>& list, std::size_t from) {              \
    const Verdicts verdicts = verdicts_of<Scalar>(path, range, list_of(list), from);                                 \
    return {verdicts.possible, verdicts.certain};                                                                    \
  }                                                                                                                  \
  test::KernelFirst<Scalar> first_##Scalar(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,        \
                                           const test::KernelTriangles<Scalar>& list, std::size_t from,              \
                                           std::uint64_t certain, Scalar limit) {                                    \
    const auto first = first_lanes_of(path, range, list_of(list), from, certain, limit);                             \
    return {first.lanes, first.t_lower, first.t_upper};                                                              \
  }                                                                                                                  \
  test::KernelFirst<Scalar> first_of_one_##Scalar(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range, \
                                                  const test::KernelTriangles<Scalar>& list, std::size_t from,       \
                                                  std::size_t lane) {                                                \
    const auto first = first_of_one_on(path, range, list_of(list), from, lane);                                      \
    return {first.lanes, first.t_lower, first.t_upper};                                                              \
  }                                                                                                                  \
  std::size_t lanes_##Scalar() { return hn::Lanes(hn::ScalableTag<Scalar>()); }
SUREHIT_DEFINE(float)
SUREHIT_DEFINE(double)
#undef SUREHIT_DEFINE

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

#define SUREHIT_EXPORT(Scalar)                                                                              \
  HWY_EXPORT(verdicts_##Scalar);                                                                            \
  HWY_EXPORT(first_##Scalar);                                                                               \
  HWY_EXPORT(first_of_one_##Scalar);                                                                        \
  HWY_EXPORT(lanes_##Scalar);                                                                               \
  auto chosen_verdicts(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,                   \
                       const test::KernelTriangles<Scalar>& list, std::size_t from) {                       \
    return HWY_DYNAMIC_DISPATCH(verdicts_##Scalar)(path, range, list, from);                                \
  }                                                                                                         \
  auto chosen_first(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,                      \
                    const test::KernelTriangles<Scalar>& list, std::size_t from, std::uint64_t certain,     \
                    Scalar limit) {                                                                         \
    return HWY_DYNAMIC_DISPATCH(first_##Scalar)(path, range, list, from, certain, limit);                   \
  }                                                                                                         \
  auto chosen_first_of_one(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,               \
                           const test::KernelTriangles<Scalar>& list, std::size_t from, std::size_t lane) { \
    return HWY_DYNAMIC_DISPATCH(first_of_one_##Scalar)(path, range, list, from, lane);                      \
  }                                                                                                         \
  auto chosen_lanes(Scalar) { return HWY_DYNAMIC_DISPATCH(lanes_##Scalar)(); }
SUREHIT_EXPORT(float)
SUREHIT_EXPORT(double)
#undef SUREHIT_EXPORT

HWY_EXPORT(in_double);
auto chosen_in_double(const KernelPath<double>& path, const PathRange<float>& range,
                      const test::KernelTriangles<float>& list, std::size_t from, std::uint64_t lanes, double limit) {
  return HWY_DYNAMIC_DISPATCH(in_double)(path, range, list, from, lanes, limit);
}

}  // namespace surehit::detail

namespace surehit::test {

template <typename Scalar>
KernelVerdicts classify(const detail::KernelPath<Scalar>& path, const detail::RangeWeights<Scalar>& range,
                        const KernelTriangles<Scalar>& list, std::size_t from) {
  return detail::chosen_verdicts(path, range, list, from);
}

template <typename Scalar>
KernelFirst<Scalar> first_of(const detail::KernelPath<Scalar>& path, const detail::RangeWeights<Scalar>& range,
                             const KernelTriangles<Scalar>& list, std::size_t from, std::uint64_t certain,
                             Scalar limit) {
  return detail::chosen_first(path, range, list, from, certain, limit);
}

template <typename Scalar>
KernelFirst<Scalar> first_of_one(const detail::KernelPath<Scalar>& path, const detail::RangeWeights<Scalar>& range,
                                 const KernelTriangles<Scalar>& list, std::size_t from, std::size_t lane) {
  return detail::chosen_first_of_one(path, range, list, from, lane);
}

KernelInDouble<float> classify_in_double(const detail::KernelPath<double>& path, const detail::PathRange<float>& range,
                                         const KernelTriangles<float>& list, std::size_t from, std::uint64_t lanes,
                                         double limit) {
  return detail::chosen_in_double(path, range, list, from, lanes, limit);
}

template <typename Scalar>
std::size_t kernel_lanes() {
  return detail::chosen_lanes(Scalar{});
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                                 \
  template KernelVerdicts classify(const detail::KernelPath<Scalar>&, const detail::RangeWeights<Scalar>&,          \
                                   const KernelTriangles<Scalar>&, std::size_t);                                    \
  template KernelFirst<Scalar> first_of(const detail::KernelPath<Scalar>&, const detail::RangeWeights<Scalar>&,     \
                                        const KernelTriangles<Scalar>&, std::size_t, std::uint64_t, Scalar);        \
  template KernelFirst<Scalar> first_of_one(const detail::KernelPath<Scalar>&, const detail::RangeWeights<Scalar>&, \
                                            const KernelTriangles<Scalar>&, std::size_t, std::size_t);              \
  template std::size_t kernel_lanes<Scalar>();
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
#endif
