#include "support/exact_cells.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace surehit::test {
namespace {

/// Keeps what lies where sign (x[axis] - plane) >= 0.
ExactPolygon cut(const ExactPolygon& polygon, std::size_t axis, const mpq_class& plane, int sign) {
  ExactPolygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ExactPoint& from = polygon[i];
    const ExactPoint& to = polygon[(i + 1) % polygon.size()];
    const mpq_class height = from[axis] - plane;
    const mpq_class to_height = to[axis] - plane;
    if (sign * sgn(height) >= 0) kept.push_back(from);
    if (sgn(height) * sgn(to_height) >= 0) continue;
    const mpq_class weight = height / (height - to_height);
    ExactPoint crossing;
    for (std::size_t k = 0; k < 3; ++k) crossing[k] = from[k] + weight * (to[k] - from[k]);
    kept.push_back(crossing);
  }
  return kept;
}

/// The parameters at which a path is in some region.
class PartOfPath {
 public:
  template <typename Scalar>
  PartOfPath(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t)
      : start_(in_frame(frame, path.start)) {
    if (std::isfinite(first_t)) first_ = first_t;
    if (std::isfinite(last_t)) last_ = last_t;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      rate_[axis] = scaled_exactly(path.toward[k], frame.exponent);
      if (path.has_end()) rate_[axis] -= scaled_exactly(path.start[k], frame.exponent);
      rate_[axis] *= frame.scale[axis];
    }
  }

  PartOfPath& within(const ExactBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) cut(start_[axis], rate_[axis], box.low[axis], box.high[axis]);
    return *this;
  }
  PartOfPath& within(const ExactSlab& slab) {
    cut(slab.height_of(start_), slab.height_of(rate_), slab.low, slab.high);
    return *this;
  }
  [[nodiscard]] bool is_empty() const { return is_empty_ || (first_ && last_ && *first_ > *last_); }

 private:
  /// To where start + t rate is in [low, high].
  void cut(const mpq_class& start, const mpq_class& rate, const mpq_class& low, const mpq_class& high) {
    if (rate == 0) {
      is_empty_ |= start < low || high < start;
      return;
    }
    mpq_class enters = (low - start) / rate;
    mpq_class leaves = (high - start) / rate;
    if (rate < 0) std::swap(enters, leaves);
    if (!first_ || *first_ < enters) first_ = enters;
    if (!last_ || *last_ > leaves) last_ = leaves;
  }

  ExactPoint start_;
  ExactPoint rate_;
  std::optional<mpq_class> first_;
  std::optional<mpq_class> last_;
  bool is_empty_ = false;
};

}  // namespace

mpq_class scaled_exactly(double x, int exponent) {
  mpq_class scaled = x;
  if (exponent >= 0) {
    mpq_mul_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return scaled;
}

template <typename Scalar>
ExactPoint in_frame(const GridFrame& frame, const Vector3<Scalar>& point) {
  ExactPoint exact;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const mpq_class scaled = scaled_exactly(point[static_cast<Eigen::Index>(axis)], frame.exponent);
    exact[axis] = (scaled - frame.origin[axis]) * frame.scale[axis] + double{frame.margin[axis]};
  }
  return exact;
}

template <typename Scalar>
ExactPolygon in_frame(const GridFrame& frame, const Triangle<Scalar>& triangle) {
  return {in_frame(frame, triangle.a), in_frame(frame, triangle.b), in_frame(frame, triangle.c)};
}

double out_of_frame(const GridFrame& frame, std::size_t axis, double place) {
  return std::ldexp((place - double{frame.margin[axis]}) / frame.scale[axis] + frame.origin[axis], -frame.exponent);
}

template <typename Scalar>
Line<Scalar> line_through_corners(const GridFrame& frame, Random& random) {
  const auto corner = [&](std::size_t axis) {
    return static_cast<Scalar>(
        out_of_frame(frame, axis, static_cast<double>(random.below(frame.resolution(axis) + 1))));
  };
  const auto step = [&] { return static_cast<Scalar>(1 + random.below(4)); };
  return {{corner(0), corner(1), 0}, {step(), random.one_in(2) ? step() : -step(), 0}};
}

Growth growth_by(const GridFrame& frame, double share, double more_cells) {
  Growth growth;
  for (std::size_t axis = 0; axis < 3; ++axis) growth[axis] = share * frame.resolution(axis) + more_cells;
  return growth;
}

ExactBox ExactBox::grown(const Growth& growth) const {
  ExactBox box = *this;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] -= growth[axis];
    box.high[axis] += growth[axis];
  }
  return box;
}

mpq_class ExactSlab::height_of(const ExactPoint& point) const {
  return normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2];
}

ExactSlab ExactSlab::grown(const Growth& growth) const {
  ExactSlab slab = *this;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    slab.low -= abs(normal[axis]) * growth[axis];
    slab.high += abs(normal[axis]) * growth[axis];
  }
  return slab;
}

ExactBox LeafCell::box() const {
  ExactBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = low[axis];
    box.high[axis] = low[axis] + size;
  }
  return box;
}

