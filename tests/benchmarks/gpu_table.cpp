#include <algorithm>
#include <cstdio>
#include <span>
#include <stdexcept>
#include <surehit/gpu.hpp>

#include "gpu/device_answers.hpp"
#include "gpu/gpu_buffer.hpp"
#include "gpu/gpu_device_state.hpp"
#include "question.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

using detail::GpuBuffer;
using detail::GpuDeviceState;

/// Segments of a set. A path batch would hold them in layouts that nobody asks for here.
std::vector<Segmentf> draw_segments(PathSet set, const NamedMesh& named, std::size_t count) {
  constexpr std::size_t at_once = 100'000;
  std::vector<Segmentf> all;
  for (std::uint64_t seed = 1; all.size() < count; ++seed) {
    const PathBatch some = draw_paths(set, named, std::min(at_once, count - all.size()), seed);
    all.insert(all.end(), some.segments().begin(), some.segments().end());
  }
  all.resize(count);
  return all;
}

/// A buffer on the device.
class DeviceBuffer {
 public:
  DeviceBuffer(const GpuDevice& device, std::size_t size) : state_(*GpuDeviceState::of(device)) {
    if (const auto error = buffer_.make(state_, size, GpuBuffer::Place::device, "a benchmark")) throw GpuError(*error);
  }
  void fill(std::span<const std::byte> bytes) {
    detail::GpuWork work(state_);
    if (const auto error = work.begin(nullptr)) throw GpuError(*error);
    if (const auto error = state_.upload(work.slots()[0], bytes, buffer_)) throw GpuError(*error);
  }
  [[nodiscard]] GpuBufferPart part() const {
    const VkBuffer handle = buffer_.get();
    GpuBufferPart part = {0, 0, buffer_.size()};
    std::copy_n(reinterpret_cast<const std::byte*>(&handle), sizeof handle, reinterpret_cast<std::byte*>(&part.buffer));
    return part;
  }

 private:
  GpuDeviceState& state_;
  GpuBuffer buffer_;
};

/// Times of each round, in nanoseconds per path.
struct GpuTimes {
  RoundSeries on_host, with_transfers, in_buffers;
  GpuStatistics statistics;
};

void require(const GpuBatchResult& result) {
  if (!result) throw GpuError(*result.error);
}

GpuTimes race(const GpuDevice& device, const GpuCollider& on_gpu, const Colliderf& collider,
              const std::vector<Segmentf>& paths, Question question, std::size_t rounds) {
  const std::span<const Segmentf> segments = paths;
  DeviceBuffer given(device, segments.size_bytes());
  const DeviceBuffer answers(device, paths.size() * sizeof(detail::DeviceHit));
  given.fill(std::as_bytes(segments));
  const GpuPaths in_buffer = {PathKind::segment, paths.size(), given.part()};
  std::vector<Hitf> hits(paths.size());
  std::vector<std::uint8_t> blocked(paths.size());
  const bool wants_first = question == Question::closest_hit;
  GpuTimes times;
  const auto per_path = [&](const auto& work) { return nanoseconds_of(work) / static_cast<double>(paths.size()); };
  for (std::size_t round = 0; round <= rounds; ++round) {
    GpuStatistics statistics;
    const double on_host = per_path([&] {
      if (wants_first) collider.first_hits(segments, hits);
      if (!wants_first) collider.any_hits(segments, blocked);
    });
    const double with_transfers = per_path([&] {
      if (wants_first) require(on_gpu.first_hits(segments, hits));
      if (!wants_first) require(on_gpu.any_hits(segments, blocked));
    });
    const double in_buffers = per_path([&] {
      if (wants_first) require(on_gpu.first_hits(in_buffer, answers.part(), {}, {.statistics = &statistics}));
      if (!wants_first) require(on_gpu.any_hits(in_buffer, answers.part(), {}, {.statistics = &statistics}));
    });
    times.statistics = statistics;
    if (round == 0) continue;  // The first one warms up.
    times.on_host.push_back(on_host);
    times.with_transfers.push_back(with_transfers);
    times.in_buffers.push_back(in_buffers);
  }
  return times;
}

void add_row(const Place& place, std::size_t count, const GpuTimes& times, MarkdownTable& table, Report& report) {
  const std::string on = " in batches of " + std::to_string(count);
  const auto keep = [&](const std::string& contender, const RoundSeries& series) {
    const Summary time = summary_of(series);
    report.keep(place, contender, "ns per path" + on, time);
    return short_number(time.median);
  };
  const GpuStatistics& of = times.statistics;
  const double left = 100 * static_cast<double>(of.undecided + of.rounded_by_host) / static_cast<double>(of.paths);
  report.keep(place, "surehit on a GPU", "percent left to the host" + on, summary_of(left));
  table.add_row({place.mesh, place.paths, place.question, std::to_string(count), keep("surehit batch", times.on_host),
                 keep("surehit on a GPU, with transfers", times.with_transfers),
                 keep("surehit on a GPU, in its buffers", times.in_buffers), short_number(left)});
}

}  // namespace

void measure_gpu(const Request& request, Report& report) {
  GpuDevice device;
  if (const GpuResult opened = device.try_open({.name = request.gpu_name}); !opened) {
    std::printf("\ngpu: left out, because %s\n", opened.error().what());
    return;
  }
  MarkdownTable table({"mesh", "paths", "question", "batch", "on the host", "with transfers", "in buffers", "left, %"},
                      3);
  for (const NamedMesh& named : request.meshes) {
    const Colliderf collider(named.mesh.view());
    const GpuCollider on_gpu(device, collider);
    for (const PathSet set : request.sets) {
      for (const std::size_t count : request.gpu_paths) {
        const std::vector<Segmentf> paths = draw_segments(set, named, count);
        for (const Question question : {Question::closest_hit, Question::any_hit}) {
          const Place place{"gpu", named.name, named.mesh.triangles.size(), name_of(set), name_of(question)};
          add_row(place, count, race(device, on_gpu, collider, paths, question, request.rounds), table, report);
        }
      }
    }
  }
  report.show("gpu: ns per path on " + device.name() + ", and on one thread of the host", table);
}

}  // namespace surehit::benchmark
