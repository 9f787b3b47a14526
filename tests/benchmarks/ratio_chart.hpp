#pragma once

#include <span>
#include <string>

#include "report.hpp"

namespace surehit::benchmark {

/// An SVG picture of how many times as long Embree's fast mode takes, by path set: bars from the worst mesh to the best
/// one, above the line at 1 where surehit is the faster one. It names the machine. Throws std::runtime_error where
/// nothing is to be drawn.
[[nodiscard]] std::string ratio_chart(std::span<const Record> records, const std::string& machine);

}  // namespace surehit::benchmark
