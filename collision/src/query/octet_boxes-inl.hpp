// The boxes around the octets of a list, against a path. Highway compiles this for each instruction set.

#if defined(SUREHIT_OCTET_BOXES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_OCTET_BOXES_INL
#undef SUREHIT_OCTET_BOXES_INL
#else
#define SUREHIT_OCTET_BOXES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "filter/block_kernel-inl.hpp"
#include "filter/kernel_path.hpp"
#include "mesh/mesh_blocks.hpp"
#include "support/lane_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The maximum number of octets that one call of `octets_met` looks at.
inline constexpr std::size_t max_octets = 8;

/// Returns the boxes of a list's octets. Returns null if the list is short, because a look at the boxes would then take
/// longer than it saves.
template <typename Scalar>
HWY_INLINE const Scalar* boxes_of(const MeshBlocks<Scalar>& mesh, std::size_t first_entry, std::size_t count) {
  constexpr std::size_t min_vectors = 4;
  const bool is_long = count >= min_vectors * hn::Lanes(hn::ScalableTag<Scalar>());
  return is_long ? mesh.octet_boxes(first_entry, count) : nullptr;
}

/// Returns a mask with a bit for each octet of a vector of triangles. Bit 0 is for the octet of the first one.
HWY_INLINE std::uint64_t octets_of_lanes(std::size_t lanes) {
  constexpr std::size_t octet = MeshBlocks<float>::octet;
  return (std::uint64_t{1} << (lanes + octet - 1) / octet) - 1;
}

/// Returns a mask with a bit for each octet that the path may meet at a t in [first, last]. Bit 0 is for the octet that
/// begins with triangle `from` of the list, which must have boxes. All bits are set if sizes might overflow. The start
/// of the path must not have been moved.
///
/// O1. A contact with a triangle of the octet at t, first <= t <= last, makes the octet's bit 1.
/// Proof. The contact lies in the box of the octet, whose coordinates are exact. On an axis where the exact D is 0, its
///     coordinate is that of the start, and both are compared without error. The computed D is 0 there and nowhere
///     else. On an axis with |D| >= 2^-60, the path is at a plane p of the box at x = (p - start) / D. The computed x
///     takes two differences, a quotient and a product. Each has a relative error of at most u = 2^-24, and what
///     underflows in the product is at most 2^-149. So |x - computed x| <= 5 u |computed x| + 2^-148. Nothing
///     overflows. Let L = `KernelBound::largest_size` = 2^34. Starts and first corners are at most L/2, and edges at
///     most L. So |p - start| <= 2 L, and its product with 1/D is below 2^96. The widening is 8 u |computed x| +
///     2^-120. It grows with x no faster than x does, so it may follow after all axes. It has room for its own
///     rounding, and for the 1 u by which a limit that was rounded to `last` may be too low. Axes with a smaller D are
///     left out.
HWY_INLINE std::uint64_t octets_met(const KernelPath<float>& path, const TriangleList<float>& list, std::size_t from,
                                    float first, float last) {
  constexpr float min_d = 0x1p-60F;
  constexpr std::size_t octet = MeshBlocks<float>::octet;
  const std::size_t box_count = list.count / octet;
  const std::size_t from_box = std::min(from / octet, box_count - 1);
  const std::size_t count = std::min(box_count - from_box, max_octets);
  // The triangles after the last whole octet have the box of the one before them.
  const std::uint64_t after_last = from_box + count == box_count ? ~std::uint64_t{0} << count : 0;
  if (!(std::isfinite(list.edge_size) && std::isfinite(path.d_size))) return ~std::uint64_t{0};
  const hn::CappedTag<float, max_octets> d;
  const auto all = [&](float x) { return hn::Set(d, x); };
  std::array<float, 3> inverse;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    inverse[axis] = std::fabs(path.d[axis]) >= min_d ? 1 / path.d[axis] : 0;
  }
  std::uint64_t met = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto enters = all(-std::numeric_limits<float>::infinity());
    auto leaves = all(std::numeric_limits<float>::infinity());
    auto beside = hn::FirstN(d, 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float* const boxes = list.boxes + from_box + i;
      const auto low = hn::LoadU(d, boxes + axis * box_count);
      const auto high = hn::LoadU(d, boxes + (3 + axis) * box_count);
      const auto start = all(path.start[axis]);
      if (inverse[axis] != 0) {
        const auto at_low = hn::Mul(hn::Sub(low, start), all(inverse[axis]));
        const auto at_high = hn::Mul(hn::Sub(high, start), all(inverse[axis]));
        enters = hn::Max(enters, hn::Min(at_low, at_high));
        leaves = hn::Min(leaves, hn::Max(at_low, at_high));
      } else if (path.d[axis] == 0) {
        beside = hn::Or(beside, hn::Or(hn::Lt(high, start), hn::Gt(low, start)));
      }
    }
    const auto widening = [&](auto x) { return hn::MulAdd(hn::Abs(x), all(0x1p-21F), all(0x1p-120F)); };
    enters = hn::Max(hn::Sub(enters, widening(enters)), all(first));
    leaves = hn::Min(hn::Add(leaves, widening(leaves)), all(last));
    met |= bits_of(d, hn::Not(hn::Or(beside, hn::Gt(enters, leaves)))) << i;
  }
  met &= (std::uint64_t{1} << count) - 1;
  return (met >> (count - 1) & 1) != 0 ? met | after_last : met;
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
