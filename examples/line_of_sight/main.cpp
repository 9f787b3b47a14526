#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "command_line/gpu_batches.hpp"
#include "command_line/output_file.hpp"
#include "command_line/parse_point.hpp"
#include "command_line/program.hpp"
#include "command_line/read_with_z_up.hpp"
#include "level/level.hpp"
#include "line_of_sight/figures.hpp"
#include "line_of_sight/floor_plan.hpp"
#include "line_of_sight/plan_picture.hpp"
#include "line_of_sight/sight.hpp"
#include "mesh_io/input_error.hpp"
#include "picture/png.hpp"

namespace surehit::example {
namespace {

struct Request {
  std::string mesh_path;
  std::string up = "z";
  std::string eye;
  float height = 0.5f;
  std::size_t points = 1'000'000;
  unsigned threads = std::clamp(std::thread::hardware_concurrency(), 1u, 1024u);
  std::string picture_path = "line_of_sight.png";
  std::string csv_path;
  bool uses_gpu = false;
  std::string gpu_name;
};

void describe(CLI::App& app, Request& request) {
  app.add_option("MESH", request.mesh_path, "A mesh: .obj, .ply, .stl or .off (default: a level that it builds itself)")
      ->type_name("");
  app.add_option("--up", request.up, "The mesh's upward axis")->check(CLI::IsMember({"y", "z"}))->capture_default_str();
  app.add_option("--eye", request.eye,
                 "Where the eye is, after z has been turned up (default: in the level's great hall; in a MESH as high "
                 "above the floor as the points, in the middle)")
      ->type_name("X,Y,Z");
  app.add_option("--height", request.height, "How high above the floor the points are")->capture_default_str();
  app.add_option("--points", request.points, "Points to look at, at least")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}).description(""))
      ->capture_default_str();
  app.add_option("--threads", request.threads, "Threads that share the points; the answers are the same for any number")
      ->check(CLI::Range(1u, 1024u).description(""))
      ->capture_default_str();
  app.add_option("-o", request.picture_path, "The plan of what is visible")->type_name("PNG")->capture_default_str();
  app.add_option("--csv", request.csv_path, "The figures")->type_name("CSV");
  app.add_flag("--gpu", request.uses_gpu, "Look on a GPU; the answers are the same");
  app.add_option("--gpu-name", request.gpu_name, "Look on the GPU with this in its name, which may be software")
      ->type_name("NAME");
  app.footer(
      "The floor is looked for below the eye's height. Exit status: 0, 2 for bad input or usage, 1 for other "
      "failures.");
}

/// As high above the floor in the middle of the mesh as the points are.
Vector3f eye_over_the_middle(const Colliderf& collider, float height) {
  const Vector3f middle = (collider.box().low + collider.box().high) / 2;
  const Rayf down{{middle.x(), middle.y(), collider.box().high.z() + 1}, {0, 0, -1}};
  const auto floor = collider.first_hit(down);
  if (!floor) throw InputError("there is no floor in the middle of the mesh: --eye must say where the eye is");
  return point(down, *floor) + Vector3f(0, 0, height);
}

template <typename Work>
auto timed(double& seconds, Work work) {
  const auto start = std::chrono::steady_clock::now();
  auto result = work();
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void print(const Figures& figures, const Request& request) {
  const double share = 100 * static_cast<double>(figures.visible) / static_cast<double>(figures.points);
  std::printf("%zu triangles, ready after %.3f s\n", figures.triangles, figures.build_seconds);
  std::printf("%zu points %g above the floor, found in %.3f s\n", figures.points, double{request.height},
              figures.floor_seconds);
  std::printf("%zu visible (%.2f%%), %zu hidden: %.3f s, %.3g segments per second on %u thread%s\n", figures.visible,
              share, figures.hidden, figures.sight_seconds, figures.segments_per_second(), figures.threads,
              figures.threads == 1 ? "" : "s");
  std::printf("%s\n", request.picture_path.c_str());
}

void look(const Request& request) {
  Figures figures;
  Mesh<float> mesh;
  Vector3f eye;
  if (request.mesh_path.empty()) {
    Level level = build_level();
    mesh = std::move(level.mesh);
    eye = {level.eye[0], level.eye[1], level.eye[2]};
  } else {
    mesh = read_with_z_up("line_of_sight", request.mesh_path, request.up);
  }
  Colliderf collider;
  const BuildResult built = timed(figures.build_seconds, [&] { return collider.try_build(mesh.view()); });
  if (!built) throw InputError(request.mesh_path + ": " + built.error().what());
  if (!request.eye.empty()) {
    eye = parse_point("--eye", request.eye);
  } else if (!request.mesh_path.empty()) {
    eye = eye_over_the_middle(collider, request.height);
  }

  const FloorPlan plan =
      timed(figures.floor_seconds, [&] { return FloorPlan(collider, eye.z(), request.points, request.threads); });
  std::optional<GpuBatches> gpu;
  if (request.uses_gpu || !request.gpu_name.empty()) gpu.emplace(collider, request.gpu_name);
  const auto sights = timed(figures.sight_seconds, [&] {
    return look_around(collider, plan, eye, request.height, request.threads, gpu ? &*gpu : nullptr);
  });
  figures.triangles = mesh.triangles.size();
  figures.threads = request.threads;
  figures.count(sights);

  char caption[80];
  std::snprintf(caption, sizeof caption, "%zu of %zu points visible, %g above the floor", figures.visible,
                figures.points, double{request.height});
  write_file(request.picture_path, encode_png(draw_plan(mesh, plan, sights, eye, caption)));
  if (!request.csv_path.empty()) write_file(request.csv_path, figures.csv());
  print(figures, request);
  if (!gpu) return;
  const GpuCounts counts = gpu->counts();
  std::printf("on %s, which left %llu segments to the host\n", gpu->name().c_str(),
              static_cast<unsigned long long>(counts.by_host));
  warn_of_failure("line_of_sight", counts);
}

Work describe_program(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  describe(app, *request);
  return [request] {
    if (!std::isfinite(request->height)) throw CLI::ValidationError("--height", "must be a finite number");
    look(*request);
    return success;
  };
}

}  // namespace
}  // namespace surehit::example

int main(int argc, char** argv) {
  return surehit::example::run_program("line_of_sight", "Draws what an eye can see of the floor of a level.", argc,
                                       argv, surehit::example::describe_program);
}
