#include "mesh_io/read_mesh.hpp"

#include <filesystem>
#include <string_view>
#include <type_traits>

#include "mesh_io/float_loss.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/lower_case.hpp"
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
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  if (ending == ".obj") return &read_obj<Scalar>;
  if (ending == ".ply") return &read_ply<Scalar>;
  if (ending == ".stl") return &read_stl<Scalar>;
  if (ending == ".off") return &read_off<Scalar>;
  throw InputError("a mesh file's name ends in .obj, .ply, .stl or .off");
}

/// Reads the file once more, in double, where that may make a difference.
void warn_of_float_loss(const std::string& path, std::string_view bytes, Mesh<float>& mesh) {
  if (!may_lose_in_float(mesh)) return;
  try {
    const Mesh<double> exact = reader_for<double>(path)(bytes);
    if (auto loss = describe_float_loss(mesh, exact)) mesh.warnings.push_back(*std::move(loss));
  } catch (const InputError&) {
    // The outline of a face crosses itself by less than floats can tell.
  }
}

bool can_be_read_in_double(const std::string& path, std::string_view bytes) {
  try {
    static_cast<void>(reader_for<double>(path)(bytes));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

Mesh<float> read_in_float(const std::string& path, std::string_view bytes) {
  try {
    Mesh<float> mesh = reader_for<float>(path)(bytes);
    warn_of_float_loss(path, bytes, mesh);
    return mesh;
  } catch (const InputError& error) {
    if (!can_be_read_in_double(path, bytes)) throw;
    throw InputError(std::string(error.what()) + " (only in float: double can read the file)");
  }
}

}  // namespace

template <typename Scalar>
Mesh<Scalar> read_mesh(const std::string& path) {
  try {
    const Reader<Scalar> read = reader_for<Scalar>(path);
    const std::string bytes = read_file(path);
    if constexpr (std::is_same_v<Scalar, float>) return read_in_float(path, bytes);
    return read(bytes);
  } catch (const InputError& error) {
    throw error.at(path);
  }
}

template Mesh<float> read_mesh<float>(const std::string&);
template Mesh<double> read_mesh<double>(const std::string&);

}  // namespace surehit::example
