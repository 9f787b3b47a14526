#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "named_mesh.hpp"

namespace surehit::benchmark {

/// One shape in ever more triangles.
struct SizeSeries {
  std::string name;
  std::vector<std::function<NamedMesh()>> sizes;  ///< one after the other, since the largest take much memory
};

/// The built-in level in about 1,000, 3,000, 10,000 … 10,000,000 triangles, up to `largest`.
[[nodiscard]] SizeSeries level_series(std::size_t largest);
/// The mesh, then with every triangle cut in four at the middles of its edges, again and again, as long as
/// there are no more than `largest`.
[[nodiscard]] SizeSeries subdivision_series(const NamedMesh& named, std::size_t largest);

}  // namespace surehit::benchmark
