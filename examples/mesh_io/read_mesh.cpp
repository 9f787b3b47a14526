#include "mesh_io/read_mesh.hpp"

#include <filesystem>
#include <string_view>

#include "mesh_io/input_error.hpp"
#include "mesh_io/read_file.hpp"
#include "mesh_io/read_obj.hpp"
#include "mesh_io/read_off.hpp"
#include "mesh_io/read_ply.hpp"
#include "mesh_io/read_stl.hpp"

namespace surehit::example {
namespace {

template <typename Scalar>
using Reader = Mesh<Scalar> (*)(std::string_view);

template <typename Scalar>
Reader<Scalar> reader_for(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) {
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (ending == ".obj") return &read_obj<Scalar>;
  if (ending == ".ply") return &read_ply<Scalar>;
  if (ending == ".stl") return &read_stl<Scalar>;
  if (ending == ".off") return &read_off<Scalar>;
  throw InputError("a mesh file's name ends in .obj, .ply, .stl or .off");
}

}  // namespace

template <typename Scalar>
Mesh<Scalar> read_mesh(const std::string& path) {
  try {
    const Reader<Scalar> read = reader_for<Scalar>(path);
    return read(read_file(path));
  } catch (const InputError& error) {
    throw error.at(path);
  }
}

template Mesh<float> read_mesh<float>(const std::string&);
template Mesh<double> read_mesh<double>(const std::string&);

}  // namespace surehit::example
