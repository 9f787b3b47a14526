#include "scene/committed_scene.hpp"

namespace surehit::detail {

template <FloatOrDouble Scalar>
CommittedShare<Scalar>::CommittedShare(const CommittedShare& other) noexcept : shared_(other.shared_) {
  if (shared_ != nullptr) shared_->shares.fetch_add(1, std::memory_order_relaxed);
}

template <FloatOrDouble Scalar>
CommittedShare<Scalar>::~CommittedShare() {
  // What this thread has read comes before the change or the end of it in another thread.
  if (shared_ != nullptr && shared_->shares.fetch_sub(1, std::memory_order_acq_rel) == 1) delete shared_;
}

template class CommittedShare<float>;
template class CommittedShare<double>;

}  // namespace surehit::detail
