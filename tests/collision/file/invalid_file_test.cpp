#include "surehit/invalid_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "collision/same_answers.hpp"
#include "support/case_count.hpp"
#include "support/path_drawer.hpp"
#include "support/saved_file.hpp"
#include "support/saved_meshes.hpp"
#include "support/scalars.hpp"

namespace surehit::test::invalid_file_test {
namespace {

using Reason = InvalidFile::Reason;

/// Returns a collider of the mesh and the masks that another one has, built anew.
template <typename Scalar>
Collider<Scalar> built_anew(const Collider<Scalar>& collider, GeneratedMesh<Scalar>& mesh) {
  std::vector<std::uint32_t> masks;
  for (std::uint32_t id = 0; id < collider.triangle_count(); ++id) {
    mesh.add(collider.triangle(id));
    masks.push_back(collider.mask(id));
  }
  return Collider<Scalar>(mesh.view(), BuildOptions{.masks = masks});
}

template <typename Scalar>
void expect_answers_of_its_mesh(const Collider<Scalar>& loaded, std::uint64_t seed) {
  if (loaded.triangle_count() == 0) return;
  GeneratedMesh<Scalar> mesh;
  const Collider<Scalar> expected = built_anew(loaded, mesh);
  PathDrawer<Scalar> drawer(mesh.view(), seed);
  std::vector<Path<Scalar>> paths;
  for (int i = 0; i < 10; ++i) paths.push_back(drawer.draw());
  expect_same_answers(loaded, expected, paths);
}

template <typename Scalar>
class InvalidFileOf : public testing::Test {
 protected:
  using Damage = std::function<void(Bytes&, const ColliderParts&)>;

  /// Returns the bytes of one of the meshes, which are built once.
  static Bytes saved_mesh(const std::string& name) {
    static const std::map<std::string, Bytes> all = [] {
      std::map<std::string, Bytes> made;
      for (const SavedMesh<Scalar>& mesh : saved_meshes<Scalar>()) made.emplace(mesh.name, saved(mesh.collider()));
      return made;
    }();
    return all.at(name);
  }

  /// Expects that a load finds the damage, although the checksum is right.
  void expect_refused(const std::string& mesh, Reason reason, std::size_t (*offset)(const ColliderParts&),
                      const Damage& damage, bool is_found_if_trusted = true) {
    Bytes bytes = saved_mesh(mesh);
    const ColliderParts parts(bytes);
    damage(bytes, parts);
    repair(bytes);
    Collider<Scalar> collider;
    const LoadResult result = collider.try_load(bytes);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().reason, reason) << result.error().what();
    EXPECT_EQ(result.error().offset, offset(parts)) << result.error().what();
    EXPECT_EQ(collider.triangle_count(), 0U);
    EXPECT_EQ(collider.try_load(bytes, {.is_trusted = true}).has_value(), !is_found_if_trusted);
  }
};
TYPED_TEST_SUITE(InvalidFileOf, Scalars, ScalarNames);

TYPED_TEST(InvalidFileOf, head) {
  const Bytes bytes = this->saved_mesh("one triangle");
  const auto expect = [&](std::size_t offset, unsigned byte, Reason reason) {
    Bytes changed = bytes;
    changed[offset] = static_cast<std::byte>(byte);
    Collider<TypeParam> collider;
    const LoadResult result = collider.try_load(changed);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().reason, reason);
    EXPECT_EQ(std::string(result.error().what()).find("byte "), 0U);
    EXPECT_LE(result.error().offset, offset);
  };
  for (std::size_t i = 0; i < 8; ++i) expect(i, 1, Reason::not_saved);
  expect(8, 1, Reason::wrong_byte_order);
  expect(12, 2, Reason::newer_version);
  expect(12, 0, Reason::not_saved);
  expect(13, 1, Reason::newer_version);
  expect(14, 's', Reason::wrong_kind);
  expect(15, 12 - sizeof(TypeParam), Reason::wrong_scalar);
  expect(16, 0, Reason::wrong_size);
  expect(23, 1, Reason::wrong_size);
  expect(bytes.size() - 1, 1, Reason::wrong_checksum);
}

TYPED_TEST(InvalidFileOf, other_scalar) {
  using Other = std::conditional_t<std::is_same_v<TypeParam, float>, double, float>;
  const LoadResult result = Collider<Other>().try_load(this->saved_mesh("one triangle"));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().reason, Reason::wrong_scalar);
}

