#include <cstdio>

#include "tables.hpp"

namespace surehit::benchmark {

void measure_gpu(const Request&, Report&) {
  std::printf("\ngpu: left out, because this was built without surehit::gpu\n");
}

void measure_gpu_scenes(const Request&, Report&) {
  std::printf("\ngpu_scene: left out, because this was built without surehit::gpu\n");
}

}  // namespace surehit::benchmark
