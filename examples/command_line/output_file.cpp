#include "command_line/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "mesh_io/input_error.hpp"

namespace surehit::example {

namespace fs = std::filesystem;

OutputFile::OutputFile(const std::string& path, Durability durability)
    : name_(path), durability_(durability), path_(path) {
  if (path == "-") {
    file_ = stdout;
    return;
  }
  if (!fs::exists(path) || fs::is_regular_file(path)) {
    // Through a symbolic link the file it points to is replaced, not the link.
    fs::path target = path;
    while (fs::is_symlink(target) && !fs::exists(target)) target = target.parent_path() / fs::read_symlink(target);
    path_ = fs::weakly_canonical(target).string();
    written_path_ = path_ + (durability == Durability::machine ? "" : "." + std::to_string(getpid())) + ".partial";
  }
  file_ = std::fopen(written_path_.empty() ? path_.c_str() : written_path_.c_str(), "wb");
  if (file_ == nullptr) throw_errno();
}

OutputFile::~OutputFile() {
  if (file_ != nullptr && file_ != stdout) std::fclose(file_);
  if (!written_path_.empty()) std::remove(written_path_.c_str());
}

bool OutputFile::is_terminal() const { return isatty(fileno(file_)) != 0; }

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) throw_errno();
}

void OutputFile::finish() {
  if (std::fflush(file_) != 0) throw_errno();
  if (file_ == stdout) return;
  if (durability_ == Durability::machine && !written_path_.empty() && fsync(fileno(file_)) != 0 && errno != EINVAL) {
    throw_errno();
  }
  if (std::fclose(std::exchange(file_, nullptr)) != 0) throw_errno();
  if (written_path_.empty()) return;
  if (std::rename(written_path_.c_str(), path_.c_str()) != 0) throw_errno();
  written_path_.clear();
}

void OutputFile::throw_errno() const {
  const int reason = errno;
  throw std::system_error(reason, std::generic_category(),
                          (name_ == "-" ? "standard output" : name_) + ": cannot be written");
}

void write_file(const std::string& path, std::string_view bytes, Durability durability) {
  OutputFile file(path, durability);
  file.write(bytes);
  file.finish();
}

void refuse_equal_outputs(std::span<const NamedOutput> outputs) {
  const auto place_of = [](const std::string& path) { return fs::weakly_canonical(fs::absolute(path)); };
  for (std::size_t i = 1; i < outputs.size(); ++i) {
    const std::string& path = outputs[i].path;
    if (fs::exists(path) && !fs::is_regular_file(path)) continue;
    for (const NamedOutput& earlier : outputs.first(i)) {
      if (place_of(path) != place_of(earlier.path)) continue;
      throw InputError(std::string(earlier.option) + " and " + std::string(outputs[i].option) + " are the same file, " +
                       path);
    }
  }
}

}  // namespace surehit::example
