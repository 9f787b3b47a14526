#pragma once

#include <optional>
#include <utility>

#include "surehit/executor.hpp"
#include "surehit/invalid_file.hpp"

namespace surehit {

/// How a saved collider or scene is loaded.
struct LoadOptions {
  /// Leaves out the proof that the lists of the grid are complete, which takes two thirds of a load. Set it only
  /// for bytes that nobody else could have written, such as a file of your own that you have signed.
  ///
  /// All else is checked, and the checksum finds damage. But **right answers are not promised** for bytes that someone
  /// has made on purpose. Queries may then miss triangles. They still end, and read no memory that is not theirs.
  bool is_trusted = false;
  /// Spreads a part of the work over threads. The result is the same. It is not used after the load.
  std::optional<Executor> executor = {};
};

/// The result of a load: success, or the reason of a failure. It is true on success.
class [[nodiscard]] LoadResult {
 public:
  /// Makes a success.
  LoadResult() noexcept = default;
  /// Makes a failure.
  LoadResult(InvalidFile error) : error_(std::move(error)) {}

  /// Returns true if the load succeeded.
  [[nodiscard]] bool has_value() const noexcept { return !error_.has_value(); }
  /// Returns true if the load succeeded.
  [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }
  /// Returns why the load failed. Must not be called after a success.
  [[nodiscard]] const InvalidFile& error() const noexcept { return *error_; }

 private:
  std::optional<InvalidFile> error_;  ///< None after a success.
};

}  // namespace surehit
