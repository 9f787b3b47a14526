#include "visibility_bake/ranks.hpp"

namespace surehit::example {

Ranks::Ranks() = default;
Ranks::~Ranks() {}

bool Ranks::are_ready(const std::function<std::uint64_t()>& prepare) const {
  static_cast<void>(prepare());
  return true;
}

void Ranks::bake(const Colliderf& collider, const PairPlan& plan, const Checkpoint& checkpoint,
                 const BakeOptions& options, Visibility& visibility) const {
  example::bake(collider, plan, checkpoint, options, visibility);
}

}  // namespace surehit::example
