#include "outlines.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <set>
#include <sstream>

#include "outline_joiner.hpp"

namespace surehit::test {
namespace {

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

std::string text_of(const Outline& outline) {
  std::ostringstream text;
  for (const Place& place : outline) text << " {" << place[0] << ", " << place[1] << "}";
  return text.str();
}

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
  return OutlineJoiner(wall, windows, OutlineJoiner::Side::inside, random).join_all();
}

Outline draw_islands(std::size_t island_count, Random& random) {
  std::vector<Outline> islands;
  for (std::int64_t i = 1; i < static_cast<std::int64_t>(island_count); ++i) {
    islands.push_back(scaled(shifted(draw_pane(false, random), {14 * (i % 3), 14 * (i / 3)}), 2));
  }
  return OutlineJoiner(scaled(draw_pane(false, random), 2), islands, OutlineJoiner::Side::outside, random).join_all();
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
    const auto side = random.one_in(2) ? OutlineJoiner::Side::inside : OutlineJoiner::Side::outside;
    OutlineJoiner joiner(result, {}, side, random);
    const Place& near = result[random.below(result.size())];
    if (!joiner.add_spike({near[0] + random.between(-12, 12), near[1] + random.between(-12, 12)})) continue;
    result = joiner.outline();
    ++found;
  }
  return result;
}

}  // namespace surehit::test
