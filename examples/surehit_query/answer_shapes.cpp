#include "surehit_query/answer_shapes.hpp"

#include <cstdio>
#include <functional>
#include <string>
#include <surehit/surehit.hpp>
#include <vector>

#include "mesh_io/input_error.hpp"
#include "surehit_query/answer_blocks.hpp"
#include "surehit_query/asked_mesh.hpp"
#include "surehit_query/asked_scene.hpp"
#include "surehit_query/hit_text.hpp"
#include "surehit_query/number_table.hpp"
#include "surehit_query/query_limits.hpp"
#include "surehit_query/statistics_text.hpp"

namespace surehit::example {
namespace {

constexpr const char* shape_columns = ",t,u,v,feature,started_touching";
constexpr const char* no_shape_hit = ",,,,,";

template <typename Scalar>
Vector3<Scalar> vector_at(const Scalar* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// The numbers of a row that say a shape: its centres at both ends, and then its size.
template <typename Shape>
struct ShapeRow;

template <typename Scalar>
struct ShapeRow<SweptSphere<Scalar>> {
  static constexpr std::size_t columns = 7;
  static constexpr std::size_t first_length = 6;  ///< From here on, no number may be negative.
  static SweptSphere<Scalar> read(const Scalar* row) { return {vector_at(row), vector_at(row + 3), row[6]}; }
};

template <typename Scalar>
struct ShapeRow<SweptBox<Scalar>> {
  static constexpr std::size_t columns = 9;
  static constexpr std::size_t first_length = 6;
  static SweptBox<Scalar> read(const Scalar* row) { return {vector_at(row), vector_at(row + 3), vector_at(row + 6)}; }
};

template <typename Scalar>
struct ShapeRow<SweptCapsule<Scalar>> {
  static constexpr std::size_t columns = 10;
  static constexpr std::size_t first_length = 9;
  static SweptCapsule<Scalar> read(const Scalar* row) {
    return {vector_at(row), vector_at(row + 3), vector_at(row + 6), row[9]};
  }
};

template <typename Shape, typename Scalar>
NumberTable<Scalar> read_shapes(const QueryRequest& request, std::size_t more_columns) {
  using Row = ShapeRow<Shape>;
  const auto check = [](const Scalar* row) {
    for (std::size_t i = Row::first_length; i < Row::columns; ++i) {
      if (row[i] >= 0) continue;
      std::string number;
      append_number(row[i], number);
      throw InputError("number " + std::to_string(i + 1) + " is a length below 0: " + number);
    }
  };
  return read_number_table<Scalar>(request.input_path, Row::columns + more_columns, check);
}

/// A moving shape may start anywhere, so there is no lower limit of t.
template <typename Scalar>
ShapeQueryOptions<Scalar> shape_options(const QueryOptions<Scalar>& options) {
  return {.max_t = options.max_t,
          .culling = options.culling,
          .mask = options.mask,
          .ignored_triangle = options.ignored_triangle,
          .ignore_start_contact = options.ignore_start_contact};
}

template <typename Scalar>
SceneShapeQueryOptions<Scalar> shape_options(const SceneQueryOptions<Scalar>& options) {
  return {.max_t = options.max_t,
          .culling = options.culling,
          .mask = options.mask,
          .instance_mask = options.instance_mask,
          .ignored_instance = options.ignored_instance,
          .ignored_triangle = options.ignored_triangle,
          .ignore_start_contact = options.ignore_start_contact};
}

template <typename Shape, typename Scalar>
void answer_shape_pairs(const QueryRequest& request) {
  const auto options = shape_options(limits_of<QueryOptions<Scalar>>(request));
  const auto table = read_shapes<Shape, Scalar>(request, 9);
  const auto answer = [&](std::size_t begin, std::size_t end) {
    AnsweredBlock answered;
    for (std::size_t i = begin; i < end; ++i) {
      const Scalar* const row = table.row(i);
      const Scalar* const corners = row + ShapeRow<Shape>::columns;
      const Triangle<Scalar> triangle{vector_at(corners), vector_at(corners + 3), vector_at(corners + 6)};
      if (const auto hit = intersect(ShapeRow<Shape>::read(row), triangle, options)) {
        answered.lines += '1';
        append_contact(*hit, answered.lines);
      } else {
        answered.lines += '0';
        answered.lines += no_shape_hit;
      }
      answered.lines += '\n';
    }
    return answered;
  };
  write_answers(request, std::string("hit") + shape_columns + "\n", table.rows(), answer);
}

/// Asks an `AskedMesh` or an `AskedScene`.
template <typename Shape, typename Scalar, typename Asked>
class ShapeQueries {
 public:
  explicit ShapeQueries(const QueryRequest& request)
      : request_(request),
        asked_(request),
        options_(shape_options(asked_.options())),
        table_(read_shapes<Shape, Scalar>(request, 0)) {}

  void answer() const {
    const std::string ids = asked_.id_columns();
    if (request_.question == Question::first) {
      write(ids + shape_columns, &ShapeQueries::first_hits);
    } else if (request_.question == Question::any) {
      write("hit", &ShapeQueries::any_hits);
    } else {
      write("path," + ids + shape_columns, &ShapeQueries::all_hits);
    }
  }

 private:
  using Answer = typename Asked::ShapeAnswer;
  using Answers = AnsweredBlock (ShapeQueries::*)(std::size_t, std::size_t) const;

  void write(const std::string& header, Answers answers) const {
    const QueryStatistics statistics =
        write_answers(request_, header + "\n", table_.rows(), std::bind_front(answers, this));
    if (request_.wants_statistics) std::fputs(text_of(statistics).c_str(), stderr);
  }

  [[nodiscard]] std::vector<Shape> shapes(std::size_t begin, std::size_t end) const {
    std::vector<Shape> shapes;
    for (std::size_t i = begin; i < end; ++i) shapes.push_back(ShapeRow<Shape>::read(table_.row(i)));
    return shapes;
  }

  void append_hit(const Answer& hit, std::string& lines) const {
    asked_.append_ids(hit, lines);
    append_contact(hit, lines);
    lines += '\n';
  }

  [[nodiscard]] AnsweredBlock first_hits(std::size_t begin, std::size_t end) const {
    std::vector<Answer> hits(end - begin);
    AnsweredBlock answered;
    asked_.target().first_hits(shapes(begin, end), hits, {.options = options_, .statistics = &answered.statistics});
    for (const Answer& hit : hits) {
      if (hit.triangle == no_triangle) {
        answered.lines += asked_.no_ids();
        answered.lines += no_shape_hit;
        answered.lines += '\n';
      } else {
        append_hit(hit, answered.lines);
      }
    }
    return answered;
  }

  [[nodiscard]] AnsweredBlock any_hits(std::size_t begin, std::size_t end) const {
    std::vector<std::uint8_t> blocked(end - begin);
    AnsweredBlock answered;
    asked_.target().any_hits(shapes(begin, end), blocked, {.options = options_, .statistics = &answered.statistics});
    for (const std::uint8_t hit : blocked) answered.lines += hit != 0 ? "1\n" : "0\n";
    return answered;
  }

  [[nodiscard]] AnsweredBlock all_hits(std::size_t begin, std::size_t end) const {
    std::vector<Answer> hits;
    AnsweredBlock answered;
    for (std::size_t i = begin; i < end; ++i) {
      asked_.target().all_hits(ShapeRow<Shape>::read(table_.row(i)), hits, options_, &answered.statistics);
      for (const Answer& hit : hits) {
        append_number(i, answered.lines);
        answered.lines += ',';
        append_hit(hit, answered.lines);
      }
    }
    return answered;
  }

  const QueryRequest& request_;
  Asked asked_;
  typename Asked::ShapeOptions options_;
  NumberTable<Scalar> table_;
};

template <template <typename> typename Shape, typename Scalar>
void answer_shapes_of(const QueryRequest& request) {
  if (request.question == Question::pair) {
    answer_shape_pairs<Shape<Scalar>, Scalar>(request);
  } else if (request.scene_path.empty()) {
    ShapeQueries<Shape<Scalar>, Scalar, AskedMesh<Scalar>>(request).answer();
  } else {
    ShapeQueries<Shape<Scalar>, Scalar, AskedScene<Scalar>>(request).answer();
  }
}

template <typename Scalar>
void answer_shapes_in(const QueryRequest& request) {
  switch (request.path) {
    case PathForm::box:
      return answer_shapes_of<SweptBox, Scalar>(request);
    case PathForm::capsule:
      return answer_shapes_of<SweptCapsule, Scalar>(request);
    default:
      return answer_shapes_of<SweptSphere, Scalar>(request);
  }
}

}  // namespace

void answer_shapes(const QueryRequest& request) {
  if (request.scalar == ScalarKind::single_precision) {
    answer_shapes_in<float>(request);
  } else {
    answer_shapes_in<double>(request);
  }
}

}  // namespace surehit::example
