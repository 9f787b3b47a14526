#include <stdexcept>

#include "command_line/gpu_batches.hpp"

namespace surehit::example {

struct GpuBatches::State {};

GpuBatches::GpuBatches(const Colliderf&, const std::string&) {
  throw std::runtime_error("this program was built without surehit::gpu");
}
GpuBatches::~GpuBatches() = default;

// No object of this class comes into being.
void GpuBatches::first_hits(const PathSpanf&, std::span<Hitf>, const BatchOptionsf&) const {}
void GpuBatches::any_hits(const PathSpanf&, std::span<std::uint8_t>, const BatchOptionsf&) const {}
std::string GpuBatches::name() const { return {}; }
GpuCounts GpuBatches::counts() const { return {}; }

}  // namespace surehit::example
