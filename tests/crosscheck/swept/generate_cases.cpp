// Writes cases of moving shapes with what is true of them, to standard output.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "command_line/program.hpp"
#include "swept_case.hpp"

namespace surehit::test {
namespace {

struct Request {
  std::uint64_t cases = 20;
  std::uint64_t seed = 1;
  bool in_double = false;
  std::vector<std::string> families;
};

example::ExitStatus generate(const Request& request) {
  for (const SphereFamily family : all_sphere_families) {
    const std::string name = name_of(family);
    if (!request.families.empty() &&
        std::find(request.families.begin(), request.families.end(), name) == request.families.end())
      continue;
    Random random(seed_of(family, request.seed));
    for (std::uint64_t i = 0; i < request.cases; ++i) {
      std::puts((request.in_double ? draw_swept_case<double>(family, random) : draw_swept_case<float>(family, random))
                    .c_str());
    }
  }
  return example::success;
}

example::Work describe(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  std::vector<std::string> names;
  for (const SphereFamily family : all_sphere_families) names.push_back(name_of(family));
  app.add_option("--cases", request->cases, "How many of each family")->capture_default_str();
  app.add_option("--seed", request->seed, "Each draws other cases")->capture_default_str();
  app.add_flag("--double", request->in_double, "In double instead of float");
  app.add_option("--family", request->families, "Only these families")->check(CLI::IsMember(names));
  return [request] { return generate(*request); };
}

}  // namespace
}  // namespace surehit::test

int main(int argc, char** argv) {
  return surehit::example::run_program("swept_cases", "Writes cases of moving shapes with what is true of them.", argc,
                                       argv, surehit::test::describe);
}
