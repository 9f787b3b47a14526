#pragma once

#include <optional>
#include <utility>

#include "surehit/invalid_mesh.hpp"

namespace surehit {

/// What a build returns: true if it succeeded, else the reason why not.
class [[nodiscard]] BuildResult {
 public:
  /// Success.
  BuildResult() noexcept = default;
  /// Failure.
  BuildResult(InvalidMesh error) : error_(std::move(error)) {}

  [[nodiscard]] bool has_value() const noexcept { return !error_.has_value(); }
  [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }
  /// Why the build failed. Valid only after a failure.
  [[nodiscard]] const InvalidMesh& error() const noexcept { return *error_; }

 private:
  std::optional<InvalidMesh> error_;
};

}  // namespace surehit
