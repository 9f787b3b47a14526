#include "shape/shape_batch.hpp"

#include <hwy/cache_control.h>

#include <array>
#include <bit>
#include <optional>

#include "shape/shape_visitor.hpp"
#include "support/rounding_flags.hpp"
#include "walk/swept_lanes.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {
namespace {

/// Walks the small shapes of a batch side by side, in `SweptLanes`. `finish(index, visitor)` gets each shape that came
/// to a list, and `miss(index)` each other one. `alone(index)` answers a shape that no lane can walk.
template <typename Shape, typename Keep, typename Finish, typename Miss, typename Alone>
class ShapeLanes {
  using Scalar = ScalarOf<Shape>;
  using Visitor = ShapeVisitor<Shape, Keep>;

 public:
  ShapeLanes(const ShapeBatch<Shape>& batch, const Finish& finish, const Miss& miss, const Alone& alone)
      : batch_(batch), finish_(finish), miss_(miss), alone_(alone), lanes_(batch.grid, batch.mesh.slabs()) {}

  void run() {
    for (;;) {
      fill();
      if (walking_ == 0) {
        if (next_ == batch_.shapes.size()) return;
        continue;  // Nothing that was waiting comes near the grid.
      }
      batch_.statistics.cells += static_cast<std::uint64_t>(std::popcount(walking_));
      lanes_.step(walking_, arrivals_);
      if (arrivals_.all != 0) visit();
      if (arrivals_.ended != 0) end(arrivals_.ended);
    }
  }

 private:
  /// A walking shape that has come to a list.
  struct Slot {
    Slot(const ShapeBatch<Shape>& batch, std::size_t index, typename Visitor::Times& enters)
        : query(batch.query(index)), visitor(query, batch.shapes[index], enters) {}

    ShapeQuery<Scalar> query;
    Visitor visitor;
  };

  /// Only so many lanes walk, because the slots take the stack.
  static constexpr std::size_t used_lanes = SweptLanes::count * sizeof(Slot) <= 0x1c00 ? SweptLanes::count : 4;
  static constexpr std::uint32_t all_lanes = (1U << used_lanes) - 1;
  /// Idle lanes are filled if there are at least so many.
  static constexpr int min_idle = 2;
  static constexpr std::size_t max_near = 64;

  /// Puts waiting shapes into idle lanes.
  void fill() {
    const std::uint32_t idle = all_lanes & ~walking_;
    if (next_ == batch_.shapes.size() || std::popcount(idle) < min_idle) return;
    std::uint32_t entering = 0;
    for (std::uint32_t left = idle; left != 0 && next_ < batch_.shapes.size(); ++next_) {
      const Shape& shape = batch_.shapes[next_];
      const ShapeQueryOptions<Scalar>& options =
          batch_.own_options.empty() ? batch_.options : batch_.own_options[next_];
      if (!is_valid(shape) || !(options.max_t >= 0)) {
        ++batch_.statistics.paths;
        miss_(next_);
        continue;
      }
      const SweptExtents extents = swept_extents(shape);
      if (!lanes_.may_enter(extents.half_extents)) {
        alone_(next_);
        continue;
      }
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      left &= left - 1;
      entering |= 1U << lane;
      index_[lane] = next_;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        entering_.start[axis][lane] = extents.start[axis];
        entering_.end[axis][lane] = extents.end[axis];
        entering_.half_extents[axis][lane] = extents.half_extents[axis];
      }
      lanes_.end[lane] = SweptLanes::beyond(last_t(options));
    }
    std::uint32_t apart = 0;
    const std::uint32_t entered = lanes_.enter(entering_, entering, apart);
    walking_ |= entered;
    batch_.statistics.paths += static_cast<std::uint64_t>(std::popcount(entering & ~apart));
    for_each_bit(apart, [&](std::size_t lane) { alone_(index_[lane]); });
    for_each_bit(entering & ~entered & ~apart, [&](std::size_t lane) { miss_(index_[lane]); });
  }

  template <typename Do>
  static void for_each_bit(std::uint32_t bits, const Do& what) {
    for (; bits != 0; bits &= bits - 1) what(static_cast<std::size_t>(std::countr_zero(bits)));
  }

  Slot& slot(std::size_t lane) {
    if (!slots_[lane]) slots_[lane].emplace(batch_, index_[lane], enters_);
    return *slots_[lane];
  }

