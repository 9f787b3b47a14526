#include "c/arguments.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "c/last_error.hpp"

namespace surehit::c {
namespace {

/// No version will have a struct as large as this, so a larger size is one that was never set.
constexpr std::size_t max_struct_size = 4096;

}  // namespace

void Arguments::refuse(surehit_status status, std::size_t element, const char* format, ...) noexcept {
  if (!are_valid()) return;
  status_ = status;
  LastError& error = last_error();
  error.status = status;
  error.element = element;
  const int begun = std::snprintf(error.message, sizeof error.message, "%s: ", function_);
  const auto used = static_cast<std::size_t>(std::max(begun, 0));
  if (used >= sizeof error.message) return;
  std::va_list list;
  va_start(list, format);
  std::vsnprintf(error.message + used, sizeof error.message - used, format, list);
  va_end(list);
}

void Arguments::check_size(std::size_t size, std::size_t first, const char* name) noexcept {
  if (size < first || size > max_struct_size) {
    refuse(SUREHIT_INVALID_SIZE, size, "%s.size is %zu, and must be at least %zu", name, size, first);
  }
}

void Arguments::check_unknown(const unsigned char* bytes, std::size_t size, std::size_t known,
                              const char* name) noexcept {
  if (size > known && std::any_of(bytes + known, bytes + size, [](unsigned char byte) { return byte != 0; })) {
    refuse(SUREHIT_INVALID_SIZE, size, "%s asks for what a later version has, and this one does not", name);
  }
}

}  // namespace surehit::c
