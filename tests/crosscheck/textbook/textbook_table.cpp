// Judges the textbook tests, and writes what it finds into the pages, between their markers.

#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line/program.hpp"
#include "textbook_page.hpp"

namespace surehit::test {
namespace {

struct Request {
  std::vector<std::string> pages;
  bool write = false;
};

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

example::ExitStatus run(const Request& request) {
  std::map<std::string, std::string> texts;
  for (const std::string& path : request.pages) texts[path] = read(path);
  const std::map<std::string, std::string> blocks = textbook_blocks();
  bool is_stale = false;
  for (const auto& [path, text] : texts) {
    const std::string renewed = with_textbook_blocks(text, blocks);
    if (renewed == text) continue;
    if (!request.write) {
      example::warn("textbook_table", path + " is stale; --write renews it");
      is_stale = true;
      continue;
    }
    std::ofstream file(path, std::ios::binary);
    file << renewed;
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
  }
  if (request.pages.empty()) {
    for (const auto& [name, block] : blocks) std::cout << name << "\n\n" << block << '\n';
  }
  return is_stale ? example::failure : example::success;
}

example::Work describe(CLI::App& app) {
  const auto request = std::make_shared<Request>();
  app.add_option("page", request->pages, "Pages with markers; none prints all blocks");
  app.add_flag("--write", request->write, "Renew the pages; else a page that is stale fails");
  return [request] { return run(*request); };
}

}  // namespace
}  // namespace surehit::test

int main(int argc, char** argv) {
  return surehit::example::run_program("textbook_table", "Judges textbook tests by exact answers.", argc, argv,
                                       surehit::test::describe);
}
