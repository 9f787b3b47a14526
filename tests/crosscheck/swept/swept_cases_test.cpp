#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "crosscheck/cgal_box_oracle.hpp"
#include "crosscheck/cgal_capsule_oracle.hpp"
#include "crosscheck/cgal_sphere_oracle.hpp"
#include "shape_of_input.hpp"
#include "support/one_root_number.hpp"
#include "support/program_run.hpp"
#include "support/shape_text.hpp"
#include "support/wrong_answers.hpp"
#include "swept_case.hpp"
#include "swept_input.hpp"

namespace surehit::test::swept_cases_test {
namespace {

const std::string samples = SWEPT_SAMPLES;

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The answer that the text of a case has, as surehit would give it.
template <typename Scalar>
std::optional<ShapeHit<Scalar>> answer_of(const std::string& truth) {
  std::istringstream words(truth);
  std::string kind;
  std::string feature;
  std::string t;
  words >> kind >> feature >> t;
  if (kind == "miss") return std::nullopt;
  std::vector<Scalar> numbers;
  for (std::string word; words >> word;) numbers.push_back(static_cast<Scalar>(std::strtod(word.c_str(), nullptr)));
  EXPECT_EQ(numbers.size(), 6U);
  const std::size_t first = sizeof(Scalar) == 4 ? 0 : 3;
  ShapeHit<Scalar> hit{numbers[first], numbers[first + 1], numbers[first + 2], 0, Feature::face, kind == "start"};
  for (std::size_t i = 0; i < 7; ++i) {
    if (name_of(static_cast<Feature>(i)) == feature) hit.feature = static_cast<Feature>(i);
  }
  EXPECT_EQ(name_of(hit.feature), feature);
  EXPECT_TRUE(is_nearest(hit.t, parse_root(t)));
  return hit;
}

/// CGAL accepts the truth, rounded to this type, and nothing beside it.
template <typename Scalar>
void check_with_cgal(const swept::Input& input) {
  const Triangle<Scalar> triangle = triangle_of<Scalar>(input);
  const std::optional<ShapeHit<Scalar>> truth = answer_of<Scalar>(input.truth);
  const auto check = [&](const auto& shape) {
    EXPECT_EQ(cgal_error(shape, triangle, truth), std::nullopt);
    for (const auto& wrong : wrong_answers(truth)) {
      EXPECT_NE(cgal_error(shape, triangle, wrong), std::nullopt) << (wrong ? hex_text(*wrong) : "a miss");
    }
  };
  std::visit(check, shape_of<Scalar>(input));
}

const std::vector<std::string> shapes = {"sphere", "box", "capsule"};

std::vector<std::string> all_samples() {
  std::vector<std::string> paths;
  for (const std::string& shape : shapes) {
    for (const char* scalar : {"_float.txt", "_double.txt"}) paths.push_back(samples + '/' + shape + scalar);
  }
  return paths;
}

TEST(SweptCases, of_the_samples_are_those_that_the_generator_writes) {
  const ProgramRun generator(SWEPT_CASES_PROGRAM);
  const auto expect_written = [&](const std::string& arguments, const std::string& sample) {
    const auto outcome = generator.run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_EQ(outcome.output, text_of(samples + sample));
  };
  for (const std::string& shape : shapes) {
    expect_written("--cases 10 --shape " + shape, '/' + shape + "_float.txt");
    expect_written("--cases 4 --double --shape " + shape, '/' + shape + "_double.txt");
  }
}

TEST(SweptCases, have_truths_that_cgal_confirms) {
  std::set<std::string> families;
  std::size_t hits = 0;
  for (const std::string& sample : all_samples()) {
    for (const std::string& line : lines_of(sample)) {
      SCOPED_TRACE(line.substr(0, 300));
      swept::Input input;
      ASSERT_TRUE(swept::read(line, input));
      families.insert(input.shape + ' ' + input.family);
      hits += input.truth.starts_with("hit");
      // Cases of floats have the truth in doubles too.
      if (input.scalar == "float") check_with_cgal<float>(input);
      check_with_cgal<double>(input);
    }
  }
  EXPECT_EQ(families.size(), all_sphere_families.size() + all_box_families.size() + all_capsule_families.size());
  EXPECT_GT(hits, 150U);
}

TEST(SweptCases, are_refused_if_a_line_is_damaged) {
  const std::string line = lines_of(samples + "/sphere_float.txt").front();
  swept::Input input;
  EXPECT_TRUE(swept::read(line, input));
  EXPECT_FALSE(swept::read("ball" + line.substr(line.find(' ')), input));
  EXPECT_FALSE(swept::read(line.substr(0, line.rfind("0x")), input) && input.truth.empty());
  std::string damaged = line;
  damaged.replace(damaged.find("0x"), 2, "zz");
  EXPECT_FALSE(swept::read(damaged, input));
  EXPECT_THROW(static_cast<void>(parse_root("1/0")), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(parse_root("lower:1:0:1")), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(parse_root("middle:1:-3:1")), std::invalid_argument);
}

/// Runs programs that are given by their paths, with a generator's cases in a file.
class SweptJudge : public testing::Test {
 protected:
  void generate(const std::string& arguments) const {
    ASSERT_EQ(run_.run_command(std::string(SWEPT_CASES_PROGRAM) + ' ' + arguments + " >cases").status, 0);
  }
  [[nodiscard]] ProgramRun::Outcome judge(const std::string& answers) const {
    return run_.run_command("{ " + answers + "; } <cases >answers && \"$program\" cases answers");
  }
  /// The columns of the last row.
  [[nodiscard]] static std::vector<std::string> sums(const std::string& table) {
    std::istringstream row(table.substr(table.rfind("| all")));
    std::vector<std::string> cells;
    for (std::string word; row >> word;) {
      if (word != "|") cells.push_back(word);
    }
    return cells;
  }

