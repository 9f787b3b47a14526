#include "surehit_query/baked_collider.hpp"

#include <fstream>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "command_line/output_file.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/read_file.hpp"
#include "surehit_query/mask_list.hpp"

namespace surehit::example {
namespace {

/// Returns whether a file begins as a saved collider does. No mesh file begins so.
bool is_baked(const std::string& path) {
  constexpr std::string_view magic = "\x89srht\r\n\x1a";
  std::string start(magic.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  return file && start == magic;
}

template <typename Scalar>
void bake_in(const QueryRequest& request) {
  const ReadCollider<Scalar> mesh = read_collider<Scalar>(request);
  OutputFile output(request.output_path);
  const auto write = [&](std::span<const std::byte> bytes) {
    output.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return true;
  };
  static_cast<void>(mesh.collider.save(write));  // `write` throws instead.
  output.finish();
}

}  // namespace

void bake(const QueryRequest& request) {
  if (request.scalar == ScalarKind::single_precision) {
    bake_in<float>(request);
  } else {
    bake_in<double>(request);
  }
}

template <typename Scalar>
std::optional<Collider<Scalar>> load_baked(const QueryRequest& request) {
  if (!is_baked(request.mesh_path)) return std::nullopt;
  if (request.ids == IdKind::face || request.ignored_face) {
    throw InputError(request.mesh_path + ": a saved collider has no faces, only triangles");
  }
  const std::string bytes = read_file(request.mesh_path);
  Collider<Scalar> collider;
  if (const LoadResult loaded = collider.try_load(std::as_bytes(std::span(bytes))); !loaded) {
    throw InputError(request.mesh_path + ": " + loaded.error().what());
  }
  check_is_there(request.ignored_triangle, collider.triangle_count(), "triangle");
  if (request.masks_path.empty()) return collider;
  const std::vector<std::uint32_t> masks = read_masks(request.masks_path);
  if (const BuildResult set = collider.try_set_masks(masks); !set || masks.size() != collider.triangle_count()) {
    throw InputError(request.masks_path + ": " + std::to_string(masks.size()) + " masks for " +
                     std::to_string(collider.triangle_count()) + " triangles");
  }
  return collider;
}

template std::optional<Collider<float>> load_baked(const QueryRequest&);
template std::optional<Collider<double>> load_baked(const QueryRequest&);

}  // namespace surehit::example
