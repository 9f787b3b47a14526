#include <cstdlib>
#include <string>

#include "mesh_io/input_error.hpp"
#include "visibility_bake/ranks.hpp"

namespace surehit::example {

/// Without MPI, several processes would all bake all rows, and write the same files at once.
Ranks::Ranks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    const char* size = std::getenv(name);
    if (size == nullptr || std::atoi(size) <= 1) continue;
    throw InputError(std::string("this build is without MPI, and cannot be one of ") + size + " processes");
  }
}
Ranks::~Ranks() {}

bool Ranks::are_ready(const std::function<std::uint64_t()>& prepare) const {
  static_cast<void>(prepare());
  return true;
}

void Ranks::bake(const Colliderf& collider, const PairPlan& plan, const Checkpoint& checkpoint,
                 const BakeOptions& options, Visibility& visibility) const {
  example::bake(collider, plan, checkpoint, options, visibility);
}

}  // namespace surehit::example
