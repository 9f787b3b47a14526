#include "mesh_io/triangulate.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <string>

#include "exact_outline.hpp"
#include "outline_judge.hpp"
#include "outlines.hpp"
#include "placed_outline.hpp"
#include "support/case_count.hpp"
#include "support/neighbour.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"

namespace surehit::test::triangulate_test {
namespace {

using Corners = std::vector<std::uint32_t>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Triangles fan_of(const Corners& corners) {
  Triangles fan;
  for (std::size_t i = 2; i < corners.size(); ++i) fan.push_back({corners[0], corners[i - 1], corners[i]});
  return fan;
}

/// A size at which bent outlines of whole numbers stay as they are, as far as products overflow and underflow.
template <typename Scalar>
int draw_exponent(Random& random) {
  constexpr int most = std::numeric_limits<Scalar>::max_exponent * 3 / 4;
  return static_cast<int>(random.between(-most, most));
}

template <typename Scalar>
std::string message_of(const Vertices<Scalar>& vertices, const Corners& corners) {
  std::ostringstream text;
  text << std::hexfloat << "the outline";
  for (const std::uint32_t corner : corners) {
    const auto& [x, y, z] = vertices[corner];
    text << " {" << x << ", " << y << ", " << z << "}";
  }
  return text.str();
}

/// In whole numbers so small that sums are exact.
std::int64_t doubled_area(const Outline& outline, const Corners& corners) {
  std::int64_t area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Place& a = outline[corners[i]];
    const Place& b = outline[corners[(i + 1) % corners.size()]];
    area += a[0] * b[1] - a[1] * b[0];
  }
  return area;
}

/// All positions in the outline from one of them on, or back.
Corners corners_from(std::size_t start, bool is_reversed, std::size_t size) {
  Corners corners(size);
  for (std::size_t i = 0; i < size; ++i) {
    corners[i] = static_cast<std::uint32_t>((is_reversed ? start + size - i : start + i) % size);
  }
  return corners;
}

enum class Shape { plane, nearly_plane };

/// From every corner on and in both directions. A plane outline is cut rightly if and only if it is so as seen along
/// any axis from out of its plane. For a bent one, being right along one is enough.
template <typename Scalar>
void expect_cut(const Vertices<Scalar>& vertices, Shape shape, Random& random, int& fans) {
  const std::vector<OutlineJudge> judges = judges_of(vertices, random);
  for (const OutlineJudge& judge : judges)
    ASSERT_TRUE(shape != Shape::plane || judge.winds_once()) << "not weakly simple";
  const std::size_t size = vertices.size();
  for (std::size_t i = 0; i < 2 * size; ++i) {
    const bool is_reversed = i >= size;
    const Corners corners = corners_from(i % size, is_reversed, size);
    Triangles triangles = {{7, 8, 9}};
    ASSERT_TRUE(example::triangulate(vertices, corners, triangles)) << message_of(vertices, corners);
    ASSERT_EQ(triangles.front(), (Triangles::value_type{7, 8, 9}));
    triangles.erase(triangles.begin());

    const Triangles fan = fan_of(corners);
    if (triangles == fan) ++fans;
    const bool looks_at_points = random.one_in(4);
    std::string complaint;
    for (const OutlineJudge& judge : judges) {
      complaint = judge.complaint(triangles, is_reversed);
      if (complaint.empty() && looks_at_points) complaint = judge.complaint_about_cover(triangles);
      if (complaint.empty() == (shape == Shape::nearly_plane)) break;
    }
    ASSERT_EQ(complaint, "") << message_of(vertices, corners);
    if (shape == Shape::plane && triangles != fan && judges[0].doubled_area() != 0) {
      ASSERT_NE(judges[0].complaint(fan, is_reversed), "") << "not the fan: " << message_of(vertices, corners);
    }
  }
}

template <typename Scalar>
class Triangulate : public testing::Test {
 protected:
  /// Keeps the outline as it is: in some plane, of some size, without rounding.
  void expect_cut_where_it_is_exact(const Outline& outline, Random& random) {
    constexpr int lowest = std::numeric_limits<Scalar>::min_exponent - std::numeric_limits<Scalar>::digits;
    constexpr int highest = std::numeric_limits<Scalar>::max_exponent - 13;
    const int exponent = random.one_in(2) ? 0 : static_cast<int>(random.between(lowest, highest));
    const Plane plane = random.one_in(2) ? draw_axis_plane(random) : draw_whole_plane(random);
    expect_cut(placed<Scalar>(outline, plane, exponent), Shape::plane, random, fans_);
    if (this->HasFatalFailure()) ADD_FAILURE() << "drawn as" << text_of(outline);
  }

