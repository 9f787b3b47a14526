#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "command_line/gpu_batches.hpp"
#include "command_line/interruption.hpp"
#include "command_line/output_file.hpp"
#include "command_line/parse_point.hpp"
#include "command_line/program.hpp"
#include "command_line/read_with_z_up.hpp"
#include "command_line/refuses_nan.hpp"
#include "level/level.hpp"
#include "mesh_io/input_error.hpp"
#include "picture/png.hpp"
#include "visibility_bake/bake.hpp"
#include "visibility_bake/bake_picture.hpp"
#include "visibility_bake/cells.hpp"
#include "visibility_bake/ranks.hpp"
#include "visibility_bake/visible_sets.hpp"

namespace surehit::example {
namespace {

struct Request {
  std::string mesh_path;
  std::string up = "z";
  std::string places_path;
  std::string start;
  WalkOptions walk;
  PairOptions pairs;
  std::optional<std::uint32_t> shown_cell;
  bool begins_again = false;
  std::optional<unsigned> threads;
  BakeOptions bake;
  bool uses_gpu = false;
  std::string gpu_name;
  std::string sets_path = "visibility.pvs";
  std::string csv_path = "visibility.csv";
  std::string picture_path = "visibility.png";
};

void describe(CLI::App& app, Request& request) {
  const auto length = [&](const std::string& name, float& value, const std::string& what) {
    return app.add_option(name, value, what)
        ->check(CLI::Range(1e-3f, 1e6f).description(""))
        ->check(refuses_nan())
        ->capture_default_str();
  };
  app.add_option("MESH", request.mesh_path, "A mesh: .obj, .ply, .stl or .off (default: a level that it builds itself)")
      ->type_name("");
  app.add_option("--up", request.up, "The mesh's upward axis")->check(CLI::IsMember({"y", "z"}))->capture_default_str();
  CLI::Option* places = app.add_option("--places", request.places_path,
                                       "The floor of each cell: x y z in each line, after z has been turned up "
                                       "(default: a grid of walkable places)")
                            ->type_name("FILE");
  length("--spacing", request.walk.spacing, "The width of a cell, and of the grid");
  app.add_option(
         "--start", request.start,
         "Only places to which one can walk from here are cells (default: the level's great hall; in a MESH all)")
      ->type_name("X,Y,Z")
      ->excludes(places);
  length("--headroom", request.walk.headroom, "What is free above a walkable place");
  length("--eye-height", request.pairs.eye_height, "How high above the floor eyes are, at most");
  length("--range", request.pairs.range, "Cells that are farther apart are not asked about");
  app.add_option("--samples", request.pairs.samples, "Segments for each pair of cells")
      ->check(CLI::Range(1u, PairPlan::max_samples).description(""))
      ->capture_default_str();
  app.add_option("--cell", request.shown_cell,
                 "The cell whose set the picture shows (default: the nearest to the start, or one that "
                 "sees the most)")
      ->type_name("ID");
  app.add_option(
         "--threads", request.threads,
         "Threads of each process that share the cells; the files are the same for any number (default: one for "
         "each core, or 1 under mpirun)")
      ->check(CLI::Range(1u, 1024u).description(""));
  app.add_option("--checkpoint-seconds", request.bake.checkpoint_seconds, "Between two checkpoints")
      ->check(CLI::Range(0.0, 1e6).description(""))
      ->check(refuses_nan())
      ->capture_default_str();
  app.add_flag("--gpu", request.uses_gpu, "Ask on a GPU; the files are the same");
  app.add_option("--gpu-name", request.gpu_name, "Ask on the GPU with this in its name, which may be software")
      ->type_name("NAME");
  app.add_flag("--restart", request.begins_again, "Begins again, and removes the checkpoint of an earlier run");
  app.add_option("-o", request.sets_path, "The set of each cell")->type_name("PVS")->capture_default_str();
  app.add_option("--csv", request.csv_path, "The figures of each cell")->type_name("CSV")->capture_default_str();
  app.add_option("--picture", request.picture_path, "What each cell sees, and the set of one")
      ->type_name("PNG")
      ->capture_default_str();
  app.footer(
      "An interrupted run goes on from PVS.checkpoint when it is started again. One file may be -, which is standard "
      "output, and the text goes to standard error then. Exit status: 0, 2 for bad input or usage, 130 after Ctrl-C, 1 "
      "for other failures.");
}

/// The mesh, and where its walkable places begin.
struct Place {
  Mesh<float> mesh;
  std::optional<Vector3f> start;
};

Place asked_place(const Request& request) {
  Place place;
  if (request.mesh_path.empty()) {
    Level level = build_level();
    place.mesh = std::move(level.mesh);
    place.start = Vector3f(level.eye[0], level.eye[1], 0);
  } else {
    place.mesh = read_with_z_up("visibility_bake", request.mesh_path, request.up);
  }
  if (!request.start.empty()) place.start = parse_point("--start", request.start);
  return place;
}

/// Rank 0 has the matrix, and a second one while it writes.
void refuse_more_than_memory(std::size_t cells) {
  const double needed = 2 * static_cast<double>(cells) * static_cast<double>(cells) / 8;
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (needed <= memory) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "%zu cells need %.0f GB of memory, and the machine has %.0f GB: there must be fewer, as with a larger "
                "--spacing",
                cells, needed / 1e9, memory / 1e9);
  throw InputError(text);
}

std::vector<Vector3f> asked_floors(const Request& request, const Colliderf& collider,
                                   const std::optional<Vector3f>& start, bool is_rank_0) {
  std::vector<Vector3f> floors;
  if (!request.places_path.empty()) {
    floors = read_places(request.places_path);
    if (floors.empty()) throw InputError(request.places_path + ": there is no place in it");
  } else {
    if (request.pairs.eye_height > request.walk.headroom) {
      throw InputError("--eye-height: it must not be above --headroom");
    }
    floors = find_floors(collider, request.walk);
    if (floors.empty()) throw InputError("the mesh has no walkable place: --up or --headroom may be wrong");
    if (start) floors = reachable_floors(collider, floors, *start, request.walk);
    if (floors.empty()) throw InputError("--start: there is no walkable place near it");
  }
  constexpr std::size_t max_cells = 1 << 20;
  if (floors.size() > max_cells) {
    throw InputError(std::to_string(floors.size()) + " cells are too many, there may be " + std::to_string(max_cells));
  }
  // Squares of greater distances, and a picture of them, are beyond float.
  constexpr float max_coordinate = 1e9f;
  for (std::size_t cell = 0; cell < floors.size(); ++cell) {
    if (floors[cell].cwiseAbs().maxCoeff() <= max_coordinate) continue;
    throw InputError("cell " + std::to_string(cell) + " is too far away: coordinates may be up to 1e9");
  }
  if (is_rank_0) refuse_more_than_memory(floors.size());
  return floors;
}

/// The cell of the picture: the one that is asked for, the nearest to the start, or one that sees the most.
std::uint32_t cell_to_show(const Request& request, const PairPlan& plan, const Visibility& visibility,
                           const std::optional<Vector3f>& start) {
  if (request.shown_cell) return *request.shown_cell;
  const auto rank = [&](std::uint32_t cell) {
    if (start) return -double{(plan.floors()[cell] - *start).norm()};
    return static_cast<double>(visibility.figures(cell).cells_seen);
  };
  std::uint32_t best = 0;
  for (std::uint32_t cell = 1; cell < plan.cell_count(); ++cell) {
    if (rank(cell) > rank(best)) best = cell;
  }
  return best;
}

/// Twice the sum over all cells is in the figures, as each pair counts for both of its cells.
struct Totals {
  std::uint64_t pairs = 0;
  std::uint64_t seen = 0;

