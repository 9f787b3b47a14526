#pragma once

#include <cstdio>
#include <span>
#include <string>
#include <string_view>

namespace surehit::example {

/// What an OutputFile outlives.
enum class Durability {
  process,  ///< This process. What is beside the path has its number in the name, so several may write at once.
  machine,  ///< A power cut: the bytes are on disk before the file is moved. One process may write the path at a time.
            ///< What one that was killed has left beside it, `PATH.partial`, is overwritten by the next.
};

/// A file that is there whole or not at all: written beside its path under another name, and moved there by `finish`.
/// `-` is standard output; that, and what is no regular file, is written to directly. Throws std::system_error.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path, Durability durability = Durability::process);
  /// Leaves nothing behind where `finish` was not reached.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] bool is_terminal() const;
  void write(std::string_view text);
  void finish();

 private:
  [[noreturn]] void throw_errno() const;

  std::string name_;  ///< as the user has given it
  Durability durability_;
  std::string path_;
  std::string written_path_;  ///< as long as it is not the path itself
  std::FILE* file_ = nullptr;
};

/// Writes a whole file. Throws std::system_error, and leaves nothing behind then.
void write_file(const std::string& path, std::string_view bytes, Durability durability = Durability::process);

/// An output that the user has asked for.
struct NamedOutput {
  std::string_view option;  ///< the option that names it
  std::string path;
};
/// Throws InputError if two outputs are the same file, or both are standard output. Several may go to one device.
void refuse_equal_outputs(std::span<const NamedOutput> outputs);

}  // namespace surehit::example
