#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "byte_source.hpp"
#include "collision/c/c_functions.hpp"
#include "finding.hpp"
#include "point_edits.hpp"

namespace surehit::test {

/// Draws arguments for calls of the C interface, right ones and wrong ones, and checks what the calls return.
template <typename Scalar>
class CArgumentDrawer {
 public:
  explicit CArgumentDrawer(ByteSource& bytes) : bytes_(bytes) {}

 protected:
  using C = CFunctions<Scalar>;
  static constexpr std::size_t vertex_count = 6;
  static constexpr std::size_t triangle_count = 5;
  static constexpr std::size_t path_count = 9;
  static constexpr std::uint32_t shape_kinds = 3;

  static void expect_status(surehit_status status, surehit_status expected) {
    if (status != expected) stop_at(std::to_string(status) + ": " + surehit_last_error());
  }
  /// Stops unless a failure tells of itself, and leaves the result as it was.
  template <typename Result>
  static surehit_status checked(surehit_status status, const Result& result, const Result& before) {
    if (status == SUREHIT_OK) return status;
    if (surehit_last_error_status() != status || std::strncmp(surehit_last_error(), "surehit_", 8) != 0) {
      stop_at(std::to_string(status) + " is not told: " + surehit_last_error());
    }
    if (status != SUREHIT_STOPPED && std::memcmp(&result, &before, sizeof result) != 0) {
      stop_at(std::string("a failure has changed its result: ") + surehit_last_error());
    }
    if (status == SUREHIT_INTERNAL_ERROR) stop_at(surehit_last_error());
    return status;
  }
  static surehit_status checked(surehit_status status) { return checked(status, 0, 0); }

  Scalar number() { return read_number<Scalar>(bytes_); }
  typename C::Vector vector() {
    typename C::Vector result;
    result.x = number();
    result.y = number();
    result.z = number();
    return result;
  }
  /// A value below the count, or now and then any value.
  std::uint32_t value(std::uint32_t count) {
    return bytes_.one_in(16) ? bytes_.take<std::uint32_t>() : static_cast<std::uint32_t>(bytes_.below(count));
  }
  std::uint8_t small_value(std::uint32_t count) { return static_cast<std::uint8_t>(value(count)); }
  /// The count or less, or one whose bytes overflow.
  std::size_t size(std::size_t count) {
    if (bytes_.one_in(16)) return SIZE_MAX - bytes_.below(8);
    if (bytes_.one_in(16)) return SIZE_MAX / 4 + bytes_.below(8);
    return bytes_.below(count + 1);
  }
  template <typename T>
  T* or_null(T* pointer) {
    return bytes_.one_in(16) ? nullptr : pointer;
  }
  template <typename T>
  T* or_none(T* pointer) {
    return bytes_.one_in(2) ? nullptr : pointer;
  }
  /// Sets the size of a struct that has one.
  template <typename Struct>
  void set_size(Struct& to) {
    to.size = bytes_.one_in(16) ? bytes_.take<std::uint16_t>() % sizeof to : sizeof to;
  }
  typename C::Path path() {
    typename C::Path result = {};
    result.start = vector();
    result.toward = vector();
    result.kind = value(3);
    return result;
  }
  template <typename Options>
  void set_options(Options& options) {
    if constexpr (requires { options.min_t; }) {
      if (bytes_.one_in(4)) options.min_t = number();
    }
    if (bytes_.one_in(4)) options.max_t = number();
    if (bytes_.one_in(4)) options.culling = small_value(3);
    if (bytes_.one_in(4)) options.mask = bytes_.take<std::uint8_t>();
    if (bytes_.one_in(4)) options.ignored_triangle = value(triangle_count);
    if (bytes_.one_in(4)) options.ignore_start_contact = small_value(2);
    if constexpr (requires { options.ignore_end_contact; }) {
      if (bytes_.one_in(4)) options.ignore_end_contact = small_value(2);
    }
  }
  typename C::Shape shape() {
    typename C::Shape result = {};
    result.start = vector();
    result.end = bytes_.one_in(8) ? result.start : vector();
    result.half = vector();
    result.radius = number();
    result.kind = value(shape_kinds);
    return result;
  }

  template <typename Hit>
  static std::int32_t accept(void* user, std::size_t path, const Hit* hit) {
    const auto choice = *static_cast<const std::uint8_t*>(user);
    return choice > 250                                       ? SUREHIT_STOP
           : (hit->triangle + path) % (1U + choice % 4U) == 0 ? SUREHIT_ACCEPT
                                                              : SUREHIT_REJECT;
  }
  /// Leaves out tasks, does some of them again, and some that are not there.
  static void run(void* user, std::size_t count, surehit_task task, void* work) {
    const auto choice = *static_cast<const std::uint8_t*>(user);
    for (std::size_t i = choice % 3; i < count + choice % 5; i += 1 + choice % 2) task(work, i);
  }

  typename C::Paths paths() {
    numbers_.clear();
    for (std::size_t i = 0; i < 6 * path_count; ++i) numbers_.push_back(number());
    typename C::Paths result = {or_null(numbers_.data()), nullptr, size(path_count), 0, 0, value(3)};
    if (bytes_.one_in(4)) result.start_stride = bytes_.below(6 * sizeof(Scalar) + 1);
    if (bytes_.one_in(4)) {
      result.towards = numbers_.data() + 3;
      result.toward_stride = bytes_.below(6 * sizeof(Scalar) + 1);
    }
    return result;
  }

  typename C::Shapes shapes() {
    numbers_.clear();
    for (std::size_t i = 0; i < sizeof(typename C::Capsule) / sizeof(Scalar) * path_count; ++i) {
      numbers_.push_back(number());
    }
    return {or_null(numbers_.data()), size(path_count), value(shape_kinds)};
  }
  typename C::Pose pose() {
    auto result = C::identity();
    if (bytes_.one_in(2)) {
      const auto translation = vector();
      result = C::rigid(number(), number(), number(), number(), translation);
    }
    if (bytes_.one_in(4)) result.y_axis = vector();
    return result;
  }

  std::uint8_t choice_ = 0;
  surehit_executor executor_ = {run, &choice_};

 private:
  ByteSource& bytes_;
  std::vector<Scalar> numbers_;  ///< The numbers of the last paths or shapes.
};

}  // namespace surehit::test
