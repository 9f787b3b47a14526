#include "command_line/thread_executor.hpp"

#include "command_line/chunked_run.hpp"

namespace surehit::example {

void ThreadExecutor::operator()(std::size_t count, const Executor::Task& task) const {
  run_in_chunks("", count, 1, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) task(i);
  });
}

}  // namespace surehit::example
