#include "file/checksum.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace surehit::test::checksum_test {
namespace {

std::uint64_t checksum_of(std::string_view text, std::size_t piece = 1000) {
  detail::Checksum sum;
  for (std::size_t at = 0; at < text.size(); at += piece) sum.add(std::as_bytes(std::span(text.substr(at, piece))));
  return sum.value();
}

/// Those that the author of XXH64 and others have published.
TEST(Checksum, is_the_published_one) {
  EXPECT_EQ(checksum_of(""), 0xef46db3751d8e999);
  EXPECT_EQ(checksum_of("a"), 0xd24ec4f1a98c6e5b);
  EXPECT_EQ(checksum_of("abc"), 0x44bc2cf5ad770999);
  EXPECT_EQ(checksum_of("Nobody inspects the spammish repetition"), 0xfbcea83c8a378bf1);
}

TEST(Checksum, does_not_depend_on_the_pieces) {
  std::string text;
  for (std::size_t i = 0; i < 200; ++i) {
    for (std::size_t piece = 1; piece < 70; ++piece) {
      ASSERT_EQ(checksum_of(text, piece), checksum_of(text)) << i << ", " << piece;
    }
    text += static_cast<char>(i * i);
  }
}

}  // namespace
}  // namespace surehit::test::checksum_test
