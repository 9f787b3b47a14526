#include "textbook_examples.hpp"

#include <array>

namespace surehit::test {

std::span<const TextbookExample> textbook_examples() {
  static const Trianglef floor = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  static const Trianglef left_of_seam = {{0, 0, 0}, {7, 1, 0}, {0, 1, 0}};
  static const Trianglef right_of_seam = {{7, 2, 0}, {0, 1, 0}, {7, 1, 0}};
  static const Trianglef millimetre = {{0, 0, 0}, {0x1p-10F, 0, 0}, {0, 0x1p-10F, 0}};
  static const Segmentf through_seam = {{6, 1, 1}, {6, 1, -1}};
  static const std::array examples = {
      TextbookExample{"a", floor, Segmentf{{0, 2, 2}, {2, 3, -1}}},
      TextbookExample{"b", left_of_seam, through_seam},
      TextbookExample{"b", right_of_seam, through_seam},
      TextbookExample{"c", floor, Segmentf{{5, 5, 0}, {6, 5, 0}}},
      TextbookExample{"d8", millimetre, Segmentf{{0x1p-12F, 0x1p-12F, 0x1p-8F}, {0x1p-12F, 0x1p-12F, -0x1p-8F}}},
      TextbookExample{"d6", millimetre, Segmentf{{0x1p-12F, 0x1p-12F, 0.25F}, {0x1p-12F, 0x1p-12F, -0.25F}}},
      TextbookExample{
          "d3", {{0, 0, 0}, {0x1p-6F, 0, 0}, {0, 0x1p-6F, 0}}, Segmentf{{0x1p-8F, 0x1p-8F, 1}, {0x1p-8F, 0x1p-8F, -1}}},
      TextbookExample{"e", {{0, 0, 0}, {3, 1, 0}, {0, 1, 0}}, Segmentf{{1, 1, 1}, {1, 1, -1}}},
      TextbookExample{"f", left_of_seam, Linef{{6, 1, 1}, {0, 0, -2}}},
      TextbookExample{
          "g1", {{0, 0, 0}, {683, -343, -288}, {160, 530, 445}}, Segmentf{{160, 530, 445}, {682, -343, -288}}},
      TextbookExample{
          "g2", {{0, 0, 0}, {-516, -688, 577}, {423, -541, -473}}, Segmentf{{-516, -688, 577}, {423, -540, -473}}},
      TextbookExample{"h", floor, Segmentf{{1, 1, 2}, {3, 2, -1}}},
      TextbookExample{"h", floor, Segmentf{{9, 9, 9}, {9, 9, 9}}},
  };
  return examples;
}

}  // namespace surehit::test
