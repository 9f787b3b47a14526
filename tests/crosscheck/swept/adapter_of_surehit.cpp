// Answers cases with surehit, in float and in double as each case says.

#include <array>
#include <cstdio>
#include <surehit/intersect.hpp>

#include "swept_case.hpp"
#include "swept_input.hpp"

namespace {

template <typename Scalar>
std::string ask_in(const swept::Input& input) {
  const auto vector = [](const std::array<double, 3>& x) {
    return surehit::Vector3<Scalar>(static_cast<Scalar>(x[0]), static_cast<Scalar>(x[1]), static_cast<Scalar>(x[2]));
  };
  const surehit::Triangle<Scalar> triangle{vector(input.corners[0]), vector(input.corners[1]),
                                           vector(input.corners[2])};
  const auto hit = surehit::intersect(
      surehit::SweptSphere<Scalar>{vector(input.start), vector(input.end), static_cast<Scalar>(input.size[0])},
      triangle);
  if (!hit) return "miss";
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "hit %a %s %a %a", double{hit->t},
                surehit::test::name_of(hit->feature).c_str(), double{hit->u}, double{hit->v});
  return text.data();
}

}  // namespace

int main() {
  return swept::answer_all(
      [](const swept::Input& input) { return input.scalar == "float" ? ask_in<float>(input) : ask_in<double>(input); });
}
