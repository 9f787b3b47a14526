// Runs a fuzz target without a fuzzer: over files, or over bytes drawn from a seed, half of them at random and half as
// mutations of a corpus. The bytes at which the target ends the program are kept in a file.

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "support/mutated.hpp"
#include "support/random.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace surehit::test {
namespace {

namespace fs = std::filesystem;

/// What is being run, for the handler of a signal: from a file, or drawn and to be kept in one.
std::string bytes_in_hand;
std::string path_in_hand;
bool is_drawn = false;

/// Calls nothing but what a handler may.
void tell_of_finding(int signal) {
  bool is_in_file = !is_drawn;
  if (is_drawn) {
    const int file = open(path_in_hand.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    is_in_file = file >= 0 &&
                 write(file, bytes_in_hand.data(), bytes_in_hand.size()) == static_cast<ssize_t>(bytes_in_hand.size());
  }
  const std::array<const char*, 3> words = {is_in_file ? "a finding: " : "a finding that cannot be kept in ",
                                            path_in_hand.c_str(), "\n"};
  for (const char* word : words) {
    if (write(STDERR_FILENO, word, std::strlen(word)) < 0) break;
  }
  _exit(128 + signal);
}

void run(std::string bytes, std::string path) {
  bytes_in_hand = std::move(bytes);
  path_in_hand = std::move(path);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes_in_hand.data()), bytes_in_hand.size());
}

/// The files, and those in the folders, in the order of their names.
std::vector<fs::path> files_of(const std::vector<std::string>& paths) {
  std::vector<fs::path> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(fs::absolute(path));
    } else {
      for (const auto& entry : fs::directory_iterator(path)) files.push_back(fs::absolute(entry.path()));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string random_bytes(Random& random) {
  std::string bytes(random.below(random.one_in(2) ? 24 : 256), '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.bits());
  return bytes;
}

/// Changes a file of the corpus. The beginning of another file may replace its own.
std::string mutation(const std::vector<std::string>& corpus, Random& random) {
  std::string bytes = corpus[random.below(corpus.size())];
  if (random.one_in(4)) {
    const std::string& other = corpus[random.below(corpus.size())];
    bytes = other.substr(0, random.below(other.size() + 1)) + bytes.substr(random.below(bytes.size() + 1));
  }
  for (std::uint64_t rounds = random.below(4); rounds > 0; --rounds) bytes = mutated(bytes, random);
  return bytes;
}

int replay(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) run(read(file), file);
  std::printf("%zu files replayed\n", files.size());
  return files.empty() ? 1 : 0;
}

int draw(std::uint64_t cases, std::uint64_t seed, const std::vector<fs::path>& files) {
  std::vector<std::string> corpus;
  for (const fs::path& file : files) corpus.push_back(read(file));
  const fs::path here = fs::current_path();
  is_drawn = true;
  const auto start = std::chrono::steady_clock::now();
  for (std::uint64_t i = 0; i < cases; ++i) {
    // Each case has a seed of its own, so that it is drawn again without those before.
    Random random(Random(seed).bits() + i);
    run(corpus.empty() || random.one_in(2) ? random_bytes(random) : mutation(corpus, random),
        here / ("finding-" + std::to_string(seed) + "-" + std::to_string(i)));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::printf("%llu cases of seed %llu in %.1f s, no finding\n", static_cast<unsigned long long>(cases),
              static_cast<unsigned long long>(seed), seconds.count());
  return 0;
}

bool parse(const char* text, std::uint64_t& number) {
  const char* const end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, number);
  return stop == end && error == std::errc();
}

int usage(const char* program) {
  std::fprintf(stderr,
               "usage: %s replay FILE|FOLDER...\n"
               "       %s draw CASES SEED [FILE|FOLDER...]   mutates those files too\n",
               program, program);
  return 2;
}

int run_program(int argc, char** argv) {
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, tell_of_finding);
  const std::vector<std::string> words(argv + 1, argv + argc);
  const auto files_from = [&](std::size_t first) {
    return files_of({words.begin() + static_cast<std::ptrdiff_t>(first), words.end()});
  };
  if (words.size() >= 2 && words[0] == "replay") return replay(files_from(1));
  std::uint64_t cases = 0;
  std::uint64_t seed = 0;
  if (words.size() < 3 || words[0] != "draw" || !parse(argv[2], cases) || !parse(argv[3], seed)) return usage(argv[0]);
  return draw(cases, seed, files_from(3));
}

}  // namespace
}  // namespace surehit::test

int main(int argc, char** argv) { return surehit::test::run_program(argc, argv); }
