#include "character/walker.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace surehit::example {
namespace {

constexpr float gravity = 9.81f;
constexpr float max_fall_speed = 40;
constexpr std::size_t max_contacts = 4;
/// What slides along a surface departs from it by this share of its way. Rounded positions along it stay free.
constexpr float departure = 0x1p-12f;

bool is_carried(const Stop& stop) { return stop.normal.z() >= Walker::min_carrying_z; }
/// A foot can stand on the edge of a stair, although the normal there is not upright.
bool has_foothold(const Stop& stop) { return is_carried(stop) || (stop.is_on_edge && stop.normal.z() > 0.0625f); }

/// The part of a way that is left at the walls met so far. The last one is new.
Vector3f deflected(const Vector3f& way, const std::vector<Vector3f>& walls) {
  const Vector3f& wall = walls.back();
  Vector3f left = way - std::min(0.0f, way.dot(wall)) * wall;
  for (std::size_t i = 0; i + 1 < walls.size(); ++i) {
    if (left.dot(walls[i]) >= 0) continue;
    const Vector3f crease = walls[i].cross(wall);
    const float square = crease.squaredNorm();
    if (square < 1e-6f) return Vector3f::Zero();
    left = way.dot(crease) / square * crease;
    for (std::size_t k = 0; k + 1 < walls.size(); ++k) {
      if (k != i && left.dot(walls[k]) < 0) return Vector3f::Zero();
    }
    break;
  }
  const float length = left.norm();
  for (const Vector3f& each : walls) left += departure * length * each;
  return left;
}

enum class Gait { walks, falls };

}  // namespace

/// One step of one character.
class Walker::Step {
 public:
  Step(const CapsuleSweep& sweep, Character& character, std::size_t& queries)
      : sweep_(sweep), character_(character), queries_(queries) {}

  void take(const Vector3f& way, std::vector<Vector3f>& positions) {
    const Vector3f start = character_.position;
    Course low = slide(start, way, Gait::walks);
    if (low.is_blocked && character_.is_standing) {
      const auto over = climb(start, way);
      if (over && advance(start, *over, way) > advance(start, low, way) + 0.01f * way.norm()) low = *over;
    }
    positions.insert(positions.end(), low.positions.begin(), low.positions.end());
    character_.position = low.end(start);
    come_down(positions);
  }

 private:
  /// Positions to which a body went.
  struct Course {
    std::vector<Vector3f> positions;
    bool is_blocked = false;  ///< True if something steep was met.

    [[nodiscard]] Vector3f end(const Vector3f& start) const { return positions.empty() ? start : positions.back(); }
    void go(const Vector3f& start, const Vector3f& to) {
      if (to != end(start)) positions.push_back(to);
    }
  };

  /// How far a course goes along a way in the plan.
  static float advance(const Vector3f& start, const Course& course, const Vector3f& way) {
    return (course.end(start) - start).dot(way) / std::max(way.norm(), 1e-30f);
  }

  Course slide(const Vector3f& start, const Vector3f& way, Gait gait) {
    Course course;
    Vector3f left = way;
    std::vector<Vector3f> walls;
    while (walls.size() < max_contacts && left.squaredNorm() > 1e-12f) {
      const Vector3f from = course.end(start);
      const auto stop = sweep_.find_stop(from, from + left, queries_);
      course.go(start, stop ? stop->position : Vector3f(from + left));
      if (!stop) break;
      const float gone = (stop->position - from).dot(left) / left.squaredNorm();
      left *= 1 - std::clamp(gone, 0.0f, 1.0f);
      Vector3f wall = stop->normal;
      if (gait == Gait::walks && !is_carried(*stop)) {
        // One does not walk up a steep wall, nor is pushed into the ground by one that leans over.
        course.is_blocked = true;
        wall.z() = 0;
        if (wall.squaredNorm() < 1e-6f) break;
        wall.normalize();
      }
      walls.push_back(wall);
      left = deflected(left, walls);
    }
    return course;
  }

  /// Goes up by a step's height, ahead and down. Returns nothing unless it comes to a foothold.
  std::optional<Course> climb(const Vector3f& start, const Vector3f& way) {
    Course course;
    const Vector3f top = start + Vector3f(0, 0, step_height);
    const auto ceiling = sweep_.find_stop(start, top, queries_);
    course.go(start, ceiling ? ceiling->position : top);
    const Vector3f above = course.end(start);
    const Course ahead = slide(above, way, Gait::walks);
    if (ahead.positions.empty()) return std::nullopt;
    course.positions.insert(course.positions.end(), ahead.positions.begin(), ahead.positions.end());
    const Vector3f over = course.end(start);
    const auto ground = sweep_.find_stop(over, over - Vector3f(0, 0, over.z() - start.z() + departure), queries_);
    if (!ground || !has_foothold(*ground)) return std::nullopt;
    // The touched point is above the bottom of the body by its radius times 1 - z.
    const float rise = ground->position.z() - start.z() + Body::radius * (1 - ground->normal.z());
    if (rise > step_height) return std::nullopt;
    course.go(start, ground->position);
    return course;
  }

  /// Goes down to the ground, or falls.
  void come_down(std::vector<Vector3f>& positions) {
    const Vector3f start = character_.position;
    if (!character_.is_standing) {
      character_.fall_speed = std::min(character_.fall_speed + time_step * gravity, max_fall_speed);
    }
    const float fall = time_step * std::max(character_.fall_speed, time_step * gravity);
    const float depth = character_.is_standing ? step_height : fall;
    const auto ground = sweep_.find_stop(start, start - Vector3f(0, 0, depth), queries_);
    Course course;
    if (!ground) {
      // This is a part of the way that is free.
      course.go(start, start - Vector3f(0, 0, fall));
      character_.is_standing = false;
    } else {
      course.go(start, ground->position);
      character_.is_standing = has_foothold(*ground);
      if (!character_.is_standing) slide_down(*ground, fall, course, start);
      if (character_.is_standing) character_.fall_speed = 0;
    }
    positions.insert(positions.end(), course.positions.begin(), course.positions.end());
    character_.position = course.end(start);
  }

  /// Slides down what is too steep to stand on.
  void slide_down(const Stop& ground, float fall, Course& course, const Vector3f& start) {
    const Vector3f from = course.end(start);
    const float left = std::max(0.0f, fall - (start.z() - from.z()));
    const Course down = slide(from, deflected({0, 0, -left}, {ground.normal}), Gait::falls);
    for (const Vector3f& position : down.positions) course.go(start, position);
    const float drop = start.z() - course.end(start).z();
    character_.fall_speed = std::clamp(drop / time_step, 0.0f, character_.fall_speed);
    // What is wedged between two steep slopes stands on both.
    character_.is_standing = drop < 0x1p-10f;
  }

  const CapsuleSweep& sweep_;
  Character& character_;
  std::size_t& queries_;
};

void Walker::step(Character& character, const Vector3f& velocity, std::vector<Vector3f>& positions,
                  std::size_t& queries) const {
  Step(sweep_, character, queries).take(time_step * velocity, positions);
}

}  // namespace surehit::example
