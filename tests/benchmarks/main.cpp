#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "command_line/output_file.hpp"
#include "command_line/program.hpp"
#include "core_pin.hpp"
#include "instruction_set.hpp"
#include "mesh_io/input_error.hpp"
#include "ratio_chart.hpp"
#include "support/instruction_sets.hpp"
#include "tables.hpp"
#include "uneven_meshes.hpp"
#include "world.hpp"

namespace surehit::benchmark {
namespace {

struct TableKind {
  std::string name;
  void (*measure)(const Request&, Report&);
  bool is_pinned = true;
};

const std::vector<TableKind>& all_tables() {
  static const std::vector<TableKind> tables = {
      {"queries", measure_queries},
      {"build", measure_builds},
      {"load", measure_loads},
      {"size", measure_sizes},
      {"tick", measure_ticks},
      {"threads", measure_threads, false},
      {"exactness", measure_exactness},
      {"statistics", measure_statistics},
      {"scene", measure_worlds},
      {"shapes", measure_shapes},
      {"scene_shapes", measure_world_shapes},
      {"gpu", measure_gpu, false},
      {"gpu_scene", measure_gpu_scenes, false},
  };
  return tables;
}

/// The command line, before meshes and names become what they stand for.
struct Words {
  std::vector<std::string> tables;
  std::vector<std::string> meshes;
  std::vector<std::string> sets;
  std::vector<std::string> worlds;
  std::vector<std::string> contenders;
  std::vector<std::string> shapes;
  std::string folder;
  std::vector<std::string> z_up;
  std::string instruction_set = all_instruction_sets().front().name;
  std::string csv_path;
  std::string chart_path;
  std::string machine;
  bool quick = false;
  bool uneven = false;
  Request request;
};

template <typename Things, typename Name>
std::vector<std::string> names_of(const Things& things, const Name& name) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.push_back(std::invoke(name, thing));
  return names;
}

/// An option whose values are among the names, which its description lists at the end.
template <typename Value>
CLI::Option* add_choice(CLI::App& app, const char* option, Value& value, std::string description,
                        const std::vector<std::string>& names) {
  const char* separator = ": ";
  for (const std::string& name : names) {
    description += separator + name;
    separator = ", ";
  }
  return app.add_option(option, value, description)->check(CLI::IsMember(names).description(""));
}

void describe(CLI::App& app, Words& words, Request& request) {
  app.add_option("--meshes", words.folder, "Measure every mesh of a folder too")->type_name("FOLDER");
  app.add_option("--z-up", words.z_up, "These meshes of the folder have z upward, the others y")->type_name("NAME");
  app.add_flag("--uneven", words.uneven, "Measure the meshes that are built to be hard for grids too");
  add_choice(app, "--table", words.tables, "Only these tables", names_of(all_tables(), &TableKind::name))
      ->type_name("NAME");
  app.add_option("--mesh", words.meshes, "Only these meshes; the built-in one is called level")->type_name("NAME");
  add_choice(app, "--set", words.sets, "Only these path sets",
             names_of(all_path_sets, [](PathSet set) { return name_of(set); }))
      ->type_name("NAME");
  add_choice(app, "--scene", words.worlds, "Only these scenes of the tables scene, scene_shapes and gpu_scene",
             world_names())
      ->type_name("NAME");
  add_choice(app, "--shape", words.shapes, "Only these moving shapes of the tables shapes and scene_shapes",
             names_of(all_shape_kinds, [](ShapeKind kind) { return name_of(kind); }))
      ->type_name("NAME");
  app.add_option("--contender", words.contenders, "Besides surehit only contenders whose name has one of these in it")
      ->type_name("TEXT");
  add_choice(app, "--instruction-set", words.instruction_set, "What surehit runs on; the others choose by themselves",
             names_of(all_instruction_sets(), &InstructionSet::name))
      ->type_name("NAME")
      ->capture_default_str();
  const CLI::Range some(std::size_t{1}, std::size_t{100'000'000});
  app.add_option("--rounds", request.rounds, "Times that every contender is measured")
      ->check(CLI::Range(some).description(""))
      ->capture_default_str();
  app.add_option("--paths", request.paths, "Paths in a set")
      ->check(CLI::Range(some).description(""))
      ->capture_default_str();
  app.add_option("--largest", request.largest, "Triangles that table size goes up to")
      ->check(CLI::Range(some).description(""))
      ->capture_default_str();
  app.add_option("--batch", request.gpu_paths,
                 "Paths in a batch of the tables gpu and gpu_scene, and may be given several times")
      ->check(CLI::Range(some).description(""))
      ->capture_default_str();
  app.add_option("--gpu-name", request.gpu_name,
                 "The device of the tables gpu and gpu_scene has this in its name, and may be software")
      ->type_name("NAME");
  app.add_option("--core", request.core, "The core to stay on (default: the first that there is)")
      ->check(CLI::NonNegativeNumber.description(""));
  app.add_flag("--quick", words.quick, "Only see that all of it runs: tiny counts, figures without meaning");
  app.add_option("--csv", words.csv_path, "All figures")->type_name("FILE");
  app.add_option("--chart", words.chart_path, "The ratios of table queries as a picture")->type_name("FILE.svg");
  app.add_option("--machine", words.machine, "What the picture says of this machine")->type_name("TEXT");
}

bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

void shrink(const CLI::App& app, Request& request) {
  const auto set = [&](const char* option, std::size_t& value, std::size_t quick) {
    if (app.get_option(option)->empty()) value = quick;
  };
  set("--rounds", request.rounds, 2);
  set("--paths", request.paths, 64);
  set("--largest", request.largest, 4000);
  request.tick_paths = {64, 128};
  if (app.get_option("--batch")->empty()) request.gpu_paths = {100, 1000};
  request.gpu_warm_up = {};
  request.detail = 0.05f;
}

void read_meshes(const Words& words, Request& request) {
  if (is_among("level", words.meshes)) request.meshes.push_back(level_mesh(words.quick ? 0.05f : 1));
  if (!words.folder.empty()) {
    for (NamedMesh& mesh : meshes_in(words.folder, words.z_up, words.meshes)) {
      request.meshes.push_back(std::move(mesh));
    }
  }
  if (words.uneven) {
    for (const std::string& name : uneven_mesh_names()) {
      if (is_among(name, words.meshes)) request.meshes.push_back(uneven_mesh(name, words.quick ? 0.05f : 1));
    }
  }
  if (request.meshes.empty()) throw example::InputError("there is no mesh of that name");
}

void choose(const Words& words, Request& request) {
  for (const PathSet set : all_path_sets) {
    if (is_among(name_of(set), words.sets)) request.sets.push_back(set);
  }
  for (const std::string& name : world_names()) {
    if (is_among(name, words.worlds)) request.worlds.push_back(name);
  }
  for (const ShapeKind kind : all_shape_kinds) {
    if (is_among(name_of(kind), words.shapes)) request.shapes.push_back(kind);
  }
  const auto copy_chosen = [&](const auto& all, auto& chosen) {
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [&](const auto& entrant) {
      const auto has = [&](const std::string& text) { return entrant.name().find(text) != std::string::npos; };
      return entrant.is_ours() || words.contenders.empty() ||
             std::any_of(words.contenders.begin(), words.contenders.end(), has);
    });
  };
  copy_chosen(all_entrants(), request.entrants);
  copy_chosen(all_world_entrants(), request.world_entrants);
  if (!words.contenders.empty()) {
    copy_chosen(surehit_small_batch_entrants(), request.entrants);
    copy_chosen(surehit_small_batch_world_entrants(), request.world_entrants);
  }
  copy_chosen(all_sweep_entrants(), request.sweep_entrants);
  copy_chosen(all_world_sweep_entrants(), request.world_sweep_entrants);
}

