#include "core_pin.hpp"

#include <cerrno>
#include <system_error>

namespace surehit::benchmark {
namespace {

cpu_set_t affinity() {
  cpu_set_t cores;
  if (sched_getaffinity(0, sizeof cores, &cores) != 0) throw std::system_error(errno, std::generic_category());
  return cores;
}

}  // namespace

CorePin::CorePin(int core) : before_(affinity()) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<unsigned>(core), &one);
  if (sched_setaffinity(0, sizeof one, &one) != 0) {
    throw std::system_error(errno, std::generic_category(), "core " + std::to_string(core));
  }
}

CorePin::~CorePin() { sched_setaffinity(0, sizeof before_, &before_); }

std::vector<int> CorePin::allowed_cores() {
  const cpu_set_t set = affinity();
  std::vector<int> cores;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<unsigned>(core), &set)) cores.push_back(core);
  }
  return cores;
}

}  // namespace surehit::benchmark
