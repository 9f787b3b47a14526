#include "path_batch.hpp"

#include <stdexcept>
#include <utility>

namespace surehit::benchmark {

PathBatch::PathBatch(std::vector<Segmentf> segments, bool are_rays) : segments_(std::move(segments)) {
  if (segments_.size() % octet_size != 0) throw std::logic_error("a batch has to be made of whole octets");
  octets_.resize(segments_.size() / octet_size);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segmentf& segment = segments_[i];
    in_double_.push_back({segment.start.cast<double>(), segment.end.cast<double>()});
    PathOctet& octet = octets_[i / octet_size];
    for (int axis = 0; axis < 3; ++axis) {
      octet.start[axis][i % octet_size] = segment.start[axis];
      octet.direction[axis][i % octet_size] = segment.end[axis] - segment.start[axis];
    }
    if (!are_rays) continue;
    rays_.push_back({segment.start, segment.end - segment.start});
    rays_in_double_.push_back({rays_.back().origin.cast<double>(), rays_.back().direction.cast<double>()});
  }
}

PathBatch PathBatch::part(std::size_t index, std::size_t parts) const {
  const auto boundary = [&](std::size_t i) {
    return segments_.begin() + static_cast<std::ptrdiff_t>(octets_.size() * i / parts * octet_size);
  };
  return PathBatch({boundary(index), boundary(index + 1)}, are_rays());
}

}  // namespace surehit::benchmark
