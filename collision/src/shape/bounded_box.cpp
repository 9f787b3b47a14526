#include "shape/bounded_box.hpp"

// All pairs are left to the integers.

namespace surehit::detail {

template <typename Scalar>
Verdict bounded_contact(const SweptBox<Scalar>&, const Triangle<Scalar>&, BoxContact&) {
  return Verdict::undecided;
}
template <typename Scalar>
bool try_round(const SweptBox<Scalar>&, const Triangle<Scalar>&, const BoxContact&, ShapeHit<Scalar>&) {
  return false;
}
template Verdict bounded_contact(const SweptBox<float>&, const Triangle<float>&, BoxContact&);
template Verdict bounded_contact(const SweptBox<double>&, const Triangle<double>&, BoxContact&);
template bool try_round(const SweptBox<float>&, const Triangle<float>&, const BoxContact&, ShapeHit<float>&);
template bool try_round(const SweptBox<double>&, const Triangle<double>&, const BoxContact&, ShapeHit<double>&);

}  // namespace surehit::detail
