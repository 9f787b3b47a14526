#pragma once

#include <cstddef>
#include <cstdint>

#include "c/arguments.hpp"
#include "c/values.hpp"
#include "surehit/path_span.hpp"
#include "surehit/vertex_view.hpp"

namespace surehit::c {

/// The paths of a batch of C.
template <typename Scalar>
class AskedPaths {
 public:
  using CPaths = typename Structs<Scalar>::Paths;

  /// Checks the paths.
  AskedPaths(Arguments& arguments, const CPaths* paths) {
    arguments.check_pointer(paths, "paths");
    if (!arguments.are_valid()) return;
    given_ = *paths;
    arguments.check_value(given_.kind, 3, 0, "paths.kind");
    const bool is_packed = given_.towards == nullptr;
    if (given_.start_stride == 0) given_.start_stride = (is_packed ? 6 : 3) * sizeof(Scalar);
    if (is_packed) given_.toward_stride = given_.start_stride;
    if (given_.toward_stride == 0) given_.toward_stride = 3 * sizeof(Scalar);
    check_points(arguments, given_.starts, given_.start_stride, "paths.starts");
    if (!is_packed) check_points(arguments, given_.towards, given_.toward_stride, "paths.towards");
    if (is_packed && arguments.are_valid() && given_.count != 0) given_.towards = given_.starts + 3;
  }

  /// Returns the number of paths.
  [[nodiscard]] std::size_t size() const { return given_.count; }
  /// Returns the paths, which must be valid.
  [[nodiscard]] PathSpan<Scalar> span() const {
    const auto starts = VertexView<Scalar>::strided(given_.starts, given_.count, given_.start_stride);
    const auto towards = VertexView<Scalar>::strided(given_.towards, given_.count, given_.toward_stride);
    switch (given_.kind) {
      case SUREHIT_RAY:
        return PathSpan<Scalar>::rays(starts, towards);
      case SUREHIT_LINE:
        return PathSpan<Scalar>::lines(starts, towards);
      default:
        return PathSpan<Scalar>::segments(starts, towards);
    }
  }

 private:
  void check_points(Arguments& arguments, const Scalar* first, std::size_t stride, const char* name) const {
    arguments.check_array(first, given_.count, stride, name);
    if (stride < 3 * sizeof(Scalar)) {
      arguments.refuse(SUREHIT_INVALID_VALUE, 0, "%s of %zu bytes lie %zu bytes apart", name, 3 * sizeof(Scalar),
                       stride);
    }
  }

  CPaths given_ = {};
};

}  // namespace surehit::c
