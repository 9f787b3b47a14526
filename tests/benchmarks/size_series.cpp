#include "size_series.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace surehit::benchmark {
namespace {

using Mesh = example::Mesh<float>;

/// Adds the middles of edges to a mesh, each once.
class EdgeMiddles {
 public:
  explicit EdgeMiddles(Mesh& mesh) : mesh_(mesh) {}

  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t edge = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [place, is_new] = index_of_.try_emplace(edge, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) {
      std::array<float, 3> middle;
      for (std::size_t i = 0; i < 3; ++i) middle[i] = (mesh_.vertices[a][i] + mesh_.vertices[b][i]) / 2;
      mesh_.vertices.push_back(middle);
    }
    return place->second;
  }

 private:
  Mesh& mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_of_;
};

Mesh subdivided(const Mesh& mesh) {
  Mesh finer;
  finer.vertices = mesh.vertices;
  finer.triangles.reserve(4 * mesh.triangles.size());
  EdgeMiddles middles(finer);
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middles.between(a, b);
    const std::uint32_t bc = middles.between(b, c);
    const std::uint32_t ca = middles.between(c, a);
    finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return finer;
}

}  // namespace

SizeSeries level_series(std::size_t largest) {
  struct Size {
    std::size_t triangles;  ///< about
    float detail;
  };
  constexpr std::array sizes = {Size{1'000, 0.01f},     Size{3'000, 0.15f},    Size{10'000, 0.2f},
                                Size{30'000, 0.5f},     Size{100'000, 1.03f},  Size{300'000, 1.85f},
                                Size{1'000'000, 3.45f}, Size{3'000'000, 6.0f}, Size{10'000'000, 11.0f}};
  SizeSeries series{"level", {}};
  for (const Size& size : sizes) {
    if (size.triangles <= largest) series.sizes.push_back([detail = size.detail] { return level_mesh(detail); });
  }
  return series;
}

SizeSeries subdivision_series(const NamedMesh& named, std::size_t largest) {
  SizeSeries series{named.name + " subdivided", {}};
  int times = 0;
  for (std::size_t triangles = named.mesh.triangles.size(); triangles <= largest; triangles *= 4, ++times) {
    series.sizes.push_back([&named, times] {
      NamedMesh finer = named;
      for (int i = 0; i < times; ++i) finer.mesh = subdivided(finer.mesh);
      return finer;
    });
  }
  return series;
}

}  // namespace surehit::benchmark
