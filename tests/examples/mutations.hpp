#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "mesh_io/input_error.hpp"
#include "mesh_io/mesh.hpp"
#include "support/case_count.hpp"
#include "support/mutated.hpp"
#include "support/random.hpp"

namespace surehit::test {

/// Whether all indices and coordinates are sound, each triangle has a face, faces go up, and warnings are lines.
template <typename Scalar>
void expect_sound_mesh(const example::Mesh<Scalar>& mesh) {
  const auto invalid = find_invalid(mesh.view());
  ASSERT_FALSE(invalid) << invalid->what();
  ASSERT_TRUE(mesh.faces.empty() || mesh.faces.size() == mesh.triangles.size());
  ASSERT_TRUE(std::is_sorted(mesh.faces.begin(), mesh.faces.end()));
  ASSERT_LE(mesh.face_count(), mesh.triangles.size());
  for (const std::string& warning : mesh.warnings) {
    ASSERT_FALSE(warning.empty());
    ASSERT_EQ(warning.find('\n'), std::string::npos) << warning;
  }
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
      ASSERT_NO_FATAL_FAILURE(expect_sound_mesh(mesh)) << bytes;
    } catch (const example::InputError& error) {
      ++errors;
      ASSERT_FALSE(std::string(error.what()).empty());
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(errors, cases / 10);
  EXPECT_LT(errors, cases);
}

}  // namespace surehit::test