ExactBox LeafCell::listed_box(const Grid& grid) const {
  const CellBox listed = grid.box(word);
  ExactBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = low[axis] + mpq_class(size * listed.low(axis), CellBox::parts);
    box.high[axis] = low[axis] + mpq_class(size * listed.high(axis), CellBox::parts);
    box.low[axis].canonicalize();
    box.high[axis].canonicalize();
  }
  return box;
}

ExactSlab LeafCell::placed(CellSlab slab) const {
  ExactSlab exact;
  ExactPoint centre;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    exact.normal[axis] = slab.normal(axis);
    centre[axis] = low[axis] + size / 2.0;
  }
  const mpq_class step = double{CellSlab::step} * size;
  exact.low = exact.height_of(centre) + slab.low() * step;
  exact.high = exact.height_of(centre) + (slab.high() + 1) * step;
  return exact;
}

LeafCells::LeafCells(const Grid& grid, const GridFrame& frame) {
  const auto& [x_cells, y_cells, z_cells] = frame.cells;
  const std::uint32_t size = frame.division;
  std::size_t cell = frame.first_top;
  for (std::uint32_t z = 0; z < z_cells; ++z) {
    for (std::uint32_t y = 0; y < y_cells; ++y) {
      for (std::uint32_t x = 0; x < x_cells; ++x)
        add(grid, grid.all_top()[cell++], {x * size, y * size, z * size}, size);
    }
  }
}

void LeafCells::add(const Grid& grid, CellWord word, const std::array<std::uint32_t, 3>& low, std::uint32_t size) {
  constexpr std::uint32_t edge = Grid::brick_edge;
  if (!word.is_divided()) {
    by_low_.emplace(low, leaves_.size());
    leaves_.push_back({low, size, word});
    return;
  }
  const std::uint32_t part = size / edge;
  for (std::uint32_t cell = 0; cell < Grid::brick_size; ++cell) {
    add(grid, grid.bricks()[std::size_t{word.brick()} * Grid::brick_size + cell],
        {low[0] + cell % edge * part, low[1] + cell / edge % edge * part, low[2] + cell / edge / edge * part}, part);
  }
}

std::vector<std::uint32_t> triangles_in(const Grid& grid, CellWord word) {
  std::set<std::uint32_t> ids;
  const auto add_list = [&](const auto& self, CellWord any) -> void {
    if (any.is_empty()) return;
    ids.insert(grid.triangles(any).begin(), grid.triangles(any).end());
    if (!any.has_inner_grid()) return;
    for (const LeafCell& leaf : LeafCells(grid, grid.inner_frame(any))) self(self, leaf.word);
  };
  add_list(add_list, word);
  return {ids.begin(), ids.end()};
}

std::optional<std::size_t> LeafCells::at(const std::array<std::uint32_t, 3>& low) const {
  const auto found = by_low_.find(low);
  return found == by_low_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::size_t> LeafCells::met_by(const ExactPolygon& polygon, const Growth& growth) const {
  // Most cells are far from the polygon, which doubles can tell: by a whole cell more than they may be off.
  std::array<double, 3> lowest;
  std::array<double, 3> highest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(),
                                                 [&](const auto& p, const auto& q) { return p[axis] < q[axis]; });
    lowest[axis] = (*low)[axis].get_d() - growth[axis] - 1;
    highest[axis] = (*high)[axis].get_d() + growth[axis] + 1;
  }
  std::vector<std::size_t> met;
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    const auto& [low, size, word] = leaves_[leaf];
    bool is_near = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      is_near &= low[axis] + size >= lowest[axis] && low[axis] <= highest[axis];
    if (is_near && meets_box(polygon, leaves_[leaf].box().grown(growth))) met.push_back(leaf);
  }
  return met;
}

ExactPolygon part_in(const ExactBox& box, const ExactPolygon& polygon) {
  ExactPolygon part = polygon;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    part = cut(cut(part, axis, box.low[axis], 1), axis, box.high[axis], -1);
  }
  return part;
}

bool meets_box(const ExactPolygon& polygon, const ExactBox& box) { return !part_in(box, polygon).empty(); }

template <typename Scalar>
bool meets_box(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t, const ExactBox& box) {
  return !PartOfPath(frame, path, first_t, last_t).within(box).is_empty();
}

template <typename Scalar>
bool meets_part_in_slab(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t,
                        const ExactBox& box, const ExactSlab& slab) {
  return !PartOfPath(frame, path, first_t, last_t).within(box).within(slab).is_empty();
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                        \
  template ExactPoint in_frame(const GridFrame&, const Vector3<Scalar>&);                                  \
  template ExactPolygon in_frame(const GridFrame&, const Triangle<Scalar>&);                               \
  template Line<Scalar> line_through_corners(const GridFrame&, Random&);                                   \
  template bool meets_box(const GridFrame&, const Path<Scalar>&, double, double, const ExactBox&);         \
  template bool meets_part_in_slab(const GridFrame&, const Path<Scalar>&, double, double, const ExactBox&, \
                                   const ExactSlab&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
