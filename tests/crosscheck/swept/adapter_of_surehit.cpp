// Answers cases with surehit, in float and in double as each case says.

#include <array>
#include <cstdio>
#include <surehit/intersect.hpp>

#include "shape_of_input.hpp"
#include "swept_case.hpp"
#include "swept_input.hpp"

namespace {

using surehit::test::shape_of;

template <typename Scalar>
std::string ask_in(const swept::Input& input) {
  const surehit::Triangle<Scalar> triangle = surehit::test::triangle_of<Scalar>(input);
  const auto hit = surehit::intersect(shape_of<Scalar>(input), triangle);
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
