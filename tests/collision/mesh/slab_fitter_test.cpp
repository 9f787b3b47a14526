#include "mesh/slab_fitter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/case_count.hpp"
#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/instruction_sets.hpp"

namespace surehit::test::slab_fitter_test {
namespace {

using detail::ListCell;
using detail::SlabFitter;
using List = std::vector<Triangle<float>>;

class SlabFitterTest : public testing::Test {
 protected:
  /// The coordinates as a block has them, with something behind them that no list holds.
  static std::vector<float> block_of(const List& list, float behind = 1e30F) {
    std::vector<float> block(9 * list.size() + 64, behind);
    for (std::size_t i = 0; i < list.size(); ++i) {
      std::size_t k = 0;
      for (const Vector3<float>& corner : {list[i].a, list[i].b, list[i].c}) {
        for (const float x : corner) block[k++ * list.size() + i] = x;
      }
    }
    return block;
  }

  /// A grid around the cube [-1, 1]³, or around what of that the width leaves.
  static GridFrame frame_of(const std::array<double, 3>& cells, std::uint32_t division, float width = 1,
                            const Vector3<float>& centre = {0, 0, 0}) {
    Box<float> box;
    box.low = centre - Vector3<float>::Constant(width);
    box.high = centre + Vector3<float>::Constant(width);
    return GridFrame::around(box, cells, division);
  }

  /// Any cell, or one that has a point in it.
  ListCell cell_at(const GridFrame& frame, const Vector3<float>& point) {
    const ExactPoint place = in_frame(frame, point);
    ListCell cell{CellWord::listing(0), {}, std::uint32_t{1} << random_.below(std::bit_width(frame.division))};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double last = frame.resolution(axis) - 1;
      const auto finest = static_cast<std::uint32_t>(std::clamp(place[axis].get_d(), 0.0, last));
      cell.low[axis] = finest / cell.size * cell.size;
    }
    return cell;
  }

  /// Every corner is between the planes, unless these are out of the cell; and each plane is near some corner.
  void expect_fitted(const GridFrame& frame, const ListCell& cell, const List& list) {
    const std::vector<float> block = block_of(list);
    const SlabFitter fitter(frame);
    for (const std::int64_t target : instruction_sets()) {
      const ForcedInstructionSet forced(target);
      SCOPED_TRACE(name_of_instruction_set(target));
      const CellSlab slab = fitter.fit(cell, block.data(), list.size());
      const std::vector<float> others = block_of(list, -7);
      EXPECT_EQ(fitter.fit(cell, others.data(), list.size()).bits(), slab.bits());
      const ExactSlab exact = LeafCell{cell.low, cell.size, cell.word}.placed(slab);
      mpq_class low;
      mpq_class high;
      bool is_first = true;
      for (const Triangle<float>& triangle : list) {
        for (const ExactPoint& corner : in_frame(frame, triangle)) {
          const mpq_class height = exact.height_of(corner);
          low = is_first ? height : std::min(low, height);
          high = is_first ? height : std::max(high, height);
          is_first = false;
        }
      }
      Growth padding = growth_by(frame, 2 * GridFrame::padding_share);
      mpq_class slack = double{CellSlab::step} * cell.size;
      for (std::size_t axis = 0; axis < 3; ++axis) slack += abs(exact.normal[axis]) * padding[axis];
      if (slab.low() != CellSlab::lowest) {
        EXPECT_LE(exact.low, low);
      }
      if (slab.high() != CellSlab::highest) {
        EXPECT_GE(exact.high, high);
      }
      // If a cell has no corners between the last steps, its planes are there.
      const mpq_class step = double{CellSlab::step} * cell.size;
      if (slab.low() != CellSlab::highest) {
        EXPECT_TRUE(exact.low + slack >= low || slab.bits() == CellSlab().bits());
      }
      if (slab.high() != CellSlab::lowest) {
        EXPECT_TRUE(exact.high - slack <= high || slab.bits() == CellSlab().bits());
      }
      fitted_ += slab.bits() != CellSlab().bits() ? 1 : 0;
    }
  }

  /// Returns triangles that nearly lie in one plane. Some are turned over.
  List flat_list(std::size_t count, float size, float height) {
    const auto drawn = [&] { return Vector3<float>::NullaryExpr([&] { return random_.symmetric<float>(); }).eval(); };
    const Vector3<float> centre = drawn();
    const Vector3<float> along = size * drawn();
    const Vector3<float> across = size * drawn();
    const auto corner = [&] {
      return Vector3<float>(centre + along * random_.symmetric<float>() + across * random_.symmetric<float>() +
                            height * drawn());
    };
    List list(count);
    for (Triangle<float>& triangle : list) triangle = {corner(), corner(), corner()};
    for (Triangle<float>& triangle : list) {
      for (Vector3<float>* point : {&triangle.a, &triangle.b, &triangle.c}) {
        *point = point->cwiseMax(-1).cwiseMin(1);
      }
    }
    return list;
  }

