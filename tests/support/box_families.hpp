#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>

#include "support/random.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Kinds of moving boxes and triangles that are hard in different ways.
enum class BoxFamily : std::uint8_t {
  general,
  grazing,         ///< corners, edges and faces that meet in whole numbers, and slides along them
  beside_grazing,  ///< the same with one number moved by one ulp
  floors,          ///< triangles across an axis, and boxes that land on them, slide along them and stand on them
  starts_touching,
  inside,          ///< begins with the whole triangle in the box
  starts_grazing,  ///< begins with the contact of the grazing family
  small_steps,     ///< a thousandth of the triangle's size and less
  small_boxes,
  huge_boxes,
  far_away,
  slivers,
  degenerate_triangles,
  at_rest,
  flat_boxes,  ///< one or two half extents are zero
  no_extents,
  small_integers,
  mixed_magnitudes,  ///< from the least denormal to the largest number
};

inline constexpr std::array all_box_families = {
    BoxFamily::general,
    BoxFamily::grazing,
    BoxFamily::beside_grazing,
    BoxFamily::floors,
    BoxFamily::starts_touching,
    BoxFamily::inside,
    BoxFamily::starts_grazing,
    BoxFamily::small_steps,
    BoxFamily::small_boxes,
    BoxFamily::huge_boxes,
    BoxFamily::far_away,
    BoxFamily::slivers,
    BoxFamily::degenerate_triangles,
    BoxFamily::at_rest,
    BoxFamily::flat_boxes,
    BoxFamily::no_extents,
    BoxFamily::small_integers,
    BoxFamily::mixed_magnitudes,
};

[[nodiscard]] std::string name_of(BoxFamily family);
inline void PrintTo(BoxFamily family, std::ostream* out) { *out << name_of(family); }

template <typename Scalar>
struct BoxPair {
  SweptBox<Scalar> box;
  Triangle<Scalar> triangle;
};

/// The next finite pair of a family. Call it in the default floating-point environment: it then draws the same
/// everywhere.
template <typename Scalar>
[[nodiscard]] BoxPair<Scalar> draw_box_pair(BoxFamily family, Random& random);

}  // namespace surehit::test
