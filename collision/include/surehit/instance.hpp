#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "surehit/attributes.hpp"

namespace surehit {

/// The index of a default `InstanceId`, which no instance has.
inline constexpr std::uint32_t no_instance = ~std::uint32_t{0};

/// Names an instance of a scene. After the instance is removed, its index may come back with another generation. So an
/// old id is never that of another instance.
struct InstanceId {
  std::uint32_t index = no_instance;  ///< Ids with a low index come first among hits with equal exact t.
  std::uint32_t generation = 0;       ///< How often the index has been used before.

  /// Orders ids by index, and then by generation.
  friend auto operator<=>(const InstanceId&, const InstanceId&) = default;
};

/// What an instance has besides its collider and its pose.
struct InstanceOptions {
  std::uint32_t mask = ~std::uint32_t{0};  ///< For `SceneQueryOptions::instance_mask`. With 0 it is never hit.
  std::uint64_t user_data = 0;             ///< Any number of yours. No query reads it.
};

/// Why a scene refuses an instance or a change of one. `what()` says the same in one line.
///
/// `Scene::try_add` and its like return it. `Scene::add` and its like throw it, where exceptions are on.
class SUREHIT_API InvalidInstance : public std::runtime_error {
 public:
  /// What is invalid, and what `element` then means.
  enum class Reason : std::uint8_t {
    no_collider,         ///< The pointer to the collider is null. `element` is 0.
    non_finite_pose,     ///< A number is NaN or infinite. `element` is 4 row + column of [linear | translation].
    pose_out_of_range,   ///< An entry of `linear` is too small or too large. `element` is as above.
    singular_pose,       ///< The exact determinant of `linear` is 0. `element` is 0.
    non_finite_motion,   ///< A coordinate is NaN or infinite. `element` is its axis.
    stale_id,            ///< The instance was removed, or never added. `element` is the index.
    too_many_instances,  ///< All 2^31 - 1 indices are in use. `element` is the number of instances.
  };

  /// Sets both members. `what()` returns the message. May throw std::bad_alloc.
  InvalidInstance(Reason reason_given, std::size_t element_at_fault, const std::string& message)
      : std::runtime_error(message), reason(reason_given), element(element_at_fault) {}

  Reason reason;        ///< What is invalid.
  std::size_t element;  ///< The first invalid element. `Reason` says which.
};

/// The result of a change of a scene: the id of the instance, or the reason of a failure. It is true on success.
class [[nodiscard]] InstanceResult {
 public:
  /// Makes a success.
  InstanceResult(InstanceId id) noexcept : id_(id) {}
  /// Makes a failure.
  InstanceResult(InvalidInstance error) : error_(std::move(error)) {}

  /// Returns true if the change succeeded.
  [[nodiscard]] bool has_value() const noexcept { return !error_.has_value(); }
  /// Returns true if the change succeeded.
  [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }
  /// Returns the id of the instance. It is a default one after a failure.
  [[nodiscard]] InstanceId id() const noexcept { return id_; }
  /// Returns why the change failed. Must not be called after a success.
  [[nodiscard]] const InvalidInstance& error() const noexcept { return *error_; }

 private:
  InstanceId id_;
  std::optional<InvalidInstance> error_;  ///< None after a success.
};

}  // namespace surehit

/// \cond Doxygen finds no scope for it.
// Hashes an id, for unordered containers.
template <>
struct std::hash<surehit::InstanceId> {
  // Returns the hash of all bits of the id.
  std::size_t operator()(const surehit::InstanceId& id) const noexcept {
    return std::hash<std::uint64_t>()(std::uint64_t{id.generation} << 32 | id.index);
  }
};
/// \endcond
