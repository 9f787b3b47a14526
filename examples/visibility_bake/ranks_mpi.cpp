#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <future>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "command_line/chunked_run.hpp"
#include "command_line/interruption.hpp"
#include "command_line/progress_bar.hpp"
#include "mesh_io/input_error.hpp"
#include "visibility_bake/ranks.hpp"
#include "visibility_bake/row_queue.hpp"

namespace surehit::example {
namespace {

constexpr int tag_of_results = 1;
constexpr int tag_of_units = 2;
constexpr int tag_of_leave = 3;
constexpr int nobody = std::numeric_limits<int>::max();

/// Whether there are other ranks. What starts them sets one of these. A program that is started alone does without MPI.
bool is_one_of_several() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

/// Returns the lowest rank that says its own number, or `nobody`.
int lowest_rank(int rank) {
  int lowest = nobody;
  MPI_Allreduce(&rank, &lowest, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return lowest;
}

/// Says what is wrong, and ends all ranks. Those that wait for a message from this one would wait forever.
[[noreturn]] void abort_all_ranks(int rank, const std::exception& error) {
  std::fprintf(stderr, "visibility_bake: rank %d: %s\n", rank, error.what());
  std::fflush(stderr);
  MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  std::abort();
}

/// What a rank has found about its unit: for each row a byte for each partner. Rank 0 knows the cells and the partners.
using Results = std::vector<std::uint8_t>;

Results bake_unit(const Colliderf& collider, const PairPlan& plan, std::span<const std::uint32_t> unit,
                  unsigned threads) {
  std::vector<RowOfPairs> rows(unit.size());
  run_in_chunks("", unit.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      stop_if_interrupted();
      rows[i] = bake_row(collider, plan, unit[i]);
    }
  });
  Results results;
  for (const RowOfPairs& row : rows) {
    for (const std::uint32_t clear : row.clear) results.push_back(static_cast<std::uint8_t>(clear));
  }
  return results;
}

/// Brings results to rank 0, and takes the next unit, until there is none. A rank that is asked to stop takes its leave
/// of rank 0 instead, without the results of its unit.
void work_for_rank_0(const Colliderf& collider, const PairPlan& plan, unsigned threads) {
  Results results;
  std::vector<std::uint32_t> unit(RowQueue::rows_of_a_unit);
  for (;;) {
    MPI_Send(results.data(), static_cast<int>(results.size()), MPI_BYTE, 0, tag_of_results, MPI_COMM_WORLD);
    MPI_Status status;
    int rows = 0;
    MPI_Recv(unit.data(), static_cast<int>(unit.size()), MPI_UINT32_T, 0, tag_of_units, MPI_COMM_WORLD, &status);
    MPI_Get_count(&status, MPI_UINT32_T, &rows);
    if (rows == 0) return;
    try {
      results = bake_unit(collider, plan, std::span(unit).first(static_cast<std::size_t>(rows)), threads);
    } catch (const Interrupted&) {
      MPI_Send(nullptr, 0, MPI_BYTE, 0, tag_of_leave, MPI_COMM_WORLD);
      return;
    }
  }
}

/// Rank 0: hands out units, takes results, and works with threads of its own.
class HeadRank {
 public:
  HeadRank(const Colliderf& collider, const PairPlan& plan, RowQueue& queue, int ranks)
      : collider_(collider), plan_(plan), queue_(queue), working_(ranks - 1), units_(static_cast<std::size_t>(ranks)) {}

  /// Returns after all ranks have finished. Throws the first error of its own work then. If it cannot serve the others,
  /// it ends them all.
  void run(unsigned threads) {
    std::vector<std::future<void>> helpers;
    try {
      for (unsigned i = 0; i < threads; ++i) {
        helpers.push_back(std::async(std::launch::async, [this] { work(); }));
      }
      serve(helpers);
    } catch (const std::exception& error) {
      abort_all_ranks(0, error);
    }
    for (auto& helper : helpers) stop_on_error([&] { helper.get(); });
    if (error_) std::rethrow_exception(error_);
  }

