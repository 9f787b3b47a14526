#include <cmath>
#include <string>
#include <surehit/surehit.hpp>
#include <vector>

#include "swept_drawings/drawings.hpp"
#include "swept_drawings/plane_view.hpp"

namespace surehit::example {
namespace {

constexpr int numbers_height = 710;
constexpr float middle = drawing_width / 2;
constexpr float gap = 150;     ///< The pixels of a gap between neighbouring floats.
constexpr int neighbours = 3;  ///< The floats on each side of the one in the middle.
constexpr float axis_end = 560;

const Trianglef floor_triangle{{-40, -40, 0}, {80, -40, 0}, {-40, 80, 0}};

Colliderf floor_collider() {
  const std::vector<Vector3f> corners = {floor_triangle.a, floor_triangle.b, floor_triangle.c};
  const std::vector<unsigned> ids = {0, 1, 2};
  return Colliderf(TriangleMeshViewf(corners, ids));
}

/// An axis of numbers. The spot of one is told by its distance from the one in the middle.
class Axis {
 public:
  Axis(Canvas& canvas, float y, float centre, float unit) : canvas_(canvas), y_(y), centre_(centre), unit_(unit) {}

  [[nodiscard]] float at(double number) const {
    return middle + gap * static_cast<float>((number - double{centre_}) / double{unit_});
  }
  /// Draws what is free on one side, and touching on the other.
  void draw_sides(double first_touching, bool is_free_below) {
    const float x = at(first_touching);
    const Colour& left = is_free_below ? free_colour : touching_colour;
    const Colour& right = is_free_below ? touching_colour : free_colour;
    canvas_.draw_rectangle({middle - axis_end, y_ - 9}, {x, y_ + 9}, left, 0.25f);
    canvas_.draw_rectangle({x, y_ - 9}, {middle + axis_end, y_ + 9}, right, 0.25f);
    canvas_.draw_line({middle - axis_end, y_}, {middle + axis_end, y_}, 1.5f, dim);
    canvas_.draw_line({x, y_ - 26}, {x, y_ + 26}, 2.5f, ink);
  }
  void draw_number(float number, bool is_free) {
    if (std::abs(at(double{number}) - middle) > axis_end) return;
    canvas_.draw_disc({at(double{number}), y_}, 8, night);
    canvas_.draw_disc({at(double{number}), y_}, 6, is_free ? free_colour : touching_colour);
  }
  void draw_name(double number, const char* name, float below, const Colour& colour) {
    const float x = at(number);
    const float tip = y_ + (below > 0 ? 12.0f : -12.0f);
    // A second name of the same number has no line of its own.
    if (std::abs(below) < 60) canvas_.draw_line({x, tip}, {x, y_ + below - (below > 0 ? 12.0f : -12.0f)}, 1.5f, colour);
    draw_centred(canvas_, {x, y_ + below}, name, 2, colour);
  }

 private:
  Canvas& canvas_;
  float y_;
  float centre_;
  float unit_;
};

/// The floats around the time of a contact.
void draw_times(Canvas& canvas, const Colliderf& floor, const SweptSpheref& ball, double exact, float y,
                const std::string& title) {
  const auto hit = floor.first_hit(ball);
  const float unit = std::nextafter(hit->t, 1.0f) - hit->t;
  Axis axis(canvas, y, hit->t, unit);
  canvas.draw_text({middle - axis_end, y - 100}, title, 2, ink);
  axis.draw_sides(exact, true);
  for (int i = -neighbours; i <= neighbours; ++i) {
    const float t = hit->t + static_cast<float>(i) * unit;
    axis.draw_number(t, !floor.any_hit(ball, {.max_t = t}));
  }
  axis.draw_name(exact, "exact t", -44, ink);
  axis.draw_name(double{hit->t}, "hit.t", 44, ink);
  const float free = floor.last_free_t(ball, *hit);
  axis.draw_name(double{free}, "last_free_t", free == hit->t ? 68 : 44, free_colour);
}

/// The floats around the height of a ball that comes down slowly.
void draw_heights(Canvas& canvas, const Colliderf& floor, const SweptSpheref& ball, float y, const std::string& title) {
  const auto hit = floor.first_hit(ball);
  const float free_t = floor.last_free_t(ball, *hit);
  const Vector3f rounded = point(Segmentf{ball.start, ball.end}, Hitf{free_t, 0, 0, 0, Side::front});
  const Vector3f rest = floor.last_free_point(ball, *hit);
  const float unit = std::nextafter(ball.radius, 2 * ball.radius) - ball.radius;
  Axis axis(canvas, y, ball.radius, unit);
  canvas.draw_text({middle - axis_end, y - 100}, title, 2, ink);
  axis.draw_sides(double{ball.radius}, false);
  float z = ball.radius - static_cast<float>(neighbours) * unit;
  for (; z <= ball.radius + static_cast<float>(neighbours) * unit; z = std::nextafter(z, 2 * ball.radius)) {
    axis.draw_number(z, !floor.any_hit(SweptSpheref{ball.start, {rest.x(), rest.y(), z}, ball.radius}));
  }
  axis.draw_name(double{ball.radius}, "the radius", -44, ink);
  axis.draw_name(double{rounded.z()}, "the centre at last_free_t, rounded", 44, touching_colour);
  axis.draw_name(double{rest.z()}, "last_free_point", rest.z() == rounded.z() ? 68 : -44, free_colour);
}

}  // namespace

Canvas draw_free_numbers() {
  Canvas canvas(drawing_width, numbers_height, night);
  const Colliderf floor = floor_collider();
  draw_times(canvas, floor, {{2, 1, 3}, {2, 1, -3}, 1}, 1.0 / 3, 130,
             "times: the ball falls by 6, and touches after 2");
  draw_times(canvas, floor, {{2, 1, 8}, {2, 1, -2}, 1}, 0.7, 350, "times: the ball falls by 10, and touches after 7");
  draw_heights(canvas, floor, {{2, 1, 1.0001f}, {9, 1, 0.9998f}, 1}, 580,
               "heights: the ball comes down very slowly on its way to the right");
  const float y = numbers_height - 28;
  canvas.draw_disc({middle - axis_end + 6, y}, 6, free_colour);
  const float x =
      canvas.draw_text({middle - axis_end + 22, y - 7}, "a float where the ball touches nothing", 2, ink) + 40;
  canvas.draw_disc({x + 6, y}, 6, touching_colour);
  canvas.draw_text({x + 22, y - 7}, "a float where it touches the floor", 2, ink);
  return canvas;
}

}  // namespace surehit::example
