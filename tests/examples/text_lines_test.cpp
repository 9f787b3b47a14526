#include "mesh_io/text_lines.hpp"

#include <gtest/gtest.h>

#include "error_of.hpp"

namespace surehit::test {
namespace {

using example::TextLines;
using Fields = std::vector<std::string_view>;

TEST(TextLines, EndInEitherWayAndTheLastOneInNone) {
  TextLines lines("one\r\n\ntwo\nthree");
  for (const char* expected : {"one", "", "two", "three"}) {
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), expected);
  }
  EXPECT_EQ(lines.number(), 4u);
  EXPECT_FALSE(lines.next());
  EXPECT_EQ(lines.number(), 4u);
}

TEST(TextLines, AreNotMadeUpByALastLineEnd) {
  TextLines lines("one\n");
  EXPECT_TRUE(lines.next());
  EXPECT_FALSE(lines.next());
  EXPECT_FALSE(TextLines("").next());
}

TEST(TextLines, PassOverAByteOrderMark) {
  TextLines lines("\xef\xbb\xbfone");
  EXPECT_TRUE(lines.next());
  EXPECT_EQ(lines.line(), "one");
}

TEST(TextLines, TellWhatFollowsTheLine) {
  TextLines lines("header\nbytes\nand more");
  EXPECT_TRUE(lines.next());
  EXPECT_EQ(lines.rest(), "bytes\nand more");
}

TEST(TextLines, AreNamedInErrors) {
  TextLines lines("one\ntwo");
  const auto read_to_the_end = [&]() -> int {
    while (lines.next()) continue;
    throw example::InputError("something is wrong");
  };
  EXPECT_EQ(error_of([&] { return naming_the_line(lines, read_to_the_end); }), "line 2: something is wrong");
}

TEST(Split, TakesAnyWhiteSpace) {
  Fields fields = {"from before"};
  example::split(" \t one\vtwo  three\r", fields);
  EXPECT_EQ(fields, (Fields{"one", "two", "three"}));
  example::split("  ", fields);
  EXPECT_EQ(fields, Fields{});
}

TEST(WithoutComment, CutsAtTheFirstHash) {
  EXPECT_EQ(example::without_comment("1 2 # 3 # 4"), "1 2 ");
  EXPECT_EQ(example::without_comment("1 2"), "1 2");
  EXPECT_EQ(example::without_comment("#"), "");
}

}  // namespace
}  // namespace surehit::test
