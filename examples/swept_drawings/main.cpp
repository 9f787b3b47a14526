#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "command_line/output_file.hpp"
#include "command_line/program.hpp"
#include "picture/png.hpp"
#include "swept_drawings/drawings.hpp"

namespace surehit::example {
namespace {

void draw(const std::string& folder) {
  const std::pair<const char*, Canvas (*)()> drawings[] = {{"touched_features.png", draw_touched_features},
                                                           {"free_numbers.png", draw_free_numbers},
                                                           {"box_and_capsule.png", draw_box_and_capsule}};
  for (const auto& [name, make] : drawings) {
    const std::string path = folder + "/" + name;
    write_file(path, encode_png(make()));
    std::printf("%s\n", path.c_str());
  }
}

Work describe_program(CLI::App& app) {
  const auto folder = std::make_shared<std::string>(".");
  app.add_option("FOLDER", *folder, "Where the pictures go")->type_name("")->capture_default_str();
  return [folder] {
    draw(*folder);
    return success;
  };
}

}  // namespace
}  // namespace surehit::example

int main(int argc, char** argv) {
  return surehit::example::run_program("swept_drawings", "Draws what moving shapes touch, and where they may stop.",
                                       argc, argv, surehit::example::describe_program);
}
