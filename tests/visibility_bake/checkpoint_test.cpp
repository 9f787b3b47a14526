#include "visibility_bake/checkpoint.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <system_error>

#include "examples/temporary_folder.hpp"
#include "mesh_io/input_error.hpp"

namespace surehit::example::checkpoint_test {
namespace {

class CheckpointTest : public testing::Test {
 protected:
  static constexpr std::uint32_t cells = 11;
  const test::TemporaryFolder folder_;
  const Checkpoint checkpoint_{folder_.at("some.checkpoint"), 77};
  Visibility visibility_{cells};

  void SetUp() override {
    visibility_.add({3, {4, 7, 10}, {0, 2, 5}});
    visibility_.add({10, {0}, {8}});
    checkpoint_.save(visibility_);
  }
  [[nodiscard]] std::string error_of(const Checkpoint& checkpoint, std::uint32_t count = cells) const {
    try {
      static_cast<void>(checkpoint.load(count));
    } catch (const InputError& error) {
      const std::string all = error.what();
      return all.substr(all.find("some.checkpoint"));
    }
    return "";
  }
};

TEST_F(CheckpointTest, gives_back_what_was_saved) {
  EXPECT_EQ(checkpoint_.load(cells), visibility_);
  EXPECT_EQ(checkpoint_.load(cells).row_count(), 2u);
  visibility_.add({0, {2}, {1}});
  checkpoint_.save(visibility_);
  EXPECT_EQ(checkpoint_.load(cells), visibility_);
  EXPECT_EQ(folder_.file_count(), 1u);
}

TEST_F(CheckpointTest, knows_nothing_without_a_file) {
  const Checkpoint absent(folder_.at("absent"), 77);
  EXPECT_EQ(absent.load(cells), Visibility(cells));
  absent.remove();
}

TEST_F(CheckpointTest, of_another_plan_is_refused) {
  const std::string error =
      "some.checkpoint: is of another mesh, of other cells or of other options; remove it, or begin again with "
      "--restart";
  EXPECT_EQ(error_of(Checkpoint(folder_.at("some.checkpoint"), 78)), error);
  EXPECT_EQ(error_of(checkpoint_, cells + 1), error);
}

TEST_F(CheckpointTest, is_refused_if_a_bit_is_damaged) {
  const std::string bytes = folder_.read("some.checkpoint");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << i % 8));
    static_cast<void>(folder_.write("some.checkpoint", damaged));
    EXPECT_NE(error_of(checkpoint_), "") << i;
  }
}

TEST_F(CheckpointTest, is_refused_if_it_ends_too_early) {
  const std::string bytes = folder_.read("some.checkpoint");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    static_cast<void>(folder_.write("some.checkpoint", bytes.substr(0, size)));
    EXPECT_NE(error_of(checkpoint_), "") << size;
  }
  static_cast<void>(folder_.write("some.checkpoint", bytes + '\0'));
  EXPECT_NE(error_of(checkpoint_), "");
}

TEST_F(CheckpointTest, stays_as_it_is_if_the_disk_is_full) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no disk that is always full";
  std::filesystem::create_symlink("/dev/full", folder_.at("some.checkpoint.partial"));
  Visibility more = visibility_;
  more.add({1, {2}, {3}});
  try {
    checkpoint_.save(more);
    FAIL() << "it was written";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_space_on_device);
    EXPECT_NE(std::string(error.what()).find("some.checkpoint: cannot be written"), std::string::npos);
  }
  EXPECT_EQ(checkpoint_.load(cells), visibility_);
  EXPECT_EQ(folder_.file_count(), 1u);
  checkpoint_.save(more);
  EXPECT_EQ(checkpoint_.load(cells), more);
}

TEST_F(CheckpointTest, overwrites_what_an_interrupted_one_has_left) {
  static_cast<void>(folder_.write("some.checkpoint.partial", "half of it"));
  EXPECT_EQ(checkpoint_.load(cells), visibility_);
  checkpoint_.save(visibility_);
  EXPECT_EQ(folder_.file_count(), 1u);
}

}  // namespace
}  // namespace surehit::example::checkpoint_test
