#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace surehit::detail {

/// The number of paths in a dispatch. Many fill the device, and few end before a desktop takes it for hung. So the
/// number follows the time that dispatches take. It changes no answer. It is always a power of two.
class DispatchSize {
 public:
  static constexpr std::uint32_t smallest = std::uint32_t{1} << 12;
  static constexpr std::uint32_t initial = std::uint32_t{1} << 16;
  static constexpr std::uint32_t largest = std::uint32_t{1} << 20;
  /// A dispatch that takes less time may become larger, and one that takes more becomes smaller.
  static constexpr std::chrono::milliseconds too_short{8};
  static constexpr std::chrono::milliseconds too_long{50};

  /// Returns the number for the next dispatch.
  [[nodiscard]] std::uint32_t paths() const { return paths_; }
  /// Grows to this many at most. There is room for so many in the memory of a device.
  void set_limit(std::uint64_t paths) {
    limit_ = smallest;
    while (limit_ < largest && 2 * std::uint64_t{limit_} <= paths) limit_ *= 2;
    paths_ = std::min(paths_.load(), limit_);
  }
  /// Stays at this number. Tests use it.
  void fix(std::uint32_t paths) {
    paths_ = paths;
    is_fixed_ = true;
  }
  /// Notes how long a dispatch took at most, from when it was given to the device until the host saw its end.
  void note(std::size_t paths, std::chrono::nanoseconds time) {
    std::uint32_t now = paths_;
    if (is_fixed_ || paths != now) return;  // Another one says nothing of this number.
    std::uint32_t next = now;
    if (time < too_short) next = std::min(2 * now, limit_);
    if (time > too_long) next = std::max(now / 2, smallest);
    paths_.compare_exchange_strong(now, next);  // Another batch may have changed it.
  }
  /// Becomes smaller than `paths`, for which there is too little memory. Returns false if it cannot.
  bool shrink_below(std::size_t paths) {
    if (is_fixed_ || paths <= smallest) return false;
    for (std::uint32_t now = paths_; now >= paths; now = paths_) {
      paths_.compare_exchange_weak(now, std::max(now / 2, smallest));  // Another batch may have changed it.
    }
    return true;
  }

 private:
  std::atomic<std::uint32_t> paths_ = initial;
  std::uint32_t limit_ = largest;
  bool is_fixed_ = false;
};

}  // namespace surehit::detail
