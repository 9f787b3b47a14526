#include "visibility_bake/visible_sets.hpp"

#include <gtest/gtest.h>

#include "mesh_io/input_error.hpp"
#include "visibility_bake/bake_picture.hpp"

namespace surehit::example::visible_sets_test {
namespace {

class VisibleSetsTest : public testing::Test {
 protected:
  const std::vector<Vector3f> floors_ = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0.25f},
                                         {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {3, 1, 0}, {4, 1, 0}};
  const PairPlan plan_{Colliderf(), floors_, {.range = 9, .samples = 3}};
  Visibility visibility_{10};

  void SetUp() override {
    visibility_.add({0, {1, 9}, {1, 0}});
    visibility_.add({8, {2, 9}, {3, 2}});
  }
};

TEST_F(VisibleSetsTest, come_back_from_the_file) {
  const VisibleSets sets = decode_visible_sets(encode_visible_sets(plan_, visibility_));
  EXPECT_EQ(sets.floors, floors_);
  EXPECT_EQ(sets.range, 9);
  EXPECT_EQ(sets.samples, 3u);
  for (std::uint32_t a = 0; a < 10; ++a) {
    for (std::uint32_t b = 0; b < 10; ++b) EXPECT_EQ(sets.sees(a, b), visibility_.sees(a, b)) << a << ' ' << b;
  }
  EXPECT_TRUE(sets.sees(9, 8));
  EXPECT_FALSE(sets.sees(9, 0));
}

TEST_F(VisibleSetsTest, are_refused_if_the_file_is_damaged) {
  const std::string file = encode_visible_sets(plan_, visibility_);
  for (std::size_t i = 0; i < file.size(); ++i) {
    std::string damaged = file;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    EXPECT_THROW(static_cast<void>(decode_visible_sets(damaged)), InputError) << i;
    EXPECT_THROW(static_cast<void>(decode_visible_sets(file.substr(0, i))), InputError) << i;
  }
}

TEST_F(VisibleSetsTest, figures_are_a_table) {
  const std::string csv = figures_csv(plan_, visibility_);
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "cell,x,y,z,cells_in_range,cells_seen,segments,clear_segments");
  EXPECT_NE(csv.find("\n4,4,0,0.25,0,0,0,0\n"), std::string::npos);
  EXPECT_NE(csv.find("\n8,3,1,0,2,2,6,5\n"), std::string::npos);
}

TEST_F(VisibleSetsTest, picture_shows_the_set_of_a_cell) {
  const Canvas of_0 = draw_bake(plan_, visibility_, 0);
  const Canvas of_8 = draw_bake(plan_, visibility_, 8);
  const auto lit = [](const Canvas& canvas) {
    std::size_t pixels = 0;
    for (int y = 0; y < canvas.height() - 44; ++y) {
      for (int x = canvas.width() / 2; x < canvas.width(); ++x) {
        const Colour& colour = canvas.at(x, y);
        pixels += colour.red > 0.95f && colour.green > 0.8f && colour.green < 0.9f;
      }
    }
    return static_cast<double>(pixels);
  };
  EXPECT_NEAR(lit(of_8) / lit(of_0), 1.5, 0.05) << "three cells beside two";
}

}  // namespace
}  // namespace surehit::example::visible_sets_test
