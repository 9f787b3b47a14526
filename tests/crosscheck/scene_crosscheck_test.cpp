#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cgal_oracle.hpp"
#include "support/case_count.hpp"
#include "support/pair_families.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"
#include "support/scene_text.hpp"

namespace surehit::test::scene_crosscheck_test {
namespace {

/// Whether a path meets any triangle, by CGAL's exact kernel.
template <typename Scalar>
bool cgal_meets_any(const DrawnScene<Scalar>& drawn, const Path<Scalar>& path, const QueryOptions<Scalar>& options) {
  for (const auto& [index, placement] : drawn.instances) {
    const DrawnMesh& mesh = drawn.meshes[index];
    if (placement.mask == 0) continue;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!mesh.masks.empty() && mesh.masks[i] == 0) continue;
      if (cgal_meets_placed(path, mesh.view().triangle(i), placement.pose, placement.motion, options)) return true;
    }
  }
  return false;
}

template <typename Scalar>
SceneQueryOptions<Scalar> of_scene(const QueryOptions<Scalar>& options) {
  return {.min_t = options.min_t,
          .max_t = options.max_t,
          .culling = options.culling,
          .ignore_start_contact = options.ignore_start_contact,
          .ignore_end_contact = options.ignore_end_contact};
}

class SceneCrosscheck : public testing::TestWithParam<SceneFamily> {};

template <typename Scalar>
void check(SceneFamily family) {
  Random random(20261126 + static_cast<std::uint64_t>(family));
  for (std::size_t i = case_count(40); i > 0; --i) {
    const DrawnScene<Scalar> drawn = draw_scene<Scalar>(family, random);
    const JudgedScene<Scalar> judged(drawn);
    ScenePathDrawer<Scalar> drawer(drawn, judged.oracle, judged.ids, random);
    for (int paths = 0; paths < 6; ++paths) {
      const Path<Scalar> path = drawer.draw();
      QueryOptions<Scalar> options;
      const auto hits = judged.oracle.all_hits(path);
      if (!hits.empty() && random.one_in(2)) options = draw_options(random, hits.front().t);
      const bool meets = cgal_meets_any(drawn, path, options);
      ASSERT_EQ(judged.scene.any_hit(path, of_scene(options)), meets) << hex_text(path) << hex_text(options);
      ASSERT_EQ(!judged.oracle.all_hits(path, of_scene(options)).empty(), meets) << hex_text(path) << hex_text(options);
    }
  }
}

TEST_P(SceneCrosscheck, of_float_scenes) { check<float>(GetParam()); }
TEST_P(SceneCrosscheck, of_double_scenes) { check<double>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Families, SceneCrosscheck, testing::ValuesIn(all_scene_families),
                         [](const auto& family) { return name_of(family.param); });

}  // namespace
}  // namespace surehit::test::scene_crosscheck_test
