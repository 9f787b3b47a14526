#pragma once

#include <cstdint>
#include <string>

namespace surehit::example {

/// What the batches on a GPU did.
struct GpuCounts {
  std::uint64_t paths = 0;
  std::uint64_t by_host = 0;  ///< the paths that the host answered, or whose hits it rounded
  std::string failure;        ///< why the device has failed first, or nothing if it has not
};

/// Warns in the name of a program if the host went on without the device.
void warn_of_failure(const char* program, const GpuCounts& counts);

}  // namespace surehit::example
