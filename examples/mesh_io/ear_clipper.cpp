#include "mesh_io/ear_clipper.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace surehit::example {

template <typename Scalar>
EarClipper<Scalar>::EarClipper(const AxisView<Scalar>& view, const std::vector<Point>& outline, int turn)
    : view_(view),
      outline_(outline),
      turn_(turn),
      previous_(outline.size()),
      next_(outline.size()),
      by_x_(outline.size()),
      is_left_(outline.size(), true),
      left_(outline.size()) {
  const auto size = static_cast<std::uint32_t>(outline.size());
  for (std::uint32_t i = 0; i < size; ++i) {
    previous_[i] = (i + size - 1) % size;
    next_[i] = (i + 1) % size;
  }
  std::iota(by_x_.begin(), by_x_.end(), 0u);
  std::stable_sort(by_x_.begin(), by_x_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return view_.x(outline_[a]) < view_.x(outline_[b]); });
}

template <typename Scalar>
int EarClipper<Scalar>::turn_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return turn_ * view_.orientation(outline_[a], outline_[b], outline_[c]);
}

/// Whether c, which is on their line, lies between p and n.
template <typename Scalar>
bool EarClipper<Scalar>::is_between(std::uint32_t p, std::uint32_t c, std::uint32_t n) const {
  const auto between = [](Scalar from, Scalar at, Scalar to) {
    return (from <= at && at <= to) || (to <= at && at <= from);
  };
  return between(view_.x(outline_[p]), view_.x(outline_[c]), view_.x(outline_[n])) &&
         between(view_.y(outline_[p]), view_.y(outline_[c]), view_.y(outline_[n]));
}

template <typename Scalar>
typename EarClipper<Scalar>::Kind EarClipper<Scalar>::kind_of(std::uint32_t c) const {
  const std::uint32_t p = previous_[c];
  const std::uint32_t n = next_[c];
  if (view_.coincide(outline_[c], outline_[p]) || view_.coincide(outline_[c], outline_[n])) return Kind::fold;
  const int turn = turn_of(p, c, n);
  if (turn > 0) return kind_of_ear(p, c, n);
  if (turn < 0) return Kind::none;
  return is_between(p, c, n) ? Kind::straight : Kind::fold;
}

/// Looks at all other corners that are not outside the triangle p c n, which is closed. What comes into it otherwise
/// would cross the outline. An edge that comes in at p or n crosses it too, or is seen at its other corner.
template <typename Scalar>
typename EarClipper<Scalar>::Kind EarClipper<Scalar>::kind_of_ear(std::uint32_t p, std::uint32_t c,
                                                                  std::uint32_t n) const {
  const std::array<Corners, 3> edges = {{{p, c, 0}, {c, n, 0}, {n, p, 0}}};

  // An edge from w, which is in the triangle, to x comes inside if x is to the left of each of the edges that w is on.
  const auto comes_in = [&](std::uint32_t w, std::uint32_t x) {
    return std::all_of(edges.begin(), edges.end(), [&](const Corners& edge) {
      return turn_of(edge[0], edge[1], w) != 0 || turn_of(edge[0], edge[1], x) > 0;
    });
  };

  const auto x_of = [&](std::uint32_t corner) { return view_.x(outline_[corner]); };
  const auto y_of = [&](std::uint32_t corner) { return view_.y(outline_[corner]); };
  const auto [min_x, max_x] = std::minmax({x_of(p), x_of(c), x_of(n)});
  const auto [min_y, max_y] = std::minmax({y_of(p), y_of(c), y_of(n)});
  auto at = std::lower_bound(by_x_.begin(), by_x_.end(), min_x,
                             [&](std::uint32_t corner, Scalar bound) { return x_of(corner) < bound; });
  Kind kind = Kind::free_ear;
  for (; at != by_x_.end() && x_of(*at) <= max_x; ++at) {
    const std::uint32_t w = *at;
    if (!is_left_[w] || w == p || w == c || w == n || y_of(w) < min_y || y_of(w) > max_y) continue;
    const auto is_outside = [&](const Corners& edge) { return turn_of(edge[0], edge[1], w) < 0; };
    if (std::any_of(edges.begin(), edges.end(), is_outside)) continue;
    if (comes_in(w, previous_[w]) || comes_in(w, next_[w])) return Kind::none;
    if (view_.coincide(outline_[w], outline_[c]) && is_lined_inside(p, c, n, w)) return Kind::none;
    kind = Kind::touched_ear;
  }
  return kind;
}

