#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <surehit/path.hpp>
#include <vector>

namespace surehit::benchmark {

/// Eight segments side by side, as packet queries take them.
struct alignas(32) PathOctet {
  float start[3][8];
  float direction[3][8];
};

/// Segments or rays in all layouts, so that no contender's time contains a change of layout.
class PathBatch {
 public:
  static constexpr std::size_t octet_size = 8;

  /// As many segments as fill octets. If they `are_rays`, they count beyond their ends too.
  explicit PathBatch(std::vector<Segmentf> segments, bool are_rays = false);

  [[nodiscard]] std::size_t size() const { return segments_.size(); }
  [[nodiscard]] bool are_rays() const { return !rays_.empty(); }
  /// Returns the last t that counts.
  [[nodiscard]] float last_t() const { return are_rays() ? std::numeric_limits<float>::infinity() : 1; }
  /// Returns the segments, or for rays those from t = 0 to t = 1.
  [[nodiscard]] std::span<const Segmentf> segments() const { return segments_; }
  /// Returns ask(paths), with the segments or the rays.
  template <typename Ask>
  decltype(auto) visit(const Ask& ask) const {
    return are_rays() ? ask(std::span(rays_)) : ask(std::span(segments_));
  }
  /// Does the same in double.
  template <typename Ask>
  decltype(auto) visit_in_double(const Ask& ask) const {
    return are_rays() ? ask(std::span(rays_in_double_)) : ask(std::span(in_double_));
  }
  [[nodiscard]] std::span<const PathOctet> octets() const { return octets_; }
  /// One of as many equal parts, a thread's share.
  [[nodiscard]] PathBatch part(std::size_t index, std::size_t parts) const;

 private:
  std::vector<Segmentf> segments_;
  std::vector<Segmentd> in_double_;
  std::vector<Rayf> rays_;
  std::vector<Rayd> rays_in_double_;
  std::vector<PathOctet> octets_;
};

/// Calls ask(some, begin) for one part of at most `size` paths after the other. It begins at path `begin`.
template <typename Ask>
void for_each_batch(const PathBatch& paths, std::size_t size, const Ask& ask) {
  paths.visit([&](const auto& all) {
    for (std::size_t i = 0; i < all.size(); i += size) ask(all.subspan(i, std::min(size, all.size() - i)), i);
  });
}

}  // namespace surehit::benchmark