  /// Gives the shapes the lists that they have come to.
  void visit() {
    for (std::size_t k = 0; k < SweptLanes::max_cells; ++k) {
      visit_lists(arrivals_.lists[k] & walking_, arrivals_.words[k]);
      for_each_bit(arrivals_.bricks[k] & walking_, [&](std::size_t lane) {
        visit_brick(lane, lanes_.cell(arrivals_, k, lane), CellWord(arrivals_.words[k][lane]));
      });
    }
  }
  void visit_lists(std::uint32_t arriving, const SweptLanes::Row<std::uint32_t>& words) {
    if (arriving == 0) return;
    std::size_t count = 0;
    for_each_bit(arriving, [&](std::size_t lane) {
      const CellWord word(words[lane]);
      prefetch(word);
      jobs_[count] = slot(lane).visitor.list_of(word);
      job_words_[count] = word;
      job_lanes_[count++] = static_cast<std::uint8_t>(lane);
    });
    const std::span<ShapeList<Scalar>> jobs(jobs_.data(), count);
    for (std::size_t found = near_.size(); found == near_.size();) {
      found = ShapeFilter<Scalar>::find_near(jobs, near_);
      for (std::size_t i = 0; i < found;) i = visit_near(i, found);
    }
  }
  void visit_brick(std::size_t lane, const std::array<std::uint32_t, 3>& cell, CellWord word) {
    Visitor& visitor = slot(lane).visitor;
    const SweptExtents extents = swept_extents(batch_.shapes[index_[lane]]);
    SweptWalk{batch_.grid, extents, batch_.mesh.slabs(), visitor.limit(), visitor, batch_.statistics.cells}
        .walk_top_cell(cell, word);
    shorten(lane, visitor);
  }
  /// Gives a shape those triangles of a list that are elements of `near_` from `first` on. Returns the next element.
  std::size_t visit_near(std::size_t first, std::size_t found) {
    const std::size_t list = near_[first].list;
    std::size_t last = first;
    while (last < found && near_[last].list == list) ++last;
    const std::size_t lane = job_lanes_[list];
    if ((walking_ >> lane & 1) == 0) return last;
    Visitor& visitor = slots_[lane]->visitor;
    visitor.visit_near(job_words_[list], jobs_[list], std::span(near_).subspan(first, last - first));
    shorten(lane, visitor);
    // The rest of the list does not count once the walk has ended, and the filter of the shape is gone.
    if ((walking_ >> lane & 1) == 0) jobs_[list].last = jobs_[list].from;
    return last;
  }
  void shorten(std::size_t lane, const Visitor& visitor) {
    if (visitor.is_done()) return end(1U << lane);
    lanes_.end[lane] = std::min(lanes_.end[lane], SweptLanes::beyond(visitor.limit()));
  }
  void prefetch(CellWord word) {
    const Scalar* const corners =
        MeshBlocks<Scalar>::corners(batch_.mesh.block(word.list(), batch_.grid.first_entry(word)));
    constexpr std::size_t line = 64 / sizeof(Scalar);
    const std::size_t numbers = std::min<std::size_t>(16 * line, 9 * batch_.grid.entry_count(word));
    for (std::size_t from = 0; from < numbers + line; from += line) hwy::Prefetch(corners + from);
    hwy::Prefetch(batch_.grid.entries().address(batch_.grid.first_entry(word)));
  }

  void end(std::uint32_t ended) {
    ended &= walking_;
    walking_ &= ~ended;
    for_each_bit(ended, [&](std::size_t lane) {
      if (slots_[lane]) {
        finish_(index_[lane], slots_[lane]->visitor);
        slots_[lane].reset();
      } else {
        miss_(index_[lane]);
      }
    });
  }

  const ShapeBatch<Shape>& batch_;
  const Finish& finish_;
  const Miss& miss_;
  const Alone& alone_;
  SweptLanes lanes_;
  SweptLanes::Entering entering_ = {};
  SweptLanes::Arrivals arrivals_;
  std::array<std::size_t, used_lanes> index_;
  std::array<std::optional<Slot>, used_lanes> slots_;
  std::array<ShapeList<Scalar>, used_lanes> jobs_;  ///< The lists that shapes have come to.
  std::array<CellWord, used_lanes> job_words_;
  std::array<std::uint8_t, used_lanes> job_lanes_;
  std::array<NearTriangles, max_near> near_;
  typename Visitor::Times enters_;
  std::size_t next_ = 0;
  std::uint32_t walking_ = 0;
};

template <typename Keep, typename Shape, typename Finish, typename Miss, typename Alone>
void answer(const ShapeBatch<Shape>& batch, const Finish& finish, const Miss& miss, const Alone& alone) {
  if (batch.grid.is_empty()) {
    for (std::size_t i = 0; i < batch.shapes.size(); ++i) alone(i);
    return;
  }
  ShapeLanes<Shape, Keep, Finish, Miss, Alone>(batch, finish, miss, alone).run();
}

}  // namespace

template <typename Shape>
void search_first(const ShapeBatch<Shape>& batch, std::span<ShapeHit<ScalarOf<Shape>>> hits) noexcept {
  using Hit = ShapeHit<ScalarOf<Shape>>;
  const auto finish = [&](std::size_t index, auto& visitor) {
    const auto& first = visitor.keep().first;
    hits[index] = first ? visitor.narrowphase().hit(*first) : Hit{};
  };
  answer<KeepFirst<ShapeCandidate<Shape>>>(
      batch, finish, [&](std::size_t index) { hits[index] = Hit{}; },
      [&](std::size_t index) { hits[index] = search_first(batch.query(index), batch.shapes[index]).value_or(Hit{}); });
}

template <typename Shape>
void search_any(const ShapeBatch<Shape>& batch, std::span<std::uint8_t> blocked) noexcept {
  const auto finish = [&](std::size_t index, auto& visitor) { blocked[index] = visitor.is_done() ? 1 : 0; };
  answer<KeepAny<ShapeCandidate<Shape>>>(
      batch, finish, [&](std::size_t index) { blocked[index] = 0; },
      [&](std::size_t index) { blocked[index] = search_any(batch.query(index), batch.shapes[index]) ? 1 : 0; });
}

#define SUREHIT_INSTANTIATE(Shape)                                                                     \
  template void search_first(const ShapeBatch<Shape>&, std::span<ShapeHit<ScalarOf<Shape>>>) noexcept; \
  template void search_any(const ShapeBatch<Shape>&, std::span<std::uint8_t>) noexcept;
SUREHIT_INSTANTIATE(SweptBox<float>)
SUREHIT_INSTANTIATE(SweptBox<double>)
SUREHIT_INSTANTIATE(SweptSphere<float>)
SUREHIT_INSTANTIATE(SweptSphere<double>)
SUREHIT_INSTANTIATE(SweptCapsule<float>)
SUREHIT_INSTANTIATE(SweptCapsule<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
