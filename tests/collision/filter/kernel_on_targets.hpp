#pragma once

#include <cstddef>
#include <cstdint>

#include "filter/kernel_path.hpp"

namespace surehit::test {

/// `detail::TriangleList`, whatever the instruction set is.
template <typename Scalar>
struct KernelTriangles {
  const Scalar* corners;
  std::size_t count;
  Scalar edge_size;
};

/// What the kernel says of a list's triangles, a bit for each.
struct KernelVerdicts {
  std::uint64_t possible;
  std::uint64_t certain;
};

/// And of certain hits, which may be the first one, and where that is.
template <typename Scalar>
struct KernelFirst {
  std::uint64_t lanes;
  Scalar t_lower;
  Scalar t_upper;
};

/// `detail::classify` on the instruction set that is chosen at the moment.
template <typename Scalar>
[[nodiscard]] KernelVerdicts classify(const detail::KernelPath<Scalar>& path, const detail::RangeWeights<Scalar>& range,
                                      const KernelTriangles<Scalar>& list, std::size_t from);

/// `detail::first_of` there.
template <typename Scalar>
[[nodiscard]] KernelFirst<Scalar> first_of(const detail::KernelPath<Scalar>& path,
                                           const detail::RangeWeights<Scalar>& range,
                                           const KernelTriangles<Scalar>& list, std::size_t from, std::uint64_t certain,
                                           Scalar limit);

/// `detail::BlockKernel::first_of_one` there, of one lane.
template <typename Scalar>
[[nodiscard]] KernelFirst<Scalar> first_of_one(const detail::KernelPath<Scalar>& path,
                                               const detail::RangeWeights<Scalar>& range,
                                               const KernelTriangles<Scalar>& list, std::size_t from, std::size_t lane);

/// What the kernel says of some lanes in double.
template <typename Scalar>
struct KernelInDouble {
  KernelVerdicts verdicts;
  KernelFirst<Scalar> first;
};

/// `detail::classify_in_double` there.
[[nodiscard]] KernelInDouble<float> classify_in_double(const detail::KernelPath<double>& path,
                                                       const detail::PathRange<float>& range,
                                                       const KernelTriangles<float>& list, std::size_t from,
                                                       std::uint64_t lanes, double limit);

/// Triangles that they take at once.
template <typename Scalar>
[[nodiscard]] std::size_t kernel_lanes();

}  // namespace surehit::test
