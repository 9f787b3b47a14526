#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "support/pair_text.hpp"
#include "support/scene_oracle.hpp"

namespace surehit::test {

template <typename Scalar>
void write(std::ostream& out, const Placement<Scalar>& placement) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out << placement.pose.linear(row, column) << ", ";
    out << placement.pose.translation[row] << (row < 2 ? ",  " : ";  ");
  }
  out << "motion ";
  write(out, placement.motion);
  out << ", mask " << placement.mask;
}

/// Returns one line for each hit.
template <typename Scalar>
std::string hex_text(const std::vector<SceneHit<Scalar>>& hits) {
  std::string text;
  for (const SceneHit<Scalar>& hit : hits) text.append("\n  ").append(hex_text(hit));
  return hits.empty() ? " none" : text;
}

}  // namespace surehit::test
