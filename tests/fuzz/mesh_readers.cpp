// Any bytes to a reader of mesh files, which the first byte chooses: an error of one line or a sound mesh, from memory
// in proportion to the bytes.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "finding.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/read_obj.hpp"
#include "mesh_io/read_off.hpp"
#include "mesh_io/read_ply.hpp"
#include "mesh_io/read_stl.hpp"
#include "peak_memory.hpp"

namespace surehit::test {
namespace {

using example::Mesh;

template <typename Scalar>
using Reader = Mesh<Scalar> (*)(std::string_view);

template <typename Scalar>
constexpr std::array<Reader<Scalar>, 4> readers = {&example::read_obj<Scalar>, &example::read_off<Scalar>,
                                                   &example::read_ply<Scalar>, &example::read_stl<Scalar>};

/// The densest file says a corner in a byte; a mesh in double keeps 24 for it, and three times as many while it grows.
/// Text is cut into views of its words, in the same proportion. The rest is for messages.
constexpr std::size_t allowed_memory(std::size_t bytes) { return 100 * bytes + 4096; }

/// No mesh where the reader reports an error.
template <typename Scalar>
std::optional<Mesh<Scalar>> read(std::size_t which, std::string_view file) {
  std::optional<Mesh<Scalar>> mesh;
  std::string error;
  begin_peak_memory();
  try {
    mesh = readers<Scalar>[which](file);
  } catch (const example::InputError& refusal) {
    error = refusal.what();
  }
  const std::size_t memory = peak_memory();
  if (memory > allowed_memory(file.size())) stop_at("takes " + std::to_string(memory) + " bytes of memory");
  if (!mesh) {
    if (error.empty() || error.find('\n') != std::string::npos) stop_at("not an error of one line: " + error);
    return mesh;
  }
  if (mesh->vertices.size() + mesh->triangles.size() > file.size()) stop_at("more elements than bytes");
  if (const auto invalid = find_invalid(mesh->view())) stop_at(invalid->what());
  if (!mesh->faces.empty() && mesh->faces.size() != mesh->triangles.size()) stop_at("not a face for each triangle");
  return mesh;
}

void check(std::size_t which, std::string_view file) {
  const auto in_double = read<double>(which, file);
  const auto in_float = read<float>(which, file);
  // A double may lie beyond the largest float, and the outline of a face may cross itself in one of the two alone.
  if (!in_float || !in_double) return;
  if (in_float->faces != in_double->faces || in_float->triangles.size() != in_double->triangles.size() ||
      in_float->vertices.size() != in_double->vertices.size()) {
    stop_at("another mesh in float than in double");
  }
  // Faces of more than three corners are cut by where the corners are.
  if (in_float->faces.empty() && in_float->triangles != in_double->triangles) {
    stop_at("other triangles in float than in double");
  }
}

}  // namespace
}  // namespace surehit::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  surehit::test::check(data[0] % 4, {reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}
