#pragma once

#include <cstdint>
#include <string>

#include "visibility_bake/visibility.hpp"

namespace surehit::example {

/// What is known so far, in a file that a later run goes on from.
class Checkpoint {
 public:
  /// `fingerprint` is that of the plan. Nothing is read or written yet.
  Checkpoint(std::string path, std::uint64_t fingerprint) : path_(std::move(path)), fingerprint_(fingerprint) {}

  /// Returns what the file has, or nothing known if there is no file. Throws InputError if the file is damaged, or is
  /// of another mesh, of other cells or of other options.
  [[nodiscard]] Visibility load(std::uint32_t cells) const;
  /// Replaces the file. Throws std::system_error, and the file is then as before.
  void save(const Visibility& visibility) const;
  /// Removes the file, and what an interrupted `save` has left.
  void remove() const;

 private:
  std::string path_;
  std::uint64_t fingerprint_;
};

}  // namespace surehit::example
