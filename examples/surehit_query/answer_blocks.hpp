#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <surehit/query_statistics.hpp>

#include "surehit_query/query_request.hpp"

namespace surehit::example {

struct AnsweredBlock {
  std::string lines;
  QueryStatistics statistics;
};

/// The answers to the paths from `begin` to before `end`. Called from several threads at once.
using AnswerBlock = std::function<AnsweredBlock(std::size_t begin, std::size_t end)>;

/// Returns what was done for all of them. Every thread answers one block of a round, and the blocks are written in
/// their order. So the output is the same for any number of threads, and at most one round is in memory.
QueryStatistics write_answers(const QueryRequest& request, std::string_view header, std::size_t paths,
                              const AnswerBlock& answer);

}  // namespace surehit::example
