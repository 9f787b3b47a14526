#include "surehit_query/answer_queries.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <future>
#include <string_view>
#include <surehit/surehit.hpp>
#include <vector>

#include "command_line/output_file.hpp"
#include "command_line/program.hpp"
#include "command_line/progress_bar.hpp"
#include "mesh_io/input_error.hpp"
#include "mesh_io/parse_number.hpp"
#include "mesh_io/read_mesh.hpp"
#include "surehit_query/exact_ties.hpp"
#include "surehit_query/hit_text.hpp"
#include "surehit_query/mask_list.hpp"
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

template <typename Scalar>
Scalar parse_limit(const char* option, const std::string& text) {
  try {
    const auto limit = parse_number_or_non_finite<Scalar>(text);
    if (std::isnan(limit)) throw InputError(example::quoted(text) + " is not a number");
    return limit;
  } catch (const InputError& error) {
    throw error.at(option);
  }
}

template <typename Scalar>
QueryOptions<Scalar> options_of(const QueryRequest& request) {
  QueryOptions<Scalar> options;
  options.min_t = parse_limit<Scalar>("--min-t", request.min_t);
  options.max_t = parse_limit<Scalar>("--max-t", request.max_t);
  options.culling = request.culling;
  options.mask = request.mask;
  options.ignored_triangle = request.ignored_triangle.value_or(no_triangle);
  options.ignore_start_contact = request.ignore_start_contact;
  options.ignore_end_contact = request.ignore_end_contact;
  return options;
}

MoreColumns columns_of(const QueryRequest& request) { return {request.wants_points, request.wants_normals}; }

template <typename Shape, typename Scalar>
void answer_pairs(const QueryRequest& request, const QueryOptions<Scalar>& options) {
  const auto table = read_number_table<Scalar>(request.input_path, 15);
  const MoreColumns columns = columns_of(request);
  write_answers(request, "hit,t,u,v,side" + columns.names() + "\n", table.rows(),
                [&](std::size_t begin, std::size_t end) {
                  AnsweredBlock answered;
                  std::string& lines = answered.lines;
                  for (std::size_t i = begin; i < end; ++i) {
                    const Scalar* const row = table.row(i);
                    const Triangle<Scalar> triangle{point_at(row + 6), point_at(row + 9), point_at(row + 12)};
                    const auto path = shape_at<Shape>(row);
                    if (const auto hit = intersect(path, triangle, options)) {
                      lines += '1';
                      append_contact(*hit, lines);
                      columns.append(path, *hit, triangle, lines);
                    } else {
                      lines += "0,,,,";
                      columns.append_none(lines);
                    }
                    lines += '\n';
                  }
                  return answered;
                });
}

/// A mesh file made ready to be asked.
template <typename Scalar>
struct ReadCollider {
  Collider<Scalar> collider;
  std::vector<std::uint32_t> ids;  ///< what the output calls each triangle; empty where that is its own id
};

template <typename Scalar>
ReadCollider<Scalar> read_collider(const QueryRequest& request) {
  Mesh<Scalar> mesh = read_mesh<Scalar>(request.mesh_path);
  for (const std::string& warning : mesh.warnings) warn("surehit-query", request.mesh_path + ": " + warning);
  const std::vector<std::uint32_t> masks = masks_of(request, mesh);
  Collider<Scalar> collider;
  if (const BuildResult built = collider.try_build(mesh.view(), {.masks = masks}); !built) {
    throw InputError(request.mesh_path + ": " + built.error().what());
  }
  if (request.ids == IdKind::triangle) mesh.faces.clear();
  return {std::move(collider), std::move(mesh.faces)};
}

template <typename Shape, typename Scalar>
class MeshQueries {
 public:
  MeshQueries(const QueryRequest& request, const QueryOptions<Scalar>& options)
      : request_(request),
        options_(options),
        columns_(columns_of(request)),
        mesh_(read_collider<Scalar>(request)),
        table_(read_number_table<Scalar>(request.input_path, 6)) {}