  explicit Totals(const Visibility& visibility) {
    for (std::uint32_t cell = 0; cell < visibility.cell_count(); ++cell) {
      pairs += visibility.figures(cell).cells_in_range;
      seen += visibility.figures(cell).cells_seen;
    }
    pairs /= 2;
    seen /= 2;
  }
};

constexpr const char* standard_output = "-";

/// Where the program says what it does. It does not mix with a file.
std::FILE* text_stream(const Request& request) {
  const bool has_file = request.sets_path == standard_output || request.csv_path == standard_output ||
                        request.picture_path == standard_output;
  return has_file ? stderr : stdout;
}

/// Beside the sets. Those on standard output have one beside where they would be without -o.
std::string checkpoint_path(const Request& request) {
  return (request.sets_path == standard_output ? Request().sets_path : request.sets_path) + ".checkpoint";
}

/// Opened before the bake, so that what cannot be written is known before it.
struct OutputFiles {
  OutputFile sets;
  OutputFile csv;
  OutputFile picture;

  explicit OutputFiles(const Request& request)
      : sets(request.sets_path, Durability::machine),
        csv(request.csv_path, Durability::machine),
        picture(request.picture_path, Durability::machine) {}
};

void write_files(const Request& request, const PairPlan& plan, const Visibility& visibility,
                 const std::optional<Vector3f>& start, OutputFiles& files) {
  const std::string sets = encode_visible_sets(plan, visibility);
  const std::uint32_t shown = cell_to_show(request, plan, visibility, start);
  const std::string csv = figures_csv(plan, visibility);
  const std::string picture = encode_png(draw_bake(plan, visibility, shown));
  for (const auto& [file, bytes] : {std::pair{&files.sets, &sets}, {&files.csv, &csv}, {&files.picture, &picture}}) {
    file->write(*bytes);
    file->finish();
  }
  std::fprintf(text_stream(request), "%s: a matrix of %zu bytes in %zu\n%s\n%s\n", request.sets_path.c_str(),
               visibility.cell_count() * visibility.bytes_of_a_row(), sets.size(), request.csv_path.c_str(),
               request.picture_path.c_str());
}

/// What all ranks have before they begin.
struct Job {
  Place place;
  Colliderf collider;
  std::optional<PairPlan> plan;
  std::optional<Checkpoint> checkpoint;
  Visibility visibility{0};
  std::optional<OutputFiles> files;  ///< of rank 0
};

/// Returns the fingerprint of the plan. Rank 0 also reads the checkpoint.
std::uint64_t prepare(const Request& request, bool is_rank_0, Job& job) {
  job.place = asked_place(request);
  if (const BuildResult built = job.collider.try_build(job.place.mesh.view()); !built) {
    throw InputError(request.mesh_path + ": " + built.error().what());
  }
  PairOptions pairs = request.pairs;
  pairs.cell_width = request.walk.spacing;
  job.plan.emplace(job.collider, asked_floors(request, job.collider, job.place.start, is_rank_0), pairs);
  if (request.shown_cell && *request.shown_cell >= job.plan->cell_count()) {
    throw InputError("--cell: there is no cell " + std::to_string(*request.shown_cell) + ", there are " +
                     std::to_string(job.plan->cell_count()));
  }
  const std::uint64_t fingerprint = job.plan->fingerprint(job.collider);
  job.checkpoint.emplace(checkpoint_path(request), fingerprint);
  if (!is_rank_0) return fingerprint;
  job.files.emplace(request);
  if (request.begins_again) job.checkpoint->remove();
  job.visibility = job.checkpoint->load(job.plan->cell_count());
  return fingerprint;
}

void work(const Request& request) {
  stop_when_asked();
  const Ranks ranks;
  const bool is_rank_0 = ranks.rank() == 0;
  Job job;
  const bool uses_gpu = request.uses_gpu || !request.gpu_name.empty();
  const auto prepare_rank = [&] {
    if (uses_gpu && ranks.size() > 1) throw InputError("--gpu: only a process that bakes alone has it");
    return prepare(request, is_rank_0, job);
  };
  if (!ranks.are_ready(prepare_rank)) return;
  const PairPlan& plan = *job.plan;
  std::optional<GpuBatches> gpu;
  if (uses_gpu) gpu.emplace(job.collider, request.gpu_name);
  BakeOptions options = request.bake;
  if (gpu) options.gpu = &*gpu;
  const unsigned cores = std::clamp(std::thread::hardware_concurrency(), 1u, 1024u);
  options.threads = request.threads.value_or(ranks.size() > 1 ? 1 : cores);
  const Totals before(job.visibility);
  std::FILE* const text = text_stream(request);
  if (is_rank_0) {
    std::fprintf(text, "%zu triangles, %u cells\n", job.place.mesh.triangles.size(), plan.cell_count());
    if (job.visibility.row_count() > 0) {
      std::fprintf(text, "goes on with %u of %u cells done\n", job.visibility.row_count(), plan.cell_count());
    }
    std::fflush(text);
  }

  const auto start = std::chrono::steady_clock::now();
  ranks.bake(job.collider, plan, *job.checkpoint, options, job.visibility);
  if (!is_rank_0) return;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Totals totals(job.visibility);
  const auto segments = static_cast<double>((totals.pairs - before.pairs) * plan.options().samples);
  std::fprintf(text, "%llu pairs in range, %llu of them see each other\n",
               static_cast<unsigned long long>(totals.pairs), static_cast<unsigned long long>(totals.seen));
  std::fprintf(text, "%.0f segments: %.3f s, %.2f M segments/s by %d process%s of %u thread%s\n", segments, seconds,
               segments / seconds / 1e6, ranks.size(), ranks.size() == 1 ? "" : "es", options.threads,
               options.threads == 1 ? "" : "s");
  if (gpu) {
    const GpuCounts counts = gpu->counts();
    std::fprintf(text, "on %s, which left %llu segments to the host\n", gpu->name().c_str(),
                 static_cast<unsigned long long>(counts.by_host));
    warn_of_failure("visibility_bake", counts);
  }
  write_files(request, plan, job.visibility, job.place.start, *job.files);
  job.checkpoint->remove();
}

Work describe_program(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  describe(app, *request);
  return [request] {
    refuse_equal_outputs(std::array<NamedOutput, 3>{
        {{"-o", request->sets_path}, {"--csv", request->csv_path}, {"--picture", request->picture_path}}});
    work(*request);
    return success;
  };
}

}  // namespace
}  // namespace surehit::example

int main(int argc, char** argv) {
  return surehit::example::run_program("visibility_bake",
                                       "Finds out which cells of a level may see each other, and writes it to a file.",
                                       argc, argv, surehit::example::describe_program);
}
