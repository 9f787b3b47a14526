#include "outlines.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>
#include <set>

namespace surehit::test {
namespace {

std::int64_t determinant(const Place& a, const Place& b, const Place& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

int turn_of(const Place& a, const Place& b, const Place& c) {
  const std::int64_t d = determinant(a, b, c);
  return d < 0 ? -1 : d > 0 ? 1 : 0;
}

bool is_on(const Place& point, const Place& a, const Place& b) {
  const auto between = [&](std::size_t i) {
    return std::min(a[i], b[i]) <= point[i] && point[i] <= std::max(a[i], b[i]);
  };
  return turn_of(a, b, point) == 0 && between(0) && between(1);
}

bool meet(const Place& a, const Place& b, const Place& c, const Place& d) {
  if (is_on(a, c, d) || is_on(b, c, d) || is_on(c, a, b) || is_on(d, a, b)) return true;
  return turn_of(a, b, c) * turn_of(a, b, d) < 0 && turn_of(c, d, a) * turn_of(c, d, b) < 0;
}

/// Whether point is in an open angle: the directions that are left of the way from before over at to after.
bool is_left_of_way(const Place& point, const Place& before, const Place& at, const Place& after) {
  const bool left_of_first = turn_of(before, at, point) > 0;
  const bool left_of_second = turn_of(at, after, point) > 0;
  const int turn = turn_of(before, at, after);
  // Out and back: all but the way itself.
  if (turn == 0 && !is_on(at, before, after)) return turn_of(before, at, point) != 0 || is_on(at, before, point);
  return turn > 0 ? left_of_first && left_of_second : turn < 0 ? left_of_first || left_of_second : left_of_first;
}

bool is_right_of_way(const Place& point, const Place& before, const Place& at, const Place& after) {
  return is_left_of_way(point, after, at, before);
}

std::int64_t doubled_area(const Outline& outline) {
  std::int64_t area = 0;
  for (std::size_t i = 2; i < outline.size(); ++i) area += determinant(outline[0], outline[i - 1], outline[i]);
  return area;
}

void wind_left(Outline& outline) {
  if (doubled_area(outline) < 0) std::reverse(outline.begin(), outline.end());
}

Outline scaled(Outline outline, std::int64_t factor) {
  for (Place& corner : outline) corner = {corner[0] * factor, corner[1] * factor};
  return outline;
}

Outline shifted(Outline outline, const Place& by) {
  for (Place& corner : outline) corner = {corner[0] + by[0], corner[1] + by[1]};
  return outline;
}

/// Turns pieces of the outline round until no two of its edges meet. Whatever is done to it is done to `companion`.
bool untangle(Outline& outline, Outline& companion) {
  const std::size_t size = outline.size();
  const auto turn_one_round = [&] {
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = i + 2; j < size; ++j) {
        if ((j + 1) % size == i || !meet(outline[i], outline[i + 1], outline[j], outline[(j + 1) % size])) continue;
        for (Outline* const each : {&outline, &companion}) {
          std::reverse(each->begin() + static_cast<std::ptrdiff_t>(i) + 1,
                       each->begin() + static_cast<std::ptrdiff_t>(j) + 1);
        }
        return true;
      }
    }
    return false;
  };
  for (std::size_t rounds = 0; rounds < 100 * size; ++rounds) {
    if (!turn_one_round()) return true;
  }
  return false;
}

/// Whether the outline folds back over itself somewhere.
bool has_fold(const Outline& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Place& before = outline[(i + outline.size() - 1) % outline.size()];
    const Place& after = outline[(i + 1) % outline.size()];
    if (turn_of(before, outline[i], after) == 0 && !is_on(outline[i], before, after)) return true;
  }
  return false;
}

std::set<Place> draw_places(std::size_t count, std::int64_t size, Random& random) {
  std::set<Place> places;
  while (places.size() < count) places.insert({random.between(-size, size), random.between(-size, size)});
  return places;
}

/// Joins loops to an outline, one after another.
class Joiner {
 public:
  enum class Side { inside, outside };

  Joiner(Outline outline, std::vector<Outline> loops, Side side, Random& random)
      : outline_(std::move(outline)), loops_(std::move(loops)), side_(side), random_(random) {}

  /// Leaves out what it finds no bridge to.
  Outline join_all() {
    for (std::size_t tries = 0; tries < 2000 && !loops_.empty(); ++tries) join_one();
    return outline_;
  }

