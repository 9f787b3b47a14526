#include "cgal_box_oracle.hpp"

#include <CGAL/Gmpq.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <array>
#include <cstddef>

#include "cgal_shapes.hpp"

namespace surehit::test {
namespace {

using namespace cgal;

// The solver takes no other rationals.
using Number = CGAL::Gmpq;
using Numbers = std::array<Number, 3>;
using Program = CGAL::Quadratic_program<Number>;
using Solution = CGAL::Quadratic_program_solution<Number>;

template <typename Scalar>
Numbers to_numbers(const Vector3<Scalar>& x) {
  return {Number(double{x[0]}), Number(double{x[1]}), Number(double{x[2]})};
}

Numbers operator-(const Numbers& x, const Numbers& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Number dot(const Numbers& x, const Numbers& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

struct ExactBox {
  Numbers start, step, extents;
  Numbers a, to_b, to_c;

  template <typename Scalar>
  ExactBox(const SweptBox<Scalar>& box, const Triangle<Scalar>& triangle)
      : start(to_numbers(box.start)),
        step(to_numbers(box.end) - start),
        extents(to_numbers(box.half_extents)),
        a(to_numbers(triangle.a)),
        to_b(to_numbers(triangle.b) - a),
        to_c(to_numbers(triangle.c) - a) {}

  /// A point of the triangle that is in the box, as a program in u, v and t. None of them is negative.
  [[nodiscard]] Program program() const {
    Program program(CGAL::SMALLER, true, 0, false, 0);
    program.set_a(0, 0, 1);
    program.set_a(1, 0, 1);
    program.set_b(0, 1);
    program.set_u(2, true, 1);
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      for (const int side : {1, -1}) {
        const int row = 1 + 2 * i + (side > 0 ? 0 : 1);
        program.set_a(0, row, side * to_b[axis]);
        program.set_a(1, row, side * to_c[axis]);
        program.set_a(2, row, -side * step[axis]);
        program.set_b(row, extents[axis] + side * (start[axis] - a[axis]));
      }
    }
    return program;
  }

  /// Returns the lowest t at which they touch, or nothing.
  [[nodiscard]] std::optional<Number> time() const {
    Program lowest = program();
    lowest.set_c(2, 1);
    const Solution solution = CGAL::solve_linear_program(lowest, Number());
    if (solution.is_infeasible()) return std::nullopt;
    return value(solution.objective_value());
  }

  /// Returns u and v of the point in the box that is nearest to the centre at t.
  [[nodiscard]] std::array<Number, 2> nearest(const Number& t) const {
    Program nearest = program();
    nearest.set_l(2, true, t);
    nearest.set_u(2, true, t);
    const Numbers w = a - Numbers{start[0] + t * step[0], start[1] + t * step[1], start[2] + t * step[2]};
    nearest.set_c(0, 2 * dot(to_b, w));
    nearest.set_c(1, 2 * dot(to_c, w));
    nearest.set_d(0, 0, 2 * dot(to_b, to_b));
    nearest.set_d(1, 0, 2 * dot(to_b, to_c));
    nearest.set_d(1, 1, 2 * dot(to_c, to_c));
    const Solution solution = CGAL::solve_quadratic_program(nearest, Number());
    auto weight = solution.variable_values_begin();
    const Number u = value(*weight);
    return {u, value(*++weight)};
  }

 private:
  template <typename Quotient>
  static Number value(const Quotient& quotient) {
    return quotient.numerator() / quotient.denominator();
  }
};

/// Returns the weights of a point of the triangle on the answered part, or nothing if it is not there.
std::optional<Numbers> weights_on(const ExactBox& box, const std::array<Number, 2>& nearest, Feature feature) {
  const Numbers& e = box.to_b;
  const Numbers& f = box.to_c;
  if (feature == Feature::face) {
    if (dot(e, e) * dot(f, f) == dot(e, f) * dot(e, f)) return std::nullopt;
    return Numbers{1 - nearest[0] - nearest[1], nearest[0], nearest[1]};
  }
  const std::array<Numbers, 3> corners = {Numbers{0, 0, 0}, e, f};
  const auto [from, to] = ends_of(feature);
  Numbers point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = nearest[0] * e[i] + nearest[1] * f[i];
  const Numbers edge = corners[to] - corners[from];
  Numbers weights = {0, 0, 0};
  weights[from] = 1;
  if (from != to) {
    if (dot(edge, edge) == 0) return std::nullopt;
    weights[to] = dot(point - corners[from], edge) / dot(edge, edge);
    weights[from] = 1 - weights[to];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (point[i] != weights[1] * e[i] + weights[2] * f[i]) return std::nullopt;
  }
  return weights;
}

}  // namespace

template <typename Scalar>
std::optional<std::string> cgal_error(const SweptBox<Scalar>& box, const Triangle<Scalar>& triangle,
                                      const std::optional<ShapeHit<Scalar>>& answer) {
  const ExactBox exact(box, triangle);
  const std::optional<Number> t = exact.time();
  if (t.has_value() != answer.has_value()) {
    return answer ? "CGAL: a hit, but they do not touch" : "CGAL: a miss, but they touch";
  }
  if (!answer) return std::nullopt;
  const auto is_rounded = [](const Number& number, Scalar rounded) {
    return rounds_to(number, rounded, [](double x, double y) { return (Number(x) + Number(y)) / 2; });
  };
  if (!is_rounded(*t, answer->t)) return "CGAL: t is wrong";
  if (answer->started_touching != (*t == 0)) return "CGAL: started_touching is wrong";
  const std::optional<Numbers> weights = weights_on(exact, exact.nearest(*t), answer->feature);
  if (!weights || !is_inside(*weights, answer->feature)) return "CGAL: the feature is wrong";
  if (!is_rounded((*weights)[1], answer->u)) return "CGAL: u is wrong";
  if (!is_rounded((*weights)[2], answer->v)) return "CGAL: v is wrong";
  return std::nullopt;
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                \
  template std::optional<std::string> cgal_error(const SweptBox<Scalar>&, const Triangle<Scalar>&, \
                                                 const std::optional<ShapeHit<Scalar>>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
