#include "render/ray_counts.hpp"

#include <cstdio>

namespace surehit::example {

RayCounts& RayCounts::operator+=(const RayCounts& more) {
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    counts_[i].rays += more.counts_[i].rays;
    counts_[i].seconds += more.counts_[i].seconds;
  }
  return *this;
}

std::size_t RayCounts::all() const {
  std::size_t sum = 0;
  for (const Count& count : counts_) sum += count.rays;
  return sum;
}

std::string RayCounts::text() const {
  constexpr std::array<const char*, 4> names = {"primary rays", "shadow rays", "secondary rays", "free points"};
  std::string lines;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i].rays == 0) continue;
    char line[80];
    std::snprintf(line, sizeof line, "  %-15s %10zu  %s on a thread\n", names[i], counts_[i].rays,
                  rate_text(counts_[i].rays, counts_[i].seconds).c_str());
    lines += line;
  }
  return lines;
}

std::string rate_since(std::chrono::steady_clock::time_point start, std::size_t rays) {
  return rate_text(rays, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

std::string rate_text(std::size_t rays, double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f M rays/s", seconds > 0 ? static_cast<double>(rays) / seconds / 1e6 : 0.0);
  return text;
}

}  // namespace surehit::example
