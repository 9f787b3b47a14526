#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "outlines.hpp"
#include "place.hpp"
#include "support/random.hpp"

namespace surehit::test {

/// Returns whether a point is in an open angle: the directions that are left of the way from before over at to after.
[[nodiscard]] inline bool is_left_of_way(const Place& point, const Place& before, const Place& at, const Place& after) {
  const bool left_of_first = turn_of(before, at, point) > 0;
  const bool left_of_second = turn_of(at, after, point) > 0;
  const int turn = turn_of(before, at, after);
  // Out and back: all but the way itself.
  if (turn == 0 && !is_on(at, before, after)) return turn_of(before, at, point) != 0 || is_on(at, before, point);
  return turn > 0 ? left_of_first && left_of_second : turn < 0 ? left_of_first || left_of_second : left_of_first;
}

[[nodiscard]] inline bool is_right_of_way(const Place& point, const Place& before, const Place& at,
                                          const Place& after) {
  return is_left_of_way(point, after, at, before);
}

/// Joins loops to an outline, one after another.
class OutlineJoiner {
 public:
  enum class Side { inside, outside };

  OutlineJoiner(Outline outline, std::vector<Outline> loops, Side side, Random& random)
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
    OutlineJoiner joined = *this;
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

}  // namespace surehit::test
