#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <surehit/triangle_mesh_view.hpp>
#include <vector>

#include "path_batch.hpp"

namespace surehit::benchmark {

/// Who says what is right.
[[nodiscard]] std::string exact_judge();

/// Whether each path meets anything, by exact arithmetic; of the first paths only where the judge is slow.
[[nodiscard]] std::vector<std::uint8_t> exact_answers(const TriangleMeshViewf& mesh, const PathBatch& paths);

}  // namespace surehit::benchmark
