#pragma once

namespace surehit::detail {

/// A library that is opened while the program runs. It closes with this.
class SharedLibrary {
 public:
  using Function = void (*)();

  SharedLibrary() = default;
  ~SharedLibrary() { close(); }
  SharedLibrary(const SharedLibrary&) = delete;
  SharedLibrary& operator=(const SharedLibrary&) = delete;

  /// Opens the library of this name. Returns false if it cannot be opened.
  [[nodiscard]] bool open(const char* name);
  /// Returns the function of this name, or null if the library has none.
  [[nodiscard]] Function find(const char* name) const;
  /// Leaves the library open for ever.
  void forget() { handle_ = nullptr; }

 private:
  void close();

  void* handle_ = nullptr;
};

}  // namespace surehit::detail
