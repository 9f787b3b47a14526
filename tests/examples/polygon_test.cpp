#include "mesh_io/polygon.hpp"

#include <gtest/gtest.h>

#include "error_of.hpp"

namespace surehit::test {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

TEST(Polygon, BecomesAFanAroundItsFirstCorner) {
  Triangles triangles = {{0, 1, 2}};
  example::append_fan({7, 8, 9, 5, 6}, triangles);
  EXPECT_EQ(triangles, (Triangles{{0, 1, 2}, {7, 8, 9}, {7, 9, 5}, {7, 5, 6}}));
}

TEST(Polygon, NeedsThreeCorners) {
  Triangles triangles;
  EXPECT_EQ(error_of([&] {
              return example::append_fan({4, 5}, triangles), 0;
            }),
            "a face needs 3 corners or more, not 2");
  EXPECT_EQ(error_of([&] { return example::append_fan({}, triangles), 0; }), "a face needs 3 corners or more, not 0");
  EXPECT_TRUE(triangles.empty());
}

TEST(Polygon, ChecksItsCornersAgainstTheVertices) {
  EXPECT_EQ(example::checked_corner(7, 8), 7u);
  EXPECT_EQ(example::checked_corner(0xffffffff, std::uint64_t{1} << 33), 0xffffffffu);
  EXPECT_EQ(error_of([] { return example::checked_corner(8, 8); }),
            "vertex index 8 is out of range, there are 8 vertices");
  EXPECT_EQ(error_of([] { return example::checked_corner(-1, 8); }),
            "vertex index -1 is out of range, there are 8 vertices");
  EXPECT_EQ(error_of([] { return example::checked_corner(0x100000000, std::uint64_t{1} << 33); }),
            "a vertex index is beyond 32 bits");
}

}  // namespace
}  // namespace surehit::test
