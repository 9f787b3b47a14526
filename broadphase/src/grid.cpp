#include "surehit/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cell_listing.hpp"
#include "surehit/floating_point_environment.hpp"

namespace surehit {
namespace {

/// The lists may hold this many entries a triangle: triangles of the size of a cell take about 5.
constexpr std::size_t entries_per_triangle = 16;
/// Small meshes may be divided as finely as one likes up to here.
constexpr std::size_t free_entries = std::size_t{1} << 24;
constexpr double cells_per_triangle_limit = 8;
constexpr double free_cells = 0x1p24;
constexpr double most_cells = 0x1p28;
constexpr double most_cells_on_an_axis = 0x1p20;

/// Cubic cells, `cells` of them or fewer, where an axis that is thinner than a cell has just one.
std::array<double, 3> cubic_resolution(const std::array<double, 3>& width, double cells) {
  std::array<double, 3> resolution = {1, 1, 1};
  std::array<bool, 3> divided = {true, true, true};
  for (int pass = 0; pass < 3; ++pass) {
    double volume = 1;
    int dimensions = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!divided[axis]) continue;
      volume *= width[axis];
      ++dimensions;
    }
    if (dimensions == 0) break;
    const double size = std::pow(volume / cells, 1.0 / dimensions);
    bool settled = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!divided[axis]) continue;
      resolution[axis] = width[axis] / size;
      if (!(resolution[axis] >= 1)) {  // NaN for a box of no width at all
        resolution[axis] = 1;
        divided[axis] = false;
        settled = false;
      }
    }
    if (settled) break;
  }
  return resolution;
}

template <typename Scalar>
std::array<double, 3> wished_resolution(const GridFrame& frame, const Box<Scalar>& box, std::size_t triangles,
                                        const GridOptions& options) {
  std::array<double, 3> width = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    width[axis] = frame.scaled(box.high[static_cast<Eigen::Index>(axis)]) - frame.origin[axis];
  }
  const double count = static_cast<double>(triangles);
  std::array<double, 3> wished = cubic_resolution(width, std::max(1.0, options.cells_per_triangle * count));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (options.resolution[axis] != 0) wished[axis] = options.resolution[axis];
    wished[axis] = std::clamp(std::floor(wished[axis]), 1.0, most_cells_on_an_axis);
  }
  const double limit = std::min(std::max(free_cells, cells_per_triangle_limit * count), most_cells);
  while (wished[0] * wished[1] * wished[2] > limit) {
    double& finest = *std::max_element(wished.begin(), wished.end());
    finest = std::floor(finest / 2);
  }
  return wished;
}

template <typename Scalar>
std::array<detail::FramePoint, 3> in_frame(const GridFrame& frame, const Triangle<Scalar>& triangle) {
  std::array<detail::FramePoint, 3> corners;
  const Vector3<Scalar>* vertices[] = {&triangle.a, &triangle.b, &triangle.c};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corners[corner][axis] = frame.scaled((*vertices[corner])[static_cast<Eigen::Index>(axis)]) - frame.origin[axis];
    }
  }
  return corners;
}

}  // namespace

template <typename Scalar>
Grid::Grid(const TriangleMeshView<Scalar>& mesh, const Box<Scalar>& box, const GridOptions& options) {
  const FloatingPointEnvironment environment;
  if (mesh.triangle_count() == 0) return;
  const std::size_t budget = std::min<std::size_t>(std::max(free_entries, entries_per_triangle * mesh.triangle_count()),
                                                   std::numeric_limits<std::uint32_t>::max());
  frame_ = GridFrame::around(box, {1, 1, 1});
  std::array<double, 3> wished = wished_resolution(frame_, box, mesh.triangle_count(), options);
  for (;;) {
    frame_ = GridFrame::around(box, wished);
    if (try_list(mesh, budget)) return;
    for (double& cells : wished) cells = std::max(1.0, std::floor(cells / 2));
  }
}

/// Lists all triangles, unless that takes more entries than the budget. One cell a triangle always fits.
template <typename Scalar>
bool Grid::try_list(const TriangleMeshView<Scalar>& mesh, std::size_t entry_budget) {
  const auto& cells = frame_.resolution;
  offsets_.assign(std::size_t{cells[0]} * cells[1] * cells[2] + 1, 0);
  std::vector<std::uint32_t> cells_met;                           // of all triangles in turn
  std::vector<std::size_t> cells_met_end(mesh.triangle_count());  // where each triangle's end

  for (std::size_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    detail::list_cells(frame_, in_frame(frame_, mesh.triangle(triangle)),
                       [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
                         const std::size_t cell = cell_index({x, y, z});
                         ++offsets_[cell + 1];
                         cells_met.push_back(static_cast<std::uint32_t>(cell));
                       });
    if (cells_met.size() > entry_budget) return false;
    cells_met_end[triangle] = cells_met.size();
  }

  for (std::size_t cell = 1; cell < offsets_.size(); ++cell) offsets_[cell] += offsets_[cell - 1];
  entries_.resize(cells_met.size());
  std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
  std::size_t met = 0;
  for (std::size_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    for (; met < cells_met_end[triangle]; ++met)
      entries_[next[cells_met[met]]++] = static_cast<std::uint32_t>(triangle);
  }
  return true;
}

template Grid::Grid(const TriangleMeshView<float>&, const Box<float>&, const GridOptions&);
template Grid::Grid(const TriangleMeshView<double>&, const Box<double>&, const GridOptions&);

}  // namespace surehit
