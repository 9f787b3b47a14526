#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include "command_line/output_file.hpp"
#include "command_line/program.hpp"
#include "command_line/replays_alike.hpp"
#include "moving_platforms/hall_picture.hpp"
#include "moving_platforms/recording.hpp"
#include "picture/animation.hpp"

namespace surehit::example {
namespace {

struct Request {
  GameOptions game{.threads = std::clamp(std::thread::hardware_concurrency(), 1u, 1024u)};
  bool full = false;
  std::string picture_path = "moving_platforms.png";
};

void describe(CLI::App& app, Request& request) {
  CLI::Option* pieces = app.add_option("--pieces", request.game.pieces, "Bullets and debris at the same time")
                            ->check(CLI::Range(std::size_t{1}, std::size_t{10'000'000}).description(""))
                            ->capture_default_str();
  CLI::Option* steps = app.add_option("--steps", request.game.steps, "Steps, 64 a second")
                           ->check(CLI::Range(1u, 1'000'000u).description(""))
                           ->capture_default_str();
  app.add_flag("--full", request.full, "8000 pieces for 576 steps")->excludes(pieces)->excludes(steps);
  app.add_option("--seed", request.game.seed, "Of the shots")->capture_default_str();
  app.add_option("--threads", request.game.threads,
                 "Threads that share the batches; the game is the same for any number")
      ->check(CLI::Range(1u, 1024u).description(""))
      ->capture_default_str();
  app.add_option("-o", request.picture_path, "The animation")->type_name("PNG")->capture_default_str();
  app.footer(
      "Exit status: 0; 1 if a piece went through a platform or a replay differs, or for other failures; 2 for bad "
      "usage.");
}

void print(const char* name, const Recording& recording) {
  std::printf("%s\n", name);
  std::printf("  through a platform      %zu of %zu ways\n", recording.breaches, recording.counts.ways);
  std::printf("  ways that met something %zu\n", recording.counts.contacts);
  std::printf("  squeezed pieces         %zu\n", recording.counts.squeezed);
  std::printf("  hash                    %016llx\n", static_cast<unsigned long long>(recording.hashes.back()));
}

/// A game with few pieces, from the time when all are there until all platforms are back in their places.
std::string animate(const Hall& hall, std::uint64_t seed) {
  constexpr int width = 480;
  constexpr std::uint32_t steps_per_frame = 4;
  HallPicture picture(hall, width);
  std::vector<Canvas> frames;
  const GameOptions options{.pieces = 72, .steps = 2 * Hall::period, .seed = seed};
  static_cast<void>(record_game(hall, options, [&](std::uint32_t step, const Game& game) {
    picture.note_step(step, game);
    if (step >= Hall::period && step % steps_per_frame == 0) frames.push_back(picture.draw());
  }));
  return encode_animation(frames, 1000 * steps_per_frame / 64);
}

ExitStatus play(Request request) {
  if (request.full) {
    request.game.pieces = 8'000;
    request.game.steps = 3 * Hall::period;
  }
  const Hall hall = build_hall();
  std::printf("%zu pieces, %u steps, %zu platforms that move, %zu fans\n", request.game.pieces, request.game.steps,
              hall.platforms.size(), hall.fans.size());
  const Recording recording = record_game(hall, request.game);
  print("surehit, with the motions of the platforms", recording);
  const bool are_alike =
      replays_alike(recording.hashes, [&](unsigned threads) { return replay_game(hall, recording, threads); });
  request.game.stepping = Stepping::by_pose;
  print("for contrast, with platforms that jump between the steps", record_game(hall, request.game));
  std::printf("every way of every piece was checked against every platform in integers\n");

  OutputFile picture(request.picture_path);
  picture.write(animate(hall, request.game.seed));
  picture.finish();
  std::printf("%s\n", request.picture_path.c_str());
  return recording.breaches == 0 && are_alike ? success : failure;
}

Work describe_program(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  describe(app, *request);
  return [request] { return play(*request); };
}

}  // namespace
}  // namespace surehit::example

int main(int argc, char** argv) {
  return surehit::example::run_program("moving_platforms",
                                       "Lets bullets and debris fly among lifts, sliding doors, a train and fans.",
                                       argc, argv, surehit::example::describe_program);
}
