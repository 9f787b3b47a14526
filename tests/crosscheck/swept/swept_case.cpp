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

template <typename Scalar>
std::string draw_swept_case(SphereFamily family, Random& random) {
  const auto [sphere, triangle] = draw_sphere_pair<Scalar>(family, random);
  std::string line = "sphere ";
  line += sizeof(Scalar) == 4 ? "float " : "double ";
  line += name_of(family);
  for (const auto* const corner : {&triangle.a, &triangle.b, &triangle.c}) append(*corner, line);
  append(sphere.start, line);
  append(sphere.end, line);
  append(double{sphere.radius}, line);
  return line + ' ' + truth_text(truth_of(sphere, triangle));
}

std::uint64_t seed_of(SphereFamily family, std::uint64_t seed) {
  return Random(seed).bits() + static_cast<std::uint64_t>(family);
}

template std::string draw_swept_case<float>(SphereFamily, Random&);
template std::string draw_swept_case<double>(SphereFamily, Random&);

}  // namespace surehit::test
