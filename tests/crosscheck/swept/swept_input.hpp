#pragma once

// What an adapter needs, and no more: it uses the standard library alone. Copy it.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace swept {

/// A line of a file of cases, as README.md describes it.
struct Input {
  std::string shape;   ///< sphere, box or capsule
  std::string scalar;  ///< float or double
  std::string family;
  std::array<std::array<double, 3>, 3> corners;
  std::array<double, 3> start;
  std::array<double, 3> end;
  std::vector<double> size;  ///< the radius; three half extents; or the half axis and the radius
  std::string truth;         ///< the rest of the line, which no adapter looks at
};

/// How many numbers say the size of a shape, or 0 for a shape that is not known.
inline std::size_t size_count(const std::string& shape) {
  return shape == "sphere" ? 1 : shape == "box" ? 3 : shape == "capsule" ? 4 : 0;
}

/// Reads a line. Returns false if it is no case.
inline bool read(const std::string& line, Input& input) {
  std::istringstream words(line);
  std::string word;
  bool is_good = true;
  const auto take = [&](double& number) {
    char* end = nullptr;
    is_good = is_good && words >> word;
    number = std::strtod(word.c_str(), &end);  // Takes hexadecimal floats, and rounds none of them.
    is_good = is_good && end != word.c_str() && *end == '\0';
  };
  if (!(words >> input.shape >> input.scalar >> input.family)) return false;
  for (auto& corner : input.corners) {
    for (double& x : corner) take(x);
  }
  for (double& x : input.start) take(x);
  for (double& x : input.end) take(x);
  input.size.assign(size_count(input.shape), 0);
  for (double& x : input.size) take(x);
  std::getline(words >> std::ws, input.truth);
  return is_good && !input.size.empty() && !input.truth.empty();
}

/// Reads cases from standard input, and writes one answer for each. `ask(input)` returns the line: `miss`, or `hit` and
/// what the engine knows of t, the feature and the weights. Returns the exit status.
template <typename Ask>
int answer_all(const Ask& ask) {
  std::string line;
  Input input;
  for (int c = std::getchar(); c != EOF; c = std::getchar()) {
    if (c != '\n') {
      line += static_cast<char>(c);
      continue;
    }
    if (!line.empty() && line.front() != '#') {
      if (!read(line, input)) {
        std::fprintf(stderr, "this line is no case: %s\n", line.c_str());
        return 1;
      }
      std::puts(ask(input).c_str());
    }
    line.clear();
  }
  return 0;
}

}  // namespace swept
