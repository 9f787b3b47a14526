#include "mesh_io/read_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "mesh_io/input_error.hpp"

namespace surehit::example {
namespace {

[[noreturn]] void throw_errno() { throw InputError("cannot be read: " + std::generic_category().message(errno)); }

std::string read_all(std::FILE* file) {
  std::string bytes;
  std::array<char, 1 << 16> block;
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file)) bytes.append(block.data(), count);
  if (std::ferror(file) != 0) throw_errno();
  return bytes;
}

}  // namespace

std::string read_file(const std::string& path) {
  if (path == "-") return read_all(stdin);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (file == nullptr) throw_errno();
  return read_all(file.get());
}

}  // namespace surehit::example
