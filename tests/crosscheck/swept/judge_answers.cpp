// Judges an engine's answers to cases: `swept_judge CASES ANSWERS` prints a table with a row for each family.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "command_line/program.hpp"
#include "mesh_io/input_error.hpp"
#include "swept_input.hpp"

namespace surehit::test {
namespace {

/// What the end of a case's line says.
struct Truth {
  std::string kind;  ///< miss, start or hit
  std::string feature;
  std::string t_exactly;
  double t_float = 0, u_float = 0, v_float = 0;
  double t = 0, u = 0, v = 0;
};

double number(const std::string& word, const std::string& where) {
  char* end = nullptr;
  const double x = std::strtod(word.c_str(), &end);
  if (end == word.c_str() || *end != '\0') throw example::InputError(where + ": '" + word + "' is not a number");
  return x;
}

Truth read_truth(const std::string& text, const std::string& where) {
  std::istringstream words(text);
  Truth truth;
  words >> truth.kind;
  if (truth.kind == "miss") return truth;
  words >> truth.feature >> truth.t_exactly;
  for (double* const x : {&truth.t_float, &truth.u_float, &truth.v_float, &truth.t, &truth.u, &truth.v}) {
    std::string word;
    words >> word;
    *x = number(word, where);
  }
  return truth;
}

struct Answer {
  bool hits = false;
  double t = 0;
  std::string feature;  ///< empty if the engine does not say
  bool has_weights = false;
  double u = 0;
  double v = 0;
};

Answer read_answer(const std::string& line, const std::string& where) {
  std::istringstream words(line);
  std::string kind;
  words >> kind;
  if (kind != "hit" && kind != "miss") throw example::InputError(where + ": '" + line + "' is no answer");
  Answer answer;
  answer.hits = kind == "hit";
  if (!answer.hits) return answer;
  std::string word;
  words >> word;
  answer.t = number(word, where);
  words >> answer.feature;
  if (!(words >> word)) return answer;
  answer.has_weights = true;
  answer.u = number(word, where);
  word.clear();
  words >> word;
  answer.v = number(word, where);
  return answer;
}

struct Row {
  std::size_t cases = 0;
  std::size_t touch = 0;
  std::size_t missed = 0;         ///< hits on the way that the engine does not tell
  std::size_t missed_starts = 0;  ///< contacts at the start that it does not tell
  std::size_t invented = 0;       ///< hits of shapes that do not touch
  std::size_t inexact = 0;        ///< hits with anything told that is not the exact one, rounded
  double max_error = 0;           ///< of t, of the hits on the way

  Row& operator+=(const Row& more) {
    cases += more.cases;
    touch += more.touch;
    missed += more.missed;
    missed_starts += more.missed_starts;
    invented += more.invented;
    inexact += more.inexact;
    max_error = std::max(max_error, more.max_error);
    return *this;
  }
  [[nodiscard]] std::size_t wrong() const { return missed + missed_starts + invented + inexact; }
};

void judge(const swept::Input& input, const Truth& truth, const Answer& answer, Row& row) {
  ++row.cases;
  const bool touches = truth.kind != "miss";
  row.touch += touches ? 1 : 0;
  if (!touches || !answer.hits) {
    row.invented += answer.hits ? 1 : 0;
    row.missed += truth.kind == "hit" ? 1 : 0;
    row.missed_starts += truth.kind == "start" ? 1 : 0;
    return;
  }
  const bool is_float = input.scalar == "float";
  const bool is_t_exact = answer.t == (is_float ? truth.t_float : truth.t);
  const bool is_part_exact = answer.feature.empty() || answer.feature == truth.feature;
  const bool are_weights_exact = !answer.has_weights || (answer.u == (is_float ? truth.u_float : truth.u) &&
                                                         answer.v == (is_float ? truth.v_float : truth.v));
  row.inexact += is_t_exact && is_part_exact && are_weights_exact ? 0 : 1;
  const double error = std::fabs(answer.t - truth.t);
  if (truth.kind == "hit") row.max_error = std::max(row.max_error, std::isnan(error) ? INFINITY : error);
}

std::vector<std::string> read_lines(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw example::InputError(path + ": cannot be read");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.front() != '#') lines.push_back(line);
  }
  return lines;
}

void print(const std::string& name, const Row& row) {
  std::printf("| %-20s | %7zu | %7zu | %7zu | %7zu | %8zu | %7zu | %9.2g |\n", name.c_str(), row.cases, row.touch,
              row.missed, row.missed_starts, row.invented, row.inexact, row.max_error);
}

example::ExitStatus judge_files(const std::string& cases_path, const std::string& answers_path) {
  const std::vector<std::string> cases = read_lines(cases_path);
  const std::vector<std::string> answers = read_lines(answers_path);
  if (cases.size() != answers.size()) {
    throw example::InputError(answers_path + ": " + std::to_string(answers.size()) + " answers to " +
                              std::to_string(cases.size()) + " cases");
  }
  std::vector<std::string> order;
  std::map<std::string, Row> rows;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string where = ": case " + std::to_string(i + 1);
    swept::Input input;
    if (!swept::read(cases[i], input)) throw example::InputError(cases_path + where + ": the line is no case");
    if (rows.find(input.family) == rows.end()) order.push_back(input.family);
    judge(input, read_truth(input.truth, cases_path + where), read_answer(answers[i], answers_path + where),
          rows[input.family]);
  }
  std::printf("| %-20s | %7s | %7s | %7s | %7s | %8s | %7s | %9s |\n", "family", "cases", "touch", "missed", "starts",
              "invented", "inexact", "max error");
  std::puts("| -------------------- | ------: | ------: | ------: | ------: | -------: | ------: | --------: |");
  Row all;
  for (const std::string& family : order) {
    print(family, rows[family]);
    all += rows[family];
  }
  print("all", all);
  return all.wrong() == 0 ? example::success : example::failure;
}

example::Work describe(CLI::App& app) {
  struct Paths {
    std::string cases;
    std::string answers;
  };
  const auto paths = std::make_shared<Paths>();
  app.add_option("CASES", paths->cases, "A file of cases")->required();
  app.add_option("ANSWERS", paths->answers, "An answer a line, in the same order")->required();
  app.footer("Exit status: 0 if every field of every answer is right, and 1 if not.");
  return [paths] { return judge_files(paths->cases, paths->answers); };
}

}  // namespace
}  // namespace surehit::test

int main(int argc, char** argv) {
  return surehit::example::run_program("swept_judge", "Judges an engine's answers about moving shapes.", argc, argv,
                                       surehit::test::describe);
}