  /// Rounded to some plane, and bent, in which corners that coincide stay together.
  void expect_cut_where_it_is_moved(const Outline& outline, Random& random) {
    const int exponent = draw_exponent<Scalar>(random);
    expect_cut(placed<Scalar>(outline, draw_plane(random), exponent), Shape::nearly_plane, random, fans_);
    expect_cut(bent<Scalar>(outline, draw_plane(random), 0x1p-13, random, exponent), Shape::nearly_plane, random,
               fans_);
    expect_cut(bent<Scalar>(outline, draw_axis_plane(random), 0.5, random, exponent), Shape::nearly_plane, random,
               fans_);
    if (this->HasFatalFailure()) ADD_FAILURE() << "drawn as" << text_of(outline);
  }

  /// `draw` makes an outline of Random.
  template <typename Draw>
  void expect_all_cut(std::size_t cases, bool may_be_moved, Draw draw) {
    Random random(1);
    for (std::size_t i = 0; i < case_count(cases) && !this->HasFatalFailure(); ++i) {
      const Outline outline = draw(random);
      expect_cut_where_it_is_exact(outline, random);
      if (may_be_moved) expect_cut_where_it_is_moved(outline, random);
    }
  }

  int fans_ = 0;
};

TYPED_TEST_SUITE(Triangulate, Scalars, ScalarNames);

TYPED_TEST(Triangulate, cuts_simple_polygons) {
  this->expect_all_cut(30, true, draw_simple);
  if (!runs_all_cases()) return;
  EXPECT_GT(this->fans_, 100);
}

TYPED_TEST(Triangulate, cuts_polygons_with_corners_on_their_edges) {
  this->expect_all_cut(10, true, [](Random& random) { return with_corners_on_edges(draw_simple(random), 3, random); });
}

TYPED_TEST(Triangulate, cuts_rectilinear_polygons) {
  this->expect_all_cut(12, true, [](Random& random) { return draw_rim_of_squares(4 + random.below(25), random); });
}

TYPED_TEST(Triangulate, cuts_walls_with_windows) {
  this->expect_all_cut(4, true, [](Random& random) { return draw_wall(1 + random.below(5), false, random); });
}

TYPED_TEST(Triangulate, cuts_walls_with_windows_that_touch) {
  this->expect_all_cut(16, false, [](Random& random) { return draw_wall(1 + random.below(5), true, random); });
}

TYPED_TEST(Triangulate, cuts_islands_with_bridges) {
  this->expect_all_cut(8, true, [](Random& random) { return draw_islands(2 + random.below(4), random); });
}

TYPED_TEST(Triangulate, cuts_polygons_with_slits_and_antennas) {
  this->expect_all_cut(15, true,
                       [](Random& random) { return with_spikes(draw_simple(random), 1 + random.below(5), random); });
}

TYPED_TEST(Triangulate, cuts_polygons_with_repeated_corners) {
  this->expect_all_cut(12, true, [](Random& random) { return with_repeated_corners(draw_simple(random), random); });
}

TYPED_TEST(Triangulate, cuts_polygons_with_folded_edges) {
  this->expect_all_cut(25, false, [](Random& random) { return with_folded_edges(draw_simple(random), random); });
}

TYPED_TEST(Triangulate, cuts_outlines_that_touch_themselves_in_any_way) {
  this->expect_all_cut(120, false,
                       [](Random& random) { return draw_crowded(4 + random.below(24), random.between(1, 4), random); });
}

/// Earlier versions of the code refused one or the other.
TYPED_TEST(Triangulate, cuts_what_is_hard_to_cut) {
  const std::vector<Outline> outlines = {
      // Two triangles and a bridge that bends: left of the bend is nothing, although it looks like an ear.
      {{0, 0}, {2, 0}, {3, -1}, {3, 1}, {2, 0}, {0, 0}, {0, 2}, {1, 3}, {-1, 3}, {0, 2}},
      {{1, 2}, {2, 2}, {1, 1}, {2, 0}, {0, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}},
      // Three times round the corner at 0, 0: only one of them is on the inside.
      {{1, 4},
       {0, 4},
       {0, 2},
       {0, 0},
       {1, 0},
       {3, 0},
       {4, 0},
       {2, 1},
       {3, 0},
       {0, 0},
       {0, 3},
       {1, 4},
       {1, 2},
       {0, 3},
       {0, 0},
       {1, 0}},
      // Twice down from 2, 2 to 2, 1, and back up by an edge with other ends.
      {{0, 3}, {2, 3}, {2, 2}, {2, 1}, {3, 0}, {2, 0}, {2, 3}, {1, 3}, {2, 2}, {2, 1}},
      // All other ears have corners in them. The bridge leads out to the right, over its first bend and back to the
      // left.
      {{0, -20},
       {20, 20},
       {-20, 20},
       {0, -20},
       {-1, 18},
       {6, 10},
       {0, 19},
       {-4, 16},
       {-1, -10},
       {-6, -8},
       {-4, 16},
       {0, 19},
       {6, 10},
       {-1, 18}},
      // There and back, all the way round a square.
      {{0, 0}, {1, 0}, {1, 1}, {1, 1}, {0, 1}, {0, 0}, {0, 0}, {0, 1}, {0, 1}, {1, 1}, {1, 0}, {1, 0}},
  };
  Random random(1);
  for (const Outline& outline : outlines) {
    expect_cut(placed<TypeParam>(outline, {{1, 0, 0}, {0, 1, 0}, {}}), Shape::plane, random, this->fans_);
    this->expect_cut_where_it_is_exact(outline, random);
  }
}

/// Points that are in one line but for a unit in their last place.
TYPED_TEST(Triangulate, cuts_slivers) {
  Random random(1);
  std::size_t cut = 0;
  for (std::size_t i = 0; i < case_count(1500) && !this->HasFatalFailure(); ++i) {
    Vertices<TypeParam> vertices;
    ExactOutline exact;
    const auto slope = random.symmetric<TypeParam>();
    const auto height = random.symmetric<TypeParam>();
    for (std::size_t j = 4 + random.below(4); j > 0; --j) {
      const auto x = random.symmetric<TypeParam>();
      const TypeParam y = neighbour(slope * x + height, static_cast<int>(random.between(-1, 1)));
      vertices.push_back({x, y, 0});
      exact.push_back({mpq_class(x), mpq_class(y)});
    }
    if (!is_simple(exact)) continue;
    expect_cut(vertices, Shape::plane, random, this->fans_);
    ++cut;
  }
  if (!runs_all_cases()) return;
  EXPECT_GT(cut, 100u);
}

TYPED_TEST(Triangulate, cuts_the_largest_polygons) {
  Random random(1);
  // Differences of these numbers overflow.
  const int exponent = std::numeric_limits<TypeParam>::max_exponent - 3;
  for (std::size_t i = 0; i < case_count(20) && !this->HasFatalFailure(); ++i) {
    Outline crowded = draw_crowded(4 + random.below(12), 14, random);
    for (Place& place : crowded) place = {place[0] - 7, place[1] - 7};
    expect_cut(placed<TypeParam>(crowded, draw_axis_plane(random), exponent), Shape::plane, random, this->fans_);
    const Outline simple = draw_untangled(6 + random.below(8), 7, random);
    expect_cut(bent<TypeParam>(simple, draw_axis_plane(random), 0.25, random, exponent), Shape::nearly_plane, random,
               this->fans_);
  }
}

/// Whatever the fan leaves to be cut has ears with nothing on their edges.
TYPED_TEST(Triangulate, makes_no_triangles_without_area_of_simple_polygons) {
  Random random(1);
  std::size_t looked_at = 0;
  for (std::size_t i = 0; i < case_count(100); ++i) {
    Outline outline = draw_simple(random);
    if (random.one_in(2)) outline = with_corners_on_edges(outline, 3, random);
    const auto vertices = placed<TypeParam>(outline, draw_axis_plane(random));
    for (std::size_t start = 0; start < outline.size(); ++start) {
      const Corners corners = corners_from(start, false, outline.size());
      Triangles triangles;
      ASSERT_TRUE(example::triangulate(vertices, corners, triangles)) << text_of(outline);
      if (triangles == fan_of(corners)) continue;
      for (const auto& [a, b, c] : triangles) ASSERT_NE(doubled_area(outline, {a, b, c}), 0) << text_of(outline);
      ++looked_at;
    }
  }
  if (!runs_all_cases()) return;
  EXPECT_GT(looked_at, 500u);
}

TYPED_TEST(Triangulate, cuts_convex_polygons_into_fans) {
  Random random(1);
  const auto expect_fans = [&](const Vertices<TypeParam>& vertices) {
    for (std::size_t i = 0; i < 2 * vertices.size(); ++i) {
      const Corners corners = corners_from(i % vertices.size(), i >= vertices.size(), vertices.size());
      Triangles triangles;
      ASSERT_TRUE(example::triangulate(vertices, corners, triangles)) << message_of(vertices, corners);
      ASSERT_EQ(triangles, fan_of(corners)) << message_of(vertices, corners);
    }
  };
  for (std::size_t i = 0; i < case_count(200) && !this->HasFatalFailure(); ++i) {
    const Outline outline = draw_convex(5 + random.below(20), 20, random);
    expect_fans(placed<TypeParam>(outline, draw_plane(random)));
    expect_fans(placed<TypeParam>(with_corners_on_edges(outline, 3, random), draw_whole_plane(random)));
  }
}

TYPED_TEST(Triangulate, cuts_what_has_no_area) {
  Random random(1);
  for (std::size_t i = 0; i < case_count(60) && !this->HasFatalFailure(); ++i) {
    const Plane plane = random.one_in(2) ? draw_axis_plane(random) : draw_whole_plane(random);
    const std::size_t size = 4 + random.below(8);
    Outline at_one_place(size, Place{random.between(-9, 9), random.between(-9, 9)});
    Outline on_one_line;
    const Place along = {random.between(-9, 9), random.between(1, 9)};
    for (std::size_t j = 0; j < size; ++j) {
      const std::int64_t steps = random.between(-4, 4);
      on_one_line.push_back({steps * along[0], steps * along[1]});
    }
    const Outline tree = with_spikes({{0, 0}, along}, 4, random);
    for (const Outline& outline : {at_one_place, on_one_line, tree}) {
      if (outline.size() < 4) continue;
      expect_cut(placed<TypeParam>(outline, plane), Shape::plane, random, this->fans_);
    }
  }
}

template <typename Scalar>
void expect_refused(const Vertices<Scalar>& vertices) {
  for (std::size_t i = 0; i < 2 * vertices.size(); ++i) {
    const Corners corners = corners_from(i % vertices.size(), i >= vertices.size(), vertices.size());
    Triangles triangles = {{7, 8, 9}};
    ASSERT_FALSE(example::triangulate(vertices, corners, triangles)) << message_of(vertices, corners);
    ASSERT_EQ(triangles, (Triangles{{7, 8, 9}})) << message_of(vertices, corners);
  }
}

TYPED_TEST(Triangulate, refuses_outlines_that_cross_themselves) {
  const std::vector<Outline> outlines = {
      {{0, 0}, {8, 8}, {8, 0}, {0, 8}},                                  // a bow tie
      {{0, 0}, {9, 3}, {9, 0}, {0, 9}},                                  // with sides of two sizes
      {{0, 0}, {4, 0}, {8, 8}, {8, 0}, {4, 0}, {0, 8}},                  // in one of its corners it only touches itself
      {{0, 10}, {6, -8}, {-10, 3}, {10, 3}, {-6, -8}},                   // a pentagram
      {{0, 0}, {8, 0}, {0, 8}, {0, 0}, {8, 0}, {0, 8}},                  // a loop walked twice
      {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {8, 0}, {8, 8}, {0, 8}},  // another one
      {{0, 0}, {9, 0}, {9, 9}, {3, 9}, {3, -3}, {6, -3}, {6, 6}, {0, 6}},        // over itself
      {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {6, 3}, {6, 6}, {3, 3}},  // a window walked the wrong way
      {{0, 0}, {6, 0}, {6, 4}, {0, 4}, {0, 8}, {6, 8}, {6, 2}, {3, 2}, {3, 6}},  // a ribbon that crosses itself
  };
  Random random(1);
  for (const Outline& outline : outlines) {
    for (std::size_t i = 0; i < case_count(6) && !this->HasFatalFailure(); ++i) {
      const int exponent = draw_exponent<TypeParam>(random);
      expect_refused(placed<TypeParam>(outline, draw_axis_plane(random), exponent));
      expect_refused(placed<TypeParam>(outline, draw_whole_plane(random), exponent));
      expect_refused(placed<TypeParam>(outline, draw_plane(random), exponent));
      expect_refused(bent<TypeParam>(outline, draw_plane(random), 0x1p-13, random, exponent));
      // Seen from within the plane, noise may look like a polygon.
      expect_refused(bent<TypeParam>(outline, draw_axis_plane(random), 1e-3, random, exponent));
      expect_refused(bent<TypeParam>(outline, draw_axis_plane(random), 1e-6, random, exponent));
    }
  }
}

/// What is cut although it crosses itself, as a slit may that goes through a wall, is cut rightly.
TYPED_TEST(Triangulate, refuses_whatever_it_cannot_cut_rightly) {
  Random random(1);
  std::size_t cut = 0;
  std::size_t refused = 0;
  std::size_t crossing = 0;
  for (std::size_t i = 0; i < case_count(3000); ++i) {
    const std::int64_t size = random.between(1, 6);
    Outline outline;
    for (std::size_t j = 4 + random.below(7); j > 0; --j)
      outline.push_back({random.between(0, size), random.between(0, size)});
    const auto vertices = placed<TypeParam>(outline, draw_axis_plane(random));
    const Corners corners = corners_from(0, false, outline.size());
    Triangles triangles = {{7, 8, 9}};
    const bool is_cut = example::triangulate(vertices, corners, triangles);
    const std::vector<OutlineJudge> judges = judges_of(vertices, random);
    ExactOutline exact;
    for (const auto& [x, y] : outline)
      exact.push_back({mpq_class(static_cast<long>(x)), mpq_class(static_cast<long>(y))});
    const bool crosses = crosses_properly(exact);
    if (crosses) ++crossing;
    if (crosses || !judges[0].winds_once()) {
      ASSERT_FALSE(is_cut) << text_of(outline);
    }
    if (!is_cut) {
      ++refused;
      ASSERT_EQ(triangles.size(), 1u);
      continue;
    }
    ++cut;
    triangles.erase(triangles.begin());
    for (const OutlineJudge& judge : judges) {
      ASSERT_EQ(judge.complaint(triangles, false), "") << text_of(outline);
      ASSERT_EQ(judge.complaint_about_cover(triangles), "") << text_of(outline);
    }
  }
  if (!runs_all_cases()) return;
  EXPECT_GT(cut, 500u);
  EXPECT_GT(refused, 500u);
  EXPECT_GT(crossing, 500u);
}

TYPED_TEST(Triangulate, cuts_large_polygons) {
  Random random(1);
  const std::size_t size = runs_all_cases() ? 5000 : 500;
  const std::vector<Outline> outlines = {
      draw_star(2 * size, 1 << 20, random), draw_star(size, 100, random), draw_comb(size / 4, random),
      draw_comb(size / 4, random),          draw_spiral(size / 4),        draw_rim_of_squares(size, random)};
  for (const Outline& outline : outlines) {
    const bool is_reversed = random.one_in(2);
    const Corners corners = corners_from(random.below(outline.size()), is_reversed, outline.size());
    Triangles triangles;
    ASSERT_TRUE(example::triangulate(placed<TypeParam>(outline, draw_axis_plane(random)), corners, triangles));
    ASSERT_EQ(triangles.size(), outline.size() - 2);
    std::int64_t area = 0;
    for (const auto& [a, b, c] : triangles) {
      const std::int64_t triangle_area = doubled_area(outline, {a, b, c});
      ASSERT_TRUE(is_reversed ? triangle_area <= 0 : triangle_area >= 0);
      area += triangle_area;
    }
    EXPECT_EQ(area, doubled_area(outline, corners));
  }
}

TYPED_TEST(Triangulate, cuts_a_dart) {
  const Vertices<TypeParam> vertices = {{-4, 4, 0}, {0, 0, 0}, {4, 4, 0}, {0, 2, 0}};
  Triangles triangles;
  ASSERT_TRUE(example::triangulate(vertices, {0, 1, 2, 3}, triangles));
  // The fan of the first corner would cover what is above the notch.
  for (auto& triangle : triangles) {
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  }
  std::sort(triangles.begin(), triangles.end());
  EXPECT_EQ(triangles, (Triangles{{0, 1, 3}, {1, 2, 3}}));
}

TYPED_TEST(Triangulate, leaves_a_window_open) {
  const Vertices<TypeParam> vertices = {{0, 0, 0}, {6, 0, 0}, {6, 0, 4}, {0, 0, 4},
                                        {2, 0, 1}, {2, 0, 3}, {4, 0, 3}, {4, 0, 1}};
  Triangles triangles;
  ASSERT_TRUE(example::triangulate(vertices, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4}, triangles));
  EXPECT_EQ(triangles.size(), 8u);
  TypeParam area = 0;
  for (const auto& triangle : triangles) {
    const auto& [a, b, c] = triangle;
    const auto side = [&](std::uint32_t to, std::size_t axis) {
      return vertices[to][axis] - vertices[triangle[0]][axis];
    };
    const TypeParam triangle_area = (side(b, 0) * side(c, 2) - side(b, 2) * side(c, 0)) / 2;
    EXPECT_GE(triangle_area, 0);
    area += triangle_area;
    // Whatever covered the middle of the window would have a corner on each side of its diagonals.
    const auto sees_middle = [&](std::uint32_t from, std::uint32_t to) {
      return (vertices[to][0] - vertices[from][0]) * (2 - vertices[from][2]) -
                 (vertices[to][2] - vertices[from][2]) * (3 - vertices[from][0]) >=
             0;
    };
    EXPECT_FALSE(sees_middle(a, b) && sees_middle(b, c) && sees_middle(c, a));
  }
  EXPECT_EQ(area, 6 * 4 - 2 * 2);
}

