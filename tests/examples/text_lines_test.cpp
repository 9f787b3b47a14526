#include "mesh_io/text_lines.hpp"

#include <gtest/gtest.h>

#include <string>

#include "error_of.hpp"
#include "with_line_ends.hpp"

namespace surehit::test::text_lines_test {
namespace {

using example::TextLines;
using Fields = std::vector<std::string_view>;

Fields lines_of(std::string_view text) {
  Fields found;
  for (TextLines lines(text); lines.next();) found.push_back(lines.line());
  return found;
}

/// What ends each line.
Fields ends_of(std::string_view text) {
  Fields found;
  for (TextLines lines(text); lines.next();) found.push_back(lines.line_end());
  return found;
}

TEST(TextLines, end_in_any_way_and_the_last_one_in_none) {
  TextLines lines("one\r\n\ntwo\rthree");
  for (const char* expected : {"one", "", "two", "three"}) {
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), expected);
  }
  EXPECT_EQ(lines.number(), 4u);
  EXPECT_FALSE(lines.next());
  EXPECT_EQ(lines.number(), 4u);
  EXPECT_EQ(lines.line(), "three");
}

TEST(TextLines, are_the_same_with_each_end) {
  const Fields expected = {"one", "", "", "two", "three"};
  for (const std::string_view end : line_ends) {
    EXPECT_EQ(lines_of(with_line_ends("one\n\n\ntwo\nthree\n", end)), expected);
    EXPECT_EQ(lines_of(with_line_ends("one\n\n\ntwo\nthree", end)), expected);
  }
  EXPECT_EQ(lines_of(with_mixed_line_ends("one\n\n\ntwo\nthree\n")), expected);
}

TEST(TextLines, take_a_return_and_a_line_feed_for_one_end_in_this_order_alone) {
  EXPECT_EQ(ends_of("a\r\nb\n\rc\r\r\nd"), (Fields{"\r\n", "\n", "\r", "\r", "\r\n", ""}));
  EXPECT_EQ(lines_of("a\r\nb\n\rc\r\r\nd"), (Fields{"a", "b", "", "c", "", "d"}));
  EXPECT_EQ(ends_of("\r"), Fields{"\r"});
  EXPECT_EQ(lines_of("\r"), Fields{""});
}

TEST(TextLines, are_not_made_up_by_a_last_line_end) {
  for (const std::string_view end : line_ends) EXPECT_EQ(lines_of("one" + std::string(end)), Fields{"one"});
  EXPECT_EQ(lines_of(""), Fields{});
}

TEST(TextLines, pass_over_a_byte_order_mark) {
  EXPECT_EQ(lines_of("\xef\xbb\xbfone"), Fields{"one"});
  EXPECT_EQ(lines_of("\xef\xbb\xbf"), Fields{});
  EXPECT_EQ(lines_of("one\xef\xbb\xbf"), Fields{"one\xef\xbb\xbf"});
}

TEST(TextLines, end_before_a_closing_control_z) {
  for (const std::string_view closing : closing_control_z) {
    const std::string text = "one\ntwo" + std::string(closing);
    Fields fields;
    std::size_t blank_lines = 0;
    for (const std::string_view line : lines_of(text)) {
      Fields of_line;
      example::split(line, of_line);
      fields.insert(fields.end(), of_line.begin(), of_line.end());
      blank_lines += of_line.empty() ? 1 : 0;
    }
    EXPECT_EQ(fields, (Fields{"one", "two"})) << testing::PrintToString(closing);
    EXPECT_EQ(blank_lines, 0u) << testing::PrintToString(closing);
  }
  EXPECT_EQ(lines_of("\x1a"), Fields{});
  EXPECT_EQ(lines_of("\xef\xbb\xbf\x1a\n"), Fields{});
}

TEST(TextLines, keep_a_control_z_that_something_follows) {
  EXPECT_EQ(lines_of("one\x1a\ntwo"), (Fields{"one\x1a", "two"}));
  EXPECT_EQ(lines_of("\x1aone\n\x1a"), Fields{"\x1aone"});
  using namespace std::string_view_literals;
  EXPECT_EQ(lines_of("one\n\x1a\0"sv), (Fields{"one", "\x1a\0"sv}));
}

TEST(TextLines, tell_what_follows_the_line) {
  TextLines lines("header\nbytes\nand more\x1a\n");
  EXPECT_TRUE(lines.next());
  EXPECT_EQ(lines.rest(), "bytes\nand more\x1a\n");
  for (const std::string_view end : line_ends) {
    const std::string text = "header" + std::string(end) + "\x1a\x1a";
    TextLines before_bytes(text);
    EXPECT_TRUE(before_bytes.next());
    EXPECT_EQ(before_bytes.rest(), "\x1a\x1a");
    EXPECT_FALSE(before_bytes.next());
    EXPECT_EQ(before_bytes.line_end(), end);
  }
}

TEST(TextLines, are_named_in_errors) {
  const auto read_to_the_end = [](TextLines& lines) -> int {
    while (lines.next()) continue;
    throw example::InputError("something is wrong");
  };
  const auto error_at_the_end = [&](const std::string& text) {
    TextLines lines(text);
    return error_of([&] { return naming_the_line(lines, [&] { return read_to_the_end(lines); }); });
  };
  for (const std::string_view end : line_ends) {
    EXPECT_EQ(error_at_the_end(with_line_ends("one\n\ntwo", end)), "line 3: something is wrong");
  }
  EXPECT_EQ(error_at_the_end(with_mixed_line_ends("a\nb\nc\nd\ne\nf")), "line 6: something is wrong");
  EXPECT_EQ(error_at_the_end(""), "something is wrong");
}

TEST(Split, takes_any_white_space) {
  Fields fields = {"from before"};
  example::split(" \t one\vtwo  three\r", fields);
  EXPECT_EQ(fields, (Fields{"one", "two", "three"}));
  example::split("  ", fields);
  EXPECT_EQ(fields, Fields{});
}

TEST(WithoutComment, cuts_at_the_first_hash_that_begins_a_word) {
  EXPECT_EQ(example::without_comment("1 2 # 3 # 4"), "1 2 ");
  EXPECT_EQ(example::without_comment("1 2\t#3"), "1 2\t");
  EXPECT_EQ(example::without_comment("1 2 ##"), "1 2 ");
  EXPECT_EQ(example::without_comment("1 2"), "1 2");
  EXPECT_EQ(example::without_comment("#"), "");
  EXPECT_EQ(example::without_comment("#1 2"), "");
  EXPECT_EQ(example::without_comment(""), "");
}

TEST(WithoutComment, keeps_a_hash_inside_a_word) {
  EXPECT_EQ(example::without_comment("1.#QNAN 2"), "1.#QNAN 2");
  EXPECT_EQ(example::without_comment("-1.#IND00 2#3 # 1.#INF"), "-1.#IND00 2#3 ");
  EXPECT_EQ(example::without_comment("a##b #"), "a##b ");
}

}  // namespace
}  // namespace surehit::test::text_lines_test
