#include "gpu/shared_library.hpp"

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace surehit::detail {

#if defined(_WIN32)

bool SharedLibrary::open(const char* name) {
  close();
  // The folder that the program happens to be started in is not among these.
  handle_ = LoadLibraryExA(name, nullptr, LOAD_LIBRARY_SEARCH_DEFAULT_DIRS);
  return handle_ != nullptr;
}

SharedLibrary::Function SharedLibrary::find(const char* name) const {
  return reinterpret_cast<Function>(GetProcAddress(static_cast<HMODULE>(handle_), name));
}

void SharedLibrary::close() {
  if (handle_ != nullptr) FreeLibrary(static_cast<HMODULE>(handle_));
  handle_ = nullptr;
}

#else

bool SharedLibrary::open(const char* name) {
  close();
  handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  return handle_ != nullptr;
}

SharedLibrary::Function SharedLibrary::find(const char* name) const {
  return reinterpret_cast<Function>(dlsym(handle_, name));
}

void SharedLibrary::close() {
  if (handle_ != nullptr) dlclose(handle_);
  handle_ = nullptr;
}

#endif

}  // namespace surehit::detail
