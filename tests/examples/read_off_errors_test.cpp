// What is said of OFF files that are wrong.

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "error_of.hpp"
#include "mesh_io/read_off.hpp"
#include "mesh_io/text_lines.hpp"
#include "mutations.hpp"
#include "off_text.hpp"

namespace surehit::test::read_off_errors_test {
namespace {

using example::read_off;

std::string error_in(const std::string& text) {
  return error_of([&] { return read_off<float>(text); });
}

TEST(ReadOffErrors, names_line_and_value_of_a_number_that_old_windows_wrote) {
  for (const std::string value : {"1.#QNAN", "-1.#IND00", "1.#INF", "1.#IND", "-1.#INF"}) {
    const std::string error = "'" + value + "' is not a number";
    EXPECT_EQ(error_in("OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 " + value + "\n3 0 1 2\n"), "line 5: " + error);
    EXPECT_EQ(error_in("OFF 3 1 0\n0 0 0\n4 0 0\n0 4 " + value + "\n3 0 1 2\n"), "line 4: " + error);
    EXPECT_EQ(error_in("3 1\n0 0 0\n" + value + " 0 0\n0 4 0\n3 0 1 2\n"), "line 3: " + error);
    EXPECT_EQ(error_in("OFF 3 1 0 0 0 0\n4 0 0 0 4\n" + value + " 3 0 1 2\n"), "line 3: " + error);
    EXPECT_EQ(error_in("OFF\n3 1 0\n0 0 0 1 0 0\n4 0 0 1 0 " + value + "\n0 4 0 1 0 0\n3 0 1 2\n"), "line 4: " + error);
    EXPECT_EQ(error_in("NOFF\n3 1 0\n0 0 0 1 0 0\n4 0 0 1 0 0\n0 4 0 1 " + value + " 0\n3 0 1 2\n"),
              "line 5: " + error);
    EXPECT_EQ(error_in("OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2 " + value + "\n"), "line 6: " + error);
    EXPECT_EQ(error_in("OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 " + value + " 2\n"),
              "line 6: '" + value + "' is not an integer");
  }
}

TEST(ReadOffErrors, names_the_line_of_an_error_in_its_header) {
  EXPECT_EQ(error_in(""), "the file is empty");
  EXPECT_EQ(error_in("# nothing\n"), "line 1: the file is empty");
  EXPECT_EQ(error_in("ply\n"), "line 1: an OFF file begins with OFF, or without it with the counts, not with 'ply'");
  EXPECT_EQ(error_in("-3 1 0\n"), "line 1: an OFF file begins with OFF, or without it with the counts, not with '-3'");
  for (const std::string word : {"4OFF", "nOFF", "4nOFF", "NnOFF", "CnOFF", "C4OFF", "STnOFF"}) {
    EXPECT_EQ(error_in("# first\n" + word + "\n3\n4 1 0\n"),
              "line 2: '" + word + "' is a kind of OFF file without 3 coordinates a vertex");
  }
  for (const char* word : {"OFF BINARY", "OFF\nBINARY", "OFFBINARY", "off binary", "COFF BINARY", "OFF Binary"}) {
    EXPECT_NE(error_in(word + std::string("\n\0\0\0\1", 5)).find(": binary OFF files are not supported"),
              std::string::npos)
        << word;
  }
  EXPECT_EQ(error_in("OFF\n"), "line 1: the file ends before the counts");
  EXPECT_EQ(error_in("OFF\n4\n"), "line 2: the file ends before the counts");
  EXPECT_EQ(error_in("OFF\n-4 1 0\n"), "line 2: a count is negative: '-4'");
  EXPECT_EQ(error_in("OFF\n4 -1 0\n"), "line 2: a count is negative: '-1'");
  EXPECT_EQ(error_in("OFF\n4 1 x\n" + square), "line 2: 'x' is not an integer");
  EXPECT_EQ(error_in("OFF\n4\n1.5\n0\n" + square), "line 3: '1.5' is not an integer");
  EXPECT_EQ(error_in("OFF\n99999999999999999999 1 0\n"), "line 2: '99999999999999999999' is beyond 64 bits");
}

TEST(ReadOffErrors, names_the_line_of_an_error_in_its_body) {
  EXPECT_EQ(error_in("OFF\n4 1\n"), "line 2: the file ends before vertex 0");
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0 0\n"), "line 3: the file ends before vertex 1");
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0\n"), "line 3: the file ends within a vertex");
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n4 0 1 2 3\n"),
            "line 3: a vertex has 3 coordinates, not 4");
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0 x\n"), "line 3: 'x' is not a number");
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0 1e39\n" + square), "line 3: '1e39' is beyond the largest float");
  EXPECT_EQ(error_in("OFF\n4 2 0\n" + square + "3 0 1 2"), "line 7: the file ends before face 1");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "4 0 1 2"), "line 7: a face of 4 corners has only 3 numbers");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "2 0 1"), "line 7: a face needs 3 corners or more, not 2");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "-3 0 1"), "line 7: a count is negative: -3");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "3 0 1 4"),
            "line 7: vertex index 4 is out of range, there are 4 vertices");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "3 0 1 -1"),
            "line 7: vertex index -1 is out of range, there are 4 vertices");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "3 0 1 2\n3 1 2 3"), "line 8: something follows the last face");
  EXPECT_EQ(error_in("OFF\n3 1 0\n" + square + "3 0 1 2"), "line 6: a face needs 3 corners or more, not 0");
  EXPECT_EQ(error_in("OFF\n5 1 0\n" + square + "4 0 1 2 3"), "line 7: a vertex has 3 coordinates, not 5");
  EXPECT_EQ(error_in("OFF\n5 2 0\n" + square + "3 0 1 2\n3 3 2 1"), "line 7: a vertex has 3 coordinates, not 4");
}

