#include "grid/grid_cover.hpp"

#include <algorithm>
#include <span>

#include "grid/grid.hpp"
#include "support/rounding_flags.hpp"

namespace surehit {
namespace {

/// A box, counted in finest cells. It is empty at first.
struct CoverBox {
  static constexpr float outside = 0x1p20F;  ///< A coordinate outside any grid.

  std::array<float, 3> low = {outside, outside, outside};
  std::array<float, 3> high = {-outside, -outside, -outside};

  [[nodiscard]] bool is_empty() const { return low[0] > high[0]; }
  /// Grows until it holds the other box too.
  void grow_around(const CoverBox& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
  /// Returns half the surface of the box.
  [[nodiscard]] float surface() const {
    const float x = high[0] - low[0];
    const float y = high[1] - low[1];
    const float z = high[2] - low[2];
    return x * y + y * z + z * x;
  }
};

/// A part of the grid, out of 8 × 8 × 8 parts.
struct GridPart {
  static constexpr std::uint32_t on_an_axis = 8;  ///< The number of parts on each axis.
  static constexpr std::size_t max_count = std::size_t{on_an_axis} * on_an_axis * on_an_axis;

  std::array<std::uint32_t, 3> cell = {0, 0, 0};  ///< The index of the part on each axis.
  CoverBox box;                                   ///< A box around what the cells of the part list.
};

/// Some parts of the grid, the box around them, and the best way to divide them into two groups.
struct PartGroup {
  std::span<GridPart> parts;
  CoverBox box;
  float gain = 0;           ///< The surface that the division saves, or 0 if no division saves any.
  std::size_t axis = 0;     ///< The axis on which the group is divided.
  std::uint32_t plane = 0;  ///< The index on that axis of the first part of the second group.

  PartGroup() = default;
  explicit PartGroup(std::span<GridPart> some) : parts(some) {
    for (const GridPart& part : parts) box.grow_around(part.box);
    for (std::size_t on = 0; on < 3; ++on) {
      std::array<CoverBox, GridPart::on_an_axis> slabs;
      for (const GridPart& part : parts) slabs[part.cell[on]].grow_around(part.box);
      std::array<CoverBox, GridPart::on_an_axis> from = slabs;  // The box around this slab and all after it.
      for (std::size_t at = from.size() - 1; at > 0; --at) from[at - 1].grow_around(from[at]);
      CoverBox before;
      for (std::uint32_t at = 1; at < GridPart::on_an_axis; ++at) {
        before.grow_around(slabs[at - 1]);
        if (before.is_empty() || from[at].is_empty()) continue;
        const float gained = box.surface() - before.surface() - from[at].surface();
        if (gained <= gain) continue;
        gain = gained;
        axis = on;
        plane = at;
      }
    }
  }
};

/// The parts of a grid whose cells list something.
class ListingParts {
 public:
  explicit ListingParts(const Grid& grid) : grid_(grid) {
    visit_cells([&](std::size_t part, const auto&, CellWord) { lists_.at(part) = true; });
  }

  /// Returns the share of the grid's silhouette, seen along the axes, in which something is listed.
  [[nodiscard]] float silhouette() const {
    std::array<std::array<bool, std::size_t{n} * n>, 3> seen = {};
    for (std::uint32_t i = 0; i < lists_.size(); ++i) {
      if (!lists_[i]) continue;
      const auto [x, y, z] = position_of(i);
      seen[0][y * n + z] = seen[1][x * n + z] = seen[2][x * n + y] = true;
    }
    float surface = 0;
    float whole = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t next = (axis + 1) % 3;
      const std::size_t last = (axis + 2) % 3;
      const auto& cells = grid_.resolution();
      // If an axis has fewer cells than parts, each cell has a part of its own.
      const auto parts = static_cast<float>(std::min(cells[next], n) * std::min(cells[last], n));
      const float face = grid_.frame().float_stop[next] * grid_.frame().float_stop[last];
      whole += face;
      surface += face * static_cast<float>(std::count(seen[axis].begin(), seen[axis].end(), true)) / parts;
    }
    return surface / whole;
  }

