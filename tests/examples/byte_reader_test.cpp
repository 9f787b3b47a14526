#include "mesh_io/byte_reader.hpp"

#include <gtest/gtest.h>

#include "error_of.hpp"

namespace surehit::test::byte_reader_test {
namespace {

using example::ByteReader;
using namespace std::string_view_literals;

TEST(ByteReader, takes_numbers_in_either_order_of_bytes) {
  ByteReader little("\x01\x02\x03\x04\x00\x00\x80\x3f"sv, std::endian::little);
  EXPECT_EQ(little.take<std::uint32_t>(), 0x04030201u);
  EXPECT_EQ(little.take<float>(), 1.0f);
  ByteReader big("\x01\x02\x03\x04\x3f\x80\x00\x00"sv, std::endian::big);
  EXPECT_EQ(big.take<std::uint32_t>(), 0x01020304u);
  EXPECT_EQ(big.take<float>(), 1.0f);
}

TEST(ByteReader, keeps_track_of_the_rest) {
  ByteReader reader("abcdef"sv, std::endian::little);
  reader.skip(2);
  EXPECT_EQ(reader.take<char>(), 'c');
  EXPECT_EQ(reader.rest(), "def");
}

TEST(ByteReader, refuses_to_read_beyond_the_end) {
  ByteReader reader("abc"sv, std::endian::little);
  EXPECT_EQ(error_of([&] { return reader.take<float>(); }), "the file ends too early");
  EXPECT_EQ(error_of([&] { return reader.skip(4), 0; }), "the file ends too early");
  EXPECT_EQ(error_of([&] { return reader.skip(~std::uint64_t{0}), 0; }), "the file ends too early");
  EXPECT_EQ(reader.rest(), "abc");
}

}  // namespace
}  // namespace surehit::test::byte_reader_test
