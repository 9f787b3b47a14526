#include "visibility_bake/cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "examples/temporary_folder.hpp"
#include "mesh_io/input_error.hpp"
#include "small_level.hpp"

namespace surehit::example::cells_test {
namespace {

bool has(const std::vector<Vector3f>& floors, const Vector3f& floor) {
  return std::ranges::find(floors, floor) != floors.end();
}

TEST(Cells, are_in_the_middle_of_squares) {
  const Mesh<float> mesh = test::level_with_a_door();
  const auto floors = find_floors(Colliderf(mesh.view()), {.spacing = 1});
  ASSERT_GE(floors.size(), 32u);
  EXPECT_TRUE(has(floors, {0.5f, 0.5f, 0}));
  EXPECT_TRUE(has(floors, {7.5f, 3.5f, 0}));
  EXPECT_FALSE(has(floors, {0.5f, 0.5f, -1})) << "faces downwards";
}

TEST(Cells, have_headroom_and_are_not_inside_of_solids) {
  SolidBuilder builder(1);
  builder.add_box({0, 0, -1}, {4, 4, 0});
  builder.add_box({1, 1, 1.5f}, {2, 2, 5});       // hangs low
  builder.add_box({2, 2, 2}, {3, 3, 5});          // hangs high
  builder.add_box({0, 0, -0.5f}, {1, 1, 0.25f});  // begins in the floor
  builder.add_box({3, 3, -0.5f}, {4, 4, 5});      // is so high that one could stand in it
  const Mesh<float> mesh = builder.take();
  const auto floors = find_floors(Colliderf(mesh.view()), {.spacing = 1, .headroom = 1.8f});
  EXPECT_FALSE(has(floors, {1.5f, 1.5f, 0}));
  EXPECT_TRUE(has(floors, {1.5f, 1.5f, 5})) << "its top";
  EXPECT_TRUE(has(floors, {2.5f, 2.5f, 0}));
  EXPECT_TRUE(has(floors, {0.5f, 0.5f, 0.25f}));
  EXPECT_FALSE(has(floors, {0.5f, 0.5f, 0}));
  EXPECT_TRUE(has(floors, {3.5f, 0.5f, 0}));
  EXPECT_TRUE(has(floors, {3.5f, 3.5f, 5}));
  EXPECT_FALSE(has(floors, {3.5f, 3.5f, 0}));
}

TEST(Cells, are_not_on_steep_ground) {
  SolidBuilder builder(1);
  builder.add_parallelogram({0, 0, 0}, {4, 0, 0}, {0, 4, 8});
  builder.add_parallelogram({4, 0, 0}, {4, 0, 0}, {0, 4, 2});
  const Mesh<float> mesh = builder.take();
  const auto floors = find_floors(Colliderf(mesh.view()), {.spacing = 1});
  EXPECT_EQ(floors.size(), 16u);
  EXPECT_TRUE(std::ranges::all_of(floors, [](const Vector3f& floor) { return floor.x() > 4; }));
}

TEST(Cells, are_reached_by_walking) {
  const Mesh<float> mesh = test::level_with_a_door();
  const Colliderf collider(mesh.view());
  const WalkOptions options{.spacing = 1};
  const auto floors = find_floors(collider, options);
  const auto reached = reachable_floors(collider, floors, {0.4f, 0.4f, 0}, options);
  EXPECT_EQ(reached.size(), 32u) << "through the door to the other room, and not to the top of the wall";
  SolidBuilder builder(1);
  builder.add_box({0, 0, -1}, {8, 4, 0});
  builder.add_box({3.9f, 0, 0}, {4.1f, 4, 3});
  const Mesh<float> closed = builder.take();
  EXPECT_EQ(reachable_floors(Colliderf(closed.view()), floors, {0.4f, 0.4f, 0}, options).size(), 16u);
  EXPECT_TRUE(reachable_floors(collider, floors, {100, 0, 0}, options).empty());
}

TEST(Cells, climb_what_is_not_too_steep) {
  SolidBuilder builder(1);
  for (int i = 0; i < 4; ++i) {
    const auto x = static_cast<float>(i);
    builder.add_box({x, 0, -1}, {x + 1, 1, 0.75f * x});
  }
  builder.add_box({4, 0, -1}, {5, 1, 6});
  const Mesh<float> mesh = builder.take();
  const Colliderf collider(mesh.view());
  const WalkOptions options{.spacing = 1, .max_slope = 0.75f};
  const auto floors = find_floors(collider, options);
  ASSERT_EQ(floors.size(), 5u);
  EXPECT_EQ(reachable_floors(collider, floors, {0.5f, 0.5f, 0}, options).size(), 4u);
  EXPECT_EQ(reachable_floors(collider, floors, {0.5f, 0.5f, 0}, {.spacing = 1, .max_slope = 0.5f}).size(), 1u);
}

TEST(Cells, are_read_from_a_file) {
  const test::TemporaryFolder folder;
  const auto places = read_places(folder.write("places.txt", "# x y z\n1 2 3\n\n-1e2 0x1p-3 4 # a comment\n"));
  EXPECT_EQ(places, (std::vector<Vector3f>{{1, 2, 3}, {-100, 0.125f, 4}}));
  const auto error_of = [&](const std::string& text) -> std::string {
    try {
      static_cast<void>(read_places(folder.write("bad.txt", text)));
    } catch (const InputError& error) {
      const std::string all = error.what();
      return all.substr(all.find("bad.txt"));
    }
    return "";
  };
  EXPECT_EQ(error_of("1 2 3\n4 5\n"), "bad.txt: line 2: a place has 3 coordinates, not 2");
  EXPECT_EQ(error_of("1 2 nan\n"), "bad.txt: line 1: 'nan' is not a number");
  EXPECT_THROW(static_cast<void>(read_places(folder.at("absent"))), InputError);
}

TEST(Cells, of_nothing_are_none) {
  EXPECT_TRUE(find_floors(Colliderf(), {}).empty());
  EXPECT_TRUE(reachable_floors(Colliderf(), {}, {0, 0, 0}, {}).empty());
  const Mesh<float> mesh = test::level_with_a_door();
  EXPECT_THROW(static_cast<void>(find_floors(Colliderf(mesh.view()), {.spacing = 1e-4f})), InputError);
}

}  // namespace
}  // namespace surehit::example::cells_test