  /// Fills `parts` with these parts and their boxes. Returns their number.
  [[nodiscard]] std::size_t boxed(std::array<GridPart, GridPart::max_count>& parts) const {
    std::array<CoverBox, GridPart::max_count> boxes;
    const auto size = static_cast<float>(grid_.frame().division);
    visit_cells([&](std::size_t part, const std::array<std::uint32_t, 3>& cell, CellWord word) {
      CoverBox box;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr std::uint32_t steps = CellBox::parts;
        const std::uint32_t low = word.is_divided() ? 0 : grid_.box(word).low(axis);
        const std::uint32_t high = word.is_divided() ? steps : grid_.box(word).high(axis);
        const auto corner = static_cast<float>(cell[axis]);
        box.low[axis] = (corner + static_cast<float>(low) / steps) * size;
        box.high[axis] = (corner + static_cast<float>(high) / steps) * size;
      }
      boxes.at(part).grow_around(box);
    });
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (lists_[i]) parts[count++] = GridPart{position_of(i), boxes[i]};
    }
    return count;
  }

 private:
  static constexpr std::uint32_t n = GridPart::on_an_axis;

  static std::array<std::uint32_t, 3> position_of(std::uint32_t part) { return {part % n, part / n % n, part / n / n}; }

  /// Calls visit(part, cell, word) for each top cell that is not empty.
  template <typename Visit>
  void visit_cells(const Visit& visit) const {
    const auto& cells = grid_.resolution();
    const CellWord* word = grid_.top().data();
    std::array<std::uint32_t, 3> cell;
    for (cell[2] = 0; cell[2] < cells[2]; ++cell[2]) {
      for (cell[1] = 0; cell[1] < cells[1]; ++cell[1]) {
        const std::size_t row = (std::size_t{cell[2] * n / cells[2]} * n + cell[1] * n / cells[1]) * n;
        for (cell[0] = 0; cell[0] < cells[0]; ++cell[0], ++word) {
          if (!word->is_empty()) visit(row + cell[0] * n / cells[0], cell, *word);
        }
      }
    }
  }

  const Grid& grid_;
  std::array<bool, GridPart::max_count> lists_ = {};
};

}  // namespace

GridCover::GridCover(const Grid& grid) {
  const ListingParts listing(grid);
  if (listing.silhouette() >= useful_share) return;
  std::array<GridPart, GridPart::max_count> parts;
  std::array<PartGroup, max_boxes> groups;
  std::size_t count = 0;
  groups[count++] = PartGroup(std::span(parts).first(listing.boxed(parts)));
  while (count < max_boxes) {
    PartGroup& best = *std::max_element(groups.data(), groups.data() + count,
                                        [](const PartGroup& a, const PartGroup& b) { return a.gain < b.gain; });
    if (best.gain <= 0) break;
    const auto middle = std::partition(best.parts.begin(), best.parts.end(),
                                       [&](const GridPart& part) { return part.cell[best.axis] < best.plane; });
    const auto first = static_cast<std::size_t>(middle - best.parts.begin());
    const std::span<GridPart> second = best.parts.subspan(first);
    best = PartGroup(best.parts.first(first));
    groups[count++] = PartGroup(second);
  }

  CoverBox whole;
  float surface = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    whole.low[axis] = 0;
    whole.high[axis] = grid.frame().float_stop[axis];
    for (Sides& sides : sides_[axis]) {
      sides.near.fill(detail::all_lanes(never));
      sides.far.fill(detail::all_lanes(-never));
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const CoverBox& box = groups[i].box;
    surface += box.surface();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float padding = grid.frame().padding(axis);
      auto& [rising, mirrored] = sides_[axis];
      rising.near[i / 4][i % 4] = box.low[axis] - padding;
      rising.far[i / 4][i % 4] = box.high[axis] + padding;
      mirrored.near[i / 4][i % 4] = whole.high[axis] - box.high[axis] - padding;
      mirrored.far[i / 4][i % 4] = whole.high[axis] - box.low[axis] + padding;
    }
  }
  is_useful_ = surface < useful_share * whole.surface();
}

}  // namespace surehit
