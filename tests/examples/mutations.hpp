#pragma once

#include <gtest/gtest.h>

#include <string>

#include "mesh_io/input_error.hpp"
#include "mesh_io/mesh.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"

namespace surehit::test {

/// The bytes with a few of them changed, removed, doubled or cut off.
inline std::string mutated(std::string bytes, Random& random) {
  for (std::uint64_t changes = 1 + random.below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = random.below(bytes.size());
    const std::size_t length = random.below(1 + std::min<std::size_t>(bytes.size() - at, 12));
    switch (random.below(6)) {
      case 0:
        bytes[at] = static_cast<char>(random.bits());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
        break;
      case 2:
        bytes[at] = "0123456789-+.eE #/\\\n"[random.below(20)];
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 4:
        bytes.insert(at, bytes.substr(at, length));
        break;
      default:
        if (random.one_in(4)) bytes.resize(at);
        break;
    }
  }
  return bytes;
}

/// Whatever becomes of a valid file, it is an error of one line or a sound mesh of a size that the bytes account for.
template <typename Read>
void expect_error_or_sound_mesh(const std::string& valid, Read read) {
  ASSERT_NO_THROW(static_cast<void>(read(valid)));
  Random random(valid.size());
  std::size_t errors = 0;
  const std::size_t cases = case_count(20000);
  for (std::size_t i = 0; i < cases; ++i) {
    const std::string bytes = mutated(valid, random);
    try {
      const auto mesh = read(bytes);
      ASSERT_LE(mesh.vertices.size() + mesh.triangles.size(), bytes.size());
      const auto invalid = find_invalid(mesh.view());
      ASSERT_FALSE(invalid) << invalid->what();
    } catch (const example::InputError& error) {
      ++errors;
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(errors, cases / 10);
  EXPECT_LT(errors, cases);
}

}  // namespace surehit::test
