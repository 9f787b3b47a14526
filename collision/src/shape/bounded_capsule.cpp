#include "shape/bounded_capsule.hpp"

#include "support/rounding_flags.hpp"

namespace surehit::detail {

template <typename Scalar>
Verdict bounded_contact(const SweptCapsule<Scalar>&, const Triangle<Scalar>&, CapsuleContact&) {
  return Verdict::undecided;
}

template <typename Scalar>
bool try_round(const SweptCapsule<Scalar>&, const Triangle<Scalar>&, const CapsuleContact&, ShapeHit<Scalar>&) {
  return false;
}

template Verdict bounded_contact(const SweptCapsule<float>&, const Triangle<float>&, CapsuleContact&);
template Verdict bounded_contact(const SweptCapsule<double>&, const Triangle<double>&, CapsuleContact&);
template bool try_round(const SweptCapsule<float>&, const Triangle<float>&, const CapsuleContact&, ShapeHit<float>&);
template bool try_round(const SweptCapsule<double>&, const Triangle<double>&, const CapsuleContact&, ShapeHit<double>&);

}  // namespace surehit::detail
