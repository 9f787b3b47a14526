#include "swept_case.hpp"

#include <array>
#include <cstdio>

#include "support/swept_truth.hpp"

namespace surehit::test {
namespace {

/// C's hexadecimal floats are the same text on every platform: normal numbers begin with 1, and digits end as soon as
/// they can.
void append(double number, std::string& line) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), " %a", number);
  line += text.data();
}

template <typename Scalar>
void append(const Vector3<Scalar>& vector, std::string& line) {
  for (const Scalar x : vector) append(double{x}, line);
}

template <typename Scalar>
void append(const ShapeHit<Scalar>& hit, std::string& line) {
  for (const Scalar x : {hit.t, hit.u, hit.v}) append(double{x}, line);
}

template <typename Scalar>
const char* shape_name(const SweptSphere<Scalar>&) {
  return "sphere";
}
template <typename Scalar>
const char* shape_name(const SweptBox<Scalar>&) {
  return "box";
}
template <typename Scalar>
const char* shape_name(const SweptCapsule<Scalar>&) {
  return "capsule";
}

template <typename Scalar>
void append_size(const SweptSphere<Scalar>& sphere, std::string& line) {
  append(double{sphere.radius}, line);
}
template <typename Scalar>
void append_size(const SweptBox<Scalar>& box, std::string& line) {
  append(box.half_extents, line);
}
template <typename Scalar>
void append_size(const SweptCapsule<Scalar>& capsule, std::string& line) {
  append(capsule.half_axis, line);
  append(double{capsule.radius}, line);
}

std::string truth_text(const SweptTruth& truth) {
  if (!truth.touches) return "miss";
  std::string text = truth.starts_touching ? "start" : "hit";
  text += ' ' + name_of(truth.feature) + ' ' + text_of(truth.t);
  append(rounded_hit<float>(truth), text);
  append(rounded_hit<double>(truth), text);
  return text;
}

}  // namespace

std::string name_of(Feature feature) {
  constexpr std::array names = {"face", "edge_ab", "edge_bc", "edge_ca", "corner_a", "corner_b", "corner_c"};
  return names[static_cast<std::size_t>(feature)];
}

template <typename Scalar, typename Family>
std::string draw_swept_case(Family family, Random& random) {
  const auto [shape, triangle] = draw_shape_pair<Scalar>(family, random);
  std::string line = shape_name(shape);
  line += sizeof(Scalar) == 4 ? " float " : " double ";
  line += name_of(family);
  for (const auto* const corner : {&triangle.a, &triangle.b, &triangle.c}) append(*corner, line);
  append(shape.start, line);
  append(shape.end, line);
  append_size(shape, line);
  return line + ' ' + truth_text(truth_of(shape, triangle));
}

#define SUREHIT_INSTANTIATE(Family)                             \
  template std::string draw_swept_case<float>(Family, Random&); \
  template std::string draw_swept_case<double>(Family, Random&);
SUREHIT_INSTANTIATE(SphereFamily)
SUREHIT_INSTANTIATE(BoxFamily)
SUREHIT_INSTANTIATE(CapsuleFamily)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
