#include "command_line/chunked_run.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <vector>

#include "command_line/progress_bar.hpp"

namespace surehit::example {

void run_in_chunks(const std::string& title, std::size_t count, std::size_t chunk, unsigned threads,
                   const std::function<void(std::size_t begin, std::size_t end)>& work,
                   const std::function<std::string()>& rate) {
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> done = 0;
  ProgressBar bar(title, count);
  const auto take_chunks = [&](bool shows) {
    for (;;) {
      const std::size_t begin = next.fetch_add(chunk);
      if (begin >= count) return;
      const std::size_t end = std::min(begin + chunk, count);
      try {
        work(begin, end);
      } catch (...) {
        next = count;
        throw;
      }
      done += end - begin;
      if (shows) bar.show(done, rate ? rate() : "");
    }
  };
  std::vector<std::future<void>> others;
  for (unsigned i = 1; i < threads; ++i) others.push_back(std::async(std::launch::async, take_chunks, false));
  take_chunks(true);
  for (auto& other : others) other.get();
}

}  // namespace surehit::example