TEST(ReadOffErrors, names_the_line_that_is_at_fault_in_a_file_of_lines) {
  const std::string faces = "4 0 1 2 3\n3 0 1 2\n3 3 2 1\n";
  EXPECT_EQ(error_in("OFF\n4 3 0\n0 0 0\n1 0\n1 1 0\n0 1 0\n" + faces), "line 4: a vertex has 3 coordinates, not 2");
  EXPECT_EQ(error_in("OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0 0\n0 1 0\n" + faces),
            "line 5: a vertex has 3 coordinates, not 4");
  EXPECT_EQ(error_in("OFF\n4 3 0\n" + square + "4 0 1 2\n3 0 1 2\n3 3 2 1\n"),
            "line 7: a face of 4 corners has only 3 numbers");
  EXPECT_EQ(error_in("OFF\n4 3 0\n" + square + "4 0 1 2 3\n3 0 1\n3 3 2 1\n"),
            "line 8: a face of 3 corners has only 2 numbers");
  EXPECT_EQ(error_in("OFF\n4 3 0\n" + square + "4 0 1 2 3\n3 0 1 9\n3 3 2 1\n"),
            "line 8: vertex index 9 is out of range, there are 4 vertices");
  EXPECT_EQ(error_in("OFF\n4 2 0\n" + square + "3 0 1 2 3\n3 2 1\n"), "line 8: a face of 3 corners has only 2 numbers");
  // What would fit with other line breaks, or other counts, is no better than the file as it is meant.
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0\n1 0 0\n1 1 0\n0 1 0\n4 3 2 1 0\n"), "line 3: a vertex has 3 coordinates, not 2");
  EXPECT_EQ(error_in("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1\n4 3 2 1 0\n"), "line 6: a vertex has 3 coordinates, not 2");
  EXPECT_EQ(error_in("OFF\n4 1\n0.5 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 9\n"),
            "line 7: vertex index 9 is out of range, there are 4 vertices");
  // The same holds for colors of vertices, which the first word does not tell of.
  const std::string colored = "0 0 0 9 0 0\n1 0 0 9 0 0\n1 1 0 9 0 0\n";
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + colored + "0 x 0 9 0 0\n4 0 1 2 3\n"), "line 6: 'x' is not a number");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + colored + "0 1 0 9 0\n4 0 1 2 3\n"), "line 6: a vertex has 3 coordinates, not 5");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + colored + "0 1 0 9 0 0\n4 0 1 2 4\n"),
            "line 7: vertex index 4 is out of range, there are 4 vertices");
}

