#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace surehit::example {

/// Tells which of a path's hits tie: meet the path at the very same exact t. Their rounded t may be the same without
/// that. The result has one number for each hit: 1 if it ties.
///
/// The hits are all those of the path, in the order of exact t, and those that tie in the order of ids. So the same
/// triangles with their ids the other way round turn the order of those that tie, and of no others.
/// `turned_order(hits)` asks these triangles alone, where hit i has the id hits.size() - 1 - i. It returns the ids in
/// the order of the new hits.
template <typename Answer, typename TurnedOrder>
[[nodiscard]] std::vector<std::uint8_t> exact_ties(const std::vector<Answer>& hits, const TurnedOrder& turned_order) {
  std::vector<std::uint8_t> ties(hits.size(), 0);
  for (std::size_t begin = 0; begin < hits.size();) {
    std::size_t end = begin + 1;
    while (end < hits.size() && hits[end].t == hits[begin].t) ++end;
    if (end - begin > 1) {
      const std::vector<std::uint32_t> order = turned_order(std::span(hits).subspan(begin, end - begin));
      std::vector<std::size_t> place(end - begin);
      for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
      for (std::size_t i = begin; i + 1 < end; ++i) {
        if (place[end - 1 - i] > place[end - 2 - i]) ties[i] = ties[i + 1] = 1;
      }
    }
    begin = end;
  }
  return ties;
}

}  // namespace surehit::example
