#include "character/bullet_capsule_sweep.hpp"

namespace surehit::example {

std::unique_ptr<const CapsuleSweep> make_bullet_capsule_sweep(const Mesh<float>&, const BulletOptions&) {
  return nullptr;
}

}  // namespace surehit::example
