#pragma once

#include <span>

#include "byte_source.hpp"
#include "surehit/path.hpp"

namespace surehit::test {

/// A number where arithmetic is hard: small integers and fractions, powers of two, denormals, the largest, the least
/// and those beside 1; or any bits at all, which may be no finite number.
template <typename Scalar>
[[nodiscard]] Scalar read_number(ByteSource& bytes);

/// Moves one of the points as the next bytes say, to where it coincides with others or nearly does: on their
/// coordinates, on their lines, in their planes, or ulps beside; or moves all of them together. A move that overflows
/// is left out. There is a point at least, and no more than 256.
template <typename Scalar>
void edit_points(ByteSource& bytes, std::span<Vector3<Scalar>* const> points);

}  // namespace surehit::test
