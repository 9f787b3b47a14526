#include "surehit_query/explanation_text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <set>
#include <utility>

#include "surehit_query/hit_text.hpp"

namespace surehit::example {
namespace {

/// A number that need not read back to the same bits.
std::string rounded(double number, const char* format) {
  std::array<char, 32> text = {};
  std::snprintf(text.data(), text.size(), format, number);
  return text.data();
}

template <typename Number>
std::string exact(Number number) {
  std::string text;
  append_number(number, text);
  return text;
}

template <typename Scalar>
std::string exact(const Vector3<Scalar>& point) {
  return exact(point[0]) + ' ' + exact(point[1]) + ' ' + exact(point[2]);
}

std::string counted(std::size_t count, const std::string& noun) {
  return exact(count) + ' ' + noun + (count == 1 ? "" : "s");
}

std::string words_for(CellFinding finding) {
  switch (finding) {
    case CellFinding::empty:
      return "empty";
    case CellFinding::misses_box:
      return "the path misses the box around its triangles";
    case CellFinding::misses_slab:
      return "the path misses the planes around its triangles";
    case CellFinding::list:
      break;
  }
  return "asks ";
}

std::string words_for(PairOutcome outcome) {
  switch (outcome) {
    case PairOutcome::left_out:
      return "left out";
    case PairOutcome::miss:
      return "miss";
    case PairOutcome::contact_left_out:
      return "hit, but left out by an option";
    case PairOutcome::hit:
      break;
  }
  return "hit";
}

std::string words_for(DecidedBy stage) {
  switch (stage) {
    case DecidedBy::options:
      return "its mask or id";
    case DecidedBy::filter:
      return "the filter";
    case DecidedBy::coordinates:
      return "comparing coordinates";
    case DecidedBy::doubles:
      return "doubles";
    case DecidedBy::plane:
      return "two coordinates in its plane";
    case DecidedBy::running_bounds:
      return "doubles with running bounds";
    case DecidedBy::integers:
      break;
  }
  return "exact integers";
}

std::string words_for(OrderedBy order) {
  switch (order) {
    case OrderedBy::nothing:
      return "first";
    case OrderedBy::bounds:
      return "later by the bounds of t";
    case OrderedBy::exact_t:
      return "later by the exact t";
    case OrderedBy::triangle:
      break;
  }
  return "at the same exact t, with a larger id";
}

/// Lines about one query.
template <typename Scalar>
class Lines {
 public:
  explicit Lines(const Explanation<Scalar>& explanation) : told_(explanation) {}

  void add_path(const Path<Scalar>& path, const QueryOptions<Scalar>& options) {
    constexpr std::array<const char*, 3> kinds = {"segment", "ray", "line"};
    text_ += kinds[static_cast<std::size_t>(path.kind)];
    text_ += " from " + exact(path.start) + (path.has_end() ? " to " : " along ") + exact(path.toward);
    text_ += sizeof(Scalar) == sizeof(float) ? ", in float\n" : ", in double\n";
    if (options.min_t > -std::numeric_limits<Scalar>::infinity()) text_ += "t from " + exact(options.min_t) + '\n';
    if (options.max_t < std::numeric_limits<Scalar>::infinity()) text_ += "t up to " + exact(options.max_t) + '\n';
  }

  void add_walk() {
    switch (told_.walk) {
      case ExplainedWalk::nowhere:
        text_ += "\nwalk: no cell: the path comes to no part of the grid that has triangles\n";
        break;
      case ExplainedWalk::cells:
        text_ += "\nwalk: " + counted(told_.cells.size(), "step") + '\n';
        break;
      case ExplainedWalk::one_list:
        text_ += "\nwalk: none: a small mesh is one list\n";
        break;
      case ExplainedWalk::all_triangles:
        text_ += "\nwalk: none: the path starts too far away for the grid, so all triangles are asked\n";
        add_candidates(0, told_.candidates.size());
    }
    for (std::size_t i = 0; i < told_.cells.size(); ++i) add_cell(i, told_.cells[i]);
  }