TYPED_TEST(InvalidFileOf, bytes_that_are_missing) {
  for (const char* const name : {"nothing", "one triangle", "prop in bricks"}) {
    const Bytes bytes = this->saved_mesh(name);
    for (std::size_t size = 0; size < bytes.size(); size += case_step()) {
      Bytes shorter(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      Collider<TypeParam> collider;
      ASSERT_FALSE(collider.try_load(shorter)) << size;
      repair(shorter);
      ASSERT_FALSE(collider.try_load(shorter)) << size;
      ASSERT_FALSE(collider.try_load(shorter, {.is_trusted = true})) << size;
    }
    Bytes longer = bytes;
    longer.push_back({});
    EXPECT_FALSE(Collider<TypeParam>().try_load(longer));
    repair(longer);
    EXPECT_FALSE(Collider<TypeParam>().try_load(longer));
  }
}

TYPED_TEST(InvalidFileOf, bytes_that_are_damaged) {
  Random random(89);
  for (const char* const name : {"one triangle", "bricks", "prop in bricks"}) {
    Bytes bytes = this->saved_mesh(name);
    for (std::size_t at = 0; at < bytes.size(); at += case_step()) {
      const std::byte kept = bytes[at];
      bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
      ASSERT_FALSE(Collider<TypeParam>().try_load(bytes)) << at;
      bytes[at] = kept;
    }
  }
}

/// Whoever makes the checksum right gets an error, or the answers of the mesh that the file now has. A trusted load may
/// get others, but it still answers.
TYPED_TEST(InvalidFileOf, bytes_that_are_forged) {
  Random random(97);
  std::size_t loaded = 0;
  std::size_t refused = 0;
  for (const char* const name : {"nothing", "one triangle", "masks", "bricks", "prop in bricks", "prop in a prop"}) {
    const Bytes bytes = this->saved_mesh(name);
    const ColliderParts parts(bytes);
    for (std::size_t i = 0; i < case_count(600); ++i) {
      Bytes forged = bytes;
      for (std::uint64_t changes = 1 + random.below(2); changes > 0; --changes) {
        // Half of the changes are behind the mesh, which is most of the file.
        const std::size_t first = random.one_in(2) || parts.frames >= parts.checksum ? 0 : parts.frames;
        const std::size_t at = first + random.below(forged.size() - 8 - first);
        forged[at] = random.one_in(2) ? forged[at] ^ static_cast<std::byte>(1 << random.below(8))
                                      : static_cast<std::byte>(random.below(6));
      }
      repair(forged);
      SCOPED_TRACE(std::string(name) + ", case " + std::to_string(i));
      Collider<TypeParam> collider;
      if (collider.try_load(forged)) {
        ++loaded;
        expect_answers_of_its_mesh(collider, i);
        if (this->HasFailure()) return;
      } else {
        ++refused;
        Collider<TypeParam> trusting;
        if (!trusting.try_load(forged, {.is_trusted = true}) || trusting.triangle_count() == 0) continue;
        GeneratedMesh<TypeParam> mesh;
        static_cast<void>(built_anew(trusting, mesh));
        PathDrawer<TypeParam> drawer(mesh.view(), i);
        for (int path = 0; path < 5; ++path) static_cast<void>(trusting.first_hit(drawer.draw()));
      }
    }
  }
  EXPECT_GT(loaded, case_count(100));
  EXPECT_GT(refused, case_count(1000));
}

TYPED_TEST(InvalidFileOf, counts_that_do_not_fit) {
  // Each count of 64 bits, and then each of 32.
  for (const std::size_t at : {24U, 32U, 40U, 80U, 88U}) {
    for (const std::uint64_t count :
         {std::uint64_t{1}, std::uint64_t{1} << 31, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
      SCOPED_TRACE(std::to_string(count) + " at " + std::to_string(at));
      this->expect_refused(
          "bricks", Reason::wrong_counts, [](const ColliderParts& parts) { return parts.counts; },
          [&](Bytes& bytes, const ColliderParts&) { set_number(bytes, at, count); });
    }
  }
  for (const std::size_t at : {72U, 76U}) {
    for (const std::uint32_t count : {0U, 1U << 20, ~0U}) {
      SCOPED_TRACE(std::to_string(count) + " at " + std::to_string(at));
      this->expect_refused(
          "bricks", Reason::wrong_counts, [](const ColliderParts& parts) { return parts.counts; },
          [&](Bytes& bytes, const ColliderParts&) { set_number(bytes, at, count); });
    }
  }
}

TYPED_TEST(InvalidFileOf, mesh) {
  this->expect_refused(
      "bricks", Reason::invalid_mesh,
      [](const ColliderParts& parts) { return parts.vertices + 15 * sizeof(TypeParam); },
      [](Bytes& bytes, const ColliderParts& parts) {
        set_number(bytes, parts.vertices + 17 * sizeof(TypeParam), std::numeric_limits<TypeParam>::quiet_NaN());
      });
  this->expect_refused(
      "bricks", Reason::invalid_mesh, [](const ColliderParts& parts) { return parts.triangles + 6; },
      [](Bytes& bytes, const ColliderParts& parts) { set_number(bytes, parts.triangles + 8, std::uint16_t{60000}); });
}

TYPED_TEST(InvalidFileOf, frames) {
  const auto first = [](const ColliderParts& parts) { return parts.frames; };
  const auto second = [](const ColliderParts& parts) { return parts.frames + parts.frame_width; };
  const auto grown = [](std::size_t frame) {
    return [frame](Bytes& bytes, const ColliderParts& parts) {
      const std::size_t at = parts.frames + frame * parts.frame_width;
      set_number(bytes, at, number_at<TypeParam>(bytes, at) - 1);
    };
  };
  this->expect_refused("prop in a prop", Reason::invalid_grid, first, grown(0));
  this->expect_refused("prop in a prop", Reason::invalid_grid, second, grown(1), false);
  constexpr TypeParam infinity = std::numeric_limits<TypeParam>::infinity();
  for (const TypeParam side : {infinity, -infinity, std::numeric_limits<TypeParam>::quiet_NaN()}) {
    this->expect_refused("prop in a prop", Reason::invalid_grid, second, [&](Bytes& bytes, const ColliderParts& parts) {
      set_number(bytes, parts.frames + parts.frame_width, side);
    });
  }
  this->expect_refused("prop in a prop", Reason::invalid_grid, second, [](Bytes& bytes, const ColliderParts& parts) {
    const std::size_t at = parts.frames + parts.frame_width;  // The low side is above the high one.
    set_number(bytes, at, number_at<TypeParam>(bytes, at + 3 * sizeof(TypeParam)) + 1);
  });
  for (const std::uint32_t cells : {0U, 2049U, ~0U}) {
    this->expect_refused("prop in a prop", Reason::invalid_grid, first, [&](Bytes& bytes, const ColliderParts& parts) {
      set_number(bytes, parts.frames + 6 * sizeof(TypeParam), cells);
    });
  }
  // There are not as many cells.
  this->expect_refused(
      "prop in a prop", Reason::wrong_counts, [](const ColliderParts& parts) { return parts.cells; },
      [](Bytes& bytes, const ColliderParts& parts) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          set_number(bytes, parts.frames + 6 * sizeof(TypeParam) + 4 * axis, 2000U);
        }
      });
}