std::int64_t target_of(const std::string& instruction_set) {
  const std::vector<InstructionSet> all = all_instruction_sets();
  const auto is_it = [&](const InstructionSet& set) { return set.name == instruction_set; };
  return std::find_if(all.begin(), all.end(), is_it)->target;
}

void write_file(const std::string& path, const std::string& text) {
  example::OutputFile file(path);
  file.write(text);
  file.finish();
}

void measure(const Words& words, const Request& request) {
  const test::ForcedInstructionSet forced(target_of(words.instruction_set));
  Report report(instruction_set_in_effect());  // rather than what was asked for
  for (const TableKind& table : all_tables()) {
    if (!is_among(table.name, words.tables)) continue;
    std::optional<CorePin> pin;
    if (table.is_pinned) pin.emplace(request.core);
    table.measure(request, report);
  }
  if (!words.csv_path.empty()) write_file(words.csv_path, report.csv());
  if (!words.chart_path.empty()) write_file(words.chart_path, ratio_chart(report.records(), words.machine));
}

example::Work describe_program(CLI::App& app) {
  const auto words = std::make_shared<Words>();
  describe(app, *words, words->request);
  return [&app, words] {
    Request& request = words->request;
    if (words->quick) shrink(app, request);
    if (app.get_option("--core")->empty()) request.core = CorePin::allowed_cores().front();
    choose(*words, request);
    read_meshes(*words, request);
    measure(*words, request);
    return example::success;
  };
}

}  // namespace
}  // namespace surehit::benchmark

int main(int argc, char** argv) {
  return surehit::example::run_program("surehit_benchmark", "Measures surehit and its peers in the same run.", argc,
                                       argv, surehit::benchmark::describe_program);
}
