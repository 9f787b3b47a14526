#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

namespace surehit::example {

/// A check of an option that refuses NaN, which is in each CLI::Range.
[[nodiscard]] inline CLI::Validator refuses_nan() {
  return {[](const std::string& text) {
            return std::isnan(std::strtof(text.c_str(), nullptr)) ? text + " is not a number" : std::string();
          },
          ""};
}

}  // namespace surehit::example
