#include "command_line/program.hpp"

#include <cstdio>
#include <exception>
#include <string>

#include "mesh_io/input_error.hpp"

namespace surehit::example {

int run_program(CLI::App& app, int argc, char** argv, const std::function<ExitStatus()>& work) {
  const std::string name = app.get_name();
  app.failure_message([&](const CLI::App*, const CLI::Error& error) {
    return name + ": " + error.what() + " (see " + name + " --help)\n";
  });
  const auto fail = [&](const std::exception& error, ExitStatus status) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return status;
  };
  try {
    app.parse(argc, argv);
    return work();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? success : bad_input;
  } catch (const InputError& error) {
    return fail(error, bad_input);
  } catch (const std::exception& error) {
    return fail(error, failure);
  }
}

}  // namespace surehit::example
