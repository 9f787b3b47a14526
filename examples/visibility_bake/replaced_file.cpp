#include "visibility_bake/replaced_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace surehit::example {
namespace {

[[noreturn]] void throw_cannot_be_written(const std::string& path) {
  throw std::system_error(errno, std::generic_category(), path + ": cannot be written");
}

}  // namespace

void replace_file(const std::string& path, std::string_view bytes) {
  const std::string side = path + ".partial";
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(side.c_str(), "wb"), &std::fclose);
  if (file == nullptr) throw_cannot_be_written(path);
  const bool is_written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
                          std::fflush(file.get()) == 0 && (fsync(fileno(file.get())) == 0 || errno == EINVAL);
  if (!is_written || std::fclose(file.release()) != 0 || std::rename(side.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    std::remove(side.c_str());
    errno = reason;
    throw_cannot_be_written(path);
  }
}

}  // namespace surehit::example
