#include "visibility_bake/checkpoint.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <string_view>

#include "command_line/output_file.hpp"
#include "mesh_io/byte_reader.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/read_file.hpp"
#include "visibility_bake/checked_bytes.hpp"

namespace surehit::example {
namespace {

constexpr std::string_view title_of_checkpoint = "surehit visibility checkpoint 1\n";

std::string_view as_text(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Visibility Checkpoint::load(std::uint32_t cells) const {
  Visibility visibility(cells);
  if (!std::filesystem::exists(path_)) return visibility;
  try {
    const std::string file = read_file(path_);
    ByteReader reader(checked_content(file, title_of_checkpoint), std::endian::little);
    if (reader.take<std::uint64_t>() != fingerprint_ || reader.take<std::uint32_t>() != cells) {
      throw InputError("is of another mesh, of other cells or of other options");
    }
    for (Visibility::Figures& figures : visibility.figures_) {
      figures.cells_in_range = reader.take<std::uint64_t>();
      figures.cells_seen = reader.take<std::uint64_t>();
      figures.clear_segments = reader.take<std::uint64_t>();
    }
    const auto take_all = [&](std::vector<std::uint8_t>& bytes) {
      for (std::uint8_t& byte : bytes) byte = reader.take<std::uint8_t>();
    };
    take_all(visibility.has_row_);
    take_all(visibility.bits_);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "; remove it, or begin again with --restart").at(path_);
  }
  visibility.row_count_ = static_cast<std::uint32_t>(std::ranges::count(visibility.has_row_, 1));
  return visibility;
}

void Checkpoint::save(const Visibility& visibility) const {
  ByteWriter writer(title_of_checkpoint);
  writer.add(fingerprint_, 8);
  writer.add(visibility.cell_count(), 4);
  for (const Visibility::Figures& figures : visibility.figures_) {
    writer.add(figures.cells_in_range, 8);
    writer.add(figures.cells_seen, 8);
    writer.add(figures.clear_segments, 8);
  }
  writer.add(as_text(visibility.has_row_));
  writer.add(as_text(visibility.bits_));
  write_file(path_, writer.finish(), Durability::machine);
}

void Checkpoint::remove() const {
  std::remove(path_.c_str());
  std::remove((path_ + ".partial").c_str());
}

}  // namespace surehit::example