  /// Goes from a corner to some place and back.
  bool add_spike(const Place& tip) {
    const std::size_t i = random_.below(outline_.size());
    const Place foot = outline_[i];
    // A tip on another corner would hide which of both an outline that goes on from there comes from.
    if (std::find(outline_.begin(), outline_.end(), tip) != outline_.end()) return false;
    if (!may_leave(outline_, i, tip) || !is_clear(foot, tip)) return false;
    insert(i, {tip, foot});
    return true;
  }

  [[nodiscard]] const Outline& outline() const { return outline_; }

 private:
  void join_one() {
    const std::size_t which = random_.below(loops_.size());
    const Outline& loop = loops_[which];
    const std::size_t i = random_.below(outline_.size());
    const std::size_t j = random_.below(loop.size());
    Outline way(loop.begin() + static_cast<std::ptrdiff_t>(j), loop.end());
    way.insert(way.end(), loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(j));
    const Place from = outline_[i];
    const Place to = way.front();

    if (from == to) {
      if (!may_leave(outline_, i, way[1]) || !may_leave(outline_, i, way.back())) return;
      if (random_.one_in(2)) {
        way.push_back(to);
      } else {
        way.erase(way.begin());
      }
    } else if (random_.one_in(3)) {
      const Place bend = {(from[0] + to[0]) / 2 + random_.between(-9, 9),
                          (from[1] + to[1]) / 2 + random_.between(-9, 9)};
      if (turn_of(from, bend, to) == 0 || !may_leave(outline_, i, bend) || !may_leave(loop, j, bend) ||
          !is_clear(from, bend) || !is_clear(bend, to)) {
        return;
      }
      way.insert(way.begin(), bend);
      way.insert(way.end(), {to, bend});
    } else {
      if (!may_leave(outline_, i, to) || !may_leave(loop, j, from) || !is_clear(from, to)) return;
      way.push_back(to);
    }
    way.push_back(from);
    Joiner joined = *this;
    joined.insert(i, way);
    joined.loops_.erase(joined.loops_.begin() + static_cast<std::ptrdiff_t>(which));
    if (joined.crosses_in_a_corner()) return;
    outline_ = joined.outline_;
    loops_ = joined.loops_;
  }

  void insert(std::size_t i, const Outline& way) {
    outline_.insert(outline_.begin() + static_cast<std::ptrdiff_t>(i) + 1, way.begin(), way.end());
  }

  /// Whether one way through a place leads from one side of another to the other side of it.
  [[nodiscard]] bool crosses_in_a_corner() const {
    std::map<Place, std::vector<std::array<Place, 2>>> ways;
    const auto add_ways = [&](const Outline& outline) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        std::size_t before = i;
        std::size_t after = i;
        while (outline[before] == outline[i]) before = (before + outline.size() - 1) % outline.size();
        while (outline[after] == outline[i]) after = (after + 1) % outline.size();
        ways[outline[i]].push_back({outline[before], outline[after]});
      }
    };
    add_ways(outline_);
    for (const Outline& loop : loops_) add_ways(loop);
    for (const auto& [at, all] : ways) {
      for (const auto& [before, after] : all) {
        if (turn_of(before, at, after) == 0 && !is_on(at, before, after)) continue;
        for (const auto& [from, to] : all) {
          const bool from_left = is_left_of_way(from, before, at, after);
          const bool to_left = is_left_of_way(to, before, at, after);
          const bool from_right = is_right_of_way(from, before, at, after);
          const bool to_right = is_right_of_way(to, before, at, after);
          if ((from_left && to_right) || (from_right && to_left)) return true;
        }
      }
    }
    return false;
  }

  [[nodiscard]] bool may_leave(const Outline& outline, std::size_t i, const Place& towards) const {
    const Place& before = outline[(i + outline.size() - 1) % outline.size()];
    const Place& after = outline[(i + 1) % outline.size()];
    return side_ == Side::inside ? is_left_of_way(towards, before, outline[i], after)
                                 : is_right_of_way(towards, before, outline[i], after);
  }

  /// Whether from and to, which may be corners, have nothing between them.
  [[nodiscard]] bool is_clear(const Place& from, const Place& to) const {
    const auto is_edge_clear = [&](const Place& a, const Place& b) {
      const bool a_is_end = a == from || a == to;
      const bool b_is_end = b == from || b == to;
      if (a_is_end && b_is_end) return false;
      if (!a_is_end && !b_is_end) return !meet(a, b, from, to);
      const Place& end = a_is_end ? a : b;
      const Place& beyond = a_is_end ? b : a;
      const Place& far = end == from ? to : from;
      return turn_of(end, beyond, far) != 0 || is_on(end, beyond, far);
    };
    const auto is_outline_clear = [&](const Outline& outline) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        if (!is_edge_clear(outline[i], outline[(i + 1) % outline.size()])) return false;
      }
      return true;
    };
    return is_outline_clear(outline_) && std::all_of(loops_.begin(), loops_.end(), is_outline_clear);
  }

  Outline outline_;
  std::vector<Outline> loops_;
  Side side_;
  Random& random_;
};

