#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace surehit::example {

/// What the programs end with.
enum ExitStatus : int { success = 0, failure = 1, bad_input = 2 };

/// Parses the command line into what `app` was told of, then works. What goes wrong becomes one line on standard error
/// that begins with the program's name, and an exit status: `bad_input` for the command line and for an InputError,
/// `failure` for any other exception, else what `work` returns.
int run_program(CLI::App& app, int argc, char** argv, const std::function<ExitStatus()>& work);

}  // namespace surehit::example
