#include "textbook_variant.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "moeller_trumbore.hpp"
#include "plane_first.hpp"
#include "surehit/intersect.hpp"
#include "watertight.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
TextbookAnswer<Scalar> surehit_itself(const Path<Scalar>& segment, const Triangle<Scalar>& triangle) {
  const std::optional<Hit<Scalar>> hit = intersect(segment, triangle);
  if (!hit) return {};
  return TextbookHit<Scalar>{hit->t, hit->u, hit->v};
}

}  // namespace

template <typename Scalar>
const std::array<TextbookVariant<Scalar>, textbook_variant_count>& textbook_variants() {
  static constexpr std::array<TextbookVariant<Scalar>, textbook_variant_count> variants = {{
      {"surehit", "surehit", Asked::segment, surehit_itself},
      {"a", "plane first, then three edges", Asked::segment, plane_first},
      {"b", "Möller–Trumbore, det = 0 refused", Asked::segment, moeller_trumbore},
      {"c", "the same, no test of det", Asked::segment, without_test_of_det},
      {"d8", "the same, \\|det\\| < 1e-8 refused", Asked::segment, with_epsilon<Scalar, 8>},
      {"d6", "the same, \\|det\\| < 1e-6 refused", Asked::segment, with_epsilon<Scalar, 6>},
      {"d3", "the same, \\|det\\| < 1e-3 refused", Asked::segment, with_epsilon<Scalar, 3>},
      {"e", "1 − u − v ≥ 0 for u + v ≤ 1", Asked::segment, with_rest_of_one},
      {"f", "of a line, t without limits", Asked::line, of_line},
      {"g1", "backs culled by the normal", Asked::front, culled_by_normal},
      {"g2", "backs culled by det", Asked::front, culled_by_det},
      {"h", "watertight (Woop, Benthin, Wald)", Asked::segment, watertight},
  }};
  return variants;
}

template <typename Scalar>
const TextbookVariant<Scalar>& textbook_variant(const char* letter) {
  return *std::ranges::find_if(textbook_variants<Scalar>(),
                               [&](const auto& variant) { return std::string_view(variant.letter) == letter; });
}

template const std::array<TextbookVariant<float>, textbook_variant_count>& textbook_variants();
template const std::array<TextbookVariant<double>, textbook_variant_count>& textbook_variants();
template const TextbookVariant<float>& textbook_variant(const char*);
template const TextbookVariant<double>& textbook_variant(const char*);

}  // namespace surehit::test