TYPED_TEST(InvalidFileOf, cells) {
  const auto first = [](const ColliderParts& parts) { return parts.cells; };
  const auto set_first = [](unsigned kind) {
    return [kind](Bytes& bytes, const ColliderParts& parts) { bytes[parts.cells] = static_cast<std::byte>(kind); };
  };
  this->expect_refused("one cell", Reason::invalid_grid, first, set_first(4));
  // The list is then that of no cell, and the triangle is in no list.
  this->expect_refused(
      "one cell", Reason::wrong_counts, [](const ColliderParts& parts) { return parts.lists; }, set_first(0));
  this->expect_refused(
      "one cell", Reason::wrong_counts, [](const ColliderParts& parts) { return parts.cells + 1; }, set_first(2));
  this->expect_refused("one cell", Reason::wrong_counts, first, set_first(3));
  // More than two levels of bricks.
  this->expect_refused(
      "bricks", Reason::invalid_grid, [](const ColliderParts& parts) { return parts.cells + 2; },
      [](Bytes& bytes, const ColliderParts& parts) {
        for (std::size_t i = 0; i < 3; ++i) bytes[parts.cells + i] = std::byte{2};
      });
}

TYPED_TEST(InvalidFileOf, lists) {
  const auto first_list = [](const ColliderParts& parts) { return parts.lists; };
  const auto behind_lists = [](const ColliderParts& parts) { return parts.entries; };
  const auto last_entry = [](const ColliderParts& parts) { return parts.entries + 199 * parts.entry_width; };
  for (const std::uint32_t count : {0U, 201U, ~0U}) {
    this->expect_refused("one cell", Reason::invalid_list, first_list,
                         [&](Bytes& bytes, const ColliderParts& parts) { set_number(bytes, parts.lists + 4, count); });
  }
  this->expect_refused("one cell", Reason::wrong_counts, behind_lists,
                       [](Bytes& bytes, const ColliderParts& parts) { set_number(bytes, parts.lists + 4, 199U); });
  this->expect_refused("one cell", Reason::invalid_list, first_list, [](Bytes& bytes, const ColliderParts& parts) {
    set_number(bytes, parts.lists, 0U | 31U << 5 | 31U << 15 | 31U << 25 | 1U << 30);
  });
  this->expect_refused("one cell", Reason::invalid_list, first_list, [](Bytes& bytes, const ColliderParts& parts) {
    set_number(bytes, parts.lists, 5U | 4U << 5);  // The high side is where the low side is.
    set_number(bytes, parts.lists, 5U | 3U << 5);
  });
  // A box that leaves out a part of the triangles.
  for (const std::uint32_t box : {1U | 31U << 5 | 31U << 15 | 31U << 25, 30U << 5 | 31U << 15 | 31U << 25,
                                  31U << 5 | 1U << 10 | 31U << 15 | 31U << 25, 31U << 5 | 31U << 15 | 30U << 25}) {
    this->expect_refused(
        "one cell", Reason::invalid_list, last_entry,
        [&](Bytes& bytes, const ColliderParts& parts) { set_number(bytes, parts.lists, box); }, false);
  }
}

