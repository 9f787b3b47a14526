#pragma once

#include <cstdint>
#include <limits>

#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

namespace detail {
/// An infinity. It is a constant because GCC 12 fails to compile a list of options with a call.
template <typename Scalar>
inline constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
}  // namespace detail

/// Which hits a query leaves out because of their `Side`.
enum class Culling : std::uint8_t {
  none,   ///< The query keeps all hits.
  back,   ///< The query keeps only `front` hits. It leaves out `edge_on` too.
  front,  ///< The query keeps only `back` hits. It leaves out `edge_on` too.
};

/// What narrows a query. The defaults leave out only triangles whose mask is 0.
template <FloatOrDouble Scalar>
struct QueryOptions {
  /// The minimum t that counts. The path is cut to [min_t, max_t], both ends included, and exact t are compared with
  /// them. This never makes a path longer. With a NaN, nothing is hit. A path of length zero has t = 0 alone.
  Scalar min_t = -detail::infinity<Scalar>;
  /// The maximum t that counts, see `min_t`. To keep a known hit, set it to `max_t_keeping`. hit.t is rounded, and may
  /// lose the hit.
  Scalar max_t = detail::infinity<Scalar>;
  /// Leaves out hits by their side.
  Culling culling = Culling::none;
  std::uint32_t mask = ~std::uint32_t{0};        ///< Leaves out triangles whose mask shares no bit with this.
  std::uint32_t ignored_triangle = no_triangle;  ///< Leaves out this triangle.
  /// Leaves out triangles that exactly contain the start of the segment or the origin of the ray. So a path may leave
  /// the triangle on which it starts. A line has no start. `min_t` does not move the start.
  bool ignore_start_contact = false;
  /// Leaves out triangles that exactly contain the end of the segment. Rays and lines have no end. `max_t` does not
  /// move the end.
  bool ignore_end_contact = false;
};

using QueryOptionsf = QueryOptions<float>;   ///< Options of a query in float.
using QueryOptionsd = QueryOptions<double>;  ///< Options of a query in double.

}  // namespace surehit
