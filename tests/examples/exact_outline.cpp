#include "exact_outline.hpp"

#include <algorithm>
#include <cstddef>

namespace surehit::test {
namespace {

int turn_of(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return sgn(mpq_class((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)));
}

bool is_on(const ExactPoint& point, const ExactPoint& a, const ExactPoint& b) {
  return turn_of(a, b, point) == 0 && std::min(a.x, b.x) <= point.x && point.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= point.y && point.y <= std::max(a.y, b.y);
}

bool cross_inside(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& d) {
  return turn_of(a, b, c) * turn_of(a, b, d) < 0 && turn_of(c, d, a) * turn_of(c, d, b) < 0;
}

}  // namespace

bool crosses_properly(const ExactOutline& outline) {
  const std::size_t size = outline.size();
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = i + 1; j < size; ++j) {
      const ExactPoint& a = outline[i];
      const ExactPoint& b = outline[(i + 1) % size];
      const ExactPoint& c = outline[j];
      const ExactPoint& d = outline[(j + 1) % size];
      if (!cross_inside(a, b, c, d)) continue;
      const mpq_class before = (d.x - c.x) * (a.y - c.y) - (d.y - c.y) * (a.x - c.x);
      const mpq_class after = (d.x - c.x) * (b.y - c.y) - (d.y - c.y) * (b.x - c.x);
      const mpq_class t = before / (before - after);
      const ExactPoint crossing = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
      bool is_alone = true;
      for (std::size_t k = 0; k < size; ++k) {
        is_alone &= k == i || k == j || !is_on(crossing, outline[k], outline[(k + 1) % size]);
      }
      if (is_alone) return true;
    }
  }
  return false;
}

bool is_simple(const ExactOutline& outline) {
  const std::size_t size = outline.size();
  for (std::size_t i = 0; i < size; ++i) {
    const ExactPoint& a = outline[i];
    const ExactPoint& b = outline[(i + 1) % size];
    for (std::size_t j = 0; j < size; ++j) {
      if (j != i && j != (i + 1) % size && is_on(outline[j], a, b)) return false;
      if (cross_inside(a, b, outline[j], outline[(j + 1) % size])) return false;
    }
  }
  return true;
}

}  // namespace surehit::test
