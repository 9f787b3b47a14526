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
  std::string shape = "sphere";
  std::uint64_t cases = 20;
  std::uint64_t seed = 1;
  bool in_double = false;
  std::vector<std::string> families;
};

template <typename Family>
void generate_families(const Request& request) {
  std::vector<std::string> names;
  for (const Family family : all_families<Family>) names.push_back(name_of(family));
  for (const std::string& chosen : request.families) {
    if (std::find(names.begin(), names.end(), chosen) == names.end()) {
      throw CLI::ValidationError("--family", chosen + " not in {" + CLI::detail::join(names) + "}");
    }
  }
  for (const Family family : all_families<Family>) {
    const auto& chosen = request.families;
    if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), name_of(family)) == chosen.end()) continue;
    Random random(seed_of(family, request.seed));
    for (std::uint64_t i = 0; i < request.cases; ++i) {
      const std::string line =
          request.in_double ? draw_swept_case<double>(family, random) : draw_swept_case<float>(family, random);
      std::puts(line.c_str());
    }
  }
}

example::ExitStatus generate(const Request& request) {
  if (request.shape == "box") {
    generate_families<BoxFamily>(request);
  } else if (request.shape == "capsule") {
    generate_families<CapsuleFamily>(request);
  } else {
    generate_families<SphereFamily>(request);
  }
  return example::success;
}

example::Work describe(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  app.add_option("--shape", request->shape, "What moves")
      ->check(CLI::IsMember({"sphere", "box", "capsule"}))
      ->capture_default_str();
  app.add_option("--cases", request->cases, "How many of each family")->capture_default_str();
  app.add_option("--seed", request->seed, "Each draws other cases")->capture_default_str();
  app.add_flag("--double", request->in_double, "In double instead of float");
  app.add_option("--family", request->families, "Only these families of the shape");
  return [request] { return generate(*request); };
}

}  // namespace
}  // namespace surehit::test

int main(int argc, char** argv) {
  return surehit::example::run_program("swept_cases", "Writes cases of moving shapes with what is true of them.", argc,
                                       argv, surehit::test::describe);
}
