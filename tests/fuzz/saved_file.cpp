// Any bytes to the loads of colliders and of scenes. The first byte chooses which, and whether the checksums are made
// right before, so that what lies behind them is attacked. A load ends with an error that says where, or with a
// collider that answers as one that is built anew of its mesh. Memory is in proportion to the bytes.

#include "support/saved_file.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "finding.hpp"
#include "peak_memory.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/same_bits.hpp"
#include "surehit/collider.hpp"
#include "surehit/scene.hpp"

namespace surehit::test {
namespace {

constexpr int paths_of_a_case = 12;

/// A byte of a file becomes a word of a cell and its distances, and two bytes of an entry become the corners of a
/// triangle in double. The rest is for a part of the check, whatever the file is.
constexpr std::size_t allowed_memory(std::size_t bytes) { return 200 * bytes + (std::size_t{1} << 20); }

/// Makes the checksum right, and before it those of the colliders in a scene.
void repair_all(Bytes& bytes) {
  constexpr std::size_t kind_at = 14;
  constexpr std::size_t first_collider = 36;
  if (bytes.size() > first_collider && bytes[kind_at] == std::byte{'s'}) {
    std::size_t at = first_collider;
    for (auto count = number_at<std::uint32_t>(bytes, 24); count > 0 && bytes.size() - at > 8; --count) {
      const auto size = number_at<std::uint64_t>(bytes, at);
      at += 8;
      if (size > bytes.size() - at) break;
      Bytes collider(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                     bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
      repair(collider);
      std::copy(collider.begin(), collider.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
      at += size;
    }
  }
  repair(bytes);
}

/// Loads the bytes, and says what is wrong with the way of it. Returns false for an error.
template <typename T>
bool load(T& into, const Bytes& bytes, bool is_trusted) {
  begin_peak_memory();
  const LoadResult result = into.try_load(bytes, {.is_trusted = is_trusted});
  const std::size_t memory = peak_memory();
  if (memory > allowed_memory(bytes.size())) stop_at("takes " + std::to_string(memory) + " bytes of memory");
  if (result) return true;
  const std::string what = result.error().what();
  if (!what.starts_with("byte ") || what.find('\n') != std::string::npos) stop_at("not an error of one line: " + what);
  if (result.error().offset > bytes.size()) stop_at("an error beyond the end: " + what);
  return false;
}

template <typename T>
void check_saved_again(const T& loaded) {
  const Bytes again = saved(loaded);
  T twice;
  if (!twice.try_load(again)) stop_at("what was loaded and saved cannot be loaded");
  if (saved(twice) != again) stop_at("what was loaded and saved twice has other bytes");
}

template <typename Scalar>
void check_collider(const Bytes& bytes, bool is_trusted) {
  Collider<Scalar> loaded;
  if (!load(loaded, bytes, is_trusted)) return;
  if (!is_trusted) check_saved_again(loaded);
  if (loaded.triangle_count() == 0) return;
  GeneratedMesh<Scalar> mesh;
  std::vector<std::uint32_t> masks;
  for (std::uint32_t id = 0; id < loaded.triangle_count(); ++id) {
    mesh.add(loaded.triangle(id));
    masks.push_back(loaded.mask(id));
  }
  Collider<Scalar> built;
  if (!built.try_build(mesh.view(), {.masks = masks})) stop_at("a mesh was loaded that a build refuses");
  PathDrawer<Scalar> drawer(mesh.view(), bytes.size());
  for (int i = 0; i < paths_of_a_case; ++i) {
    const Path<Scalar> path = drawer.draw();
    const auto hit = loaded.first_hit(path);
    const auto expected = built.first_hit(path);
    std::vector<Hit<Scalar>> hits;
    std::vector<Hit<Scalar>> all_expected;
    loaded.all_hits(path, hits);
    built.all_hits(path, all_expected);
    if (is_trusted) continue;  // It has ended, and has read nothing else.
    if (hit.has_value() != expected.has_value() || (hit && !same_bits(*hit, *expected)) ||
        hits.size() != all_expected.size() || loaded.any_hit(path) != expected.has_value()) {
      stop_at("another answer to " + hex_text(path));
    }
  }
}

template <typename Scalar>
void check_scene(const Bytes& bytes, bool is_trusted) {
  Scene<Scalar> loaded;
  if (!load(loaded, bytes, is_trusted)) return;
  if (!is_trusted) check_saved_again(loaded);
  for (const InstanceId id : loaded.instances()) {
    if (loaded.triangle_count(id) == 0) continue;
    const Triangle<Scalar> triangle = loaded.triangle(id, 0);
    static_cast<void>(loaded.first_hit(Segment<Scalar>{triangle.a, triangle.b}));
  }
}

void check(std::uint8_t choice, Bytes bytes) {
  if ((choice & 1) != 0) repair_all(bytes);
  const bool is_trusted = (choice & 2) != 0;
  switch (choice >> 2 & 3) {
    case 0:
      return check_collider<float>(bytes, is_trusted);
    case 1:
      return check_collider<double>(bytes, is_trusted);
    case 2:
      return check_scene<float>(bytes, is_trusted);
    default:
      return check_scene<double>(bytes, is_trusted);
  }
}

}  // namespace
}  // namespace surehit::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  surehit::test::check(data[0], {bytes.begin(), bytes.end()});
  return 0;
}
