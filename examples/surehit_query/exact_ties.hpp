#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <surehit/collider.hpp>
#include <vector>

namespace surehit::example {

/// Tells which of a path's hits tie: meet the path at the very same exact t. Their rounded t may be the same without
/// that.
///
/// A collider puts hits in the order of exact t, and those that tie in the order of ids. So a collider of the same
/// triangles with their ids the other way round turns the order of those that tie, and of no others.
template <typename Scalar>
class ExactTies {
 public:
  ExactTies(const Collider<Scalar>& collider, const QueryOptions<Scalar>& options)
      : collider_(collider), options_(options) {
    options_.mask = ~std::uint32_t{0};
    options_.ignored_triangle = no_triangle;
  }

  /// The hits are all those of the path, in their order. The result has one number for each: 1 if it ties.
  [[nodiscard]] std::vector<std::uint8_t> find(const Path<Scalar>& path, const std::vector<Hit<Scalar>>& hits) const {
    std::vector<std::uint8_t> ties(hits.size(), 0);
    for (std::size_t begin = 0; begin < hits.size();) {
      std::size_t end = begin + 1;
      while (end < hits.size() && hits[end].t == hits[begin].t) ++end;
      if (end - begin > 1) find_among(path, hits, begin, end, ties);
      begin = end;
    }
    return ties;
  }

 private:
  void find_among(const Path<Scalar>& path, const std::vector<Hit<Scalar>>& hits, std::size_t begin, std::size_t end,
                  std::vector<std::uint8_t>& ties) const {
    std::vector<std::array<Scalar, 3>> corners;
    for (std::size_t i = end; i-- > begin;) {
      const Triangle<Scalar> triangle = collider_.triangle(hits[i].triangle);
      for (const auto* corner : {&triangle.a, &triangle.b, &triangle.c}) {
        corners.push_back({corner->x(), corner->y(), corner->z()});
      }
    }
    std::vector<std::uint32_t> ids(corners.size());
    std::iota(ids.begin(), ids.end(), 0u);
    Collider<Scalar> turned;
    if (!turned.try_build({corners, ids})) return;  // cannot be: the collider has taken each of them

    std::vector<Hit<Scalar>> in_turned_order;
    turned.all_hits(path, in_turned_order, options_);
    std::vector<std::size_t> place(end - begin);
    for (std::size_t i = 0; i < in_turned_order.size(); ++i) place[in_turned_order[i].triangle] = i;
    for (std::size_t i = begin; i + 1 < end; ++i) {
      if (place[end - 1 - i] > place[end - 2 - i]) ties[i] = ties[i + 1] = 1;
    }
  }

  const Collider<Scalar>& collider_;
  QueryOptions<Scalar> options_;
};

}  // namespace surehit::example
