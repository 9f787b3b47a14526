#include "walk/swept_lanes.hpp"

#include "support/rounding_flags.hpp"

// This file is compiled once for each instruction set. The best one is chosen when the first batch is asked.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "walk/swept_lanes.cpp"
#include <hwy/foreach_target.h>
// These must come after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/lane_bits-inl.hpp"
#include "walk/grid_traversal.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using SweptTag = hn::CappedTag<float, SweptLanes::count>;

/// The steps of `SweptLanes`, for the lanes of one vector.
class SweptStep {
  static constexpr SweptTag d{};
  static constexpr hn::RebindToSigned<SweptTag> di{};
  static constexpr hn::RebindToUnsigned<SweptTag> du{};
  using Mask = hn::Mask<SweptTag>;
  using Floats = hn::Vec<SweptTag>;
  using Ints = hn::Vec<decltype(di)>;
  using Words = hn::Vec<decltype(du)>;

 public:
  /// The first lane is lane `from`.
  HWY_INLINE SweptStep(SweptLanes& lanes, std::size_t from) : lanes_(lanes), from_(from) {}

  /// Begins the walk of some lanes whose ways are set. Returns those that have something to walk.
  HWY_INLINE std::uint32_t begin(std::uint32_t entering) {
    Floats enters = hn::Zero(d);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      enters = hn::Max(enters, hn::Mul(hn::Neg(high(axis)), load(lanes_.inverse_rate[axis])));
    }
    auto inside = hn::Le(enters, load(lanes_.end));
    const Mask begins = mask_of(d, entering);
    store_where(begins, enters, d, &lanes_.t[from_]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Floats first = first_cell(axis, enters);
      inside = hn::And(inside, hn::Lt(first, stop(axis)));
      const Floats last = hn::Max(first, hn::Min(last_cell(axis, enters), hn::Sub(stop(axis), one())));
      store_where(begins, axis == 0 ? first : hn::Add(last, one()), d, &lanes_.horizon[axis][from_]);
    }
    return static_cast<std::uint32_t>(bits_of(d, inside)) & entering;
  }

  /// Makes a step with all lanes that still walk.
  HWY_INLINE void step(std::uint32_t walking, SweptLanes::Arrivals& arrivals) {
    const Mask begins = mask_of(d, lanes_.begins >> from_);
    const Mask leaped = mask_of(d, lanes_.leaped >> from_);
    Floats horizon[3];
    Floats crossing[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      horizon[axis] = load(lanes_.horizon[axis]);
      crossing[axis] = hn::Mul(hn::Sub(horizon[axis], high(axis)), load(lanes_.inverse_rate[axis]));
    }
    const Floats next = hn::Min(hn::Min(crossing[0], crossing[1]), crossing[2]);
    const Mask across[3] = {hn::Or(begins, hn::Eq(crossing[0], next)),
                            hn::AndNot(hn::Or(begins, hn::Eq(crossing[0], next)), hn::Eq(crossing[1], next)),
                            hn::AndNot(begins, hn::And(hn::Ne(crossing[0], next), hn::Ne(crossing[1], next)))};
    const Floats before = load(lanes_.t);
    const Floats now = hn::IfThenElse(begins, before, hn::Max(before, next));
    Mask inside = hn::Le(now, load(lanes_.end));
    Floats low[3];   // The box's first cell.
    Floats base[3];  // The first one of those that the box comes to now.
    Floats more[3];  // 1 where it also comes to the next cell on an axis.
    Floats seen[3];  // The horizon after this step.
    Mask is_in_grid = hn::Eq(now, now);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = first_cell(axis, now);
      inside = hn::And(inside, hn::Lt(low[axis], stop(axis)));
      const Floats seen_before = hn::Sub(hn::Min(horizon[axis], stop(axis)), one());
      const Floats last = hn::IfThenElse(leaped, hn::Min(seen_before, last_cell(axis, now)), seen_before);
      base[axis] = hn::IfThenElse(across[axis], horizon[axis], low[axis]);
      more[axis] = hn::IfThenZeroElse(across[axis], hn::Sub(last, low[axis]));
      seen[axis] = hn::Add(hn::IfThenElse(across[axis], horizon[axis], last), one());
      is_in_grid = hn::And(is_in_grid, hn::Lt(base[axis], stop(axis)));
    }
    inside = hn::And(inside, mask_of(d, walking));
    arrivals.ended |= static_cast<std::uint32_t>(bits_of(d, hn::AndNot(inside, mask_of(d, walking)))) << from_;
    const Floats pitch[3] = {load(lanes_.pitch[0]), load(lanes_.pitch[1]), load(lanes_.pitch[2])};
    const Floats first = load(lanes_.first);
    // Lanes that do not walk look at the first cell.
    const auto look = [&](const Floats(&cell)[3], Mask looking) HWY_ATTR {
      const Floats index =
          hn::MulAdd(cell[0], pitch[0], hn::MulAdd(cell[1], pitch[1], hn::MulAdd(cell[2], pitch[2], first)));
      const auto* const top = reinterpret_cast<const std::uint32_t*>(lanes_.grid.all_top().data());
      return hn::GatherIndex(du, top, hn::ConvertTo(di, hn::IfThenElseZero(looking, index)));
    };
    // The cube of empty cells that begins with the box's first cell.
    const Words word = look(low, inside);
    const Words octant = hn::LoadU(du, &lanes_.octant[from_]);
    const Words distance = hn::And(hn::Shr(word, hn::ShiftLeft<2>(octant)), hn::Set(du, 15U));
    const Floats edge = hn::ConvertTo(d, hn::BitCast(di, distance));
    Mask is_empty = hn::RebindMask(d, hn::Ne(hn::And(word, hn::Set(du, 15U)), hn::Zero(du)));
    Floats beyond[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      beyond[axis] = hn::Add(low[axis], edge);
      is_empty = hn::And(is_empty, hn::Ge(beyond[axis], hn::Min(seen[axis], stop(axis))));
    }
    Mask still_begins = begins;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Floats far = hn::IfThenElse(is_empty, hn::Max(beyond[axis], seen[axis]), seen[axis]);
      // Beyond the grid there are no cells.
      far = hn::IfThenElse(hn::Ge(far, stop(axis)), hn::Set(d, 0x1p60F), far);
      if (axis == 0) still_begins = hn::And(still_begins, hn::Le(far, last_cell(0, now)));
      hn::StoreU(hn::IfThenElse(inside, far, horizon[axis]), d, &lanes_.horizon[axis][from_]);
    }
    hn::StoreU(hn::IfThenElse(inside, now, before), d, &lanes_.t[from_]);
    still_begins = hn::And(still_begins, inside);
    const auto keep = [&](std::uint32_t& bits, Mask mask) HWY_ATTR {
      const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << hn::Lanes(d)) - 1);
      bits = (bits & ~(all << from_)) | static_cast<std::uint32_t>(bits_of(d, mask)) << from_;
    };
    keep(lanes_.begins, still_begins);
    keep(lanes_.leaped, is_empty);
    // The cells that the box comes to lie side by side on two axes.
    const Mask looking = hn::AndNot(is_empty, hn::And(inside, is_in_grid));
    const Floats more_x = more[0];
    const Mask first_pair = hn::Gt(hn::IfThenElse(across[0], more[1], more_x), hn::Zero(d));
    const Mask second_pair = hn::Gt(hn::IfThenElse(across[2], more[1], more[2]), hn::Zero(d));
    for (std::size_t k = 0; k < SweptLanes::max_cells; ++k) {
      Mask comes = looking;
      if ((k & 1) != 0) comes = hn::And(comes, first_pair);
      if ((k & 2) != 0) comes = hn::And(comes, second_pair);
      arrivals_at(k, comes, across, base, look, now, arrivals);
    }
  }

 private:
  static HWY_INLINE Floats one() { return hn::Set(d, 1.0F); }
  HWY_INLINE Floats load(const SweptLanes::Row<float>& row) const { return hn::LoadU(d, &row[from_]); }
  HWY_INLINE Floats high(std::size_t axis) const { return hn::Add(load(lanes_.start[axis]), load(lanes_.reach[axis])); }
  HWY_INLINE Floats low(std::size_t axis) const { return hn::Sub(load(lanes_.start[axis]), load(lanes_.reach[axis])); }
  HWY_INLINE Floats stop(std::size_t axis) const {
    return hn::Set(d, static_cast<float>(lanes_.grid.frame().cells[axis]));
  }
  /// Returns the first cell of the grid on an axis that the box meets at some t.
  HWY_INLINE Floats first_cell(std::size_t axis, Floats t) const {
    return hn::Max(hn::Zero(d), hn::Floor(hn::MulAdd(t, load(lanes_.rate[axis]), low(axis))));
  }
  /// Returns the last cell that it meets, inside the grid or not.
  HWY_INLINE Floats last_cell(std::size_t axis, Floats t) const {
    return hn::Floor(hn::MulAdd(t, load(lanes_.rate[axis]), high(axis)));
  }

  /// Sets what some lanes come to in their cell number k.
  template <typename Look>
  HWY_INLINE void arrivals_at(std::size_t k, Mask comes, const Mask (&across)[3], const Floats (&base)[3],
                              const Look& look, Floats now, SweptLanes::Arrivals& arrivals) const {
    if (hn::AllFalse(d, comes)) return;
    // The first of the two axes is x, or y for a box that comes across x.
    Floats cell[3] = {base[0], base[1], base[2]};
    if ((k & 1) != 0) {
      cell[0] = hn::Add(cell[0], hn::IfThenZeroElse(across[0], one()));
      cell[1] = hn::Add(cell[1], hn::IfThenElseZero(across[0], one()));
    }
    if ((k & 2) != 0) {
      cell[2] = hn::Add(cell[2], hn::IfThenZeroElse(across[2], one()));
      cell[1] = hn::Add(cell[1], hn::IfThenElseZero(across[2], one()));
    }
    const Words word = look(cell, comes);
    const auto bits = [&](auto mask) HWY_ATTR { return static_cast<std::uint32_t>(bits_of(du, mask)); };
    const auto coming = static_cast<std::uint32_t>(bits_of(d, comes));
    const std::uint32_t full = coming & bits(hn::Eq(hn::And(word, hn::Set(du, 15U)), hn::Zero(du)));
    if (full == 0) return;
    const std::uint32_t plain =
        full & bits(hn::Eq(hn::And(word, hn::Set(du, CellWord::inner_bit | CellWord::divided_bits)), hn::Set(du, 16U)));
    hn::StoreU(word, du, &arrivals.words[k][from_]);
    const std::uint32_t bricks = full & ~plain;
    if (bricks != 0) {
      for (std::size_t axis = 0; axis < 3; ++axis) hn::StoreU(cell[axis], d, &arrivals.cells[k][axis][from_]);
    }
    const std::uint32_t lists = plain == 0 ? 0 : meet_lists(cell, word, plain, now);
    arrivals.bricks[k] |= bricks << from_;
    arrivals.lists[k] |= lists << from_;
    arrivals.all |= (bricks | lists) << from_;
  }

  /// Returns the lanes of `in_lists` whose box may meet a triangle of their list. It tests the box of the list, and its
  /// slab.
  HWY_INLINE std::uint32_t meet_lists(const Floats (&cell)[3], Words word, std::uint32_t in_lists, Floats now) const {
    const auto has_list = mask_of(du, in_lists);
    const auto* const lists = reinterpret_cast<const std::uint32_t*>(lanes_.grid.lists().data());
    const Words list = hn::IfThenElseZero(has_list, hn::ShiftRight<CellWord::list_shift>(word));
    const Words box = hn::GatherIndex(du, lists, hn::BitCast(di, hn::ShiftLeft<1>(list)));
    const Words octant = hn::LoadU(du, &lanes_.octant[from_]);
    const Words last_part = hn::Set(du, CellBox::parts - 1);
    const Floats part = hn::Set(d, 1.0F / CellBox::parts);
    Floats enters = now;
    Floats leaves = load(lanes_.end);
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = static_cast<int>(k);
      const auto is_mirrored = hn::Ne(hn::And(octant, hn::Set(du, 1U << axis)), hn::Zero(du));
      const Words low_part = hn::And(hn::ShiftRightSame(box, 10 * axis), last_part);
      const Words high_part = hn::And(hn::ShiftRightSame(box, 10 * axis + 5), last_part);
      const Words first = hn::IfThenElse(is_mirrored, hn::Xor(high_part, last_part), low_part);
      const Words last = hn::IfThenElse(is_mirrored, hn::Xor(low_part, last_part), high_part);
      const Floats near = hn::MulAdd(hn::ConvertTo(d, hn::BitCast(di, first)), part, cell[k]);
      const Floats far = hn::MulAdd(hn::ConvertTo(d, hn::BitCast(di, last)), part, hn::Add(cell[k], part));
      const Floats inverse = load(lanes_.inverse_rate[k]);
      enters = hn::Max(enters, hn::Mul(hn::Sub(near, high(k)), inverse));
      leaves = hn::Min(leaves, hn::Mul(hn::Sub(far, low(k)), inverse));
    }
    const std::uint32_t meeting = static_cast<std::uint32_t>(bits_of(d, hn::Le(enters, leaves))) & in_lists;
    if (lanes_.slabs == nullptr || meeting == 0) return meeting;
    const Ints slab = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(lanes_.slabs), hn::BitCast(di, list));
    return meeting & ~miss_slabs(cell, slab, enters, leaves);
  }

  /// Returns the lanes whose box misses the slab of the list. It is near the list between `enters` and `leaves`.
  HWY_INLINE std::uint32_t miss_slabs(const Floats (&cell)[3], Ints slab, Floats enters, Floats leaves) const {
    const Words octant = hn::LoadU(du, &lanes_.octant[from_]);
    Floats height = hn::Zero(d);
    Floats rate = hn::Zero(d);
    Floats reach = hn::Zero(d);
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = static_cast<int>(k);
      const Floats component = hn::ConvertTo(d, hn::ShiftRight<27>(hn::ShiftLeftSame(slab, 27 - 5 * axis)));
      // The sign changes where the box is mirrored.
      const Floats sign = hn::BitCast(d, hn::ShiftLeftSame(hn::And(octant, hn::Set(du, 1U << axis)), 31 - axis));
      const Floats normal = hn::Xor(component, sign);
      const Floats to_start = hn::Sub(load(lanes_.start[k]), hn::Add(cell[k], hn::Set(d, 0.5F)));
      height = hn::MulAdd(normal, to_start, height);
      rate = hn::MulAdd(normal, load(lanes_.rate[k]), rate);
      reach = hn::MulAdd(hn::Abs(component), load(lanes_.reach[k]), reach);
    }
    const Floats at_entry = hn::MulAdd(enters, rate, height);
    const Floats at_exit = hn::MulAdd(leaves, rate, height);
    const Floats step = hn::Set(d, CellSlab::step);
    const Floats first = hn::ConvertTo(d, hn::ShiftRight<24>(hn::ShiftLeft<8>(slab)));
    const Floats last = hn::ConvertTo(d, hn::Add(hn::ShiftRight<24>(slab), hn::Set(di, 1)));
    const auto below = hn::Lt(hn::Max(at_entry, at_exit), hn::Sub(hn::Mul(first, step), reach));
    const auto above = hn::Gt(hn::Min(at_entry, at_exit), hn::MulAdd(last, step, reach));
    return static_cast<std::uint32_t>(bits_of(d, hn::Or(below, above)));
  }

  SweptLanes& lanes_;
  const std::size_t from_;
};

