#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "surehit/attributes.hpp"

namespace surehit {

/// Why a saved collider or scene cannot be loaded, and where in the file the fault is. `what()` says the same in one
/// line.
///
/// `Collider::try_load` and `Scene::try_load` return it. `Collider::load` and `Scene::load` throw it, where exceptions
/// are on.
class SUREHIT_API InvalidFile : public std::runtime_error {
 public:
  /// What is wrong.
  enum class Reason : std::uint8_t {
    not_saved,         ///< The file does not begin as saved colliders and scenes do.
    wrong_byte_order,  ///< The bytes of its numbers were turned round.
    newer_version,     ///< A newer version of the library has written it.
    wrong_kind,        ///< It holds a scene instead of a collider, or the other way round.
    wrong_scalar,      ///< It holds floats instead of doubles, or the other way round.
    wrong_size,        ///< It has fewer or more bytes than it says.
    wrong_checksum,    ///< Its checksum is not that of its bytes.
    wrong_counts,      ///< Its parts do not fit into its bytes, or do not fit each other.
    invalid_mesh,      ///< A build would refuse the mesh.
    invalid_grid,      ///< The cells are not those of a grid of this mesh.
    invalid_list,      ///< A list is not what a build makes of its cell.
    invalid_instance,  ///< A scene would refuse the instance, or its place is taken twice.
  };

  /// Sets both members. `what()` returns the message. May throw std::bad_alloc.
  InvalidFile(Reason reason_given, std::size_t offset_of_fault, const std::string& message)
      : std::runtime_error(message), reason(reason_given), offset(offset_of_fault) {}

  Reason reason;       ///< What is wrong.
  std::size_t offset;  ///< The index of the first byte of what is wrong.
};

}  // namespace surehit