TYPED_TEST(Triangulate, sees_at_once_that_a_loop_is_walked_again_and_again) {
  const Vertices<TypeParam> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Corners corners;
  for (int i = 0; i < 5000; ++i) corners.insert(corners.end(), {0, 1, 2});
  Triangles triangles;
  EXPECT_FALSE(example::triangulate(vertices, corners, triangles));
  EXPECT_TRUE(triangles.empty());
}

TYPED_TEST(Triangulate, leaves_triangles_as_they_are) {
  const Vertices<TypeParam> vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  Triangles triangles = {{7, 8, 9}};
  EXPECT_TRUE(example::triangulate(vertices, {2, 0, 1}, triangles));
  EXPECT_TRUE(example::triangulate(vertices, {1, 1, 1}, triangles));
  EXPECT_EQ(triangles, (Triangles{{7, 8, 9}, {2, 0, 1}, {1, 1, 1}}));
}

TYPED_TEST(Triangulate, names_corners_by_their_vertices) {
  const Vertices<TypeParam> vertices = {{9, 9, 9}, {1, 1, 0}, {9, 9, 9}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  Triangles triangles;
  EXPECT_TRUE(example::triangulate(vertices, {3, 5, 1, 4}, triangles));
  EXPECT_EQ(triangles, (Triangles{{3, 5, 1}, {3, 1, 4}}));
}

}  // namespace
}  // namespace surehit::test::triangulate_test