/// Counts the ways of some boxes in cells, as many as fit a vector of doubles. Returns those that can walk in lanes.
class SweptEntry {
  using Tag = hn::CappedTag<double, 8>;
  static constexpr Tag d{};
  static constexpr hn::Rebind<float, Tag> df{};
  using V = hn::Vec<Tag>;

 public:
  static HWY_INLINE std::uint32_t place(const SweptLanes::Entering& boxes, std::uint32_t entering, std::size_t from,
                                        SweptLanes& lanes) {
    const GridFrame& frame = lanes.grid.frame();
    const V per_cell = hn::Set(d, 1.0 / frame.division);
    const auto taken = mask_of(df, entering);
    const auto keep = [&](SweptLanes::Row<float>& row, hn::Vec<decltype(df)> x)
                          HWY_ATTR { store_where(taken, x, df, &row[from]); };
    const auto scaled = [&](const SweptLanes::Row<double>& row) HWY_ATTR {
      return hn::Mul(hn::Mul(hn::LoadU(d, &row[from]), hn::Set(d, frame.unit[0])), hn::Set(d, frame.unit[1]));
    };
    V first_cell = hn::Set(d, static_cast<double>(frame.first_top));
    auto is_plain = hn::Eq(first_cell, first_cell);
    V octant = hn::Zero(d);
    for (std::size_t k = 0; k < 3; ++k) {
      const V stop = hn::Set(d, static_cast<double>(frame.cells[k]));
      const V scale = hn::Set(d, frame.scale[k]);
      const auto to_cells = [&](const SweptLanes::Row<double>& row) HWY_ATTR {
        const V cells = hn::Mul(hn::Sub(scaled(row), hn::Set(d, frame.origin[k])), scale);
        return hn::Mul(hn::Add(cells, hn::Set(d, double{frame.margin[k]})), per_cell);
      };
      const V from_start = to_cells(boxes.start[k]);
      const V way = hn::Sub(to_cells(boxes.end[k]), from_start);
      const V reach = hn::Add(hn::Mul(hn::Mul(scaled(boxes.half_extents[k]), scale), per_cell),
                              hn::Set(d, 3.0 * GridFrame::padding_share * frame.cells[k]));
      is_plain = hn::And(is_plain, hn::And(hn::Ge(from_start, hn::Neg(stop)), hn::Le(from_start, hn::Add(stop, stop))));
      const V speed = hn::Abs(way);
      is_plain = hn::And(is_plain, hn::And(hn::Le(speed, hn::Set(d, 0x1p10 * frame.cells[k])),
                                           hn::Le(reach, hn::Set(d, SweptLanes::largest_reach))));
      const auto is_mirrored = hn::Lt(way, hn::Zero(d));
      const auto is_still = hn::Lt(speed, hn::Set(d, double{ClippedPath::min_rate}));
      const V inverse =
          hn::IfThenElse(is_still, hn::Set(d, double{ClippedPath::max_inverse}), hn::Div(hn::Set(d, 1.0), speed));
      const V pitch = hn::Set(d, static_cast<double>(frame.top_orders[0].pitch[k]));
      keep(lanes.start[k], hn::DemoteTo(df, hn::IfThenElse(is_mirrored, hn::Sub(stop, from_start), from_start)));
      keep(lanes.rate[k], hn::DemoteTo(df, hn::IfThenZeroElse(is_still, speed)));
      keep(lanes.inverse_rate[k], hn::DemoteTo(df, inverse));
      keep(lanes.reach[k], hn::DemoteTo(df, reach));
      keep(lanes.pitch[k], hn::DemoteTo(df, hn::IfThenElse(is_mirrored, hn::Neg(pitch), pitch)));
      const double mirrored_first = frame.top_orders[std::size_t{1} << k].first - frame.top_orders[0].first;
      first_cell = hn::Add(first_cell, hn::IfThenElseZero(is_mirrored, hn::Set(d, mirrored_first)));
      octant = hn::Add(octant, hn::IfThenElseZero(is_mirrored, hn::Set(d, static_cast<double>(1U << k))));
    }
    keep(lanes.first, hn::DemoteTo(df, first_cell));
    const hn::Rebind<std::int32_t, Tag> di;
    const hn::Rebind<std::uint32_t, Tag> du;
    store_where(hn::RebindMask(du, taken), hn::BitCast(du, hn::DemoteTo(di, octant)), du, &lanes.octant[from]);
    return static_cast<std::uint32_t>(bits_of(d, is_plain)) & entering;
  }
};