  Random random_{20241117};
  std::size_t fitted_ = 0;
};

TEST_F(SlabFitterTest, holds_lists_of_every_length) {
  for (const std::array<double, 3>& cells : {std::array<double, 3>{9, 7, 8}, std::array<double, 3>{1, 30, 4}}) {
    for (const std::uint32_t division : {1U, 16U}) {
      const GridFrame frame = frame_of(cells, division);
      for (std::size_t count = 1; count <= 40; ++count) {
        const List list = flat_list(count, 0.1F, 0.01F);
        expect_fitted(frame, cell_at(frame, list[0].a), list);
      }
    }
  }
  EXPECT_GE(fitted_, 100U);
}

/// Where a finest cell is sixteen paddings wide, and roundings come to a good part of a step.
TEST_F(SlabFitterTest, holds_lists_in_the_finest_cells) {
  const GridFrame frame = frame_of({2000, 1900, 2047}, 16);
  ASSERT_GT(frame.resolution(2), 32000U);
  for (std::size_t i = case_count(3000); i > 0; --i) {
    const List list = flat_list(1 + random_.below(20), 0.0003F, 0.00001F);
    expect_fitted(frame, cell_at(frame, list[0].a), list);
  }
  EXPECT_GE(fitted_, case_count(3000));
}

TEST_F(SlabFitterTest, holds_lists_far_from_the_origin_and_of_any_size) {
  for (const float width : {1e-15F, 1e-10F, 1e6F, 1e12F, 1e17F}) {
    const Vector3<float> centre = width * Vector3<float>(3, -2, 1);
    const GridFrame frame = frame_of({20, 30, 25}, 4, width, centre);
    ASSERT_TRUE(frame.has_floats);
    fitted_ = 0;
    for (std::size_t i = case_count(200); i > 0; --i) {
      List list = flat_list(1 + random_.below(12), 0.05F, 0.001F);
      for (Triangle<float>& triangle : list) {
        for (Vector3<float>* point : {&triangle.a, &triangle.b, &triangle.c}) {
          *point = (centre + width * *point).cwiseMax(centre - Vector3<float>::Constant(width));
          *point = point->cwiseMin(centre + Vector3<float>::Constant(width));
        }
      }
      expect_fitted(frame, cell_at(frame, list[0].a), list);
    }
    EXPECT_GE(fitted_, case_count(200)) << width;
  }
}

/// A triangle that is larger than its cell reaches beyond all steps.
TEST_F(SlabFitterTest, holds_what_other_cells_have_of_the_triangles) {
  const GridFrame frame = frame_of({20, 30, 25}, 1);
  for (std::size_t i = case_count(300); i > 0; --i) {
    const List list = flat_list(1 + random_.below(6), 1, 0.5F);
    expect_fitted(frame, cell_at(frame, list[0].b), list);
  }
}

TEST_F(SlabFitterTest, is_as_thin_as_a_triangle_of_any_direction) {
  const GridFrame frame = frame_of({8, 3, 40}, 1);
  for (std::size_t i = case_count(500); i > 0; --i) {
    const List list = flat_list(1, 0.05F, 0);
    const CellSlab slab = SlabFitter(frame).fit(cell_at(frame, list[0].a), block_of(list).data(), 1);
    // The components are off by half at most, and so is the height by half of what the triangle is long on each axis.
    const ExactPolygon corners = in_frame(frame, list[0]);
    mpq_class thickness = 2 * double{CellSlab::step} + 2 * double{frame.padding(2)} * 3 * CellSlab::longest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
      thickness += (high - low) / 2;
    }
    EXPECT_LE((slab.high() + 1 - slab.low()) * double{CellSlab::step}, thickness.get_d());
    // The components are whole numbers, and the longest is 15.
    std::int32_t longest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, std::abs(slab.normal(axis)));
    EXPECT_EQ(longest, CellSlab::longest);
  }
}

/// Half of the triangles are wound the other way.
TEST_F(SlabFitterTest, does_not_ask_how_triangles_are_wound) {
  const GridFrame frame = frame_of({8, 8, 8}, 1);
  for (std::size_t count = 2; count <= 20; ++count) {
    List list(count, {{0.1F, 0.1F, 0.1F}, {0.2F, 0.1F, 0.15F}, {0.1F, 0.2F, 0.15F}});
    for (std::size_t i = 0; i < count; i += 2) std::swap(list[i].b, list[i].c);
    const CellSlab slab = SlabFitter(frame).fit(cell_at(frame, list[0].a), block_of(list).data(), count);
    EXPECT_LE(slab.high() - slab.low(), 3) << count;
  }
}

TEST_F(SlabFitterTest, is_the_whole_cell_where_triangles_have_no_normal) {
  const GridFrame frame = frame_of({8, 8, 8}, 1);
  const Vector3<float> a = {0.1F, 0.2F, 0.3F};
  const Vector3<float> b = {0.2F, 0.2F, 0.3F};
  for (const List& list : {List{{a, a, a}}, List{{a, b, a}, {b, b, a}}, List{{a, b, (a + b) / 2}}}) {
    expect_fitted(frame, cell_at(frame, a), list);
    EXPECT_EQ(SlabFitter(frame).fit(cell_at(frame, a), block_of(list).data(), list.size()).bits(), CellSlab().bits());
  }
}

}  // namespace
}  // namespace surehit::test::slab_fitter_test
