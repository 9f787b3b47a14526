#include "line_of_sight/floor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "command_line/chunked_run.hpp"

namespace surehit::example {
namespace {

/// The middle of one of `count` equal parts of [low, high].
float middle_of_part(std::size_t part, std::size_t count, float low, float high) {
  return low + (high - low) * ((static_cast<float>(part) + 0.5f) / static_cast<float>(count));
}

}  // namespace

FloorPlan::FloorPlan(const Colliderf& collider, float cut_height, std::size_t wanted, unsigned threads)
    : box_(collider.box()) {
  if (box_.is_empty() || !(box_.low.x() < box_.high.x() && box_.low.y() < box_.high.y())) {
    throw std::runtime_error("the mesh covers no area in the plan");
  }
  if (!(box_.high - box_.low).allFinite()) throw std::runtime_error("the mesh is too large to be drawn");
  const std::size_t most = 64 * wanted;
  for (std::size_t points = wanted; points <= most;) {
    divide(points);
    run_in_chunks("floor", size(), 1 << 14, threads, [&](std::size_t begin, std::size_t end) {
      std::vector<Rayf> rays;
      for (std::size_t i = begin; i < end; ++i) rays.push_back({{x(i), y(i), cut_height}, {0, 0, -1}});
      std::vector<Hitf> hits(rays.size());
      collider.first_hits(rays, hits);
      for (std::size_t i = begin; i < end; ++i) {
        const Hitf& hit = hits[i - begin];
        const bool is_floor = hit.triangle != no_triangle && hit.side == Side::front;
        heights_[i] = is_floor ? cut_height - hit.t : std::numeric_limits<float>::quiet_NaN();
      }
    });
    const std::size_t found = floor_count();
    if (found >= wanted) return;
    if (found == 0) {
      throw std::runtime_error("there is no floor below " + std::to_string(cut_height) +
                               ": no triangle whose front looks up (is z up in this mesh?)");
    }
    const double share = static_cast<double>(found) / static_cast<double>(size());
    points = static_cast<std::size_t>(1.01 * static_cast<double>(wanted) / share) + 1;
  }
  throw std::runtime_error("too little of the plan has a floor for so many points");
}

void FloorPlan::divide(std::size_t points) {
  const double width = double{box_.high.x()} - double{box_.low.x()};
  const double depth = double{box_.high.y()} - double{box_.low.y()};
  const double most = static_cast<double>(points);
  columns_ = static_cast<std::size_t>(std::clamp(std::ceil(std::sqrt(most * (width / depth))), 1.0, most));
  rows_ = (points + columns_ - 1) / columns_;
  heights_.assign(columns_ * rows_, 0);
}

float FloorPlan::x(std::size_t index) const {
  return middle_of_part(index % columns_, columns_, box_.low.x(), box_.high.x());
}

float FloorPlan::y(std::size_t index) const {
  return middle_of_part(index / columns_, rows_, box_.low.y(), box_.high.y());
}

bool FloorPlan::has_floor(std::size_t index) const { return !std::isnan(heights_[index]); }

std::size_t FloorPlan::floor_count() const {
  return static_cast<std::size_t>(
      std::count_if(heights_.begin(), heights_.end(), [](float height) { return !std::isnan(height); }));
}

}  // namespace surehit::example