/// In a square of 12 × 12, winding to the left. One of the kinds reaches the middle of each side, another a corner.
Outline draw_pane(bool may_touch, Random& random) {
  const std::int64_t low = random.between(1, 4);
  const std::int64_t high = random.between(7, 11);
  switch (random.below(may_touch ? 6 : 4)) {
    case 0:
      return {{low, low}, {high, low}, {high, high}, {low, high}};
    case 1:
      return {{low, 2}, {high, 5}, {low + 2, 10}};
    case 2:
      return {{low, low}, {high, low}, {high, 5}, {5, 5}, {5, high}, {low, high}};
    case 3:
      return {{2, low}, {6, 5}, {10, low}, {high, 10}, {6, 9}, {2, 10}};
    case 4:
      return {{6, 0}, {12, 6}, {6, 12}, {0, 6}};
    default:
      return {{0, 0}, {11, 3}, {3, 11}};
  }
}

}  // namespace

Outline draw_star(std::size_t corner_count, std::int64_t radius, Random& random) {
  // Half an axis each, so that no two neighbours are half a turn apart.
  std::vector<Place> places = {{radius, 0}, {0, radius}, {-radius, 0}, {0, -radius}};
  while (places.size() < corner_count) {
    const Place place = {random.between(-radius, radius), random.between(-radius, radius)};
    if (place != Place{0, 0}) places.push_back(place);
  }
  const auto is_lower = [](const Place& place) { return place[1] < 0 || (place[1] == 0 && place[0] < 0); };
  const auto comes_before = [&](const Place& a, const Place& b) {
    if (is_lower(a) != is_lower(b)) return is_lower(b);
    return turn_of({0, 0}, a, b) > 0;
  };
  std::stable_sort(places.begin(), places.end(), comes_before);
  // One of each direction.
  places.erase(std::unique(places.begin(), places.end(),
                           [&](const Place& a, const Place& b) { return !comes_before(a, b) && !comes_before(b, a); }),
               places.end());
  return places;
}

Outline draw_comb(std::size_t tooth_count, Random& random) {
  const bool is_pointed = random.one_in(2);
  Outline comb = {{0, 0}};
  for (auto x = static_cast<std::int64_t>(2 * tooth_count + 1); x > 1; x -= 2) {
    if (comb.size() == 1) comb.push_back({x, 0});
    const std::int64_t height = random.between(5, 60);
    comb.push_back({x, height});
    if (!is_pointed) comb.insert(comb.end(), {{x - 1, height}, {x - 1, 2}});
    comb.push_back({x - 2, 2});
  }
  comb.push_back({0, 3});
  return comb;
}

Outline draw_spiral(std::size_t turn_count) {
  // The outer wall inwards, then the inner one back out, a unit beside it.
  constexpr std::array<Place, 4> directions = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  Outline out = {{0, 0}};
  Outline back = {{0, 1}};
  Place at = {0, 0};
  const std::size_t leg_count = 4 * turn_count;
  std::int64_t length = static_cast<std::int64_t>(leg_count) + 4;
  for (std::size_t leg = 0; leg < leg_count; ++leg) {
    const Place& direction = directions[leg % 4];
    const Place& next_direction = directions[(leg + 1) % 4];
    at = {at[0] + direction[0] * length, at[1] + direction[1] * length};
    out.push_back(at);
    back.push_back({at[0] - direction[0] + next_direction[0], at[1] - direction[1] + next_direction[1]});
    if (leg % 2 == 1) length -= 2;
  }
  // Both ends are cut straight.
  const Place& side = directions[leg_count % 4];
  back.back() = {at[0] + side[0], at[1] + side[1]};
  out.insert(out.end(), back.rbegin(), back.rend());
  return out;
}

Outline draw_untangled(std::size_t corner_count, std::int64_t size, Random& random) {
  for (;;) {
    const std::set<Place> places = draw_places(corner_count, size, random);
    Outline outline(places.begin(), places.end());
    for (std::size_t i = outline.size(); i > 1; --i) std::swap(outline[i - 1], outline[random.below(i)]);
    Outline companion = outline;
    if (!untangle(outline, companion) || has_fold(outline)) continue;
    wind_left(outline);
    return outline;
  }
}