  void add_hits() {
    text_ += '\n' + (told_.hits.empty() ? "order: no hit" : "order: " + counted(told_.hits.size(), "hit")) + '\n';
    for (const auto& [hit, t_lower, t_upper, ordered_by, is_rounded_by_integers] : told_.hits) {
      text_ += "  triangle " + exact(hit.triangle) + ": " + words_for(ordered_by);
      text_ += "; t is from " + rounded(t_lower, "%.9g") + " to " + rounded(t_upper, "%.9g") + '\n';
    }
    if (told_.hits.empty()) return;
    const ExplainedHit<Scalar>& first = told_.hits.front();
    text_ += "\nrounding: by ";
    text_ += first.is_rounded_by_integers ? "exact integers\n" : "doubles, whose bounds leave one number for each\n";
  }

  void add_answer() {
    text_ += "\nanswer: ";
    const auto hit = told_.first_hit();
    text_ += hit ? "triangle " + exact(hit->triangle) + ", t = " + exact(hit->t) + ", u = " + exact(hit->u) +
                       ", v = " + exact(hit->v) + ", " + name_of(hit->side) + '\n'
                 : "no hit\n";
  }

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void add_cell(std::size_t index, const ExplainedCell& cell) {
    text_ += "cell " + exact(index) + (cell.is_inner ? " of an inner grid" : "");
    text_ += ", t " + rounded(cell.enters, "%.6g") + " to " + rounded(cell.leaves, "%.6g");
    for (int axis = 0; axis < 3; ++axis) {
      text_ += std::string(", ") + "xyz"[axis] + ' ' + rounded(cell.box.low[axis], "%.6g") + " to " +
               rounded(cell.box.high[axis], "%.6g");
    }
    text_ += ": " + words_for(cell.finding);
    if (cell.finding == CellFinding::list) text_ += counted(cell.candidate_count, "triangle");
    text_ += '\n';
    add_candidates(cell.first_candidate, cell.candidate_count);
  }

  void add_candidates(std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) add_candidate(told_.candidates[i]);
  }

  void add_candidate(const ExplainedCandidate& candidate) {
    text_ += "  triangle " + exact(candidate.triangle) + ": " + words_for(candidate.outcome);
    if (!asked_.insert(candidate.triangle).second) {
      text_ += ", as before\n";
      return;
    }
    text_ += ", by " + words_for(candidate.decided_by);
    const bool is_asked_further = candidate.decided_by != DecidedBy::options;
    if (candidate.filter_verdict == FilterVerdict::undecided && is_asked_further) text_ += "; the filter is undecided";
    text_ += '\n';
    if (!candidate.numbers) return;
    const auto& [det, t_det, u_det, v_det, w_det] = *candidate.numbers;
    text_ += "    det " + bounded_text(det) + ", T " + bounded_text(t_det) + '\n';
    text_ += "    U " + bounded_text(u_det) + ", V " + bounded_text(v_det) + ", W " + bounded_text(w_det) + '\n';
  }

  /// The filter's numbers are Scalars.
  [[nodiscard]] static std::string bounded_text(const FilterNumber& number) {
    return exact(static_cast<Scalar>(number.value)) + " +- " + rounded(number.bound, "%.3g");
  }

  const Explanation<Scalar>& told_;
  std::set<std::uint32_t> asked_;
  std::string text_;
};

}  // namespace

template <typename Scalar>
std::string text_of(const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                    const Explanation<Scalar>& explanation) {
  Lines<Scalar> lines(explanation);
  lines.add_path(path, options);
  lines.add_walk();
  lines.add_hits();
  lines.add_answer();
  return lines.take();
}

template std::string text_of(const Path<float>&, const QueryOptions<float>&, const Explanation<float>&);
template std::string text_of(const Path<double>&, const QueryOptions<double>&, const Explanation<double>&);

}  // namespace surehit::example
