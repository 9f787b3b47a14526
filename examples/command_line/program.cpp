#include "command_line/program.hpp"

#include <cstdio>
#include <exception>
#include <string>

#include "command_line/interruption.hpp"
#include "mesh_io/input_error.hpp"

namespace surehit::example {
namespace {

ExitStatus parse_and_work(const std::string& name, CLI::App& app, int argc, char** argv,
                          Work (*describe)(CLI::App& app)) {
  app.failure_message([&](const CLI::App*, const CLI::Error& error) {
    return name + ": " + error.what() + " (see " + name + " --help)\n";
  });
  const Work work = describe(app);
  try {
    app.parse(argc, argv);
    return work();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? success : bad_input;
  }
}

}  // namespace

int run_program(const char* name, const char* description, int argc, char** argv,
                Work (*describe)(CLI::App& app)) noexcept {
  const auto fail = [&](const std::exception& error, ExitStatus status) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return status;
  };
  try {
    CLI::App app(description, name);
    return parse_and_work(name, app, argc, argv, describe);
  } catch (const InputError& error) {
    return fail(error, bad_input);
  } catch (const Interrupted& error) {
    return fail(error, interrupted);
  } catch (const std::exception& error) {
    return fail(error, failure);
  }
}

void warn(const char* program, const std::string& warning) {
  std::fprintf(stderr, "%s: warning: %s\n", program, warning.c_str());
}

}  // namespace surehit::example
