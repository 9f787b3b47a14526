#pragma once

#include <cstdint>
#include <optional>

#include "contact.hpp"
#include "moller_trumbore.hpp"
#include "path_range.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// One path, asked against triangle after triangle: the kernel first, what it leaves undecided in double with error
/// bounds, and what that leaves undecided exactly.
template <typename Scalar>
class Narrowphase {
 public:
  Narrowphase(const Path<Scalar>& path, const QueryOptions<Scalar>& options, QueryStatistics& statistics);

  /// Whether nothing can be hit: the path is not finite, or the options admit no parameter.
  [[nodiscard]] bool admits_nothing() const { return admits_nothing_; }
  [[nodiscard]] const PathRange<Scalar>& range() const { return range_; }

  /// The contact, unless the options leave it out.
  [[nodiscard]] std::optional<Contact> contact(const Triangle<Scalar>& triangle) const;
  /// Whether there is one; it need not be located.
  [[nodiscard]] bool meets(const Triangle<Scalar>& triangle) const;

  struct Candidate {
    const Triangle<Scalar>* triangle = nullptr;
    std::uint32_t id = no_triangle;
    Contact contact;
  };
  /// By exact t, then by id.
  [[nodiscard]] bool comes_before(const Candidate& x, const Candidate& y) const;

  /// A contact as it is reported: t, u and v rounded once.
  [[nodiscard]] Hit<Scalar> hit(const Candidate& candidate) const;

 private:
  [[nodiscard]] bool admits(const Contact& contact) const;
  [[nodiscard]] std::optional<Contact> resolve(const Triangle<Scalar>& triangle) const;

  const Path<Scalar>& path_;
  const QueryOptions<Scalar>& options_;
  QueryStatistics& statistics_;
  PathRange<Scalar> range_;
  MollerTrumbore<Scalar> kernel_;
  bool admits_nothing_;
  bool every_hit_counts_;  ///< no option looks at the side or at the path's ends
};

}  // namespace surehit::detail