std::uint32_t enter_lanes(SweptLanes& lanes, const SweptLanes::Entering& boxes, std::uint32_t entering,
                          std::uint32_t& apart) {
  const hn::CappedTag<double, 8> d;
  std::uint32_t placed = 0;
  for (std::size_t from = 0; from < SweptLanes::count; from += hn::Lanes(d)) {
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << hn::Lanes(d)) - 1);
    if ((entering >> from & all) == 0) continue;
    placed |= SweptEntry::place(boxes, entering >> from & all, from, lanes) << from;
  }
  apart = entering & ~placed;
  const std::size_t width = hn::Lanes(SweptTag());
  std::uint32_t walking = 0;
  for (std::size_t from = 0; from < SweptLanes::count; from += width) {
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << width) - 1);
    if ((placed >> from & all) == 0) continue;
    walking |= SweptStep(lanes, from).begin(placed >> from & all) << from;
  }
  lanes.begins = (lanes.begins & ~entering) | walking;
  lanes.leaped &= ~entering;
  return walking;
}

void step_lanes(SweptLanes& lanes, std::uint32_t walking, SweptLanes::Arrivals& arrivals) {
  arrivals.ended = 0;
  arrivals.all = 0;
  arrivals.lists = {};
  arrivals.bricks = {};
  const std::size_t width = hn::Lanes(SweptTag());
  for (std::size_t from = 0; from < SweptLanes::count; from += width) {
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << width) - 1);
    if ((walking >> from & all) == 0) continue;
    SweptStep(lanes, from).step(walking >> from & all, arrivals);
  }
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit {
namespace detail {
namespace {

HWY_EXPORT(enter_lanes);
HWY_EXPORT(step_lanes);

std::uint32_t enter(SweptLanes& lanes, const SweptLanes::Entering& boxes, std::uint32_t entering,
                    std::uint32_t& apart) {
  return HWY_DYNAMIC_DISPATCH(enter_lanes)(lanes, boxes, entering, apart);
}
void step(SweptLanes& lanes, std::uint32_t walking, SweptLanes::Arrivals& arrivals) {
  HWY_DYNAMIC_DISPATCH(step_lanes)(lanes, walking, arrivals);
}

}  // namespace
}  // namespace detail

std::uint32_t SweptLanes::enter(const Entering& boxes, std::uint32_t entering, std::uint32_t& apart) {
  return detail::enter(*this, boxes, entering, apart);
}
void SweptLanes::step(std::uint32_t walking, Arrivals& arrivals) { detail::step(*this, walking, arrivals); }

}  // namespace surehit
#endif