  void answer() const {
    const std::string id = request_.ids == IdKind::face ? "face" : "triangle";
    if (request_.question == Question::first) {
      write(id + ",t,u,v,side" + columns_.names() + (request_.wants_free_points ? ",free_x,free_y,free_z\n" : "\n"),
            &MeshQueries::first_hits);
    } else if (request_.question == Question::any) {
      write("hit\n", &MeshQueries::any_hits);
    } else {
      write("path," + id + ",t,u,v,side,tie" + columns_.names() + "\n", &MeshQueries::all_hits);
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

  /// Appends the id, the contact and then whatever `append_between` does, before the columns that may be asked for.
  template <typename AppendBetween>
  void append_hit(const Shape& path, const Hit<Scalar>& hit, AppendBetween append_between, std::string& lines) const {
    append_number(mesh_.ids.empty() ? hit.triangle : mesh_.ids[hit.triangle], lines);
    append_contact(hit, lines);
    append_between();
    columns_.append(path, hit, mesh_.collider.triangle(hit.triangle), lines);
  }

  [[nodiscard]] AnsweredBlock first_hits(std::size_t begin, std::size_t end) const {
    std::vector<Hit<Scalar>> hits(end - begin);
    const std::vector<Shape> asked = paths(begin, end);
    AnsweredBlock answered;
    std::string& lines = answered.lines;
    mesh_.collider.first_hits(asked, hits, {.options = options_, .statistics = &answered.statistics});
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (hits[i].triangle == no_triangle) {
        lines += "-1,,,,";
        columns_.append_none(lines);
      } else {
        append_hit(
            asked[i], hits[i], [] {}, lines);
      }
      append_free_point(asked[i], hits[i], lines);
      lines += '\n';
    }
    return answered;
  }

  /// A step that meets nothing may end where it would.
  void append_free_point(const Segment<Scalar>& segment, const Hit<Scalar>& hit, std::string& lines) const {
    if (!request_.wants_free_points) return;
    const bool is_free = hit.triangle == no_triangle;
    append_vector(is_free ? segment.end : mesh_.collider.last_free_point(segment, hit, options_), lines);
  }
  /// Only a segment is a step.
  template <typename Other>
  void append_free_point(const Other&, const Hit<Scalar>&, std::string&) const {}

  [[nodiscard]] AnsweredBlock any_hits(std::size_t begin, std::size_t end) const {
    std::vector<std::uint8_t> blocked(end - begin);
    const std::vector<Shape> asked = paths(begin, end);
    AnsweredBlock answered;
    mesh_.collider.any_hits(asked, blocked, {.options = options_, .statistics = &answered.statistics});
    for (const std::uint8_t hit : blocked) answered.lines += hit != 0 ? "1\n" : "0\n";
    return answered;
  }

  [[nodiscard]] AnsweredBlock all_hits(std::size_t begin, std::size_t end) const {
    const ExactTies<Scalar> exact_ties(mesh_.collider, options_);
    std::vector<Hit<Scalar>> hits;
    AnsweredBlock answered;
    std::string& lines = answered.lines;
    for (std::size_t i = begin; i < end; ++i) {
      const auto path = shape_at<Shape>(table_.row(i));
      mesh_.collider.all_hits(path, hits, options_, &answered.statistics);
      const std::vector<std::uint8_t> ties = exact_ties.find(path, hits);
      for (std::size_t j = 0; j < hits.size(); ++j) {
        append_number(i, lines);
        lines += ',';
        append_hit(
            path, hits[j], [&] { lines += ties[j] != 0 ? ",1" : ",0"; }, lines);
        lines += '\n';
      }
    }
    return answered;
  }

  const QueryRequest& request_;
  QueryOptions<Scalar> options_;
  MoreColumns columns_;
  ReadCollider<Scalar> mesh_;
  NumberTable<Scalar> table_;
};

template <typename Shape, typename Scalar>
void answer_shapes(const QueryRequest& request) {
  const auto options = options_of<Scalar>(request);
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