TEST(ReadOffErrors, names_the_line_that_is_at_fault_in_a_file_of_free_line_breaks) {
  EXPECT_EQ(error_in("OFF 4 2 0\n0 0 0 1 0 0\n1 1 0 0 x 0\n3 0 1 2 3 3 2 1\n"), "line 3: 'x' is not a number");
  EXPECT_EQ(error_in("OFF 4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2 3 3 2 4\n"),
            "line 4: vertex index 4 is out of range, there are 4 vertices");
  EXPECT_EQ(error_in("OFF\n4\n2\n0\n0 0 0 1 0\n0 1 1 0 0 1\n0 3 0\n1 2 3 3 2\nx\n"), "line 9: 'x' is not an integer");
  EXPECT_EQ(error_in("OFF 4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2 3 3 2\n"),
            "line 4: a face of 3 corners has only 2 numbers");
  EXPECT_EQ(error_in("OFF 4 2 0\n0 0 0 1 0 0\n1 1 0 0 1\n"), "line 3: the file ends within a vertex");
  EXPECT_EQ(error_in("OFF 4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2 3 3 2 1 3 0 1 2 3 3 2 1\n"),
            "line 4: something follows the last face");
  EXPECT_EQ(error_in("OFF\n4 3 0\n" + square + "3 0 1 2 3 0 1 2\n3 0 1 x\n"), "line 8: 'x' is not an integer");
  EXPECT_EQ(error_in("OFF\n4 5 0\n" + square + "3 0 1 2 3 0 1 2 3 0 1 2\n3 0 1 2\n3 0 1 x\n"),
            "line 9: 'x' is not an integer");
  EXPECT_EQ(error_in("OFF 4 2 0 0 0 0 1 0 0 1 1 0 0 x 0 3 0 1 2 3 3 2 1"), "line 1: 'x' is not a number");
  EXPECT_EQ(error_in("COFF 3 1 0\n0 0 0 1 0\n0 1 4 0 0\n1 0 0 1\n0 4 0 1 x 0 1\n3 0 1 2\n"),
            "line 5: 'x' is not a number");
}

/// A cube whose faces begin with its last corners, so that a shifted number may well be a face's count.
const std::string cube =
    "OFF\n8 6 12\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n0 0 4\n4 0 4\n4 4 4\n0 4 4\n4 3 2 1 0\n4 4 5 6 7\n4 5 4 0 1\n4 6 5 1 2\n"
    "4 7 6 2 3\n4 4 7 3 0\n";

TEST(ReadOffErrors, makes_an_error_of_a_word_too_few_or_too_many_in_a_file_of_lines) {
  ASSERT_EQ(read_off<float>(cube).triangles.size(), 12u);
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < cube.size(); at = cube.find('\n', at) + 1) {
    lines.push_back(cube.substr(at, cube.find('\n', at) - at));
  }
  for (std::size_t changed = 2; changed < lines.size(); ++changed) {
    std::vector<std::string_view> words;
    example::split(lines[changed], words);
    const bool is_face = words.size() == 5;
    for (std::size_t gone = is_face ? 1 : 0; gone < words.size(); ++gone) {
      std::string text;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i != changed) text += lines[i];
        for (std::size_t word = 0; i == changed && word < words.size(); ++word) {
          if (word != gone) text += std::string(words[word]) + " ";
        }
        text += "\n";
      }
      EXPECT_EQ(error_in(text),
                "line " + std::to_string(changed + 1) +
                    (is_face ? ": a face of 4 corners has only 3 numbers" : ": a vertex has 3 coordinates, not 2"));
    }
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) text += lines[i] + (i == changed ? " 3 3\n" : "\n");
    EXPECT_EQ(error_in(text), "line " + std::to_string(changed + 1) +
                                  (is_face ? ": a face is followed by 2 numbers in its line, but a color has 1, 3 or 4"
                                           : ": a vertex has 3 coordinates, not 5"));
  }
}

TEST(ReadOffErrors, takes_no_memory_on_the_word_of_a_header) {
  EXPECT_EQ(error_in("OFF\n9223372036854775807 9223372036854775807 0\n0 0 0\n"),
            "line 3: the file ends before vertex 1");
  EXPECT_EQ(error_in("OFF\n0 9223372036854775807 0\n"), "line 2: the file ends before face 0");
  EXPECT_EQ(error_in("OFF\n4 1 0\n" + square + "9223372036854775807 0 1 2 3\n"),
            "line 7: a face of 9223372036854775807 corners has only 4 numbers");
}

TEST(ReadOffErrors, makes_an_error_or_a_mesh_of_any_bytes) {
  expect_error_or_sound_mesh("OFF # square\n4 2 5\n" + square + "4 0 1 2 3\n3 0 1 2 0.5 0.5 0.5\n", read_off<float>);
  expect_error_or_sound_mesh("4 2\r0 0 0 1 0 0\r1 0 0 1 0 0\r1 1 0 1 0 0\r0 1 0 1 0 0\r\n3 0 1 2 3 0 1 2\r\n\x1a",
                             read_off<double>);
  expect_error_or_sound_mesh("coff 4 2 0 0 0 0 1 0 0 1 1\n0 0 1 0 0 1 1 1 0 1 0 0 1 0 1\n0 1 0 0 1 3 0 1 2 3 3 2 1",
                             read_off<float>);
  expect_error_or_sound_mesh(text_of(placed(wall_plane, keyholed_wall)), read_off<float>);
}

}  // namespace
}  // namespace surehit::test::read_off_errors_test
