// Lists the devices, or says why there is none. Either will do: what counts is that the program is linked and starts.
#include <cstdio>
#include <surehit/gpu.hpp>
#include <vector>

int main() {
  std::vector<surehit::GpuDescription> devices;
  const surehit::GpuResult listed = surehit::GpuDevice::try_list(devices);
  if (!listed) std::printf("%s\n", listed.error().what());
  for (const surehit::GpuDescription& device : devices) std::printf("%s\n", device.name.c_str());
  surehit::GpuCollider unused;
  return unused.memory_bytes() == 0 ? 0 : 1;
}
