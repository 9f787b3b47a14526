#pragma once

#include <optional>
#include <utility>

#include "surehit/invalid_mesh.hpp"

namespace surehit {

/// The result of a build: success, or the reason of a failure. It is true on success.
class [[nodiscard]] BuildResult {
 public:
  /// Makes a success.
  BuildResult() noexcept = default;
  /// Makes a failure.
  BuildResult(InvalidMesh error) : error_(std::move(error)) {}

  /// Returns true if the build succeeded.
  [[nodiscard]] bool has_value() const noexcept { return !error_.has_value(); }
  /// Returns true if the build succeeded.
  [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }
  /// Returns why the build failed. Must not be called after a success.
  [[nodiscard]] const InvalidMesh& error() const noexcept { return *error_; }

 private:
  std::optional<InvalidMesh> error_;  ///< None after a success.
};

}  // namespace surehit
