#include "kernel_on_targets.hpp"

// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel_on_targets.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.h.
#include "block_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

#define SUREHIT_DEFINE(Scalar)                                                                                  \
  test::KernelVerdicts verdicts_##Scalar(const KernelPath<Scalar>& path, const Scalar* list, std::size_t pitch, \
                                         std::size_t count, Scalar edge_size) {                                 \
    const Lanes lanes = classify(path, list, pitch, count, edge_size);                                          \
    return {lanes.possible, lanes.certain};                                                                     \
  }                                                                                                             \
  std::size_t lanes_##Scalar() { return hn::Lanes(hn::ScalableTag<Scalar>()); }
SUREHIT_DEFINE(float)
SUREHIT_DEFINE(double)
#undef SUREHIT_DEFINE

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

#define SUREHIT_EXPORT(Scalar)                                                                                   \
  HWY_EXPORT(verdicts_##Scalar);                                                                                 \
  HWY_EXPORT(lanes_##Scalar);                                                                                    \
  auto chosen_verdicts(const KernelPath<Scalar>& path, const Scalar* list, std::size_t pitch, std::size_t count, \
                       Scalar edge_size) {                                                                       \
    return HWY_DYNAMIC_DISPATCH(verdicts_##Scalar)(path, list, pitch, count, edge_size);                         \
  }                                                                                                              \
  auto chosen_lanes(Scalar) { return HWY_DYNAMIC_DISPATCH(lanes_##Scalar)(); }
SUREHIT_EXPORT(float)
SUREHIT_EXPORT(double)
#undef SUREHIT_EXPORT

}  // namespace surehit::detail

namespace surehit::test {

template <typename Scalar>
KernelVerdicts classify(const detail::KernelPath<Scalar>& path, const Scalar* list, std::size_t pitch,
                        std::size_t count, Scalar edge_size) {
  return detail::chosen_verdicts(path, list, pitch, count, edge_size);
}

template <typename Scalar>
std::size_t kernel_lanes() {
  return detail::chosen_lanes(Scalar{});
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                            \
  template KernelVerdicts classify(const detail::KernelPath<Scalar>&, const Scalar*, std::size_t, std::size_t, \
                                   Scalar);                                                                    \
  template std::size_t kernel_lanes<Scalar>();
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
#endif
