#pragma once

#include <memory>
#include <utility>

#include "c/arguments.hpp"
#include "c/asked.hpp"
#include "c/handle.hpp"

namespace surehit::c {

/// A call that is about one object.
template <typename Object>
class HandleCall {
 public:
  HandleCall(const char* function, const void* handle)
      : arguments(function), object(arguments.object_of<Object>(handle, Asked<Object>::name)) {}

  /// Sets the result to what `get(object)` returns.
  template <typename Result, typename Get>
  [[nodiscard]] surehit_status tell(Result* result, const char* name, const Get& get) {
    arguments.check_pointer(result, name);
    return arguments.then([&] { *result = get(std::as_const(*object)); });
  }

  Arguments arguments;
  Object* object;
};

/// Sets `handle` to a new handle of the object that `make()` returns, unless making it has failed.
template <typename CHandle, typename Make>
[[nodiscard]] surehit_status open(Arguments& arguments, CHandle** handle, const Make& make) {
  return arguments.then([&] {
    auto made = make();
    if (arguments.are_valid()) *handle = reinterpret_cast<CHandle*>(Handle::open(std::move(made)));
  });
}

/// Gives up an object. Null is allowed.
template <typename Object>
[[nodiscard]] surehit_status destroy(const char* function, void* handle) {
  if (handle == nullptr) return SUREHIT_OK;
  HandleCall<Object> call(function, handle);
  return call.arguments.then([&] { static_cast<Handle*>(handle)->close(); });
}

}  // namespace surehit::c
