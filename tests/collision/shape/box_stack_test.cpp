#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "collision/painted_stack.hpp"
#include "support/box_families.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

#if defined(SUREHIT_TEST_PROMISES_STACK)

namespace surehit::test {
namespace {

template <typename Scalar>
constexpr std::size_t promised_bytes = (sizeof(Scalar) == 4 ? 32 : 256) * 1024;

template <typename Scalar>
class BoxStack : public testing::Test {};
TYPED_TEST_SUITE(BoxStack, Scalars, ScalarNames);

TYPED_TEST(BoxStack, of_all_queries_in_all_families) {
  using Scalar = TypeParam;
  PaintedStack stack;
  std::size_t deepest = 0;
  for (const BoxFamily family : all_box_families) {
    Random random(41 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(10); ++i) {
      const auto [box, triangle] = draw_box_pair<Scalar>(family, random);
      GeneratedMesh<Scalar> mesh;
      mesh.add(triangle);
      mesh.add({triangle.b, triangle.c, triangle.a});  // A tie.
      const Collider<Scalar> collider(mesh.view());
      std::vector<ShapeHit<Scalar>> hits(1);
      const auto measure = [&](const auto& call) {
        deepest = std::max(deepest, stack.bytes_used_by(call));
        ASSERT_LT(deepest, promised_bytes<Scalar>) << name_of(family) << ", case " << i;
      };
      measure([&] { static_cast<void>(intersect(box, triangle, {.max_t = Scalar(0.5), .culling = Culling::back})); });
      measure([&] { static_cast<void>(collider.first_hit(box)); });
      measure([&] { static_cast<void>(collider.any_hit(box, {.max_t = Scalar(0.5)})); });
      measure([&] { collider.first_hits(std::span{&box, 1}, hits); });
      measure([&] { collider.all_hits(box, hits); });
      if (hits.empty()) continue;
      measure([&] { static_cast<void>(collider.last_free_t(box, hits.front())); });
      measure([&] { static_cast<void>(collider.last_free_point(box, hits.front())); });
    }
  }
  testing::Test::RecordProperty("bytes", static_cast<int>(deepest));
  // The longest integers are among the cases.
  EXPECT_GT(deepest, promised_bytes<Scalar> / 4);
}

}  // namespace
}  // namespace surehit::test

#endif
