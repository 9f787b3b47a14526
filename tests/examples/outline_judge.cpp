#include "outline_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace surehit::test {
namespace {

/// Thirds, for centres of triangles, and 512ths, for points beside edges.
constexpr long parts_of_unit = 3 * 1024;

template <typename Point>
mpz_class determinant(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

template <typename Point>
int turn_of(const Point& a, const Point& b, const Point& c) {
  return sgn(determinant(a, b, c));
}

bool is_between(const mpz_class& a, const mpz_class& at, const mpz_class& b) {
  return (a <= at && at <= b) || (b <= at && at <= a);
}

template <typename Point>
bool is_on(const Point& point, const Point& a, const Point& b) {
  return is_between(a.x, point.x, b.x) && is_between(a.y, point.y, b.y) && turn_of(a, b, point) == 0;
}

enum class Where { outside, on_edge, inside };

template <typename Point>
Where where_in(const std::array<Point, 3>& triangle, const Point& point) {
  const auto& [a, b, c] = triangle;
  if ((point.x < a.x && point.x < b.x && point.x < c.x) || (point.x > a.x && point.x > b.x && point.x > c.x)) {
    return Where::outside;
  }
  if ((point.y < a.y && point.y < b.y && point.y < c.y) || (point.y > a.y && point.y > b.y && point.y > c.y)) {
    return Where::outside;
  }
  if (is_on(point, a, b) || is_on(point, b, c) || is_on(point, c, a)) return Where::on_edge;
  const int turn = turn_of(a, b, point);
  return turn != 0 && turn == turn_of(b, c, point) && turn == turn_of(c, a, point) ? Where::inside : Where::outside;
}

/// The exponent of the lowest digit that is not zero.
template <typename Scalar>
int lowest_digit(Scalar x) {
  int exponent = std::ilogb(x);
  Scalar rest = std::scalbn(std::fabs(x), -exponent);
  while (rest != std::floor(rest)) {
    rest *= 2;
    --exponent;
  }
  return exponent;
}

}  // namespace

template <typename Scalar>
OutlineJudge::OutlineJudge(const std::vector<std::array<Scalar, 3>>& outline, std::size_t axis, Random& random) {
  int unit = std::numeric_limits<int>::max();
  for (const auto& corner : outline) {
    for (const Scalar coordinate : corner) {
      if (coordinate != 0) unit = std::min(unit, lowest_digit(coordinate));
    }
  }
  const auto whole = [&](Scalar coordinate) -> mpz_class {
    if (coordinate == 0) return 0;
    const int exponent = lowest_digit(coordinate);
    const mpz_class digits(static_cast<double>(std::scalbn(coordinate, -exponent)));
    return parts_of_unit * (digits << static_cast<mp_bitcnt_t>(exponent - unit));
  };
  for (const auto& corner : outline) corners_.push_back({whole(corner[(axis + 1) % 3]), whole(corner[(axis + 2) % 3])});

  const std::size_t size = corners_.size();
  for (std::size_t i = 0; i < size; ++i) {
    const Point& a = corners_[i];
    const Point& b = corners_[(i + 1) % size];
    doubled_area_ += a.x * b.y - a.y * b.x;
    look_at(a);
    const Point middle = {(a.x + b.x) / 2, (a.y + b.y) / 2};
    look_at(middle);
    // To the left and to the right of it.
    for (const int side : {-1, 1}) look_at({middle.x - side * (b.y - a.y) / 512, middle.y + side * (b.x - a.x) / 512});
    const Point& c = corners_[(i + 2) % size];
    look_at({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3});
  }
  const auto [left, right] =
      std::minmax_element(corners_.begin(), corners_.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  const auto [low, high] =
      std::minmax_element(corners_.begin(), corners_.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
  for (std::size_t i = 0; i < size; ++i) {
    const mpz_class across(static_cast<unsigned long>(random.below(4096)));
    const mpz_class up(static_cast<unsigned long>(random.below(4096)));
    look_at({left->x + (right->x - left->x) * across / 4096, low->y + (high->y - low->y) * up / 4096});
  }
}

/// Notes how often the outline winds round the point.
void OutlineJudge::look_at(const Point& point) {
  Sample sample{point, false, 0};
  for (std::size_t i = 0; i < corners_.size() && !sample.is_on_outline; ++i) {
    const Point& a = corners_[i];
    const Point& b = corners_[(i + 1) % corners_.size()];
    sample.is_on_outline = is_on(point, a, b);
    if ((a.y <= point.y) == (b.y <= point.y)) continue;
    const int turn = turn_of(a, b, point);
    if (turn > 0 && a.y < b.y) ++sample.winding;
    if (turn < 0 && a.y > b.y) --sample.winding;
  }
  if (!sample.is_on_outline) {
    winds_left_ = std::max(winds_left_, sample.winding);
    winds_right_ = std::max(winds_right_, -sample.winding);
  }
  samples_.push_back(sample);
}

std::string OutlineJudge::complaint(const Triangles& triangles, bool is_reversed) const {
  if (std::string text = complaint_about_rim(triangles, is_reversed); !text.empty()) return text;
  const int turn = (is_reversed ? -1 : 1) * sgn(doubled_area_);
  mpz_class area;
  for (const auto& [a, b, c] : triangles) {
    const mpz_class triangle_area = determinant(corners_[a], corners_[b], corners_[c]);
    if (triangle_area != 0 && sgn(triangle_area) != turn) return "a triangle turns the other way";
    area += triangle_area;
  }
  return abs(area) == abs(doubled_area_) ? "" : "the areas do not sum up to the polygon's";
}

std::string OutlineJudge::complaint_about_cover(const Triangles& triangles) const {
  std::vector<std::array<Point, 3>> points;
  for (const auto& [a, b, c] : triangles) points.push_back({corners_[a], corners_[b], corners_[c]});

  const auto complaint_at = [&](const Point& point, bool is_on_outline, bool is_inside) {
    int inside = 0;
    bool is_covered = false;
    for (const auto& triangle : points) {
      const Where where = where_in(triangle, point);
      if (where == Where::inside) ++inside;
      is_covered |= where != Where::outside;
    }
    if (inside > 1) return "a point is in two triangles";
    if (is_covered) return is_on_outline || is_inside ? "" : "a point outside is covered";
    if (is_on_outline) return "a point on the outline is not covered";
    return is_inside ? "a point inside is not covered" : "";
  };
  for (const Sample& sample : samples_) {
    const std::string text = complaint_at(sample.point, sample.is_on_outline, sample.winding != 0);
    if (!text.empty()) return text;
  }
  for (const auto& [a, b, c] : points) {
    if (turn_of(a, b, c) == 0) continue;
    const std::string text = complaint_at({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3}, false, true);
    if (!text.empty()) return text;
  }
  return "";
}

/// Whether there are the right number of triangles of the outline's corners, and whether their edges cancel each other
/// until the outline is left: then they join without a gap, and neighbours as well, however bent all is.
std::string OutlineJudge::complaint_about_rim(const Triangles& triangles, bool is_reversed) const {
  const auto size = static_cast<std::uint32_t>(corners_.size());
  if (triangles.size() + 2 != size) return "there are " + std::to_string(triangles.size()) + " triangles";
  std::map<std::array<std::uint32_t, 2>, int> walked;
  const auto walk = [&](std::uint32_t from, std::uint32_t to, int times) {
    if (from > to) return void(walked[{to, from}] -= times);
    walked[{from, to}] += times;
  };
  for (const auto& [a, b, c] : triangles) {
    if (std::max({a, b, c}) >= size) return "a corner is not one of the polygon's";
    if (a == b || b == c || c == a) return "a triangle has a corner twice";
    walk(a, b, 1);
    walk(b, c, 1);
    walk(c, a, 1);
  }
  for (std::uint32_t i = 0; i < size; ++i) walk(i, (i + 1) % size, is_reversed ? 1 : -1);
  for (const auto& [edge, times] : walked) {
    if (times != 0) return "the edge " + std::to_string(edge[0]) + " " + std::to_string(edge[1]) + " is left open";
  }
  return "";
}

template <typename Scalar>
std::vector<OutlineJudge> judges_of(const std::vector<std::array<Scalar, 3>>& outline, Random& random) {
  std::vector<OutlineJudge> all;
  mpz_class largest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.emplace_back(outline, axis, random);
    largest = std::max(largest, mpz_class(abs(all.back().doubled_area())));
  }
  std::vector<OutlineJudge> judges;
  for (OutlineJudge& judge : all) {
    if (5 * abs(judge.doubled_area()) >= largest) judges.push_back(std::move(judge));
  }
  return judges;
}

template OutlineJudge::OutlineJudge(const std::vector<std::array<float, 3>>&, std::size_t, Random&);
template OutlineJudge::OutlineJudge(const std::vector<std::array<double, 3>>&, std::size_t, Random&);
template std::vector<OutlineJudge> judges_of(const std::vector<std::array<float, 3>>&, Random&);
template std::vector<OutlineJudge> judges_of(const std::vector<std::array<double, 3>>&, Random&);

}  // namespace surehit::test
