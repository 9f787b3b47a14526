#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace surehit::example {

/// What a renderer asks about.
enum class RayKind : std::uint8_t {
  primary,     ///< from the eye through a pixel
  shadow,      ///< to a lamp
  secondary,   ///< reflected or refracted
  free_point,  ///< from a ray's origin to just before its hit
};

/// How many rays of each kind were asked about, and how long the queries took.
class RayCounts {
 public:
  /// Runs a query of `count` rays, and counts it.
  template <typename Query>
  void measure(RayKind kind, std::size_t count, Query query) {
    const auto start = std::chrono::steady_clock::now();
    query();
    Count& sum = counts_[static_cast<std::size_t>(kind)];
    sum.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    sum.rays += count;
  }

  RayCounts& operator+=(const RayCounts& more);
  [[nodiscard]] std::size_t rays(RayKind kind) const { return counts_[static_cast<std::size_t>(kind)].rays; }
  [[nodiscard]] std::size_t all() const;
  /// A line for each kind that was asked about.
  [[nodiscard]] std::string text() const;

 private:
  struct Count {
    std::size_t rays = 0;
    double seconds = 0;  ///< of all threads
  };

  std::array<Count, 4> counts_;
};

/// A number of rays in a time, such as "2.1 M rays/s".
[[nodiscard]] std::string rate_text(std::size_t rays, double seconds);
/// The same for rays since a start.
[[nodiscard]] std::string rate_since(std::chrono::steady_clock::time_point start, std::size_t rays);

}  // namespace surehit::example