TYPED_TEST(InvalidFileOf, entries) {
  const auto seventh = [](const ColliderParts& parts) { return parts.entries + 14; };
  const auto last = [](const ColliderParts& parts) { return parts.entries + 398; };
  const auto set = [](std::size_t entry, std::uint16_t id) {
    return [=](Bytes& bytes, const ColliderParts& parts) { set_number(bytes, parts.entries + 2 * entry, id); };
  };
  this->expect_refused("one cell", Reason::invalid_list, seventh, set(7, 6));
  this->expect_refused("one cell", Reason::invalid_list, seventh, set(7, 5));
  this->expect_refused("one cell", Reason::invalid_list, last, set(199, 200));
  this->expect_refused("one cell", Reason::invalid_list, last, set(199, 60000));
}

/// Removes an entry of each list, or adds one in front or behind, and makes the counts right.
TYPED_TEST(InvalidFileOf, lists_that_are_not_those_of_a_build) {
  for (const char* const name : {"scattered", "bricks", "prop", "prop in bricks", "prop in a prop"}) {
    const Bytes bytes = this->saved_mesh(name);
    const ColliderParts parts(bytes);
    const auto last_triangle = static_cast<std::uint16_t>(parts.triangle_count - 1);
    std::size_t first_entry = 0;
    std::size_t behind = 0;
    for (std::size_t list = 0; list < parts.list_count; ++list) {
      SCOPED_TRACE(std::string(name) + ", list " + std::to_string(list));
      const std::size_t record = parts.lists + 8 * list + 4;
      const auto count = number_at<std::uint32_t>(bytes, record);
      const std::size_t first = parts.entries + 2 * first_entry;
      const std::size_t last = first + 2 * count;
      first_entry += count;
      if (list % case_step() != 0) continue;
      const auto expect_found = [&](Bytes forged, std::uint32_t new_count, std::size_t offset) {
        set_number(forged, record, new_count);
        set_number(forged, 88, std::uint64_t{parts.entry_count + new_count - count});
        repair(forged);
        const LoadResult result = Collider<TypeParam>().try_load(forged);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().reason, Reason::invalid_list);
        EXPECT_EQ(result.error().offset, offset) << result.error().what();
        EXPECT_TRUE(Collider<TypeParam>().try_load(forged, {.is_trusted = true}));
      };
      const auto with = [&](std::size_t offset, std::uint16_t id) {
        Bytes forged = bytes;
        forged.insert(forged.begin() + static_cast<std::ptrdiff_t>(offset), 2, std::byte{0});
        set_number(forged, offset, id);
        return forged;
      };
      if (count > 1) {
        Bytes forged = bytes;
        const auto entry = forged.begin() + static_cast<std::ptrdiff_t>(first);
        forged.erase(entry, entry + 2);
        expect_found(forged, count - 1, first);
      }
      if (count > 0 && number_at<std::uint16_t>(bytes, first) > 0) expect_found(with(first, 0), count + 1, first);
      if (count > 0 && number_at<std::uint16_t>(bytes, last - 2) < last_triangle) {
        expect_found(with(last, last_triangle), count + 1, last);
        ++behind;
      }
    }
    EXPECT_GT(behind * case_step(), 3U);
  }
}

