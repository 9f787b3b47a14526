#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "character/bullet_capsule_sweep.hpp"
#include "character/crowd_walk.hpp"
#include "character/exact_capsule_sweep.hpp"
#include "character/trail_picture.hpp"
#include "command_line/output_file.hpp"
#include "command_line/program.hpp"
#include "command_line/refuses_nan.hpp"
#include "command_line/replays_alike.hpp"
#include "level/level.hpp"
#include "picture/png.hpp"

namespace surehit::example {
namespace {

struct Request {
  WalkOptions walk{.threads = std::clamp(std::thread::hardware_concurrency(), 1u, 1024u)};
  float margin = 0;
  std::vector<float> skins = {1e-3f, 1e-5f, 0};
  bool full = false;
  std::string picture_path = "character.png";
};

void describe(CLI::App& app, Request& request) {
  CLI::Option* characters = app.add_option("--characters", request.walk.characters, "Characters that walk")
                                ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}).description(""))
                                ->capture_default_str();
  CLI::Option* steps = app.add_option("--steps", request.walk.steps, "Steps of each, 32 a second")
                           ->check(CLI::Range(1u, 1'000'000u).description(""))
                           ->capture_default_str();
  app.add_flag("--full", request.full, "4000 characters for 250 steps, a million in all")
      ->excludes(characters)
      ->excludes(steps);
  app.add_option("--seed", request.walk.seed, "Of the starts and the goals")->capture_default_str();
  app.add_option("--margin", request.margin, "Metres by which Bullet thickens the level, for contrast")
      ->check(CLI::Range(0.0f, 1.0f).description(""))
      ->check(refuses_nan())
      ->capture_default_str();
  app.add_option("--skin", request.skins, "Metres by which Bullet's stops are pushed off a surface, for each run")
      ->check(CLI::Range(0.0f, 1.0f).description(""))
      ->check(refuses_nan())
      ->capture_default_str();
  app.add_option("--threads", request.walk.threads,
                 "Threads that share the characters; they walk the same for any number")
      ->check(CLI::Range(1u, 1024u).description(""))
      ->capture_default_str();
  app.add_option("-o", request.picture_path, "The picture")->type_name("PNG")->capture_default_str();
  app.footer(
      "Exit status: 0; 1 if a character touched the level or fell out of it with surehit, if the check is not sure "
      "that none touched it, if a replay differs, or for other failures; 2 for bad usage.");
}

void print(const std::string& name, const WalkRecording& recording) {
  const WalkCounts& counts = recording.counts;
  const std::size_t characters = recording.starts.size();
  const auto a_step = [&](double sum) { return sum / static_cast<double>(counts.steps); };
  std::printf("%s\n", name.c_str());
  std::printf("  ways that touch the level    %zu of %zu, and %zu not decided\n", counts.touching_ways, counts.ways,
              counts.unsure_ways);
  std::printf("  characters that touched it   %zu of %zu, %zu of them deeper than 5 cm\n", counts.touching, characters,
              counts.deep);
  std::printf("  characters that fell out     %zu\n", counts.lost);
  std::printf("  characters that got stuck    %zu\n", counts.stuck);
  std::printf("  characters up the stairs     %zu\n", counts.climbed);
  std::printf("  way in the plan              %.0f m in %zu steps\n", counts.metres, counts.steps);
  std::printf("  a step                       %.2f queries, %.1f us on one thread; its check takes %.1f us\n",
              a_step(static_cast<double>(counts.queries)), 1e6 * a_step(counts.walk_seconds),
              1e6 * a_step(counts.check_seconds));
  std::printf("  hash                         %016llx\n", static_cast<unsigned long long>(recording.hashes.back()));
  std::fflush(stdout);
}

/// Walks with Bullet's convex sweep.
void print_contrast(const Mesh<float>& level, const std::vector<Vector3f>& starts, const ClearanceCheck& check,
                    const Request& request) {
  for (const float skin : request.skins) {
    const auto bullet = make_bullet_capsule_sweep(level, {.margin = request.margin, .skin = skin});
    if (!bullet) {
      std::printf("built without Bullet, so there is no contrast\n");
      return;
    }
    char name[160];
    std::snprintf(name, sizeof name, "for contrast, Bullet's convex sweep, with a skin of %g m and a margin of %g m",
                  double{skin}, double{request.margin});
    print(name, record_walk(starts, *bullet, check, request.walk));
  }
}

ExitStatus play(Request request) {
  if (request.full) {
    request.walk.characters = 4'000;
    request.walk.steps = 250;
  }
  const Level level = build_level();
  const Colliderf collider(level.mesh.view());
  const ClearanceCheck check(level.mesh);
  const auto starts = draw_starts(collider, whole_level, request.walk.characters, request.walk.seed);
  std::printf("%zu characters, %u steps, %zu triangles\n", starts.size(), request.walk.steps,
              level.mesh.triangles.size());
  const ExactCapsuleSweep sweep(collider);
  const WalkRecording recording = record_walk(starts, sweep, check, request.walk);
  print("surehit", recording);
  const bool are_alike =
      replays_alike(recording.hashes, [&](unsigned threads) { return replay_walk(sweep, recording, threads); });
  print_contrast(level.mesh, starts, check, request);

  constexpr std::size_t drawn = 48;
  Trails trails;
  const auto few = draw_starts(collider, great_hall, drawn, request.walk.seed);
  static_cast<void>(record_walk(few, sweep, check, {.characters = few.size(), .steps = 224, .seed = request.walk.seed},
                                [&](std::uint32_t, std::span<const Character> all) { trails.note(all); }));
  OutputFile picture(request.picture_path);
  picture.write(encode_png(draw_trails(trails, 960, 540, request.walk.threads)));
  picture.finish();
  std::printf("%s\n", request.picture_path.c_str());
  const bool is_clear = recording.counts.touching_ways + recording.counts.unsure_ways + recording.counts.lost == 0;
  return is_clear && are_alike ? success : failure;
}

Work describe_program(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  describe(app, *request);
  return [request] { return play(*request); };
}

}  // namespace
}  // namespace surehit::example

int main(int argc, char** argv) {
  return surehit::example::run_program("character", "Lets characters walk, slide and climb steps in a level.", argc,
                                       argv, surehit::example::describe_program);
}
