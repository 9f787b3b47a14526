#include "render/cost_picture.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "render/id_picture.hpp"
#include "render/shaded_picture.hpp"

namespace surehit::example::cost_picture_test {
namespace {

constexpr int width = 60;
constexpr int height = 40;

class CostPicture : public testing::Test {
 protected:
  const Stage stage = exercise_stage();
  const World world{stage.model, Culling::none};
  const Camera camera = camera_of(stage, width, height);
  RayCounts counts;

  [[nodiscard]] QueryStatistics all() const {
    QueryStatistics sum;
    for (int j = 0; j < height; ++j) {
      for (int i = 0; i < width; ++i) {
        static_cast<void>(world.collider().first_hit(camera.ray(i, j), {}, &sum));
      }
    }
    return sum;
  }
  [[nodiscard]] std::uint64_t sum_of(Cost cost) {
    const auto costs = costs_of(world.collider(), camera, Culling::none, cost, 2, counts);
    EXPECT_EQ(costs.size(), std::size_t{width * height});
    return std::accumulate(costs.begin(), costs.end(), std::uint64_t{0});
  }
};

TEST_F(CostPicture, counts_the_work_of_each_ray) {
  const QueryStatistics sum = all();
  EXPECT_EQ(sum_of(Cost::cells), sum.cells);
  EXPECT_EQ(sum_of(Cost::candidates), sum.candidates);
  EXPECT_EQ(sum_of(Cost::exact_decisions), sum.exact_decisions);
  EXPECT_EQ(counts.rays(RayKind::primary), std::size_t{3 * width * height});
}

TEST_F(CostPicture, more_work_is_brighter) {
  std::vector<std::uint64_t> costs(width * height);
  for (std::size_t i = 0; i < costs.size(); ++i) costs[i] = i % width;
  const Canvas canvas = draw_costs(costs, width, height, "cells");
  EXPECT_GT(canvas.height(), height) << "there is a legend";
  for (int x = 1; x < width; ++x) {
    const auto light = [&](int column) {
      const Colour& colour = canvas.at(column, 20);
      return 0.3f * colour.red + 0.6f * colour.green + 0.1f * colour.blue;
    };
    EXPECT_GT(light(x), light(x - 1)) << x;
  }
}

TEST_F(CostPicture, ids_have_colours_of_their_own) {
  const Canvas canvas = draw_ids(world, camera, 2, counts);
  std::size_t hits = 0;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const auto hit = world.collider().first_hit(camera.ray(i, j));
      if (!hit) continue;
      ++hits;
      EXPECT_EQ(canvas.at(i, j).red, colour_of_id(hit->triangle).red);
      EXPECT_EQ(canvas.at(i, j).blue, colour_of_id(hit->triangle).blue);
    }
  }
  EXPECT_GT(hits, std::size_t{width * height / 2});
  EXPECT_NE(colour_of_id(0).red, colour_of_id(1).red);
}

}  // namespace
}  // namespace surehit::example::cost_picture_test