/// Each cell in turn counts as empty, and its list is gone with all entries.
TYPED_TEST(InvalidFileOf, cells_that_have_lost_their_list) {
  for (const char* const name : {"scattered", "bricks"}) {
    const Bytes bytes = this->saved_mesh(name);
    const ColliderParts parts(bytes);
    std::size_t list = 0;
    std::size_t first_entry = 0;
    for (std::size_t cell = 0; cell < parts.cell_count; ++cell) {
      if (bytes[parts.cells + cell] != std::byte{1}) continue;
      const std::size_t record = parts.lists + 8 * list++;
      const auto count = number_at<std::uint32_t>(bytes, record + 4);
      const std::size_t entry = parts.entries + parts.entry_width * first_entry;
      first_entry += count;
      Bytes forged = bytes;
      const auto at = [&](std::size_t offset) { return forged.begin() + static_cast<std::ptrdiff_t>(offset); };
      forged.erase(at(entry), at(entry + count * parts.entry_width));
      forged.erase(at(record), at(record + 8));
      forged[parts.cells + cell] = std::byte{0};
      set_number(forged, 76, static_cast<std::uint32_t>(parts.list_count - 1));
      set_number(forged, 88, std::uint64_t{parts.entry_count - count});
      repair(forged);
      const LoadResult result = Collider<TypeParam>().try_load(forged);
      ASSERT_FALSE(result) << name << ", cell " << cell;
      EXPECT_EQ(result.error().reason, Reason::invalid_list);
      EXPECT_TRUE(Collider<TypeParam>().try_load(forged, {.is_trusted = true}));
    }
    EXPECT_GT(list, 3U);
  }
}

/// The list of a cell with an inner grid has the large triangles alone, or none. But its box is around all.
TYPED_TEST(InvalidFileOf, boxes_of_cells_with_inner_grids) {
  std::size_t without_entries = 0;
  for (const SavedMesh<TypeParam>& made : saved_meshes<TypeParam>()) {
    const Bytes bytes = saved(made.collider());
    const ColliderParts parts(bytes);
    std::size_t record = parts.lists;
    for (std::size_t cell = parts.cells; cell < parts.lists; ++cell) {
      if (bytes[cell] == std::byte{1}) record += 8;
      if (bytes[cell] != std::byte{3}) continue;
      const std::size_t of_cell = record;
      record += 8;
      without_entries += number_at<std::uint32_t>(bytes, of_cell + 4) == 0 ? 1 : 0;
      const auto box = number_at<std::uint32_t>(bytes, of_cell);
      for (int side = 0; side < 6; ++side) {
        const std::uint32_t low = box >> (side - side % 2) * 5 & 31;
        const std::uint32_t high = box >> ((side - side % 2) * 5 + 5) & 31;
        if (low == high) continue;  // It cannot be thinner.
        Bytes forged = bytes;
        set_number(forged, of_cell, side % 2 == 0 ? box + (1U << 5 * side) : box - (1U << 5 * side));
        repair(forged);
        const LoadResult result = Collider<TypeParam>().try_load(forged);
        ASSERT_FALSE(result) << made.name << ", side " << side;
        EXPECT_EQ(result.error().reason, Reason::invalid_list);
      }
    }
  }
  EXPECT_GT(without_entries, 0U);
}

