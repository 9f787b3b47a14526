#pragma once

#include <cstdint>
#include <limits>

#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

namespace detail {
/// A constant and not a call, with which GCC 12 fails to compile a list of options.
template <typename Scalar>
inline constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
}  // namespace detail

/// Which hits a query leaves out by the side that the path arrives from.
enum class Culling : std::uint8_t {
  none,   ///< keep all
  back,   ///< keep `front` hits alone
  front,  ///< keep `back` hits alone
};

/// What narrows a query. The defaults leave nothing out.
template <FloatOrDouble Scalar>
struct QueryOptions {
  /// The path is cut to the parameters in [min_t, max_t], both ends included, compared exactly. A segment or a ray is
  /// never lengthened by it. NaN admits nothing. A path of no length is there at t = 0 alone. To keep a hit that is
  /// known, take `max_t_keeping` for max_t: hit.t is rounded and may lose it.
  Scalar min_t = -detail::infinity<Scalar>;
  Scalar max_t = detail::infinity<Scalar>;
  Culling culling = Culling::none;
  std::uint32_t mask = ~std::uint32_t{0};        ///< a triangle takes part if it shares a bit with this
  std::uint32_t ignored_triangle = no_triangle;  ///< never hit
  /// Leave out the triangles that contain the start of the segment, or the origin of the ray, exactly. The path may
  /// then leave through the triangle on which it starts. A line has no start. `min_t` does not move the start.
  bool ignore_start_contact = false;
  /// Leave out the triangles that contain the end of the segment exactly. Only a segment ends. `max_t` does not move
  /// the end.
  bool ignore_end_contact = false;
};

using QueryOptionsf = QueryOptions<float>;
using QueryOptionsd = QueryOptions<double>;

}  // namespace surehit
