#pragma once

#include <surehit/collider.hpp>

#include "character/capsule_sweep.hpp"

namespace surehit::example {

/// Asks the library. A body that starts free of contact stops free of contact, and so is all of the way to its stop.
///
/// The exact place of the stop is no position of floats, and a rounded one may touch what the exact one does not. So
/// `last_free_point` asks exact queries about rounded positions before it. If none is free, the body stays where it is.
class ExactCapsuleSweep : public CapsuleSweep {
 public:
  /// The collider must outlive this.
  explicit ExactCapsuleSweep(const Colliderf& collider) : collider_(collider) {}

  [[nodiscard]] std::optional<Stop> find_stop(const Vector3f& from, const Vector3f& to,
                                              std::size_t& queries) const override;

 private:
  const Colliderf& collider_;
};

}  // namespace surehit::example
