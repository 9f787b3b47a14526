#pragma once

namespace surehit::example {

/// The whole of surehit-query: parses the command line, answers and returns the exit status.
int run_query_program(int argc, char** argv) noexcept;

}  // namespace surehit::example
