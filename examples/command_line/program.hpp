#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace surehit::example {

/// What the programs end with.
enum ExitStatus : int { success = 0, failure = 1, bad_input = 2, interrupted = 130 };

/// What a program does once its command line is parsed.
using Work = std::function<ExitStatus()>;

/// A program's whole main: `describe` tells `app` the options and returns the work. What goes wrong becomes one line on
/// standard error that begins with the program's name, and an exit status: `bad_input` for the command line and for an
/// InputError, `interrupted` where the user has asked the program to stop, `failure` for any other exception, else what
/// the work returns.
int run_program(const char* name, const char* description, int argc, char** argv,
                Work (*describe)(CLI::App& app)) noexcept;

/// Says something on standard error that is no failure, in one line that begins with the program's name.
void warn(const char* program, const std::string& warning);

}  // namespace surehit::example
