// Masks as bits, for the instruction set that Highway compiles this for.

#if defined(SUREHIT_LANE_BITS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_LANE_BITS_INL
#undef SUREHIT_LANE_BITS_INL
#else
#define SUREHIT_LANE_BITS_INL
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Bit i is lane i.
template <typename D>
HWY_INLINE std::uint64_t bits_of(D d, hn::Mask<D> mask) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

template <typename D>
HWY_INLINE hn::Mask<D> mask_of(D d, std::uint64_t bits) {
  return hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&bits));
}

/// Stores those lanes of x that a mask has. The others must have a number in memory, which stays. A masked store of
/// AVX2 would take AMD's processors dozens of operations, so a number is loaded for each lane.
template <typename D>
HWY_INLINE void store_where(hn::Mask<D> mask, hn::Vec<D> x, D d, hn::TFromD<D>* to) {
#if HWY_TARGET <= HWY_AVX3
  hn::BlendedStore(x, mask, d, to);
#else
  hn::StoreU(hn::IfThenElse(mask, x, hn::LoadU(d, to)), d, to);
#endif
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
