#include "cgal_oracle.hpp"

#include <gtest/gtest.h>

#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test::cgal_oracle_test {
namespace {

/// The start is a corner. Compiled for SSE4.1, CGAL is certain that there is no contact; a fuzzer found that.
TEST(CgalOracle, is_right_where_products_overflow) {
  const Vector3<double> corner = {-0x1.fffffffffffffp+1017, 0x1.3c6955c5d35f3p-1006, -0x1.c8fd2fab28cp-389};
  const Segment<double> segment = {corner, {0x1.67178ff2832p-1002, 0x1.ba90e6b1ed6p-1005, 0x0.00000000038ffp-1022}};
  const Triangle<double> triangle = {
      {-0x1.fffffffffffffp+1023, -0x1.2a35d4b8074p-1006, -0x1.c8fd2fab28cp-389},
      {-0x0.0000000001fp-1022, 0x1.2575fc55e9cp-1006, 0x1.c8fd2bb92c4p-389},
      corner,
  };
  EXPECT_TRUE(cgal_meets<double>(segment, triangle, {}));
}

}  // namespace
}  // namespace surehit::test::cgal_oracle_test
