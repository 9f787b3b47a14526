#include "command_line/read_with_z_up.hpp"

#include "command_line/program.hpp"
#include "mesh_io/read_mesh.hpp"

namespace surehit::example {

Mesh<float> read_with_z_up(const char* program, const std::string& path, const std::string& up) {
  Mesh<float> mesh = read_mesh<float>(path);
  for (const std::string& warning : mesh.warnings) warn(program, path + ": " + warning);
  if (up == "y") {
    for (auto& vertex : mesh.vertices) vertex = {vertex[0], -vertex[2], vertex[1]};
  }
  return mesh;
}

}  // namespace surehit::example
