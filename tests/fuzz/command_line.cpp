// surehit-query in this process. The first line of the bytes are its arguments, parted by single spaces; what follows
// is the mesh file that they name, up to a line --, and then the paths, in the file `paths` and on standard input.
// After another line -- comes the file `scene`, which may place the mesh too. Whatever that makes, the program ends as
// it documents: 0 without a word on standard error, but for statistics where they are asked for; 2 with one line there,
// and no output; 1 where the output cannot be written. Warnings of the mesh may come before, each kind once.

#include <stdio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "examples/temporary_folder.hpp"
#include "finding.hpp"
#include "surehit_query/query_program.hpp"

namespace surehit::test {
namespace {

namespace fs = std::filesystem;

/// What a program would have for its standard streams, for as long as this lives. In glibc these are variables.
class StandardStreams {
 public:
  explicit StandardStreams(const std::string& input)
      : input_file_(input.empty() ? fopen("/dev/null", "rb")
                                  : fmemopen(const_cast<char*>(input.data()), input.size(), "rb")),
        output_file_(open_memstream(&output_, &output_size_)),
        error_file_(open_memstream(&error_, &error_size_)),
        cout_(std::cout.rdbuf(cout_text_.rdbuf())),
        cerr_(std::cerr.rdbuf(cerr_text_.rdbuf())) {
    std::swap(stdin, input_file_);
    std::swap(stdout, output_file_);
    std::swap(stderr, error_file_);
  }
  ~StandardStreams() {
    free(output_);
    free(error_);
  }
  StandardStreams(const StandardStreams&) = delete;
  StandardStreams& operator=(const StandardStreams&) = delete;

  void restore() {
    std::swap(stdin, input_file_);
    std::swap(stdout, output_file_);
    std::swap(stderr, error_file_);
    std::cout.rdbuf(cout_);
    std::cerr.rdbuf(cerr_);
    for (FILE* file : {input_file_, output_file_, error_file_}) fclose(file);
  }
  [[nodiscard]] std::string output() const { return std::string(output_, output_size_) + cout_text_.str(); }
  [[nodiscard]] std::string error() const { return std::string(error_, error_size_) + cerr_text_.str(); }

 private:
  char* output_ = nullptr;
  std::size_t output_size_ = 0;
  char* error_ = nullptr;
  std::size_t error_size_ = 0;
  FILE* input_file_;
  FILE* output_file_;
  FILE* error_file_;
  std::ostringstream cout_text_;
  std::ostringstream cerr_text_;
  std::streambuf* cout_;
  std::streambuf* cerr_;
};

/// Up to the mark, or all; the mark is left out and what follows stays behind in `text`.
std::string cut_before(std::string_view mark, std::string_view& text) {
  const std::size_t end = std::min(text.find(mark), text.size());
  const std::string part(text.substr(0, end));
  text.remove_prefix(std::min(end + mark.size(), text.size()));
  return part;
}

/// Takes the warnings off the front. A mesh has three kinds, and one of what a reader passes over. A scene has one.
std::string without_warnings(std::string text, std::size_t& warnings) {
  constexpr std::string_view mesh_mark = "surehit-query: warning: mesh.";
  constexpr std::string_view scene_mark = "surehit-query: warning: scene: ";
  while (text.starts_with(mesh_mark) || text.starts_with(scene_mark)) {
    text.erase(0, text.find('\n') + 1);
    ++warnings;
  }
  return text;
}

/// No argument leads out of the folder but to these: the program writes where it is told.
std::string harmless(std::string argument) {
  if (argument == "/dev/null" || argument == "/dev/full") return argument;
  std::erase_if(argument, [](char c) { return c == '/' || c == '\0'; });
  return argument;
}

std::vector<std::string> split_arguments(const std::string& line) {
  std::vector<std::string> arguments = {"surehit-query"};
  std::istringstream words(line);
  for (std::string word; std::getline(words, word, ' ');) arguments.push_back(harmless(word));
  return arguments;
}

void check(std::string_view text) {
  static const TemporaryFolder folder;
  fs::current_path(folder.at(""));
  for (const auto& left : fs::directory_iterator(".")) fs::remove_all(left);

  std::vector<std::string> arguments = split_arguments(cut_before("\n", text));
  const std::string mesh = cut_before("\n--\n", text);
  const std::string paths = cut_before("\n--\n", text);
  const std::string scene(text);
  static_cast<void>(folder.write("paths", paths));
  static_cast<void>(folder.write("masks", paths));
  static_cast<void>(folder.write("scene", scene));
  std::size_t max_warnings = 1;
  for (const char* name : {"mesh.obj", "mesh.off", "mesh.ply", "mesh.stl"}) {
    if (std::find(arguments.begin(), arguments.end(), name) != arguments.end() ||
        scene.find(name) != std::string::npos) {
      static_cast<void>(folder.write(name, mesh));
      max_warnings += 4;
    }
  }
  const std::size_t files = folder.file_count();

  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  const auto count = static_cast<int>(pointers.size());
  pointers.push_back(nullptr);
  StandardStreams streams(paths);
  const int status = example::run_query_program(count, pointers.data());
  streams.restore();

  const std::string output = streams.output();
  std::size_t warnings = 0;
  const std::string error = without_warnings(streams.error(), warnings);
  const auto tell = [&](const std::string& finding) {
    stop_at("exit status " + std::to_string(status) + ": " + finding + "\noutput: " + output + "\nerror: " + error);
  };
  if (warnings > max_warnings) tell("more warnings than there are kinds of them");
  if (status == 0) {
    const bool wants_statistics = std::any_of(arguments.begin(), arguments.end(),
                                              [](const std::string& argument) { return argument.starts_with("--s"); });
    const bool is_answer = wants_statistics && error.starts_with("statistic,count,");
    if (!error.empty() && !is_answer) tell("a success that complains");
    return;
  }
  if (std::count(error.begin(), error.end(), '\n') != 1 || !error.ends_with('\n') ||
      !error.starts_with("surehit-query: ")) {
    tell("not an error of one line");
  }
  if (folder.file_count() > files) tell("a failure that leaves a file behind");
  if (status == 1) {
    if (error.find(": cannot be written: ") == std::string::npos) tell("a failure of another kind");
  } else if (status != 2) {
    tell("no status that is documented");
  } else if (!output.empty()) {
    tell("bad input, answered all the same");
  }
}

}  // namespace
}  // namespace surehit::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  surehit::test::check({reinterpret_cast<const char*>(data), size});
  return 0;
}