Outline draw_letter(Random& random) {
  const std::vector<Outline> letters = {
      {{0, 0}, {8, 0}, {8, 3}, {3, 3}, {3, 9}, {0, 9}},                                                    // L
      {{0, 0}, {9, 0}, {9, 9}, {6, 9}, {6, 3}, {3, 3}, {3, 9}, {0, 9}},                                    // U
      {{3, 0}, {6, 0}, {6, 6}, {9, 6}, {9, 9}, {0, 9}, {0, 6}, {3, 6}},                                    // T
      {{3, 0}, {6, 0}, {6, 3}, {9, 3}, {9, 6}, {6, 6}, {6, 9}, {3, 9}, {3, 6}, {0, 6}, {0, 3}, {3, 3}},    // +
      {{0, 0}, {9, 0}, {9, 2}, {2, 2}, {2, 4}, {9, 4}, {9, 6}, {2, 6}, {2, 8}, {9, 8}, {9, 10}, {0, 10}},  // E
      {{-4, 4}, {0, 0}, {4, 4}, {0, 2}},                                                                   // a dart
  };
  return letters[random.below(letters.size())];
}

Outline draw_convex(std::size_t point_count, std::int64_t size, Random& random) {
  for (;;) {
    const std::set<Place> places = draw_places(point_count, size, random);
    // The lower half from left to right, the upper half back.
    Outline hull;
    const auto add_half = [&](auto begin, auto end) {
      const std::size_t start = hull.size();
      for (auto place = begin; place != end; ++place) {
        while (hull.size() >= start + 2 && turn_of(hull[hull.size() - 2], hull.back(), *place) <= 0) hull.pop_back();
        hull.push_back(*place);
      }
      hull.pop_back();
    };
    add_half(places.begin(), places.end());
    add_half(places.rbegin(), places.rend());
    if (hull.size() >= 4) return hull;
  }
}

Outline draw_simple(Random& random) {
  switch (random.below(6)) {
    case 0:
      return draw_star(6 + random.below(20), 30, random);
    case 1:
      return draw_comb(1 + random.below(5), random);
    case 2:
      return draw_spiral(1 + random.below(3));
    case 3:
      return draw_untangled(5 + random.below(18), 25, random);
    case 4:
      return draw_letter(random);
    default:
      return draw_convex(8 + random.below(10), 20, random);
  }
}

Outline draw_rim_of_squares(std::size_t square_count, Random& random) {
  constexpr std::array<Place, 4> directions = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  std::vector<Place> squares = {{0, 0}};
  std::set<Place> taken = {{0, 0}};
  while (squares.size() < square_count) {
    const Place& square = squares[random.below(squares.size())];
    const Place& direction = directions[random.below(4)];
    const Place next = {square[0] + direction[0], square[1] + direction[1]};
    if (taken.insert(next).second) squares.push_back(next);
  }
  // Edges that have a square to the left and none to the right, from the lowest square on.
  const auto is_edge = [&](const Place& at, std::size_t towards) {
    const Place& ahead = directions[towards];
    const Place& left = directions[(towards + 1) % 4];
    const auto square = [](const Place& middle) -> Place { return {(middle[0] - 1) / 2, (middle[1] - 1) / 2}; };
    const auto middle = [&](std::int64_t side) -> Place {
      // Doubled, and far from zero so that the division goes down.
      return {2 * at[0] + ahead[0] + side * left[0] + 2000, 2 * at[1] + ahead[1] + side * left[1] + 2000};
    };
    const auto is_taken = [&](std::int64_t side) {
      const Place found = square(middle(side));
      return taken.count({found[0] - 1000, found[1] - 1000}) != 0;
    };
    return is_taken(1) && !is_taken(-1);
  };
  const Place start = *std::min_element(squares.begin(), squares.end(), [](const Place& a, const Place& b) {
    return a[1] != b[1] ? a[1] < b[1] : a[0] < b[0];
  });
  const bool stays_with_square = random.one_in(2);
  const bool keeps_all = random.one_in(2);
  Outline rim;
  Place at = start;
  std::size_t towards = 0;
  do {
    at = {at[0] + directions[towards][0], at[1] + directions[towards][1]};
    const std::size_t left = (towards + 1) % 4;
    const std::size_t right = (towards + 3) % 4;
    const std::size_t first = stays_with_square ? left : right;
    const std::size_t second = stays_with_square ? right : left;
    const std::size_t onwards = is_edge(at, first) ? first : is_edge(at, towards) ? towards : second;
    if (onwards != towards || keeps_all) rim.push_back(at);
    towards = onwards;
  } while (at != start || towards != 0);
  return scaled(rim, 3);
}

