#include "surehit_query/answer_queries.hpp"

#include <cstdio>
#include <functional>
#include <optional>
#include <string_view>
#include <surehit/surehit.hpp>
#include <type_traits>
#include <vector>

#include "command_line/gpu_batches.hpp"
#include "surehit_query/answer_blocks.hpp"
#include "surehit_query/answer_shapes.hpp"
#include "surehit_query/asked_mesh.hpp"
#include "surehit_query/asked_scene.hpp"
#include "surehit_query/hit_text.hpp"
#include "surehit_query/number_table.hpp"
#include "surehit_query/query_limits.hpp"
#include "surehit_query/statistics_text.hpp"

namespace surehit::example {
namespace {

template <typename Scalar>
Vector3<Scalar> point_at(const Scalar* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

template <typename Shape, typename Scalar>
Shape shape_at(const Scalar* numbers) {
  return {point_at(numbers), point_at(numbers + 3)};
}

MoreColumns columns_of(const QueryRequest& request) { return {request.wants_points, request.wants_normals}; }

template <typename Shape, typename Scalar>
void answer_pairs(const QueryRequest& request) {
  const auto options = limits_of<QueryOptions<Scalar>>(request);
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
                      columns.append(
                          path, *hit, [&] { return normal(triangle); }, lines);
                    } else {
                      lines += "0,,,,";
                      columns.append_none(lines);
                    }
                    lines += '\n';
                  }
                  return answered;
                });
}

/// Asks an `AskedMesh` or an `AskedScene`.
template <typename Shape, typename Scalar, typename Asked>
class Queries {
 public:
  explicit Queries(const QueryRequest& request)
      : request_(request),
        columns_(columns_of(request)),
        asked_(request),
        table_(read_number_table<Scalar>(request.input_path, 6)) {
    if constexpr (may_use_gpu) {
      if (request.uses_gpu) gpu_.emplace(asked_.target(), request.gpu_name);
    }
  }

  void answer() const {
    const std::string ids = asked_.id_columns();
    if (request_.question == Question::first) {
      write(ids + ",t,u,v,side" + columns_.names() + (request_.wants_free_points ? ",free_x,free_y,free_z\n" : "\n"),
            &Queries::first_hits);
    } else if (request_.question == Question::any) {
      write("hit\n", &Queries::any_hits);
    } else {
      write("path," + ids + ",t,u,v,side,tie" + columns_.names() + "\n", &Queries::all_hits);
    }
  }

 private:
  static constexpr bool may_use_gpu = std::is_same_v<Scalar, float>;
  using Target = std::conditional_t<may_use_gpu, typename Asked::Target, Colliderf>;
  using Answer = typename Asked::Answer;
  using Answers = AnsweredBlock (Queries::*)(std::size_t, std::size_t) const;

  void write(std::string_view header, Answers answers) const {
    const QueryStatistics statistics = write_answers(request_, header, table_.rows(), std::bind_front(answers, this));
    if (request_.wants_statistics) std::fputs(text_of(statistics).c_str(), stderr);
    if (!gpu_) return;
    const GpuCounts counts = gpu_->counts();
    warn_of_failure("surehit-query", counts);
    if (!request_.wants_statistics) return;
    std::fprintf(stderr, "gpu_paths,%llu,,\ngpu_left_to_host,%llu,,\n", static_cast<unsigned long long>(counts.paths),
                 static_cast<unsigned long long>(counts.by_host));
  }

  [[nodiscard]] std::vector<Shape> paths(std::size_t begin, std::size_t end) const {
    std::vector<Shape> paths;
    for (std::size_t i = begin; i < end; ++i) paths.push_back(shape_at<Shape>(table_.row(i)));
    return paths;
  }

  /// Appends the ids, the contact and then whatever `append_between` does, before the columns that may be asked for.
  template <typename AppendBetween>
  void append_hit(const Shape& path, const Answer& hit, AppendBetween append_between, std::string& lines) const {
    asked_.append_ids(hit, lines);
    append_contact(hit, lines);
    append_between();
    columns_.append(
        path, hit, [&] { return asked_.normal(hit); }, lines);
  }

