#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include "command_line/output_file.hpp"
#include "command_line/program.hpp"
#include "command_line/refuses_nan.hpp"
#include "game_physics/arena.hpp"
#include "game_physics/arena_picture.hpp"
#include "game_physics/epsilon_sweep.hpp"
#include "game_physics/exact_sweep.hpp"
#include "game_physics/trial.hpp"
#include "picture/png.hpp"

namespace surehit::example {
namespace {

struct Request {
  TrialOptions trial{.threads = std::clamp(std::thread::hardware_concurrency(), 1u, 1024u)};
  float skin = 1e-3f;
  bool full = false;
  std::string picture_path = "game_physics.png";
};

void describe(CLI::App& app, Request& request) {
  const auto count = [&](const std::string& name, std::size_t& value, const std::string& what) {
    return app.add_option(name, value, what)
        ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}).description(""))
        ->capture_default_str();
  };
  CLI::Option* points = count("--points", request.trial.points, "Points that fly, each on its own");
  CLI::Option* steps = count("--steps", request.trial.steps, "Steps of each, a quarter of a second long");
  app.add_flag("--full", request.full, "20000 points for 2000 steps")->excludes(points)->excludes(steps);
  app.add_option("--speed", request.trial.speed, "Metres a second at the start")
      ->check(CLI::Range(0.0f, 10'000.0f).description(""))
      ->check(refuses_nan())
      ->capture_default_str();
  app.add_option("--seed", request.trial.seed, "Of the starts")->capture_default_str();
  app.add_option("--skin", request.skin, "Metres by which the float test for contrast pushes its points off a wall")
      ->check(CLI::Range(0.0f, 1.0f).description(""))
      ->check(refuses_nan())
      ->capture_default_str();
  app.add_option("--threads", request.trial.threads, "Threads that share the points; they fly the same for any number")
      ->check(CLI::Range(1u, 1024u).description(""))
      ->capture_default_str();
  app.add_option("-o", request.picture_path, "The picture")->type_name("PNG")->capture_default_str();
  app.footer(
      "Exit status: 0; 1 if a point went through a wall or never moved, or for other failures; 2 for bad usage.");
}

void print(const char* name, const TrialReport& report) {
  std::printf("%s\n", name);
  std::printf("  points through a wall   %zu of %zu, %zu of them out of the room\n", report.escaped, report.points,
              report.outside);
  std::printf("  points that never moved %zu\n", report.stuck);
  std::printf("  path completed          %.7f%% of %.0f m\n", 100 * report.share_completed(), report.length_wanted);
  std::printf("  bounces                 %zu in %zu steps\n", report.bounces, report.steps);
  std::printf("  steps per second        %.0f on one thread\n", report.steps_per_second());
}

ExitStatus play(Request request) {
  if (request.full) {
    request.trial.points = 20'000;
    request.trial.steps = 2'000;
  }
  const Arena arena = build_arena();
  std::printf("%zu points, %zu steps, %zu thin walls, %g m/s: %g m a step\n", request.trial.points, request.trial.steps,
              arena.walls.triangles.size(), double{request.trial.speed},
              double{request.trial.speed * Flight::time_step});
  const TrialReport exact = run_trial("surehit", arena, ExactSweep(arena.walls), request.trial);
  print("surehit", exact);
  const TrialReport with_epsilon =
      run_trial("for contrast", arena, EpsilonSweep(arena.walls, request.skin), request.trial);
  print("for contrast, float arithmetic with epsilon, tried on every wall", with_epsilon);
  std::printf("every way of every point was checked against every wall in integers: %.1f s\n",
              exact.check_seconds + with_epsilon.check_seconds);

  OutputFile picture(request.picture_path);
  picture.write(encode_png(draw_trials(arena, exact, with_epsilon)));
  picture.finish();
  std::printf("%s\n", request.picture_path.c_str());
  return exact.escaped == 0 && exact.stuck == 0 ? success : failure;
}

Work describe_program(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  describe(app, *request);
  return [request] {
    if (!std::isfinite(request->trial.speed)) throw CLI::ValidationError("--speed", "must be a finite number");
    if (!std::isfinite(request->skin)) throw CLI::ValidationError("--skin", "must be a finite number");
    return play(*request);
  };
}

}  // namespace
}  // namespace surehit::example

int main(int argc, char** argv) {
  return surehit::example::run_program(
      "game_physics", "Lets fast points bounce in a room of thin walls and checks that none goes through.", argc, argv,
      surehit::example::describe_program);
}
