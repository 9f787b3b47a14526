#include "surehit_query/read_scene.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "error_of.hpp"
#include "support/case_count.hpp"
#include "support/mutated.hpp"
#include "support/random.hpp"
#include "temporary_folder.hpp"
#include "with_line_ends.hpp"

namespace surehit::test::read_scene_test {
namespace {

using example::PlacedMesh;
using example::read_scene;

const std::string identity = "1 0 0 0  0 1 0 0  0 0 1 0";
const std::string counted = "1 2 3 4  5 6 7 8  9 10 11 12";

class ReadScene : public testing::Test {
 protected:
  [[nodiscard]] std::vector<PlacedMesh<float>> read(const std::string& text) const {
    return read_scene<float>(folder_.write("scene.txt", text));
  }

  void expect_one(const std::string& line, const PlacedMesh<float>& expected) const {
    std::vector<PlacedMesh<float>> scene;
    ASSERT_NO_THROW(scene = read(line + "\n")) << line;
    ASSERT_EQ(scene.size(), 1u) << line;
    EXPECT_EQ(scene[0].mesh_path, expected.mesh_path) << line;
    EXPECT_EQ(scene[0].pose.linear, expected.pose.linear) << line;
    EXPECT_EQ(scene[0].pose.translation, expected.pose.translation) << line;
    EXPECT_EQ(scene[0].motion, expected.motion) << line;
    EXPECT_EQ(scene[0].mask, expected.mask) << line;
  }

  /// The mesh of the folder, in the pose of the numbers from 1 to 12.
  [[nodiscard]] PlacedMesh<float> placed(const std::string& mesh) const {
    PlacedMesh<float> placed{.line = 1, .mesh_path = folder_.at(mesh)};
    placed.pose.linear << 1, 2, 3, 5, 6, 7, 9, 10, 11;
    placed.pose.translation << 4, 8, 12;
    return placed;
  }

  void expect_error(const std::string& line, const std::string& error) const {
    const std::string text = "# a scene\n\na.obj " + identity + "\n" + line + "\na.obj " + identity + "\n";
    EXPECT_EQ(error_of([&] { return read(text); }), folder_.at("scene.txt") + ": line 4: " + error) << line;
  }