/// The corner, or the first one after it that is left.
template <typename Scalar>
std::uint32_t EarClipper<Scalar>::first_left(std::uint32_t c) const {
  while (!is_left_[c]) c = next_[c];
  return c;
}

/// Whether a and b are in the same direction from a corner that coincides with neither.
template <typename Scalar>
bool EarClipper<Scalar>::is_ahead(std::uint32_t from, std::uint32_t a, std::uint32_t b) const {
  return turn_of(from, a, b) == 0 && !is_between(a, from, b);
}

/// Whether the outline passes w, which coincides with c, along both edges of the ear on its way back. If it passes
/// inside of them, the edge from n to p would cross it.
///
/// A bridge that bends is an example. What is left of c there is either the polygon, and w is beyond the bridge, or the
/// inside of the bridge itself, which has no width. Where the outline passes inside in the same direction, it does so
/// on its way back as well, in between.
template <typename Scalar>
bool EarClipper<Scalar>::is_lined_inside(std::uint32_t p, std::uint32_t c, std::uint32_t n, std::uint32_t w) const {
  if (!is_ahead(c, p, next_[w]) || !is_ahead(c, n, previous_[w])) return false;

  // Nothing is seen of the side on which w is until the two part, as they do where nothing is folded.
  for (std::size_t steps = 0; steps < 2 * left_; ++steps) {
    const std::uint32_t end = next_[c];
    const std::uint32_t end_of_w = previous_[w];
    const bool ends = is_between(c, end, end_of_w);
    const bool w_ends = is_between(w, end_of_w, end);
    const std::uint32_t at = ends ? end : end_of_w;
    const std::uint32_t to = ends ? next_[end] : end;
    const std::uint32_t w_to = w_ends ? previous_[end_of_w] : end_of_w;
    if (!is_ahead(at, to, w_to)) return is_left_of(w_to, c, at, to);
    if (ends) c = end;
    if (w_ends) w = end_of_w;
  }
  return false;
}

/// Whether x is to the left of the way that leads to `at` and from there on; it is on neither part of it.
template <typename Scalar>
bool EarClipper<Scalar>::is_left_of(std::uint32_t x, std::uint32_t from, std::uint32_t at, std::uint32_t to) const {
  const bool left_before = turn_of(from, at, x) > 0;
  const bool left_after = turn_of(at, to, x) > 0;
  const int turn = turn_of(from, at, to);
  if (turn == 0) return left_before;
  return turn > 0 ? left_before && left_after : left_before || left_after;
}

template <typename Scalar>
void EarClipper<Scalar>::cut(std::uint32_t c) {
  const std::uint32_t p = previous_[c];
  const std::uint32_t n = next_[c];
  triangles_.push_back({p, c, n});
  next_[p] = n;
  previous_[n] = p;
  is_left_[c] = false;
  --left_;
  if (left_ * 2 < by_x_.size()) {
    std::erase_if(by_x_, [&](std::uint32_t corner) { return !is_left_[corner]; });
  }
}

/// Cuts the corner if it is a fold, and then whatever has become one by that.
template <typename Scalar>
void EarClipper<Scalar>::cut_folds_at(std::uint32_t c) {
  std::vector<std::uint32_t> open = {c};
  while (!open.empty() && left_ > 3) {
    const std::uint32_t corner = open.back();
    open.pop_back();
    if (!is_left_[corner]) continue;
    const std::uint32_t p = previous_[corner];
    const std::uint32_t n = next_[corner];
    const bool is_fold = view_.coincide(outline_[corner], outline_[p]) ||
                         view_.coincide(outline_[corner], outline_[n]) ||
                         (turn_of(p, corner, n) == 0 && !is_between(p, corner, n));
    if (!is_fold) continue;
    cut(corner);
    open.push_back(n);
    open.push_back(p);
  }
}

