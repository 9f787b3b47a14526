#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <surehit/path.hpp>
#include <vector>

namespace surehit::benchmark {

/// Eight segments side by side, as packet queries take them.
struct alignas(32) PathOctet {
  float start[3][8];
  float direction[3][8];
};

/// Segments in all layouts, so that no contender's time contains a change of layout.
class PathBatch {
 public:
  static constexpr std::size_t octet_size = 8;

  /// As many segments as fill octets.
  explicit PathBatch(std::vector<Segmentf> segments);

  [[nodiscard]] std::size_t size() const { return segments_.size(); }
  [[nodiscard]] std::span<const Segmentf> segments() const { return segments_; }
  [[nodiscard]] std::span<const Segmentd> in_double() const { return in_double_; }
  [[nodiscard]] std::span<const PathOctet> octets() const { return octets_; }
  /// One of as many equal parts, a thread's share.
  [[nodiscard]] PathBatch part(std::size_t index, std::size_t parts) const;

 private:
  std::vector<Segmentf> segments_;
  std::vector<Segmentd> in_double_;
  std::vector<PathOctet> octets_;
};

/// Calls ask(segments, begin) for one part of at most `size` paths after the other. It begins at path `begin`.
template <typename Ask>
void for_each_batch(const PathBatch& paths, std::size_t size, const Ask& ask) {
  const std::span<const Segmentf> all = paths.segments();
  for (std::size_t i = 0; i < all.size(); i += size) ask(all.subspan(i, std::min(size, all.size() - i)), i);
}

}  // namespace surehit::benchmark
