#pragma once

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

namespace surehit::test {

using Scalars = testing::Types<float, double>;

struct ScalarNames {
  template <typename Scalar>
  static std::string GetName(int) {
    return std::is_same_v<Scalar, float> ? "float" : "double";
  }
};

}  // namespace surehit::test
