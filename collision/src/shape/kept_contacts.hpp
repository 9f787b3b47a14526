#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid/packed_ids.hpp"

namespace surehit::detail {

// What a search keeps of the contacts that it finds. `Candidate` is `ShapeCandidate`, or `PlacedShapeCandidate` in a
// scene. Contacts after `limit` no longer count, and none does once `is_done` is true. Ids are those that decide ties.

/// Returns the last t that counts.
template <typename Options>
double last_t(const Options& options) {
  return std::min(1.0, double{options.max_t});
}

/// Keeps the first contact.
template <typename Candidate>
struct KeepFirst {
  explicit KeepFirst(double last) : limit(last) {}
  template <typename Query, typename Narrowphase>
  void take(const Query& query, const Narrowphase& narrowphase, const Candidate& candidate) {
    if (first && !narrowphase.comes_before(candidate, *first)) return;
    if (query.filter != nullptr && !query.accepts(hit_of(query, narrowphase, candidate))) return;
    first = candidate;
    limit = std::min(limit, candidate.contact.t_upper);
  }
  /// Returns true if the triangle of these ids cannot be the first one, whatever its contact is.
  template <typename Ids>
  [[nodiscard]] bool passes_over(const Ids& ids) const {
    return first && (ids == first->ids() || passes_over_from(ids));
  }
  /// Returns true if neither this triangle nor one with higher ids can be the first one.
  template <typename Ids>
  [[nodiscard]] bool passes_over_from(const Ids& ids) const {
    return first && first->contact.at_start && ids >= first->ids();
  }
  /// Returns how many triangles of a list may be the first one. If the shape begins with a contact, they are those with
  /// lower ids. Ids ascend in a list.
  template <typename IdsOf>
  [[nodiscard]] std::size_t count_that_counts(const PackedIds::Range& list, const IdsOf& ids_of) const {
    if (!first || !first->contact.at_start) return list.size();
    const auto end = std::ranges::partition_point(list, [&](std::uint32_t id) { return ids_of(id) < first->ids(); });
    return static_cast<std::size_t>(end - list.begin());
  }
  std::optional<Candidate> first;
  double limit;
  static constexpr bool is_done = false;
};

/// What keeps contacts of all triangles, whatever it has found.
struct KeepEverywhere {
  template <typename Ids>
  [[nodiscard]] static bool passes_over(const Ids&) {
    return false;
  }
  template <typename Ids>
  [[nodiscard]] static bool passes_over_from(const Ids&) {
    return false;
  }
  template <typename IdsOf>
  [[nodiscard]] static std::size_t count_that_counts(const PackedIds::Range& list, const IdsOf&) {
    return list.size();
  }
};

/// Notes whether there is a contact.
template <typename Candidate>
struct KeepAny : KeepEverywhere {
  explicit KeepAny(double last) : limit(last) {}
  template <typename Query, typename Narrowphase>
  void take(const Query& query, const Narrowphase& narrowphase, const Candidate& candidate) {
    is_done = query.filter == nullptr || query.accepts(hit_of(query, narrowphase, candidate));
  }
  double limit;
  bool is_done = false;
};

/// Keeps all contacts.
template <typename Candidate>
struct KeepAll : KeepEverywhere {
  explicit KeepAll(double last) : limit(last) {}
  template <typename Query, typename Narrowphase>
  void take(const Query&, const Narrowphase&, const Candidate& candidate) {
    all.push_back(candidate);
  }
  std::vector<Candidate> all;
  double limit;
  static constexpr bool is_done = false;
};

}  // namespace surehit::detail
