#include "command_line/gpu_counts.hpp"

#include "command_line/program.hpp"

namespace surehit::example {

void warn_of_failure(const char* program, const GpuCounts& counts) {
  if (!counts.failure.empty()) warn(program, "the host went on without the device: " + counts.failure);
}

}  // namespace surehit::example
