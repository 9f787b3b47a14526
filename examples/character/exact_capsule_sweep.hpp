#pragma once

#include <surehit/collider.hpp>

#include "character/capsule_sweep.hpp"

namespace surehit::example {

/// Asks the library. A body that starts free of contact stops free of contact, and so is all of the way to its stop.
///
/// The library says at which t the body is free for the last time. But a position is a float, so it is rounded, and
/// may touch what the exact point does not. So the rounded position is only proposed. A second exact query asks about
/// the way to it. If it touches something, the proposal moves off the surface by an ulp, then by two, and so on. If all
/// proposals touch something, the body stays where it is.
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
