#include <stdexcept>

#include "command_line/gpu_batches.hpp"

namespace surehit::example {

template <typename Asked>
struct GpuBatchesOf<Asked>::State {};

template <typename Asked>
GpuBatchesOf<Asked>::GpuBatchesOf(const Asked&, const std::string&) {
  throw std::runtime_error("this program was built without surehit::gpu");
}
template <typename Asked>
GpuBatchesOf<Asked>::~GpuBatchesOf() = default;

// No object comes into being.
template <typename Asked>
void GpuBatchesOf<Asked>::first_hits(const PathSpanf&, std::span<Hit>, const Options&) const {}
template <typename Asked>
void GpuBatchesOf<Asked>::any_hits(const PathSpanf&, std::span<std::uint8_t>, const Options&) const {}
template <typename Asked>
std::string GpuBatchesOf<Asked>::name() const {
  return {};
}
template <typename Asked>
GpuCounts GpuBatchesOf<Asked>::counts() const {
  return {};
}

template class GpuBatchesOf<Colliderf>;
template class GpuBatchesOf<Scenef>;

}  // namespace surehit::example
