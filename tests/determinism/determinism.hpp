#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "answers.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_text.hpp"
#include "support/threads.hpp"

namespace surehit::test {

/// One mesh and some questions about it, whose answers must be the same to the bit however they come about.
template <typename Scalar>
class Determinism {
 public:
  /// The mesh, the masks and the questions outlive it.
  Determinism(const TriangleMeshView<Scalar>& mesh, std::span<const std::uint32_t> masks,
              const Questions<Scalar>& questions)
      : mesh_(mesh), masks_(masks), questions_(questions), collider_(built({})), answers_(collider_, questions) {}

  Determinism(const Determinism&) = delete;
  Determinism& operator=(const Determinism&) = delete;

  [[nodiscard]] const Answers<Scalar>& answers() const { return answers_; }

  void expect_same_of_every_instruction_set() const {
    for (const std::int64_t target : instruction_sets()) {
      SCOPED_TRACE(name_of_instruction_set(target));
      const ForcedInstructionSet forced(target);
      const Collider<Scalar> collider = built({});
      expect_same(Answers<Scalar>(collider, questions_));
    }
  }

  /// Returns the cells of the grid, in which the first `count` questions are asked.
  std::size_t expect_same_in(const GridOptions& options, std::size_t count) const {
    const Collider<Scalar> collider = built(options);
    SCOPED_TRACE(std::to_string(collider.grid_summary().cells) + " cells");
    Questions<Scalar> some = questions_;
    some.all.erase(some.all.begin() + static_cast<std::ptrdiff_t>(count), some.all.end());
    expect_same(Answers<Scalar>(collider, some));
    return collider.grid_summary().cells;
  }
  std::size_t expect_same_in(const GridOptions& options) const {
    return expect_same_in(options, questions_.all.size());
  }

  /// The queries, and the build too.
  void expect_same_of_any_number_of_threads() const {
    for (std::size_t count = 1; count <= 8; ++count) {
      SCOPED_TRACE(std::to_string(count) + " threads");
      const Threads threads(count);
      const Executor executor = threads;
      Collider<Scalar> collider;
      ASSERT_TRUE(collider.try_build(mesh_, {{}, masks_, executor}));
      expect_same(Answers<Scalar>(collider, questions_, {.executor = executor}));
    }
  }

  void expect_same_of_any_batch_size() const {
    for (const std::size_t size : {1U, 3U, 16U, 17U, 1000U}) {
      SCOPED_TRACE("batches of " + std::to_string(size));
      expect_same(Answers<Scalar>(collider_, questions_, {.batch = size}));
    }
  }

  void expect_same_in_any_order() const {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      SCOPED_TRACE("order " + std::to_string(seed));
      expect_same(Answers<Scalar>(collider_, questions_, {.shuffled = seed}));
      expect_same(Answers<Scalar>(collider_, questions_, {.batch = 61, .shuffled = seed}));
    }
  }

 private:
  [[nodiscard]] Collider<Scalar> built(const GridOptions& grid) const {
    return Collider<Scalar>(mesh_, {grid, masks_});
  }

  void expect_same(const Answers<Scalar>& others) const {
    std::size_t different = 0;
    for (std::size_t id = 0; id < others.all().size(); ++id) {
      const Answer<Scalar>& answer = answers_.all()[id];
      const Answer<Scalar>& other = others.all()[id];
      if (answer.same_as(other) || ++different > 5) continue;
      ADD_FAILURE() << "question " << id << ", " << hex_text(questions_.all[id].path) << ": " << hex_text(answer.first)
                    << " or " << hex_text(other.first) << ", in a batch " << hex_text(answer.first_of_batch) << " or "
                    << hex_text(other.first_of_batch);
    }
    EXPECT_EQ(different, 0U);
  }

  TriangleMeshView<Scalar> mesh_;
  std::span<const std::uint32_t> masks_;
  const Questions<Scalar>& questions_;
  Collider<Scalar> collider_;
  Answers<Scalar> answers_;
};

}  // namespace surehit::test
