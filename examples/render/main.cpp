#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "command_line/interruption.hpp"
#include "command_line/output_file.hpp"
#include "command_line/parse_point.hpp"
#include "command_line/program.hpp"
#include "command_line/read_with_z_up.hpp"
#include "command_line/refuses_nan.hpp"
#include "level/level.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/lower_case.hpp"
#include "picture/png.hpp"
#include "picture/ppm.hpp"
#include "render/cost_picture.hpp"
#include "render/crack_picture.hpp"
#include "render/id_picture.hpp"
#include "render/shaded_picture.hpp"
#include "render/shapes.hpp"

namespace surehit::example {
namespace {

struct Request {
  std::string mesh_path;
  std::string up = "z";
  std::string scene = "exercise";
  std::string mode = "shaded";
  std::string cost = "candidates";
  std::string culling = "none";
  std::string material = "plaster";
  bool is_flat = false;
  bool has_no_floor = false;
  std::string eye;
  std::string target;
  float degrees = 0;
  bool has_unit_directions = false;
  std::optional<int> width;
  int height = 540;
  int samples = 2;
  int max_depth = 8;
  std::optional<std::uint32_t> vertex;
  unsigned threads = std::clamp(std::thread::hardware_concurrency(), 1u, 1024u);
  bool uses_gpu = false;
  std::string gpu_name;
  std::string picture_path = "render.png";
};

const std::map<std::string, Culling> culling_names = {
    {"none", Culling::none}, {"back", Culling::back}, {"front", Culling::front}};
const std::map<std::string, Cost> cost_names = {
    {"cells", Cost::cells}, {"candidates", Cost::candidates}, {"exact", Cost::exact_decisions}};

void describe(CLI::App& app, Request& request) {
  const auto one_of = [&](const std::string& name, std::string& value, const std::string& what,
                          const std::vector<std::string>& names) {
    app.add_option(name, value, what)->check(CLI::IsMember(names))->capture_default_str();
  };
  const auto count = [&](const std::string& name, int& value, const std::string& what, int max, int min = 1) {
    app.add_option(name, value, what)->check(CLI::Range(min, max).description(""))->capture_default_str();
  };
  CLI::Option* mesh =
      app.add_option("MESH", request.mesh_path, "A mesh to render: .obj, .ply, .stl or .off")->type_name("");
  one_of("--up", request.up, "The mesh's upward axis", {"y", "z"});
  app.add_option("--scene", request.scene, "What to render without a MESH: spheres on a floor, or the built-in level")
      ->check(CLI::IsMember({"exercise", "level"}))
      ->capture_default_str()
      ->excludes(mesh);
  one_of("--mode", request.mode,
         "Light and shadows; the work of each ray; a colour for each triangle; or a close look at a vertex, by plain "
         "floats and by surehit",
         {"shaded", "cost", "ids", "cracks"});
  one_of("--cost", request.cost, "What --mode cost counts", {"cells", "candidates", "exact"});
  one_of("--culling", request.culling, "The sides of triangles that rays do not see", {"none", "back", "front"});
  one_of("--material", request.material, "What a MESH is made of; one of glass must be closed",
         {"plaster", "mirror", "glass"});
  app.add_flag("--flat", request.is_flat, "Shows a MESH with the normals of its triangles, not with interpolated ones");
  app.add_flag("--no-floor", request.has_no_floor, "Shows a MESH without a floor of squares");
  app.add_option("--eye", request.eye, "Where the eye is")->type_name("X,Y,Z");
  app.add_option("--target", request.target, "What is in the middle of the picture")->type_name("X,Y,Z");
  app.add_option("--degrees", request.degrees, "The angle of view from top to bottom")
      ->check(CLI::Range(0.001f, 179.0f).description(""))
      ->check(refuses_nan());
  app.add_flag("--unit-directions", request.has_unit_directions,
               "Rays have directions of length 1, not directions that lead to the image plane");
  app.add_option("--width", request.width,
                 "Pixels of a row; of a side of each picture, in --mode cracks (default: 960; 512)")
      ->check(CLI::Range(1, 16'384).description(""));
  count("--height", request.height, "Pixels of a column", 16'384);
  count("--samples", request.samples, "Rays of a pixel in each direction, in --mode shaded", 16);
  count("--depth", request.max_depth, "How often light is reflected or refracted", 64, 0);
  app.add_option("--vertex", request.vertex, "The vertex of --mode cracks (default: one at the top)")->type_name("ID");
  app.add_option("--threads", request.threads, "Threads that share the rows; the picture is the same for any number")
      ->check(CLI::Range(1u, 1024u).description(""))
      ->capture_default_str();
  app.add_flag("--gpu", request.uses_gpu, "Ask a GPU, in --mode shaded and ids; the picture is the same");
  app.add_option("--gpu-name", request.gpu_name, "Ask the GPU with this in its name, which may be software")
      ->type_name("NAME");
  app.add_option("-o", request.picture_path, "The picture, as its ending says")
      ->type_name("PNG|PPM")
      ->capture_default_str();
  app.footer(
      "Exit status: 0, 2 for bad input or usage, 130 after Ctrl-C, 1 for other failures. Unless it is 0, no picture is "
      "written.");
}

std::string encode(const Canvas& canvas, const std::string& path) {
  return lower_case(path).ends_with(".ppm") ? encode_ppm(canvas) : encode_png(canvas);
}

/// Where the program says what it does. It does not mix with a picture.
std::FILE* text_stream(const Request& request) { return request.picture_path == "-" ? stderr : stdout; }

Stage asked_stage(const Request& request) {
  Stage stage;
  if (!request.mesh_path.empty()) {
    ShowOptions options{.is_smooth = !request.is_flat, .has_floor = !request.has_no_floor};
    options.material.is_glass = request.material == "glass";
    if (request.material == "mirror") options.material.mirror = 0.9f;
    stage = stage_of(read_with_z_up("render", request.mesh_path, request.up), options);
  } else {
    stage = request.scene == "level" ? level_stage() : exercise_stage();
  }
  if (!request.eye.empty()) stage.eye = parse_point("--eye", request.eye);
  if (!request.target.empty()) stage.target = parse_point("--target", request.target);
  if (request.degrees > 0) stage.degrees = request.degrees;
  return stage;
}

Mesh<float> mesh_with_cracks(const Request& request) {
  if (!request.mesh_path.empty()) return read_with_z_up("render", request.mesh_path, request.up);
  if (request.scene == "level") return build_level().mesh;
  // No number of this sphere is round, as those of a scan are not.
  return tessellated_sphere({0.3f, 0.7f, -0.2f}, 1.3f, 3).mesh;
}

Canvas draw_cracks(const Request& request) {
  constexpr int max_width = 4096;
  if (request.width.value_or(0) > max_width) {
    throw InputError("--width: at most " + std::to_string(max_width) + " in --mode cracks, which draws two pictures");
  }
  const Mesh<float> mesh = mesh_with_cracks(request);
  const CrackView view = find_crack_view(mesh, request.vertex, request.width.value_or(512));
  const auto start = std::chrono::steady_clock::now();
  Cracks cracks = draw_cracks(mesh, view, request.threads);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::fprintf(text_stream(request), "vertex %u, a view of %g across, %zu rays\n", view.vertex, double{view.width},
               cracks.rays);
  std::fprintf(text_stream(request), "  plain floats: %zu holes\n  surehit: %zu holes\n", cracks.holes_of_plain,
               cracks.holes_of_surehit);
  std::fprintf(text_stream(request), "by both: %.3f s, %s on %u thread%s\n", seconds,
               rate_text(cracks.rays, seconds).c_str(), request.threads, request.threads == 1 ? "" : "s");
  return std::move(cracks.picture);
}

bool asks_gpu(const Request& request) { return request.uses_gpu || !request.gpu_name.empty(); }

Canvas draw_stage(const Request& request) {
  const Stage stage = asked_stage(request);
  const Culling culling = culling_names.at(request.culling);
  const DirectionLength length = request.has_unit_directions ? DirectionLength::unit : DirectionLength::to_image_plane;
  const int width = request.width.value_or(960);
  const Camera camera = camera_of(stage, width, request.height, length);
  const auto build_start = std::chrono::steady_clock::now();
  World world(stage.model, culling);
  if (asks_gpu(request)) world.use_gpu(request.gpu_name);
  const auto start = std::chrono::steady_clock::now();
  RayCounts counts;
  Canvas canvas(1, 1, {});
  if (request.mode == "cost") {
    const auto costs =
        costs_of(world.collider(), camera, culling, cost_names.at(request.cost), request.threads, counts);
    const std::string name = request.cost == "exact" ? "exact decisions" : request.cost;
    canvas = draw_costs(costs, width, request.height, name);
  } else if (request.mode == "ids") {
    canvas = draw_ids(world, camera, request.threads, counts);
  } else {
    canvas = draw_shaded(world, stage,
                         {width, request.height, request.samples, request.max_depth, length, request.threads}, counts);
  }
  const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
  const double drawn = seconds(start, std::chrono::steady_clock::now());
  std::fprintf(text_stream(request), "%zu triangles, ready after %.3f s\n", stage.model.mesh.triangles.size(),
               seconds(build_start, start));
  std::fprintf(text_stream(request), "%zu rays: %.3f s, %s on %u thread%s\n%s", counts.all(), drawn,
               rate_text(counts.all(), drawn).c_str(), request.threads, request.threads == 1 ? "" : "s",
               counts.text().c_str());
  if (const GpuBatches* gpu = world.gpu()) {
    const GpuCounts of_gpu = gpu->counts();
    std::fprintf(text_stream(request), "on %s, which left %llu of %llu to the host\n", gpu->name().c_str(),
                 static_cast<unsigned long long>(of_gpu.by_host), static_cast<unsigned long long>(of_gpu.paths));
    warn_of_failure("render", of_gpu);
  }
  return canvas;
}

Work describe_program(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  describe(app, *request);
  return [request] {
    if (asks_gpu(*request) && request->mode != "shaded" && request->mode != "ids") {
      throw CLI::ValidationError("--gpu", "only --mode shaded and ids have it");
    }
    stop_when_asked();
    try {
      // What cannot be written is better known before the work than after it.
      OutputFile file(request->picture_path);
      const Canvas canvas = request->mode == "cracks" ? draw_cracks(*request) : draw_stage(*request);
      file.write(encode(canvas, request->picture_path));
      file.finish();
    } catch (const InvalidMesh& error) {
      throw InputError(request->mesh_path + ": " + error.what());
    }
    if (request->picture_path != "-") std::printf("%s\n", request->picture_path.c_str());
    return success;
  };
}

}  // namespace
}  // namespace surehit::example

int main(int argc, char** argv) {
  return surehit::example::run_program("render", "Renders a mesh by rays, with hard shadows, mirrors and glass.", argc,
                                       argv, surehit::example::describe_program);
}
