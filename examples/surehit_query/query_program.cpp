#include "surehit_query/query_program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "command_line/program.hpp"
#include "surehit_query/answer_queries.hpp"

namespace surehit::example {
namespace {

template <typename Choice>
using Choices = std::vector<std::pair<std::string, Choice>>;

/// The first of the choices is the default.
template <typename Choice>
void add_choice(CLI::App& command, const std::string& name, Choice& choice, const Choices<Choice>& choices,
                const std::string& description) {
  std::vector<std::string> names;
  for (const auto& entry : choices) names.push_back(entry.first);
  const auto choose = [&choice, choices, names](const std::string& chosen) {
    const auto index = std::find(names.begin(), names.end(), chosen) - names.begin();
    choice = choices[static_cast<std::size_t>(index)].second;
  };
  command.add_option_function<std::string>(name, choose, description)
      ->check(CLI::IsMember(names).description(""))
      ->type_name(CLI::detail::join(names, "|"))
      ->default_str(names.front());
}

CLI::App& add_command(CLI::App& app, QueryRequest& request, Question question, const std::string& name,
                      const std::string& description) {
  CLI::App& command = *app.add_subcommand(name, description);
  command.callback([&request, question] { request.question = question; });
  if (question != Question::pair) {
    command.add_option("MESH", request.mesh_path, "A mesh: .obj, .ply, .stl or .off")->required()->type_name("");
    command.add_flag("--statistics", request.wants_statistics,
                     "Then say on standard error, as CSV, what the queries did: cells walked, candidate triangles, how "
                     "many of them the filter left undecided, and how often it took exact arithmetic");
  }
  command.add_option("FILE", request.input_path, "The paths, one a line; - is standard input")
      ->required()
      ->type_name("");
  add_choice<ScalarKind>(command, "--scalar", request.scalar,
                         {{"float", ScalarKind::single_precision}, {"double", ScalarKind::double_precision}},
                         "The type that all numbers are read to and answers rounded to");
  add_choice<PathKind>(command, "--path", request.path,
                       {{"segment", PathKind::segment}, {"ray", PathKind::ray}, {"line", PathKind::line}},
                       "What a path is: from p to q, from p along a direction, or both ways along it");
  add_choice<Culling>(command, "--cull", request.culling,
                      {{"none", Culling::none}, {"back", Culling::back}, {"front", Culling::front}},
                      "Leave out the hits on this side of a triangle");
  command.add_option("-o", request.output_path, "Where the answers go; - is standard output")
      ->type_name("OUT")
      ->capture_default_str();
  command
      .add_option("--threads", request.threads, "Threads that share the paths; the output is the same for any number")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1024}).description(""))
      ->capture_default_str();
  return command;
}

void describe(CLI::App& app, QueryRequest& request) {
  request.threads = std::clamp(std::thread::hardware_concurrency(), 1u, 1024u);
  app.require_subcommand(1);
  app.get_formatter()->column_width(36);
  app.footer(
      "A line of FILE holds the numbers of one path: p, then q or the direction. They are decimal or hex\n"
      "floats (0x1.8p-3), with white space, a comma or both between them. Blank lines and lines that begin\n"
      "with # are skipped. Answers are exact, their numbers rounded once to nearest; what is written reads\n"
      "back to the same bits. COMMAND --help tells the options and the output of a command.\n"
      "Exit status: 0, 2 for bad input or usage, 1 for any other failure.");

  add_command(app, request, Question::pair, "pair", "Does each path meet the triangle beside it?")
      .footer(
          "FILE: 15 numbers a line: p, then q or the direction, then the corners a, b and c.\n"
          "Output: hit,t,u,v,side, one line a pair; a miss is 0,,,, and side is front, back or edge_on.");
  add_command(app, request, Question::first, "first", "Where does each path first meet the mesh?")
      .footer(
          "FILE: 6 numbers a line: p, then q or the direction.\n"
          "Output: triangle,t,u,v,side, one line a path; a miss is -1,,,, and triangles count from 0.");
  add_command(app, request, Question::any, "any", "Does each path meet the mesh at all?")
      .footer(
          "FILE: 6 numbers a line: p, then q or the direction.\n"
          "Output: hit, one line a path: 1 or 0.");
  add_command(app, request, Question::all, "all", "Where does each path meet the mesh, every triangle?")
      .footer(
          "FILE: 6 numbers a line: p, then q or the direction.\n"
          "Output: path,triangle,t,u,v,side, one line a hit, in order along the path; paths and triangles count from "
          "0.");
}

Work describe_program(CLI::App& app) {
  const auto request = std::make_shared<QueryRequest>();
  describe(app, *request);
  return [request] {
    answer_queries(*request);
    return success;
  };
}

}  // namespace

int run_query_program(int argc, char** argv) noexcept {
  return run_program("surehit-query", "Asks exactly where straight paths meet triangles.", argc, argv,
                     describe_program);
}

}  // namespace surehit::example
