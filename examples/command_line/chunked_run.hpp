#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace surehit::example {

/// Works on the items 0 … count - 1 in chunks, on as many threads, and shows a bar on a long run. `work` is called from
/// several threads at once, each time with another range [begin, end); what it throws ends the run and is thrown on.
/// `rate` says how fast the work is, for the bar.
void run_in_chunks(const std::string& title, std::size_t count, std::size_t chunk, unsigned threads,
                   const std::function<void(std::size_t begin, std::size_t end)>& work,
                   const std::function<std::string()>& rate = {});

}  // namespace surehit::example