 private:
  static bool has_running(const std::vector<std::future<void>>& helpers) {
    for (const auto& helper : helpers) {
      if (helper.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return true;
    }
    return false;
  }

  void serve(const std::vector<std::future<void>>& helpers) {
    ProgressBar bar("visibility", std::max(queue_.row_count(), std::size_t{1}));
    while (working_ > 0 || has_running(helpers)) {
      if (serve_one()) continue;
      try {
        if (!error_) stop_if_interrupted();
      } catch (const Interrupted&) {
        stop_early();
      }
      bar.show(queue_.added(), queue_.rate());
      // A look at the messages in a loop would take the core from a rank that works.
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }

  /// The others may still need some time for their rows. What started them may not give it to them, so what is known is
  /// saved before.
  void stop_early() {
    stop_on_error([] { throw Interrupted(); });
    stop_on_error([&] { queue_.save(); });
  }

  template <typename Step>
  void stop_on_error(Step step) {
    try {
      step();
    } catch (...) {
      queue_.close();
      if (!error_) error_ = std::current_exception();
    }
  }

  void work() {
    try {
      for (auto unit = queue_.take(); !unit.empty(); unit = queue_.take()) bake_rows(collider_, plan_, unit, queue_);
    } catch (...) {
      queue_.close();
      throw;
    }
  }

  /// Takes the results of a rank, and gives it the next unit, or lets it go. Returns false if there is no message.
  bool serve_one() {
    int is_there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) return false;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Results results(static_cast<std::size_t>(size));
    const int rank = status.MPI_SOURCE;
    MPI_Recv(results.data(), size, MPI_BYTE, rank, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (status.MPI_TAG == tag_of_leave) {
      --working_;
      if (!error_) stop_early();
      return true;
    }
    auto& unit = units_[static_cast<std::size_t>(rank)];
    stop_on_error([&] { add(unit, results); });
    unit = queue_.take();
    if (unit.empty()) --working_;
    MPI_Send(unit.data(), static_cast<int>(unit.size()), MPI_UINT32_T, rank, tag_of_units, MPI_COMM_WORLD);
    return true;
  }

  void add(std::span<const std::uint32_t> unit, const Results& results) {
    std::size_t next = 0;
    for (const std::uint32_t cell : unit) {
      RowOfPairs row{cell, plan_.partners(cell), {}};
      for (std::size_t i = 0; i < row.partners.size(); ++i) row.clear.push_back(results.at(next++));
      queue_.add(row);
    }
  }

  const Colliderf& collider_;
  const PairPlan& plan_;
  RowQueue& queue_;
  int working_;                                        ///< the other ranks that still get units
  std::vector<std::span<const std::uint32_t>> units_;  ///< what each rank works on
  std::exception_ptr error_;
};

}  // namespace

Ranks::Ranks() {
  if (!is_one_of_several()) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() {
  int is_initialized = 0;
  MPI_Initialized(&is_initialized);
  if (is_initialized != 0) MPI_Finalize();
}

bool Ranks::are_ready(const std::function<std::uint64_t()>& prepare) const {
  std::uint64_t fingerprint = 0;
  if (size_ == 1) {
    static_cast<void>(prepare());
    return true;
  }
  std::exception_ptr error;
  try {
    fingerprint = prepare();
  } catch (...) {
    error = std::current_exception();
  }
  if (const int failed = lowest_rank(error ? rank_ : nobody); failed != nobody) {
    if (failed == rank_) std::rethrow_exception(error);
    return false;
  }
  std::uint64_t of_rank_0 = fingerprint;
  MPI_Bcast(&of_rank_0, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  if (const int other = lowest_rank(fingerprint != of_rank_0 ? rank_ : nobody); other != nobody) {
    if (other == rank_) {
      throw InputError("rank " + std::to_string(rank_) + " has another mesh, other cells or other options than rank 0");
    }
    return false;
  }
  return true;
}

void Ranks::bake(const Colliderf& collider, const PairPlan& plan, const Checkpoint& checkpoint,
                 const BakeOptions& options, Visibility& visibility) const {
  if (size_ == 1) return example::bake(collider, plan, checkpoint, options, visibility);
  if (rank_ != 0) {
    try {
      return work_for_rank_0(collider, plan, options.threads);
    } catch (const std::exception& error) {
      abort_all_ranks(rank_, error);
    }
  }
  RowQueue queue(plan, checkpoint, options.checkpoint_seconds, visibility);
  try {
    HeadRank(collider, plan, queue, size_).run(options.threads);
  } catch (const Interrupted&) {
    queue.save();
    throw;
  }
}

}  // namespace surehit::example
