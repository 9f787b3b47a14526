#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <surehit/hit.hpp>
#include <surehit/shape_hit.hpp>

namespace surehit::example {

/// Appends a number so that it reads back to the same bits.
template <typename Number>
void append_number(Number number, std::string& text) {
  std::array<char, 32> digits;
  const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

[[nodiscard]] inline const char* name_of(Side side) {
  switch (side) {
    case Side::front:
      return "front";
    case Side::back:
      return "back";
    case Side::edge_on:
      break;
  }
  return "edge_on";
}

[[nodiscard]] inline const char* name_of(Feature feature) {
  constexpr std::array names = {"face", "edge_ab", "edge_bc", "edge_ca", "corner_a", "corner_b", "corner_c"};
  return names[static_cast<std::size_t>(feature)];
}

/// Appends `,t,u,v,feature,started_touching`.
template <typename Scalar>
void append_contact(const ShapeHit<Scalar>& hit, std::string& text) {
  for (const Scalar number : {hit.t, hit.u, hit.v}) {
    text += ',';
    append_number(number, text);
  }
  text += ',';
  text += name_of(hit.feature);
  text += hit.started_touching ? ",1" : ",0";
}

/// Appends `,t,u,v,side`.
template <typename Scalar>
void append_contact(const Hit<Scalar>& hit, std::string& text) {
  for (const Scalar number : {hit.t, hit.u, hit.v}) {
    text += ',';
    append_number(number, text);
  }
  text += ',';
  text += name_of(hit.side);
}

/// Appends `,x,y,z`.
template <typename Scalar>
void append_vector(const Vector3<Scalar>& vector, std::string& text) {
  for (const Scalar number : vector) {
    text += ',';
    append_number(number, text);
  }
}

/// The columns that a user may ask for behind those of every hit: the point, and the normal of the triangle.
class MoreColumns {
 public:
  MoreColumns(bool has_points, bool has_normals) : has_points_(has_points), has_normals_(has_normals) {}

  [[nodiscard]] std::string names() const {
    return std::string(has_points_ ? ",x,y,z" : "") + (has_normals_ ? ",nx,ny,nz" : "");
  }

  /// Asks for the normal only if the user does.
  template <typename Shape, typename Scalar, typename Normal>
  void append(const Shape& path, const Hit<Scalar>& hit, const Normal& normal, std::string& text) const {
    if (has_points_) append_vector(point(path, hit), text);
    if (has_normals_) append_vector(normal(), text);
  }

  void append_none(std::string& text) const { text.append((has_points_ ? 3 : 0) + (has_normals_ ? 3 : 0), ','); }

 private:
  bool has_points_;
  bool has_normals_;
};

}  // namespace surehit::example
