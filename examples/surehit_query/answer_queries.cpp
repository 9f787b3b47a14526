#include "surehit_query/answer_queries.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <future>
#include <string_view>
#include <surehit/surehit.hpp>
#include <vector>

#include "command_line/output_file.hpp"
#include "command_line/progress_bar.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/read_mesh.hpp"
#include "surehit_query/hit_text.hpp"
#include "surehit_query/number_table.hpp"
#include "surehit_query/statistics_text.hpp"

namespace surehit::example {
namespace {

struct AnsweredBlock {
  std::string lines;
  QueryStatistics statistics;
};

/// The answers to the paths from `begin` to before `end`. Called from several threads at once.
using Answer = std::function<AnsweredBlock(std::size_t begin, std::size_t end)>;

/// Returns what was done for all of them. Every thread answers one block of a round; the blocks are written in their
/// order, so the output is the same for any number of threads, and no more than a round of it is held in memory.
QueryStatistics write_answers(const QueryRequest& request, std::string_view header, std::size_t paths,
                              const Answer& answer) {
  constexpr std::size_t block = 4096;
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

template <typename Scalar>
Vector3<Scalar> point_at(const Scalar* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

template <typename Shape, typename Scalar>
Shape shape_at(const Scalar* numbers) {
  return {point_at(numbers), point_at(numbers + 3)};
}

template <typename Shape, typename Scalar>
void answer_pairs(const QueryRequest& request, const QueryOptions<Scalar>& options) {
  const auto table = read_number_table<Scalar>(request.input_path, 15);
  write_answers(request, "hit,t,u,v,side\n", table.rows(), [&](std::size_t begin, std::size_t end) {
    AnsweredBlock answered;
    std::string& lines = answered.lines;
    for (std::size_t i = begin; i < end; ++i) {
      const Scalar* const row = table.row(i);
      const Triangle<Scalar> triangle{point_at(row + 6), point_at(row + 9), point_at(row + 12)};
      if (const auto hit = intersect(shape_at<Shape>(row), triangle, options)) {
        lines += '1';
        append_contact(*hit, lines);
      } else {
        lines += "0,,,,\n";
      }
    }
    return answered;
  });
}

template <typename Scalar>
Collider<Scalar> read_collider(const std::string& path) {
  const Mesh<Scalar> mesh = read_mesh<Scalar>(path);
  Collider<Scalar> collider;
  if (const auto invalid = collider.try_build(mesh.view())) throw InputError(path + ": " + invalid->what());
  return collider;
}

template <typename Shape, typename Scalar>
class MeshQueries {
 public:
  MeshQueries(const QueryRequest& request, const QueryOptions<Scalar>& options)
      : request_(request),
        options_(options),
        collider_(read_collider<Scalar>(request.mesh_path)),
        table_(read_number_table<Scalar>(request.input_path, 6)) {}

  void answer() const {
    if (request_.question == Question::first) {
      write("triangle,t,u,v,side\n", &MeshQueries::first_hits);
    } else if (request_.question == Question::any) {
      write("hit\n", &MeshQueries::any_hits);
    } else {
      write("path,triangle,t,u,v,side\n", &MeshQueries::all_hits);
    }
  }

 private:
  using Answers = AnsweredBlock (MeshQueries::*)(std::size_t, std::size_t) const;

  void write(std::string_view header, Answers answers) const {
    const QueryStatistics statistics = write_answers(request_, header, table_.rows(), std::bind_front(answers, this));
    if (request_.wants_statistics) std::fputs(text_of(statistics).c_str(), stderr);
  }

  [[nodiscard]] std::vector<Shape> paths(std::size_t begin, std::size_t end) const {
    std::vector<Shape> paths;
    for (std::size_t i = begin; i < end; ++i) paths.push_back(shape_at<Shape>(table_.row(i)));
    return paths;
  }

  [[nodiscard]] AnsweredBlock first_hits(std::size_t begin, std::size_t end) const {
    std::vector<Hit<Scalar>> hits(end - begin);
    AnsweredBlock answered;
    std::string& lines = answered.lines;
    collider_.first_hits(paths(begin, end), hits, options_, &answered.statistics);
    for (const auto& hit : hits) {
      if (hit.triangle == no_triangle) {
        lines += "-1,,,,\n";
      } else {
        append_number(hit.triangle, lines);
        append_contact(hit, lines);
      }
    }
    return answered;
  }

  [[nodiscard]] AnsweredBlock any_hits(std::size_t begin, std::size_t end) const {
    std::vector<std::uint8_t> blocked(end - begin);
    AnsweredBlock answered;
    collider_.any_hits(paths(begin, end), blocked, options_, &answered.statistics);
    for (const std::uint8_t hit : blocked) answered.lines += hit != 0 ? "1\n" : "0\n";
    return answered;
  }

  [[nodiscard]] AnsweredBlock all_hits(std::size_t begin, std::size_t end) const {
    std::vector<Hit<Scalar>> hits;
    AnsweredBlock answered;
    std::string& lines = answered.lines;
    for (std::size_t i = begin; i < end; ++i) {
      collider_.all_hits(shape_at<Shape>(table_.row(i)), hits, options_, &answered.statistics);
      for (const auto& hit : hits) {
        append_number(i, lines);
        lines += ',';
        append_number(hit.triangle, lines);
        append_contact(hit, lines);
      }
    }
    return answered;
  }

  const QueryRequest& request_;
  QueryOptions<Scalar> options_;
  Collider<Scalar> collider_;
  NumberTable<Scalar> table_;
};

template <typename Shape, typename Scalar>
void answer_shapes(const QueryRequest& request) {
  QueryOptions<Scalar> options;
  options.culling = request.culling;
  if (request.question == Question::pair) {
    answer_pairs<Shape>(request, options);
  } else {
    MeshQueries<Shape, Scalar>(request, options).answer();
  }
}

template <typename Scalar>
void answer_in(const QueryRequest& request) {
  switch (request.path) {
    case PathKind::segment:
      return answer_shapes<Segment<Scalar>, Scalar>(request);
    case PathKind::ray:
      return answer_shapes<Ray<Scalar>, Scalar>(request);
    case PathKind::line:
      return answer_shapes<Line<Scalar>, Scalar>(request);
  }
}

}  // namespace

void answer_queries(const QueryRequest& request) {
  if (request.scalar == ScalarKind::single_precision) {
    answer_in<float>(request);
  } else {
    answer_in<double>(request);
  }
}

}  // namespace surehit::example
