#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace surehit::example {

/// A file that is there whole or not at all: written beside its path under another name, and moved there by `finish`.
/// `-` is standard output; that, and what is no regular file, is written to directly. Throws std::system_error.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  /// Leaves nothing behind where `finish` was not reached.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] bool is_terminal() const;
  void write(std::string_view text);
  void finish();

 private:
  [[noreturn]] void throw_errno() const;

  std::string path_;
  std::string written_path_;  ///< as long as it is not the path itself
  std::FILE* file_ = nullptr;
};

/// Writes a whole file. Throws std::system_error, and leaves nothing behind then.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace surehit::example
