#include "character/core_distance.hpp"

namespace surehit::example {

std::optional<bool> touches_exactly(const Vector3f&, const Vector3f&, const Trianglef&) { return std::nullopt; }

}  // namespace surehit::example
