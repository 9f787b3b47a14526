#include "mesh_io/float_loss.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace surehit::example {
namespace {

constexpr double little_of_mesh = 1e-6;
constexpr double little_of_triangle = 1e-2;

template <typename Scalar>
double longest_side(const Mesh<Scalar>& mesh, const std::array<std::uint32_t, 3>& triangle) {
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = mesh.vertices[triangle[i]];
    const auto& b = mesh.vertices[triangle[(i + 1) % 3]];
    const auto side = [&](std::size_t axis) { return double{b[axis]} - double{a[axis]}; };
    longest = std::max(longest, std::hypot(side(0), side(1), side(2)));
  }
  return longest;
}

/// The longest side of the box around all triangles.
template <typename Scalar>
double size_of(const Mesh<Scalar>& mesh) {
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) {
        low = std::min(low, double{mesh.vertices[corner][axis]});
        high = std::max(high, double{mesh.vertices[corner][axis]});
      }
    }
    size = std::max(size, high - low);
  }
  return size;
}

std::string text_of(double number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return {digits.data(), end.ptr};
}

std::string rounded_text_of(double number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::general, 2);
  return {digits.data(), end.ptr};
}

/// Half a unit in the last place: rounding to a float of this size moves nothing further.
double half_unit_of(double number) {
  using Float = std::numeric_limits<float>;
  return std::max(number * Float::epsilon(), double{Float::denorm_min()}) / 2;
}

/// How far rounding moves coordinates, and the one that it moves furthest.
struct Move {
  double distance = 0;
  std::uint32_t vertex = 0;
  std::size_t axis = 0;

  void add(const Mesh<float>& rounded, const Mesh<double>& mesh, std::uint32_t corner) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double moved = std::fabs(double{rounded.vertices[corner][i]} - mesh.vertices[corner][i]);
      if (moved > distance) *this = {moved, corner, i};
    }
  }
};

}  // namespace

bool may_lose_in_float(const Mesh<float>& mesh) {
  double max_of_mesh = 0;
  for (const auto& triangle : mesh.triangles) {
    double max_of_triangle = 0;
    for (const std::uint32_t corner : triangle) {
      for (const float coordinate : mesh.vertices[corner]) {
        max_of_triangle = std::max(max_of_triangle, std::fabs(double{coordinate}));
      }
    }
    // Sides may be longer before they are rounded, but not by so much.
    if (half_unit_of(max_of_triangle) > little_of_triangle / 2 * longest_side(mesh, triangle)) return true;
    max_of_mesh = std::max(max_of_mesh, max_of_triangle);
  }
  return !mesh.triangles.empty() && half_unit_of(max_of_mesh) > little_of_mesh / 2 * size_of(mesh);
}

std::optional<std::string> describe_float_loss(const Mesh<float>& rounded, const Mesh<double>& mesh) {
  Move worst;
  std::size_t changed = 0;
  for (const auto& triangle : mesh.triangles) {
    Move move;
    for (const std::uint32_t corner : triangle) move.add(rounded, mesh, corner);
    if (move.distance > worst.distance) worst = move;
    // A triangle that is a point has no side to lose.
    const double longest = longest_side(mesh, triangle);
    if (longest > 0 && move.distance > little_of_triangle * longest) ++changed;
  }
  const double size = size_of(mesh);
  if (changed == 0 && (size == 0 || worst.distance <= little_of_mesh * size)) return std::nullopt;

  const double exact = mesh.vertices[worst.vertex][worst.axis];
  std::string text = "float cannot hold its coordinates, double can: ";
  text += "xyz"[worst.axis];
  text += " of vertex " + std::to_string(worst.vertex) + " is " + text_of(exact) + " and becomes " +
          text_of(double{rounded.vertices[worst.vertex][worst.axis]}) + " in a mesh that measures " +
          rounded_text_of(size);
  if (changed > 0) {
    text += "; " + std::to_string(changed) + " of " + std::to_string(mesh.triangles.size()) +
            " triangles change by more than a hundredth of their longest side";
  }
  return text;
}

}  // namespace surehit::example