/// A grid in a grid, and so on, each of one cell.
TYPED_TEST(InvalidFileOf, inner_grids_that_lie_too_deep) {
  const Bytes bytes = this->saved_mesh("one triangle");
  const ColliderParts parts(bytes);
  for (const std::size_t depth : {4U, 5U}) {
    Bytes forged(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(parts.frames));
    const auto append = [&](std::size_t first, std::size_t last) {
      forged.insert(forged.end(), bytes.begin() + static_cast<std::ptrdiff_t>(first),
                    bytes.begin() + static_cast<std::ptrdiff_t>(last));
    };
    for (std::size_t i = 0; i <= depth; ++i) append(parts.frames, parts.cells);
    forged.insert(forged.end(), depth, std::byte{3});
    forged.push_back(std::byte{1});
    for (std::size_t i = 0; i < depth; ++i) {
      append(parts.lists, parts.lists + 4);
      forged.insert(forged.end(), 4, std::byte{0});
    }
    append(parts.lists, bytes.size());
    set_number(forged, 72, static_cast<std::uint32_t>(depth + 1));
    set_number(forged, 76, static_cast<std::uint32_t>(depth + 1));
    set_number(forged, 80, std::uint64_t{depth + 1});
    repair(forged);
    EXPECT_EQ(Collider<TypeParam>().try_load(forged, {.is_trusted = true}).has_value(), depth <= 4);
    // One cell fits any box that is finite.
    Bytes not_finite = forged;
    set_number(not_finite, parts.frames + parts.frame_width, std::numeric_limits<TypeParam>::quiet_NaN());
    repair(not_finite);
    EXPECT_FALSE(Collider<TypeParam>().try_load(not_finite, {.is_trusted = true}));
    EXPECT_FALSE(Collider<TypeParam>().try_load(forged));  // The triangle is not small.
  }
}

/// Empty cells in turn get an inner grid of one cell, which is empty too. No build makes one, but it changes no answer.
TYPED_TEST(InvalidFileOf, inner_grids_without_triangles) {
  const Bytes bytes = this->saved_mesh("prop in a prop");
  const ColliderParts parts(bytes);
  std::size_t cell = parts.lists - 1;
  while (bytes[cell] != std::byte{3}) --cell;  // Behind it, a new inner grid is the last one.
  std::size_t count = 0;
  for (; cell < parts.lists; ++cell) {
    if (bytes[cell] != std::byte{0} || ++count % 16 != 1) continue;
    const auto lists_before = std::count_if(
        &bytes[parts.cells], &bytes[cell], [](std::byte kind) { return kind == std::byte{1} || kind == std::byte{3}; });
    Bytes forged = bytes;
    const auto insert = [&](std::size_t at, std::size_t first, std::size_t last) {
      forged.insert(forged.begin() + static_cast<std::ptrdiff_t>(at), &bytes[first], &bytes[last]);
    };
    // From the last part to the first, so that all places are those of `parts`.
    const std::size_t new_list = parts.lists + 8 * static_cast<std::size_t>(lists_before);
    insert(new_list, parts.lists, parts.lists + 8);
    set_number(forged, new_list + 4, 0U);
    insert(parts.lists, cell, cell + 1);
    forged[cell] = std::byte{3};
    insert(parts.cells, parts.frames, parts.frames + parts.frame_width);  // The new frame is the last one.
    for (std::size_t axis = 1; axis <= 3; ++axis) set_number(forged, parts.cells + parts.frame_width - 4 * axis, 1U);
    set_number(forged, 72, static_cast<std::uint32_t>(parts.frame_count + 1));
    set_number(forged, 76, static_cast<std::uint32_t>(parts.list_count + 1));
    set_number(forged, 80, std::uint64_t{parts.cell_count + 1});
    repair(forged);
    const LoadResult result = Collider<TypeParam>().try_load(forged);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().reason, Reason::invalid_grid) << result.error().what();
    EXPECT_EQ(result.error().offset, parts.cells) << result.error().what();
    Collider<TypeParam> trusted;
    ASSERT_TRUE(trusted.try_load(forged, {.is_trusted = true}));
    expect_answers_of_its_mesh(trusted, cell);
  }
  EXPECT_GT(count, 16U);
}

TYPED_TEST(InvalidFileOf, masks_of_some_triangles_alone) {
  Bytes forged = this->saved_mesh("bricks");
  const ColliderParts parts(forged);
  forged.insert(forged.begin() + static_cast<std::ptrdiff_t>(parts.masks), 8, std::byte{1});
  set_number(forged, 40, std::uint64_t{2});
  repair(forged);
  const LoadResult result = Collider<TypeParam>().try_load(forged);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().reason, Reason::wrong_counts);
}

}  // namespace
}  // namespace surehit::test::invalid_file_test
