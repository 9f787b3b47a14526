#include "surehit_query/answer_blocks.hpp"

#include <algorithm>
#include <future>
#include <vector>

#include "command_line/output_file.hpp"
#include "command_line/progress_bar.hpp"

namespace surehit::example {

QueryStatistics write_answers(const QueryRequest& request, std::string_view header, std::size_t paths,
                              const AnswerBlock& answer) {
  const std::size_t block = request.uses_gpu ? 1 << 17 : 1 << 12;  // A device answers many at a time.
  OutputFile output(request.output_path);
  output.write(header);
  ProgressBar progress("Answering", paths);
  QueryStatistics statistics;
  for (std::size_t begin = 0; begin < paths;) {
    std::vector<std::future<AnsweredBlock>> round;
    for (std::size_t thread = 0; thread < request.threads && begin < paths; ++thread) {
      const std::size_t end = std::min(begin + block, paths);
      round.push_back(std::async(std::launch::async, answer, begin, end));
      begin = end;
    }
    for (auto& answered : round) {
      const AnsweredBlock block_of_answers = answered.get();
      if (output.is_terminal()) progress.hide();
      output.write(block_of_answers.lines);
      statistics += block_of_answers.statistics;
    }
    progress.show(begin);
  }
  output.finish();
  return statistics;
}

}  // namespace surehit::example
