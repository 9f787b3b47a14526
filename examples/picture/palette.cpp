#include "picture/palette.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace surehit::example {

Palette::Bytes Palette::bytes_of(const Colour& colour) {
  const auto byte = [](float part) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0f, 1.0f)));
  };
  return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

std::size_t Palette::cell_of(const Bytes& bytes) {
  std::size_t cell = 0;
  for (const std::uint8_t byte : bytes) cell = cell << bits | byte >> (8 - bits);
  return cell;
}

void Palette::count(const Canvas& canvas) {
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      const Bytes bytes = bytes_of(canvas.at(x, y));
      Cell& cell = cells_[cell_of(bytes)];
      ++cell.pixels;
      for (std::size_t part = 0; part < 3; ++part) cell.sums[part] += bytes[part];
    }
  }
}

void Palette::choose() {
  std::vector<std::size_t> order(cells_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return cells_[i].pixels; });
  colours_.clear();
  for (std::size_t i = 0; i < max_colours && cells_[order[i]].pixels > 0; ++i) {
    const Cell& cell = cells_[order[i]];
    Bytes mean;
    for (std::size_t part = 0; part < 3; ++part) mean[part] = static_cast<std::uint8_t>(cell.sums[part] / cell.pixels);
    colours_.push_back(mean);
  }
  nearest_.assign(cells_.size(), 0);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].pixels == 0) continue;
    std::int64_t best = std::numeric_limits<std::int64_t>::max();
    for (std::size_t colour = 0; colour < colours_.size(); ++colour) {
      std::int64_t distance = 0;
      for (std::size_t part = 0; part < 3; ++part) {
        const auto difference =
            static_cast<std::int64_t>(cells_[i].sums[part] / cells_[i].pixels) - std::int64_t{colours_[colour][part]};
        distance += difference * difference;
      }
      if (distance >= best) continue;
      best = distance;
      nearest_[i] = static_cast<std::uint8_t>(colour);
    }
  }
}

}  // namespace surehit::example
