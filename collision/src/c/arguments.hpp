#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <type_traits>

#include "c/handle.hpp"
#include "support/inlining.hpp"
#include "surehit/c/status.h"

namespace surehit::c {

/// The size that a struct with a member `size` had when it was new. A struct that has grown needs a number of its own.
template <typename Struct>
inline constexpr std::size_t first_size = sizeof(Struct);

/// Checks the arguments of a call. The first failure counts: it is kept as the last error of the thread, and later
/// checks do nothing. No argument may be read before `are_valid` says so.
class Arguments {
 public:
  /// Begins the checks of a function of this name.
  explicit Arguments(const char* function) noexcept : function_(function) {}

  /// Returns true if no check has failed.
  [[nodiscard]] bool are_valid() const noexcept { return status_ == SUREHIT_OK; }
  /// Returns the status of the first failure, or success.
  [[nodiscard]] surehit_status status() const noexcept { return status_; }

  /// Fails, unless something has failed before. The message is made as by printf.
  SUREHIT_FORMAT(4, 5)
  SUREHIT_COLD void refuse(surehit_status status, std::size_t element, const char* format, ...) noexcept;

  /// Fails if the address is null, or is none that a T can have.
  template <typename T>
  void check_pointer(const T* pointer, const char* name) noexcept {
    if (pointer == nullptr) {
      refuse(SUREHIT_NULL_POINTER, 0, "%s is null", name);
    } else {
      check_alignment(pointer, name);
    }
  }
  /// Does the same where null is allowed.
  template <typename T>
  void check_optional(const T* pointer, const char* name) noexcept {
    if (pointer != nullptr) check_alignment(pointer, name);
  }
  /// Does the same for the first element of an array, which may be null if it has none. Also fails if the array would
  /// not fit into memory. `stride` is in bytes.
  template <typename T>
  void check_array(const T* first, std::size_t count, std::size_t stride, const char* name) noexcept {
    if (count == 0) return;
    check_pointer(first, name);
    check_extent(reinterpret_cast<std::uintptr_t>(first), count, stride, name);
  }
  /// Fails if an array from this address on would not fit into memory.
  void check_extent(std::uintptr_t address, std::size_t count, std::size_t stride, const char* name) noexcept {
    if (stride != 0 && count > (PTRDIFF_MAX < UINTPTR_MAX - address ? PTRDIFF_MAX : UINTPTR_MAX - address) / stride) {
      refuse(SUREHIT_TOO_LARGE, count, "%zu %s of %zu bytes do not fit into memory", count, name, stride);
    }
  }
  /// Fails unless the value is below the count.
  void check_value(std::uint32_t value, std::uint32_t count, std::size_t element, const char* name) noexcept {
    if (value >= count) {
      refuse(SUREHIT_INVALID_VALUE, element, "%s is %u, and must be below %u", name, value, count);
    }
  }
  /// Fails if there is no such triangle.
  void check_triangle(std::uint32_t triangle, std::size_t count) noexcept {
    if (triangle >= count) {
      refuse(SUREHIT_OUT_OF_RANGE, triangle, "there is no triangle %u, because there are %zu", triangle, count);
    }
  }

  /// Returns what a handle stands for. Fails, and returns null, if it is not the handle of an `Object`.
  template <typename Object>
  [[nodiscard]] Object* object_of(const void* handle, const char* name) noexcept {
    check_pointer(static_cast<const Handle*>(handle), name);
    if (!are_valid()) return nullptr;
    auto* const object = static_cast<const Handle*>(handle)->template get<Object>();
    if (object == nullptr) refuse(SUREHIT_INVALID_HANDLE, 0, "%s was destroyed, or is of another kind", name);
    return object;
  }
  /// Returns a share of what a handle stands for. Fails, and returns null, as `object_of` does.
  template <typename Object>
  [[nodiscard]] std::shared_ptr<Object> share_of(const void* handle, const char* name) noexcept {
    if (object_of<Object>(handle, name) == nullptr) return nullptr;
    return static_cast<const Handle*>(handle)->template share<Object>();
  }

  /// Returns a struct that begins with its size, with zeros for what an older version lacks. Null is a struct of zeros.
  /// Fails if the size is that of no version, or if a newer version has more than zeros in what is unknown here.
  template <typename Struct>
  [[nodiscard]] Struct read_sized(const Struct* given, const char* name) noexcept {
    Struct result = {};
    check_optional(given, name);
    if (given == nullptr || !are_valid()) return result;
    check_size(given->size, first_size<Struct>, name);
    if (!are_valid()) return result;
    check_unknown(reinterpret_cast<const unsigned char*>(given), given->size, sizeof(Struct), name);
    std::memcpy(&result, given, std::min(given->size, sizeof(Struct)));
    return result;
  }
  /// Fails if the size of a struct for results is that of no version. Whoever fills a struct that has grown must see
  /// which members there are.
  template <typename Struct>
  void check_sized_result(const Struct* result, const char* name) noexcept {
    check_pointer(result, name);
    if (are_valid()) check_size(result->size, first_size<Struct>, name);
  }

  /// Calls `work()` if all arguments are valid, and returns the status. No exception of `work` leaves it.
  template <typename Work>
  [[nodiscard]] surehit_status then(const Work& work) noexcept {
    if (!are_valid()) return status_;
#if defined(__cpp_exceptions)
    try {
      work();
    } catch (const std::bad_alloc&) {
      refuse_memory();
    } catch (const std::length_error&) {
      refuse_memory();
    } catch (const std::exception& error) {
      refuse(SUREHIT_INTERNAL_ERROR, 0, "%s", error.what());
    } catch (...) {
      refuse(SUREHIT_INTERNAL_ERROR, 0, "an exception of unknown type");
    }
#else
    work();
#endif
    return status_;
  }

 private:
  void refuse_memory() noexcept { refuse(SUREHIT_OUT_OF_MEMORY, 0, "memory ran out"); }

  template <typename T>
  void check_alignment(const T* pointer, const char* name) noexcept {
    if constexpr (!std::is_void_v<T>) {
      if (reinterpret_cast<std::uintptr_t>(pointer) % alignof(T) != 0) {
        refuse(SUREHIT_MISALIGNED, 0, "the address of %s is not a multiple of %zu", name, alignof(T));
      }
    }
  }
  /// Fails if no version of a struct has this size.
  void check_size(std::size_t size, std::size_t first, const char* name) noexcept;
  /// Fails unless the bytes behind those that are known are zeros.
  void check_unknown(const unsigned char* bytes, std::size_t size, std::size_t known, const char* name) noexcept;

  const char* function_;
  surehit_status status_ = SUREHIT_OK;
};

}  // namespace surehit::c