  TemporaryFolder folder_;
};

TEST_F(ReadScene, takes_rows_of_the_pose_with_their_translations) { expect_one("a.obj " + counted, placed("a.obj")); }

TEST_F(ReadScene, takes_motion_and_mask_in_any_order) {
  PlacedMesh<float> expected = placed("a.obj");
  expected.motion << 1, -2.5f, 0.125f;
  expect_one("a.obj " + counted + " motion 1 -2.5 0x1p-3", expected);
  expected.mask = 0x1f;
  expect_one("a.obj " + counted + " motion 1 -2.5 0x1p-3 mask 31", expected);
  expect_one("a.obj " + counted + "\tmask 0x1F  motion 1 -2.5 0x1p-3 ", expected);
  expected.motion.setZero();
  expected.mask = 0;
  expect_one("a.obj " + counted + " mask 0", expected);
  expected.mask = ~0u;
  expect_one("a.obj " + counted + " mask 4294967295", expected);
}

TEST_F(ReadScene, takes_commas_between_numbers) {
  PlacedMesh<float> expected = placed("a.obj");
  expected.motion << 1, 2, 3;
  expected.mask = 4;
  expect_one("a.obj,1,2,3,4,5,6,7,8,9,10,11,12,motion,1,2,3,mask,4", expected);
  expect_one(" a.obj , 1 2 3 4, 5 6 7 8, 9 10 11 12, motion 1 2 3, mask 4", expected);
}

TEST_F(ReadScene, takes_names_in_quotation_marks) {
  expect_one("\"a.obj\" " + counted, placed("a.obj"));
  expect_one("\"the old, red door.obj\"," + counted, placed("the old, red door.obj"));
  expect_one("\"#1.obj\" " + counted, placed("#1.obj"));
  expect_one("\"12\"\" door.obj\" " + counted, placed("12\" door.obj"));
  expect_one("12\"door.obj " + counted, placed("12\"door.obj"));
  expect_one("d\xc3\xb6r.obj " + counted, placed("d\xc3\xb6r.obj"));
}

TEST_F(ReadScene, finds_meshes_relative_to_the_scene) {
  expect_one("meshes/a.obj " + counted, placed("meshes/a.obj"));
  expect_one("./x/../a.obj " + counted, placed("a.obj"));
  PlacedMesh<float> absolute = placed("");
  absolute.mesh_path = "/meshes/a.obj";
  expect_one("/meshes/a.obj " + counted, absolute);
}

TEST_F(ReadScene, numbers_lines_and_skips_comments_and_blank_lines) {
  const std::string text = "# a scene\n\na.obj " + identity + "\n  # more\n \t\nb.obj " + identity + "\n";
  for (const std::string_view end : line_ends) {
    const auto scene = read("\xef\xbb\xbf" + with_line_ends(text, end) + "\x1a");
    ASSERT_EQ(scene.size(), 2u);
    EXPECT_EQ(scene[0].line, 3u);
    EXPECT_EQ(scene[0].mesh_path, folder_.at("a.obj"));
    EXPECT_EQ(scene[1].line, 6u);
    EXPECT_EQ(scene[1].mesh_path, folder_.at("b.obj"));
  }
  EXPECT_TRUE(read("").empty());
  EXPECT_TRUE(read("# nothing\n").empty());
}

TEST_F(ReadScene, rounds_each_number_once) {
  // Just above the middle of two floats: rounded to double first, it would be the middle and go down to 1.
  const std::string number = "1.000000059604644775390625000000001";
  const std::string text = "a.obj " + number + " 0 0 0  0 1 0 0.1  0 0 1 0 motion 0.1 " + number + " 0\n";
  const std::string path = folder_.write("scene.txt", text);
  const auto in_float = read_scene<float>(path);
  EXPECT_EQ(in_float[0].pose.linear(0, 0), 0x1.000002p0f);
  EXPECT_EQ(in_float[0].pose.translation[1], 0.1f);
  EXPECT_EQ(in_float[0].motion[1], 0x1.000002p0f);
  const auto in_double = read_scene<double>(path);
  EXPECT_EQ(in_double[0].pose.linear(0, 0), 0x1.000001p0);
  EXPECT_EQ(in_double[0].pose.translation[1], 0.1);
  EXPECT_EQ(in_double[0].motion[0], 0.1);
}

TEST_F(ReadScene, does_not_judge_poses) {
  EXPECT_EQ(read("a.obj 0 0 0 0 0 0 0 0 0 0 0 0\n")[0].pose.linear(2, 2), 0.0f);
  EXPECT_EQ(read("a.obj 1e38 0 0 0 0 1e-38 0 0 0 0 1 0\n")[0].pose.linear(0, 0), 1e38f);
}

TEST_F(ReadScene, names_the_line_of_an_error) {
  const std::pair<std::string, std::string> lines[] = {
      {"a.obj", "a pose has 12 numbers, not 0"},
      {"a.obj 1 2 3 4 5 6 7 8 9 10 11", "a pose has 12 numbers, not 11"},
      {"a.obj 1 2 3 4 5 6 7 8 9 10 11 mask 1", "a pose has 12 numbers, not 11"},
      {"1 2 3 4 5 6 7 8 9 10 11 12", "a pose has 12 numbers, not 11"},
      {"a.obj " + counted + " 13", "expected motion or mask, not '13'"},
      {"a.obj " + counted + " # the door", "expected motion or mask, not '#'"},
      {"a.obj " + counted + " speed 1", "expected motion or mask, not 'speed'"},
      {"a.obj " + counted + " MASK 1", "expected motion or mask, not 'MASK'"},
      {"a.obj 1 2 3 4 5 6 x 8 9 10 11 12", "'x' is not a number"},
      {"a.obj 1 2 3 4 5 6 nan 8 9 10 11 12", "'nan' is not a number"},
      {"a.obj 1 2 3 inf 5 6 7 8 9 10 11 12", "'inf' is not a number"},
      {"a.obj 1 2 3 1e39 5 6 7 8 9 10 11 12", "'1e39' is beyond the largest float"},
      {"a.obj 1 2 3,,4 5 6 7 8 9 10 11 12", "a number is missing beside a comma"},
      {"a.obj,," + counted, "a number is missing beside a comma"},
      {"a.obj " + counted + ",", "a number is missing beside a comma"},
      {"a.obj " + counted + " motion", "motion needs 3 numbers"},
      {"a.obj " + counted + " motion 1 2", "motion needs 3 numbers"},
      {"a.obj " + counted + " motion 1 2 mask 3", "motion needs 3 numbers"},
      {"a.obj " + counted + " motion 1 2 3 4", "expected motion or mask, not '4'"},
      {"a.obj " + counted + " motion 1 2 up", "'up' is not a number"},
      {"a.obj " + counted + " motion 1 2 -inf", "'-inf' is not a number"},
      {"a.obj " + counted + " motion 1 2 3 motion 1 2 3", "motion is there twice"},
      {"a.obj " + counted + " mask", "mask needs a number"},
      {"a.obj " + counted + " mask motion 1 2 3", "mask needs a number"},
      {"a.obj " + counted + " mask -1", "'-1' is no mask of 32 bits"},
      {"a.obj " + counted + " mask 4294967296", "'4294967296' is no mask of 32 bits"},
      {"a.obj " + counted + " mask 1.5", "'1.5' is no mask of 32 bits"},
      {"a.obj " + counted + " mask 1 mask 1", "mask is there twice"},
      {"\"a.obj " + identity, "a quotation mark is missing behind '\"a.obj 1 0 0 0  0 1 0 0  0 0 1 0'"},
      {"\"a.obj\"1 " + identity, "white space or a comma is missing behind the name of the mesh"},
      {"\"\" " + identity, "the name of the mesh is missing"},
      {"," + identity, "the name of the mesh is missing"},
  };
  for (const auto& [line, error] : lines) expect_error(line, error);
  EXPECT_EQ(error_of([&] { return read_scene<float>(folder_.at("none")); }),
            folder_.at("none") + ": cannot be read: No such file or directory");
}

TEST_F(ReadScene, reads_any_bytes_or_names_what_is_wrong) {
  const std::string valid = "# a scene\n\"a b.obj\" " + counted + " motion 1 2 3 mask 0x7\nb.obj," + identity + "\n";
  ASSERT_EQ(read(valid).size(), 2u);
  Random random(1);
  std::size_t errors = 0;
  const std::size_t cases = case_count(500);
  for (std::size_t i = 0; i < cases; ++i) {
    const std::string bytes = mutated(valid, random);
    try {
      ASSERT_LE(read(bytes).size(), bytes.size());
    } catch (const example::InputError& error) {
      ++errors;
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ASSERT_NE(std::string(error.what()).find("scene.txt: line "), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(errors, cases / 10);
  EXPECT_LT(errors, cases);
}

}  // namespace
}  // namespace surehit::test::read_scene_test
