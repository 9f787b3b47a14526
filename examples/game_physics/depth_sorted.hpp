#pragma once

#include <vector>

#include "game_physics/oblique_view.hpp"
#include "picture/canvas.hpp"

namespace surehit::example {

/// All that is drawn within a room, from the back to the front. Lines are cut short, so that each piece of them is
/// drawn at its depth.
class DepthSorted {
 public:
  explicit DepthSorted(const ObliqueView& view) : view_(view) {}

  void add_face(const std::vector<Vector3f>& corners, const Colour& colour, float opacity);
  void add_line(const Vector3f& from, const Vector3f& to, float width, const Colour& colour, float opacity = 1);
  void add_disc(const Vector3f& centre, float radius, const Colour& colour);

  void draw(Canvas& canvas);

 private:
  struct Shape {
    float depth;
    std::vector<Spot> spots;  ///< one of a disc, two of a line, more of a face
    Colour colour;
    float opacity;
    float width;  ///< of a line; a disc's radius
  };

  void add(const std::vector<Vector3f>& points, const Colour& colour, float opacity, float width);

  const ObliqueView& view_;
  std::vector<Shape> shapes_;
};

}  // namespace surehit::example