Outline draw_wall(std::size_t window_count, bool may_touch, Random& random) {
  const std::int64_t columns = random.between(1, 4);
  const std::int64_t rows = (static_cast<std::int64_t>(window_count) + columns - 1) / columns;
  std::vector<Outline> windows;
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(window_count); ++i) {
    windows.push_back(scaled(shifted(draw_pane(may_touch, random), {12 * (i % columns), 12 * (i / columns)}), 2));
    std::reverse(windows.back().begin(), windows.back().end());
  }
  const std::int64_t width = 24 * columns;
  const std::int64_t height = 24 * rows;
  Outline wall = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  if (random.one_in(3)) wall = {{0, 0}, {width / 2, -60}, {width, 0}, {width + 9, height}, {-5, height}};
  return Joiner(wall, windows, Joiner::Side::inside, random).join_all();
}

Outline draw_islands(std::size_t island_count, Random& random) {
  std::vector<Outline> islands;
  for (std::int64_t i = 1; i < static_cast<std::int64_t>(island_count); ++i) {
    islands.push_back(scaled(shifted(draw_pane(false, random), {14 * (i % 3), 14 * (i / 3)}), 2));
  }
  return Joiner(scaled(draw_pane(false, random), 2), islands, Joiner::Side::outside, random).join_all();
}

Outline draw_crowded(std::size_t corner_count, std::int64_t size, Random& random) {
  for (;;) {
    Outline places;
    Outline nearby;
    for (std::size_t i = 0; i < corner_count; ++i) {
      const Place place = {random.between(0, size), random.between(0, size)};
      // So near that an edge passes another place on one side of it, unless the place is on the edge.
      constexpr std::int64_t unit = 1 << 20;
      constexpr std::int64_t near = 1 << 10;
      places.push_back(place);
      nearby.push_back({place[0] * unit + random.between(-near, near), place[1] * unit + random.between(-near, near)});
    }
    if (!untangle(nearby, places)) continue;
    if (doubled_area(nearby) < 0) std::reverse(places.begin(), places.end());
    return places;
  }
}

Outline with_corners_on_edges(const Outline& outline, std::int64_t factor, Random& random) {
  Outline result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Place& from = outline[i];
    const Place& to = outline[(i + 1) % outline.size()];
    result.push_back({from[0] * factor, from[1] * factor});
    for (std::int64_t part = 1; part < factor; ++part) {
      if (!random.one_in(3)) continue;
      result.push_back({from[0] * (factor - part) + to[0] * part, from[1] * (factor - part) + to[1] * part});
    }
  }
  return result;
}

Outline with_repeated_corners(const Outline& outline, Random& random) {
  Outline result;
  for (const Place& corner : outline) result.insert(result.end(), random.one_in(3) ? 1 + random.below(3) : 1, corner);
  if (random.one_in(2)) result.push_back(result.front());
  return result;
}

Outline with_folded_edges(const Outline& outline, Random& random) {
  constexpr std::int64_t parts = 4;
  Outline result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Place& from = outline[i];
    const Place& to = outline[(i + 1) % outline.size()];
    const auto at = [&](std::int64_t part) -> Place {
      return {from[0] * (parts - part) + to[0] * part, from[1] * (parts - part) + to[1] * part};
    };
    result.push_back(at(0));
    if (!random.one_in(4)) continue;
    const std::int64_t far = random.between(1, parts);
    result.push_back(at(far));
    result.push_back(at(random.between(0, far)));
  }
  return result;
}

Outline with_spikes(const Outline& outline, std::size_t count, Random& random) {
  Outline result = scaled(outline, 4);
  std::size_t found = 0;
  for (std::size_t tries = 0; tries < 200 && found < count; ++tries) {
    const auto side = random.one_in(2) ? Joiner::Side::inside : Joiner::Side::outside;
    Joiner joiner(result, {}, side, random);
    const Place& near = result[random.below(result.size())];
    if (!joiner.add_spike({near[0] + random.between(-12, 12), near[1] + random.between(-12, 12)})) continue;
    result = joiner.outline();
    ++found;
  }
  return result;
}

}  // namespace surehit::test