/// Whether the outline walks an edge twice more often in one direction than back. Then it winds round what is on one
/// side of the edge twice more often than round what is on the other. This is seen at once here; an outline that goes
/// round and round would take long to run out of ears.
template <typename Scalar>
bool EarClipper<Scalar>::goes_the_same_way_again() const {
  using Place = std::array<Scalar, 2>;
  struct Edge {
    Place low, high;
    std::uint32_t from;
    int upwards;
  };
  std::vector<Edge> edges;
  for (const std::uint32_t c : by_x_) {
    if (!is_left_[c]) continue;
    const auto place = [&](std::uint32_t corner) {
      return Place{view_.x(outline_[corner]), view_.y(outline_[corner])};
    };
    const Place from = place(c);
    const Place to = place(next_[c]);
    edges.push_back(from < to ? Edge{from, to, c, 1} : Edge{to, from, c, -1});
  }
  const auto ends = [](const Edge& edge) { return std::pair(edge.low, edge.high); };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return ends(a) < ends(b); });

  // Edges with other ends may lead back. All are counted that contain the piece of this one beside its lower end.
  const auto goes_again_along = [&](const Edge& edge) {
    int upwards = 0;
    for (const Edge& other : edges) {
      if (other.low > edge.low || other.high <= edge.low) continue;
      const auto is_on_line = [&](std::uint32_t corner) { return turn_of(edge.from, next_[edge.from], corner) == 0; };
      if (is_on_line(other.from) && is_on_line(next_[other.from])) upwards += other.upwards;
    }
    return upwards < -1 || upwards > 1;
  };
  for (std::size_t i = 0; i < edges.size();) {
    int upwards = 0;
    const Edge& first = edges[i];
    for (; i < edges.size() && ends(edges[i]) == ends(first); ++i) upwards += edges[i].upwards;
    if ((upwards < -1 || upwards > 1) && goes_again_along(first)) return true;
  }
  return false;
}

template <typename Scalar>
std::optional<std::vector<typename EarClipper<Scalar>::Corners>> EarClipper<Scalar>::clip() {
  const auto size = static_cast<std::uint32_t>(outline_.size());
  for (std::uint32_t c = 0; c < size; ++c) cut_folds_at(c);
  if (goes_the_same_way_again()) return std::nullopt;

  // Goes round the outline, but first looks once more at the neighbours of what was cut: in a long ribbon nothing else
  // has become an ear.
  std::uint32_t at = 0;
  std::vector<std::uint32_t> neighbours;
  Kind accepted = Kind::free_ear;
  for (std::size_t refused = 0; left_ > 3;) {
    const bool goes_round = neighbours.empty();
    const std::uint32_t c = goes_round ? first_left(at) : neighbours.back();
    if (goes_round) {
      at = next_[c];
    } else {
      neighbours.pop_back();
    }
    if (is_left_[c] && kind_of(c) <= accepted) {
      const std::uint32_t p = previous_[c];
      const std::uint32_t n = next_[c];
      cut(c);
      cut_folds_at(p);
      cut_folds_at(n);
      neighbours.push_back(p);
      neighbours.push_back(n);
      accepted = Kind::free_ear;
      refused = 0;
    } else if (goes_round && ++refused == left_) {
      if (accepted == Kind::straight) return std::nullopt;
      accepted = accepted == Kind::free_ear ? Kind::touched_ear : Kind::straight;
      refused = 0;
    }
  }
  const std::uint32_t c = first_left(at);
  if (turn_of(previous_[c], c, next_[c]) < 0) return std::nullopt;
  triangles_.push_back({previous_[c], c, next_[c]});
  return std::move(triangles_);
}

template class EarClipper<float>;
template class EarClipper<double>;

}  // namespace surehit::example