  ProgramRun run_{SWEPT_JUDGE_PROGRAM};
};

TEST_F(SweptJudge, finds_nothing_wrong_with_surehit) {
  for (const std::string& arguments :
       {std::string("--cases 200 --shape "), std::string("--cases 40 --double --shape ")}) {
    for (const std::string& shape : shapes) {
      generate("--seed 2 " + arguments + shape);
      const auto outcome = judge(SWEPT_SUREHIT_PROGRAM);
      EXPECT_EQ(outcome.status, 0) << outcome.output << outcome.error;
      const std::vector<std::string> all = sums(outcome.output);
      ASSERT_EQ(all.size(), 8U) << outcome.output;
      EXPECT_GT(std::stoi(all[2]), 200);
      for (const std::size_t wrong : {3U, 4U, 5U, 6U}) EXPECT_EQ(all[wrong], "0") << outcome.output;
    }
  }
}

TEST_F(SweptJudge, tells_of_each_wrong_field) {
  generate("--family general --cases 200");
  const std::string answers = SWEPT_SUREHIT_PROGRAM;
  const auto column_after = [&](const std::string& change, std::size_t column) {
    const auto outcome = judge(answers + " | sed '" + change + "'");
    EXPECT_EQ(outcome.status, 1) << change << outcome.error;
    return std::stoi(sums(outcome.output).at(column));
  };
  EXPECT_GT(column_after("s/^hit.*/miss/", 3), 10);                          // missed
  EXPECT_GT(column_after("s/^hit.*/miss/", 4), 0);                           // missed at the start
  EXPECT_GT(column_after("s/^miss/hit 0x1p-1 face 0x0p+0 0x0p+0/", 5), 10);  // invented
  EXPECT_GT(column_after("s/ edge_ab / edge_bc /", 6), 5);                   // another feature
  EXPECT_GT(column_after("s/^hit 0x\\([^ ]*\\)/hit 0x1p-3/", 6), 10);        // another t
  EXPECT_GT(column_after("s/[^ ]* \\([^ ]*\\)$/0x1.8p-9 \\1/", 6), 10);      // another u
  EXPECT_GT(column_after("s/ [^ ]*$/ 0x1.8p-9/", 6), 10);                    // another v
}

TEST_F(SweptJudge, takes_what_an_engine_knows) {
  generate("--family general --cases 200");
  const std::string answers = SWEPT_SUREHIT_PROGRAM;
  const std::string without_weights = " | sed 's/^\\(hit [^ ]* [^ ]*\\) .*/\\1/'";
  EXPECT_EQ(judge(answers + without_weights).status, 0);
  EXPECT_EQ(judge(answers + " | sed 's/^\\(hit [^ ]*\\) .*/\\1/'").status, 0);
  const auto outcome = judge(answers + without_weights + " | sed 's/ edge_ab$/ edge_bc/'");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_GT(std::stoi(sums(outcome.output).at(6)), 5) << outcome.output;
}

TEST_F(SweptJudge, names_the_line_that_it_cannot_read) {
  generate("--family general --cases 3");
  EXPECT_EQ(judge("printf 'miss\\nmiss\\n'").status, 2);
  EXPECT_EQ(judge("printf 'miss\\nmiss\\n'").error, "swept_judge: answers: 2 answers to 3 cases\n");
  EXPECT_EQ(judge("printf 'miss\\nhit 1,5\\nmiss\\n'").error, "swept_judge: answers: case 2: '1,5' is not a number\n");
  EXPECT_EQ(judge("printf 'miss\\nmaybe\\nmiss\\n'").error, "swept_judge: answers: case 2: 'maybe' is no answer\n");
}

// What is known of Bullet: it misses shapes of all kinds.
TEST_F(SweptJudge, finds_wrong_answers_of_bullet) {
  if (std::string(SWEPT_BULLET_PROGRAM).empty()) GTEST_SKIP() << "Bullet was not found";
  for (const std::string& shape : shapes) {
    generate("--cases 60 --shape " + shape);
    const auto outcome = judge(SWEPT_BULLET_PROGRAM);
    EXPECT_EQ(outcome.status, 1) << outcome.error;
    const std::vector<std::string> all = sums(outcome.output);
    ASSERT_EQ(all.size(), 8U) << outcome.output << outcome.error;
    EXPECT_GT(std::stoi(all[3]), 10) << outcome.output;
    RecordProperty("table_" + shape, outcome.output);
  }
}

TEST_F(SweptJudge, gets_no_answers_of_bullet_to_cases_of_doubles) {
  if (std::string(SWEPT_BULLET_PROGRAM).empty()) GTEST_SKIP() << "Bullet was not found";
  generate("--double --cases 1");
  const auto outcome = judge(SWEPT_BULLET_PROGRAM);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.error, "Bullet computes in float here, and cannot answer cases of doubles\n");
}

}  // namespace
}  // namespace surehit::test::swept_cases_test
