#include "textbook_page.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace surehit::test::textbook_page_test {
namespace {

const std::map<std::string, std::string> blocks = {{"one", "| 1 |\n"}, {"two", "| 2 |\n"}};

TEST(TextbookPage, has_each_block_between_its_markers) {
  const std::string page =
      "a\n\n<!-- textbook: two -->\nold\n<!-- end -->\n\nb <!-- figures: one -->1<!-- end -->\n"
      "<!-- textbook: one --><!-- end -->";
  const std::string renewed =
      "a\n\n<!-- textbook: two -->\n\n| 2 |\n\n<!-- end -->\n\nb <!-- figures: one -->1"
      "<!-- end -->\n<!-- textbook: one -->\n\n| 1 |\n\n<!-- end -->";
  EXPECT_EQ(with_textbook_blocks(page, blocks), renewed);
  EXPECT_EQ(with_textbook_blocks(renewed, blocks), renewed);
}

TEST(TextbookPage, is_refused_if_its_markers_are_wrong) {
  EXPECT_THROW((void)with_textbook_blocks("none", blocks), std::runtime_error);
  EXPECT_THROW((void)with_textbook_blocks("<!-- textbook: three -->\n<!-- end -->", blocks), std::runtime_error);
  EXPECT_THROW((void)with_textbook_blocks("<!-- textbook: one -->\n", blocks), std::runtime_error);
  EXPECT_THROW((void)with_textbook_blocks("<!-- textbook: one <!-- end -->\n -->", blocks), std::runtime_error);
}

}  // namespace
}  // namespace surehit::test::textbook_page_test
