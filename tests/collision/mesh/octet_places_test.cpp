#include "mesh/octet_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "support/random.hpp"

namespace surehit::test::octet_places_test {
namespace {

using detail::OctetPlaces;

constexpr std::size_t octets = 1000;

TEST(OctetPlaces, are_numbered_in_order) {
  OctetPlaces places;
  for (const std::size_t max_gap : {1U, 3U, 100U, 700U}) {
    places.reset(octets);
    std::vector<std::size_t> boxed;
    Random random(max_gap);
    for (std::size_t first = random.below(max_gap); first < octets; first += random.below(max_gap)) {
      const std::size_t count = std::min<std::size_t>(4 + random.below(66), octets - first);
      places.add(first, count);
      for (std::size_t i = 0; i < count; ++i) boxed.push_back(first++);
    }
    EXPECT_EQ(places.number(), boxed.size());
    for (std::size_t i = 0; i < boxed.size(); ++i) EXPECT_EQ(places.place(boxed[i]), i) << boxed[i];
  }
}

TEST(OctetPlaces, are_forgotten) {
  OctetPlaces places;
  places.reset(octets);
  places.add(0, octets);
  EXPECT_EQ(places.number(), octets);
  places.reset(octets);
  EXPECT_EQ(places.number(), 0U);
}

TEST(OctetPlaces, may_be_none) {
  OctetPlaces places;
  places.reset(0);
  EXPECT_EQ(places.number(), 0U);
}

}  // namespace
}  // namespace surehit::test::octet_places_test
