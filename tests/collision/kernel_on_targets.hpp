#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel_path.hpp"

namespace surehit::test {

/// What the kernel says of a list's triangles, a bit for each.
struct KernelVerdicts {
  std::uint64_t possible;
  std::uint64_t certain;
};

/// `detail::classify` on the instruction set that is chosen at the moment.
template <typename Scalar>
[[nodiscard]] KernelVerdicts classify(const detail::KernelPath<Scalar>& path, const Scalar* list, std::size_t pitch,
                                      std::size_t count, Scalar edge_size);

/// Triangles that it takes at once.
template <typename Scalar>
[[nodiscard]] std::size_t kernel_lanes();

}  // namespace surehit::test