  void ask(const std::vector<Shape>& shapes, std::vector<Answer>& hits, QueryStatistics& statistics) const {
    if constexpr (may_use_gpu) {
      if (gpu_) return gpu_->first_hits(shapes, hits, {.options = asked_.options(), .statistics = &statistics});
    }
    asked_.target().first_hits(shapes, hits, {.options = asked_.options(), .statistics = &statistics});
  }
  void ask(const std::vector<Shape>& shapes, std::vector<std::uint8_t>& blocked, QueryStatistics& statistics) const {
    if constexpr (may_use_gpu) {
      if (gpu_) return gpu_->any_hits(shapes, blocked, {.options = asked_.options(), .statistics = &statistics});
    }
    asked_.target().any_hits(shapes, blocked, {.options = asked_.options(), .statistics = &statistics});
  }

  [[nodiscard]] AnsweredBlock first_hits(std::size_t begin, std::size_t end) const {
    std::vector<Answer> hits(end - begin);
    const std::vector<Shape> shapes = paths(begin, end);
    AnsweredBlock answered;
    std::string& lines = answered.lines;
    ask(shapes, hits, answered.statistics);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (hits[i].triangle == no_triangle) {
        lines += asked_.no_ids();
        lines += ",,,,";
        columns_.append_none(lines);
      } else {
        append_hit(
            shapes[i], hits[i], [] {}, lines);
      }
      append_free_point(shapes[i], hits[i], lines);
      lines += '\n';
    }
    return answered;
  }

  /// A step that meets nothing may end where it would.
  void append_free_point(const Segment<Scalar>& segment, const Answer& hit, std::string& lines) const {
    if (!request_.wants_free_points) return;
    const bool is_free = hit.triangle == no_triangle;
    append_vector(is_free ? segment.end : asked_.target().last_free_point(segment, hit, asked_.options()), lines);
  }
  /// Only a segment is a step.
  template <typename Other>
  void append_free_point(const Other&, const Answer&, std::string&) const {}

  [[nodiscard]] AnsweredBlock any_hits(std::size_t begin, std::size_t end) const {
    std::vector<std::uint8_t> blocked(end - begin);
    const std::vector<Shape> shapes = paths(begin, end);
    AnsweredBlock answered;
    ask(shapes, blocked, answered.statistics);
    for (const std::uint8_t hit : blocked) answered.lines += hit != 0 ? "1\n" : "0\n";
    return answered;
  }

  [[nodiscard]] AnsweredBlock all_hits(std::size_t begin, std::size_t end) const {
    std::vector<Answer> hits;
    AnsweredBlock answered;
    std::string& lines = answered.lines;
    for (std::size_t i = begin; i < end; ++i) {
      const auto path = shape_at<Shape>(table_.row(i));
      asked_.target().all_hits(path, hits, asked_.options(), &answered.statistics);
      const std::vector<std::uint8_t> ties = asked_.ties(path, hits);
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
  MoreColumns columns_;
  Asked asked_;
  NumberTable<Scalar> table_;
  std::optional<GpuBatchesOf<Target>> gpu_;  ///< where it was asked for
};

template <typename Shape, typename Scalar>
void answer_paths(const QueryRequest& request) {
  if (request.question == Question::pair) {
    answer_pairs<Shape, Scalar>(request);
  } else if (request.scene_path.empty()) {
    Queries<Shape, Scalar, AskedMesh<Scalar>>(request).answer();
  } else {
    Queries<Shape, Scalar, AskedScene<Scalar>>(request).answer();
  }
}

template <typename Scalar>
void answer_in(const QueryRequest& request) {
  switch (request.path) {
    case PathForm::segment:
      return answer_paths<Segment<Scalar>, Scalar>(request);
    case PathForm::ray:
      return answer_paths<Ray<Scalar>, Scalar>(request);
    case PathForm::line:
      return answer_paths<Line<Scalar>, Scalar>(request);
    default:
      return;  // A shape.
  }
}

}  // namespace

void answer_queries(const QueryRequest& request) {
  if (is_shape(request.path)) return answer_shapes(request);
  if (request.scalar == ScalarKind::single_precision) {
    answer_in<float>(request);
  } else {
    answer_in<double>(request);
  }
}

}  // namespace surehit::example
