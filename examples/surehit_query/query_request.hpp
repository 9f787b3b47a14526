#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <surehit/path.hpp>
#include <surehit/query_options.hpp>

namespace surehit::example {

enum class Question : std::uint8_t { pair, first, any, all };

enum class ScalarKind : std::uint8_t { single_precision, double_precision };

/// What the command line asks for.
struct QueryRequest {
  Question question = Question::pair;
  std::string mesh_path;  ///< none for `pair`
  std::string input_path;
  std::string output_path = "-";
  ScalarKind scalar = ScalarKind::single_precision;
  PathKind path = PathKind::segment;
  Culling culling = Culling::none;
  std::size_t threads = 1;
  bool wants_statistics = false;  ///< none of `pair`
};

}  // namespace surehit::example
