#include "render/cost_picture.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <mutex>

#include "command_line/chunked_run.hpp"
#include "command_line/interruption.hpp"
#include "render/frame_colours.hpp"

namespace surehit::example {
namespace {

constexpr int legend_height = 34;

/// From no work to the most: dark, violet, red, orange and light yellow.
Colour heat(float share) {
  constexpr std::array<Colour, 5> stops = {Colour::hex(0x0b0a1c), Colour::hex(0x54157a), Colour::hex(0xb63455),
                                           Colour::hex(0xf5802a), Colour::hex(0xfcf8b0)};
  const float place = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(stops.size() - 1);
  const std::size_t stop = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  return mix(stops[stop], stops[stop + 1], place - static_cast<float>(stop));
}

std::uint64_t count_of(const QueryStatistics& statistics, Cost cost) {
  switch (cost) {
    case Cost::cells:
      return statistics.cells;
    case Cost::candidates:
      return statistics.candidates;
    case Cost::exact_decisions:
      break;
  }
  return statistics.exact_decisions;
}

/// The cost that one pixel in a thousand exceeds. A few extreme pixels shall not make all others dark.
std::uint64_t brightest(std::vector<std::uint64_t> costs) {
  const std::size_t rank = costs.size() - 1 - costs.size() / 1000;
  const auto nth = costs.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(costs.begin(), nth, costs.end());
  return std::max(*nth, std::uint64_t{1});
}

void draw_legend(Canvas& canvas, int top, std::uint64_t brightest, std::uint64_t max, const std::string& name) {
  const auto y = static_cast<float>(top);
  constexpr int ramp = 120;
  for (int x = 0; x < ramp; ++x) {
    for (int row = 12; row < 24; ++row) {
      canvas.at(std::min(12 + x, canvas.width() - 1), top + row) = heat(static_cast<float>(x) / (ramp - 1));
    }
  }
  char text[96];
  std::snprintf(text, sizeof text, "0 to %zu %s a ray, %zu at most", static_cast<std::size_t>(brightest), name.c_str(),
                static_cast<std::size_t>(max));
  canvas.draw_text({12 + ramp + 14, y + 14}, text, 1, ink);
}

}  // namespace

std::vector<std::uint64_t> costs_of(const Colliderf& collider, const Camera& camera, Culling culling, Cost cost,
                                    unsigned threads, RayCounts& counts) {
  const auto width = static_cast<std::size_t>(camera.width());
  const auto height = static_cast<std::size_t>(camera.height());
  std::vector<std::uint64_t> costs(width * height);
  std::mutex mutex;
  const auto start = std::chrono::steady_clock::now();
  const auto draw_rows = [&](std::size_t begin, std::size_t end) {
    stop_if_interrupted();
    RayCounts counts_of_rows;
    counts_of_rows.measure(RayKind::primary, (end - begin) * width, [&] {
      for (std::size_t i = begin * width; i < end * width; ++i) {
        QueryStatistics statistics;
        const Rayf ray = camera.ray(static_cast<int>(i % width), static_cast<int>(i / width));
        static_cast<void>(collider.first_hit(ray, {.culling = culling}, &statistics));
        costs[i] = count_of(statistics, cost);
      }
    });
    const std::lock_guard lock(mutex);
    counts += counts_of_rows;
  };
  run_in_chunks("cost", height, 8, threads, draw_rows, [&] {
    const std::lock_guard lock(mutex);
    return rate_since(start, counts.all());
  });
  return costs;
}

Canvas draw_costs(const std::vector<std::uint64_t>& costs, int width, int height, const std::string& name) {
  Canvas canvas(width, height + legend_height, paper);
  const std::uint64_t full = brightest(costs);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      canvas.at(x, y) = heat(static_cast<float>(costs[i]) / static_cast<float>(full));
    }
  }
  draw_legend(canvas, height, full, *std::ranges::max_element(costs), name);
  return canvas;
}

}  // namespace surehit::example
