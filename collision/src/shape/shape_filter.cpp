#include "shape/shape_filter.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "support/rounding_flags.hpp"

// This file is compiled once for each instruction set. The best one is chosen when the first list is asked.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/shape_filter.cpp"
#include <hwy/foreach_target.h>
// This header must come after foreach_target.h.
#include "shape/filter_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Calls `use(lanes, numbers)` with the numbers of a shape. `lanes` only says which type of `FilterLanes` it has.
template <typename Scalar, typename Number, typename Use>
HWY_INLINE auto with_lanes(Core core, const ShapeNumbers<Number>& numbers, const Use& use) {
  switch (core) {
    case Core::box:
      return use(FilterLanes<Scalar, Number, Core::box>(), numbers);
    case Core::segment:
      return use(FilterLanes<Scalar, Number, Core::segment>(), numbers);
    case Core::point:
      break;
  }
  return use(FilterLanes<Scalar, Number, Core::point>(), numbers);
}
template <typename Scalar, typename Use>
HWY_INLINE auto with_lanes(const ShapeFilter<Scalar>& shape, const Use& use) {
  if constexpr (std::is_same_v<Scalar, float>) {
    if (shape.fits_float) return with_lanes<float>(shape.core, shape.floats, use);
  }
  return with_lanes<Scalar>(shape.core, shape.doubles, use);
}

template <typename Scalar>
HWY_INLINE std::uint64_t find(const ShapeFilter<Scalar>& shape, const Scalar* corners, std::size_t count,
                              std::size_t from, double limit, double* enters) {
  return with_lanes(shape, [&]<typename Lanes>(Lanes, const auto& numbers)
                               HWY_ATTR { return Lanes::find(numbers, corners, count, from, limit, enters); });
}
template <typename Scalar>
HWY_INLINE std::size_t find_near(std::span<ShapeList<Scalar>> lists, std::span<NearTriangles> near) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    if (lists[i].from >= lists[i].last) continue;  // The filter of a shape that is done is gone.
    with_lanes(*lists[i].filter, [&]<typename Lanes>(Lanes, const auto& numbers)
                                     HWY_ATTR { Lanes::find_near(numbers, lists[i], i, near, count); });
  }
  return count;
}
template <typename Scalar>
HWY_INLINE std::uint64_t find_times(const ShapeList<Scalar>& list, const NearTriangles& near, double limit,
                                    double* enters) {
  return with_lanes(*list.filter, [&]<typename Lanes>(Lanes, const auto& numbers)
                                      HWY_ATTR { return Lanes::find_times(numbers, list, near, limit, enters); });
}

std::uint64_t find_floats(const ShapeFilter<float>& shape, const float* corners, std::size_t count, std::size_t from,
                          double limit, double* enters) {
  return find(shape, corners, count, from, limit, enters);
}
std::uint64_t find_doubles(const ShapeFilter<double>& shape, const double* corners, std::size_t count, std::size_t from,
                           double limit, double* enters) {
  return find(shape, corners, count, from, limit, enters);
}
std::size_t find_near_floats(std::span<ShapeList<float>> lists, std::span<NearTriangles> near) {
  return find_near(lists, near);
}
std::size_t find_near_doubles(std::span<ShapeList<double>> lists, std::span<NearTriangles> near) {
  return find_near(lists, near);
}
std::uint64_t find_times_floats(const ShapeList<float>& list, const NearTriangles& near, double limit, double* enters) {
  return find_times(list, near, limit, enters);
}
std::uint64_t find_times_doubles(const ShapeList<double>& list, const NearTriangles& near, double limit,
                                 double* enters) {
  return find_times(list, near, limit, enters);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(find_floats);
HWY_EXPORT(find_doubles);
HWY_EXPORT(find_near_floats);
HWY_EXPORT(find_near_doubles);
HWY_EXPORT(find_times_floats);
HWY_EXPORT(find_times_doubles);

template <>
std::uint64_t ShapeFilter<float>::find(const float* corners, std::size_t count, std::size_t from, double limit,
                                       Times& enters) const {
  return HWY_DYNAMIC_DISPATCH(find_floats)(*this, corners, count, from, limit, enters.data());
}
template <>
std::uint64_t ShapeFilter<double>::find(const double* corners, std::size_t count, std::size_t from, double limit,
                                        Times& enters) const {
  return HWY_DYNAMIC_DISPATCH(find_doubles)(*this, corners, count, from, limit, enters.data());
}

template <>
std::size_t ShapeFilter<float>::find_near(std::span<ShapeList<float>> lists, std::span<NearTriangles> near) {
  return HWY_DYNAMIC_DISPATCH(find_near_floats)(lists, near);
}
template <>
std::size_t ShapeFilter<double>::find_near(std::span<ShapeList<double>> lists, std::span<NearTriangles> near) {
  return HWY_DYNAMIC_DISPATCH(find_near_doubles)(lists, near);
}
template <>
std::uint64_t ShapeFilter<float>::find_times(const ShapeList<float>& list, const NearTriangles& near, double limit,
                                             double* enters) const {
  return HWY_DYNAMIC_DISPATCH(find_times_floats)(list, near, limit, enters);
}
template <>
std::uint64_t ShapeFilter<double>::find_times(const ShapeList<double>& list, const NearTriangles& near, double limit,
                                              double* enters) const {
  return HWY_DYNAMIC_DISPATCH(find_times_doubles)(list, near, limit, enters);
}

}  // namespace surehit::detail
#endif
