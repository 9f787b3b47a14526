#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "dispatch_timer.hpp"
#include "gpu/gpu_buffer.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu/in_dispatches.hpp"
#include "gpu_race.hpp"
#include "pinned_threads.hpp"
#include "tables.hpp"
#include "world_paths.hpp"

namespace surehit::benchmark {
namespace {

using detail::GpuBuffer;
using detail::GpuDeviceState;

/// Segments of a set. `draw(count, seed)` returns some. A path batch would hold all in layouts that nobody asks for.
template <typename Draw>
std::vector<Segmentf> draw_segments(std::size_t count, const Draw& draw) {
  constexpr std::size_t at_once = 100'000;
  std::vector<Segmentf> all;
  for (std::uint64_t seed = 1; all.size() < count; ++seed) {
    const PathBatch some = draw(std::min(at_once, count - all.size()), seed);
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
  RoundSeries on_host, with_transfers;
  RoundSeries on_all_threads, with_transfers_on_all;  ///< The same with all threads of the host.
  RoundSeries in_buffers;
  RoundSeries kernel;  ///< Empty where the device has no timestamps.
  GpuStatistics statistics;
};

std::string all_threads() { return "all threads (" + std::to_string(CorePin::allowed_cores().size()) + ")"; }

/// Times and break-evens, and what they are measured with.
class GpuTables {
 public:
  GpuTables(std::string table, const GpuDevice& device, const Request& request, Report& report)
      : table_(std::move(table)), device_(device), request_(request), report_(report) {}

  /// Adds the rows of a set of paths.
  template <typename Host, typename Draw>
  void measure(const BothSides<Host>& sides, Place place, const Draw& draw) {
    place.table = table_;
    const std::size_t largest = *std::max_element(request_.gpu_paths.begin(), request_.gpu_paths.end());
    const std::vector<Segmentf> paths = draw_segments(largest, draw);
    for (const Question question : all_questions) {
      place.question = name_of(question);
      for (const std::size_t count : request_.gpu_paths) {
        add_times(place, count, race(sides, question, std::span(paths).first(count)));
      }
      add_break_even(place, sides, question, std::span(paths).first(std::min(largest, request_.largest_break_even)));
    }
  }

  void show() const {
    report_.show(table_ + ": ns per path on the host, and on " + device_.name(), times_);
    report_.show(table_ + ": paths in a batch, from which on " + device_.name() + " is no slower than the host",
                 break_even_);
  }

 private:
  template <typename Host>
  GpuTimes race(const BothSides<Host>& sides, Question question, std::span<const Segmentf> paths) const {
    DeviceBuffer given(device_, paths.size_bytes());
    const DeviceBuffer answers(device_, paths.size() * sizeof(typename OnDevice<Host>::HitInBuffer));
    given.fill(std::as_bytes(paths));
    GpuRace<Host> race(sides, question, paths);
    GpuTimes times;
    race.time_on_host();
    race.time_with_transfers();
    for (std::size_t round = 0; round < request_.rounds; ++round) {
      times.on_host.push_back(race.time_on_host());
      times.with_transfers.push_back(race.time_with_transfers());
    }
    {
      const PinnedThreads threads(CorePin::allowed_cores().size());
      race.time_on_host(threads);
      race.time_with_transfers(threads);
      for (std::size_t round = 0; round < request_.rounds; ++round) {
        times.on_all_threads.push_back(race.time_on_host(threads));
        times.with_transfers_on_all.push_back(race.time_with_transfers(threads));
      }
    }
    // A card that mostly waits for the host runs slowly, and takes a while to speed up.
    const auto ask_in_buffers = [&](GpuStatistics& statistics) {
      return race.time_in_buffers(given.part(), answers.part(), statistics);
    };
    const auto warm = std::chrono::steady_clock::now() + request_.gpu_warm_up;
    do {
      GpuStatistics unused;
      ask_in_buffers(unused);
    } while (std::chrono::steady_clock::now() < warm);
    for (std::size_t round = 0; round < request_.rounds; ++round) {
      times.statistics = {};
      times.in_buffers.push_back(ask_in_buffers(times.statistics));
      // Apart from the other times, because timestamps take time too.
      GpuStatistics unused;
      const std::size_t tasks = paths.size() / detail::DispatchSize::smallest + 1;
      DispatchTimer timer(device_, 2 * tasks);  // Each task has two dispatches.
      ask_in_buffers(unused);
      const std::optional<double> kernel = timer.nanoseconds();
      if (kernel) times.kernel.push_back(*kernel / static_cast<double>(paths.size()));
    }
    return times;
  }

  void add_times(const Place& place, std::size_t count, const GpuTimes& times) {
    const std::string on = " in batches of " + std::to_string(count);
    const auto keep = [&](const std::string& contender, const RoundSeries& series) -> std::string {
      if (series.empty()) return "-";
      const Summary time = summary_of(series);
      report_.keep(place, contender, "ns per path" + on, time);
      return short_number(time.median);
    };
    const GpuStatistics& of = times.statistics;
    const auto percent = [&](const char* what, std::uint64_t number) {
      const double share = 100 * static_cast<double>(number) / static_cast<double>(of.paths);
      report_.keep(place, "surehit on a GPU", std::string("percent ") + what + on, summary_of(share));
      return short_number(share);
    };
    times_.add_row({place.mesh, place.paths, place.question, std::to_string(count),
                    keep("surehit batch", times.on_host),
                    keep("surehit on a GPU, with transfers", times.with_transfers),
                    keep("surehit batch, all threads", times.on_all_threads),
                    keep("surehit on a GPU, with transfers, all threads", times.with_transfers_on_all),
                    keep("surehit on a GPU, in its buffers", times.in_buffers),
                    keep("surehit on a GPU, kernel alone", times.kernel), percent("answered by the host", of.undecided),
                    percent("rounded by the host", of.rounded_by_host)});
  }

  /// Tries batches of twice as many paths again and again, beside one thread of the host and beside all.
  template <typename Host>
  void add_break_even(const Place& place, const BothSides<Host>& sides, Question question,
                      std::span<const Segmentf> paths) {
    const PinnedThreads threads(CorePin::allowed_cores().size());
    std::size_t beside_one = 0, beside_all = 0;  // 0 if there is none.
    for (std::size_t count = 64; count <= paths.size(); count *= 2) {
      GpuRace<Host> race(sides, question, paths.first(count));
      RoundSeries one, all, gpu, gpu_with_all;
      for (std::size_t round = 0; round <= request_.rounds; ++round) {
        one.push_back(race.time_on_host());
        all.push_back(race.time_on_host(threads));
        gpu.push_back(race.time_with_transfers());
        gpu_with_all.push_back(race.time_with_transfers(threads));
        if (round == 0) one.clear(), all.clear(), gpu.clear(), gpu_with_all.clear();
      }
      const auto note = [&](const RoundSeries& on_host, const RoundSeries& on_gpu, std::size_t& found) {
        if (summary_of(on_gpu).median > summary_of(on_host).median) {
          found = 0;
        } else if (found == 0) {
          found = count;
        }
      };
      note(one, gpu, beside_one);
      note(all, gpu_with_all, beside_all);
    }
    const auto keep = [&](const std::string& beside, std::size_t count) -> std::string {
      if (count == 0) return "none";
      report_.keep(place, "surehit on a GPU", "break-even batch beside " + beside,
                   summary_of(static_cast<double>(count)));
      return std::to_string(count);
    };
    break_even_.add_row(
        {place.mesh, place.paths, place.question, keep("one thread", beside_one), keep(all_threads(), beside_all)});
  }

  std::string table_;
  const GpuDevice& device_;
  const Request& request_;
  Report& report_;
  MarkdownTable times_{{"mesh", "paths", "question", "batch", "one thread", "with transfers", all_threads(),
                        "with transfers", "in buffers", "kernel alone", "by host, %", "rounded, %"},
                       3};
  MarkdownTable break_even_{{"mesh", "paths", "question", "beside one thread", "beside " + all_threads()}, 3};
};

/// The scene of a world. Instances share their meshes.
Scenef scene_of(const World& world) {
  std::vector<std::shared_ptr<const Colliderf>> colliders;
  for (const auto& mesh : world.meshes) colliders.push_back(std::make_shared<Colliderf>(mesh.view()));
  Scenef scene;
  for (const auto& [mesh, pose] : world.instances) scene.add(colliders[mesh], pose);
  scene.commit();
  return scene;
}

void add_meshes(const GpuDevice& device, const Request& request, GpuTables& tables) {
  for (const NamedMesh& named : request.meshes) {
    const Colliderf collider(named.mesh.view());
    const GpuCollider on_gpu(device, collider);
    for (const PathSet set : sets_of_segments(request.sets)) {
      tables.measure<Colliderf>(
          {collider, on_gpu}, {"", named.name, named.mesh.triangles.size(), name_of(set)},
          [&](std::size_t count, std::uint64_t seed) { return draw_paths(set, named, count, seed); });
    }
  }
}

void add_scenes(const GpuDevice& device, const Request& request, GpuTables& tables) {
  for (const std::string& name : request.worlds) {
    const World world = build_world(name, request.detail);
    const Scenef scene = scene_of(world);
    GpuScene on_gpu;
    if (const GpuResult uploaded = on_gpu.try_upload(device, scene.snapshot()); !uploaded) {
      std::printf("\ngpu_scene: %s left out, because %s\n", name.c_str(), uploaded.error().what());
      continue;
    }
    for (const PathSet set : path_sets_of(world)) {
      if (std::find(request.sets.begin(), request.sets.end(), set) == request.sets.end()) continue;
      tables.measure<Scenef>(
          {scene, on_gpu}, {"", name, world.triangle_count(), name_of(set)},
          [&](std::size_t count, std::uint64_t seed) { return draw_world_paths(set, world, count, seed); });
    }
  }
}

/// Shows a table of this name, or says why there is none.
void measure_on_device(const char* table, const Request& request, Report& report,
                       void (*add)(const GpuDevice&, const Request&, GpuTables&)) {
  GpuDevice device;
  if (const GpuResult opened = device.try_open({.name = request.gpu_name}); !opened) {
    std::printf("\n%s: left out, because %s\n", table, opened.error().what());
    return;
  }
  GpuTables tables(table, device, request, report);
  add(device, request, tables);
  tables.show();
}

}  // namespace

void measure_gpu(const Request& request, Report& report) { measure_on_device("gpu", request, report, add_meshes); }

void measure_gpu_scenes(const Request& request, Report& report) {
  measure_on_device("gpu_scene", request, report, add_scenes);
}

}  // namespace surehit::benchmark
