#include "visibility_bake/visible_sets.hpp"

#include <bit>
#include <cstdio>

#include "mesh_io/byte_reader.hpp"
#include "mesh_io/input_error.hpp"
#include "visibility_bake/checked_bytes.hpp"

namespace surehit::example {
namespace {

constexpr std::string_view title_of_sets = "surehit potentially visible sets 1\n";

}  // namespace

std::string encode_visible_sets(const PairPlan& plan, const Visibility& visibility) {
  ByteWriter writer(title_of_sets);
  writer.add(plan.cell_count(), 4);
  writer.add(plan.options().range);
  writer.add(plan.options().samples, 4);
  for (const Vector3f& floor : plan.floors()) {
    for (const float coordinate : {floor.x(), floor.y(), floor.z()}) writer.add(coordinate);
  }
  const std::vector<std::uint8_t> bits = visibility.matrix();
  writer.add(compressed_bytes({reinterpret_cast<const char*>(bits.data()), bits.size()}));
  return writer.finish();
}

VisibleSets decode_visible_sets(std::string_view file) {
  ByteReader reader(checked_content(file, title_of_sets), std::endian::little);
  VisibleSets sets;
  const auto cells = reader.take<std::uint32_t>();
  sets.range = reader.take<float>();
  sets.samples = reader.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < cells; ++i) {
    Vector3f floor;
    for (int axis = 0; axis < 3; ++axis) floor[axis] = reader.take<float>();
    sets.floors.push_back(floor);
  }
  sets.bits = decompressed_bytes(reader.rest(), cells * ((std::size_t{cells} + 7) / 8));
  return sets;
}

std::string figures_csv(const PairPlan& plan, const Visibility& visibility) {
  std::string text = "cell,x,y,z,cells_in_range,cells_seen,segments,clear_segments\n";
  for (std::uint32_t cell = 0; cell < plan.cell_count(); ++cell) {
    const Vector3f& floor = plan.floors()[cell];
    const Visibility::Figures& figures = visibility.figures(cell);
    const std::uint64_t segments = figures.cells_in_range * plan.options().samples;
    char place[96];
    std::snprintf(place, sizeof place, "%u,%.9g,%.9g,%.9g", cell, double{floor.x()}, double{floor.y()},
                  double{floor.z()});
    text += place;
    for (const std::uint64_t figure : {figures.cells_in_range, figures.cells_seen, segments, figures.clear_segments}) {
      text += ',';
      text += std::to_string(figure);
    }
    text += '\n';
  }
  return text;
}

}  // namespace surehit::example
