#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "gpu/vulkan_functions.hpp"

namespace surehit::detail {

struct GpuDeviceState;

/// A buffer with memory of its own. It must be destroyed before its device is.
class GpuBuffer {
 public:
  /// Where a buffer lies.
  enum class Place : std::uint8_t {
    device,  ///< In the memory of the device.
    host,    ///< Where the host sees it, at `data()`.
  };

  GpuBuffer() = default;
  ~GpuBuffer();
  GpuBuffer(GpuBuffer&& other) noexcept { *this = static_cast<GpuBuffer&&>(other); }
  GpuBuffer& operator=(GpuBuffer&& other) noexcept;

  /// Becomes a buffer of at least one byte. `what` is what it is for.
  [[nodiscard]] std::optional<GpuError> make(const GpuDeviceState& device, std::size_t size, Place place,
                                             const char* what);

  /// Leaves the buffer and its memory to the device for ever.
  void forget() { device_ = nullptr; }
  [[nodiscard]] VkBuffer get() const { return buffer_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::byte* data() const { return data_; }

 private:
  const GpuDeviceState* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::size_t size_ = 0;
  std::byte* data_ = nullptr;
};

}  // namespace surehit::detail
