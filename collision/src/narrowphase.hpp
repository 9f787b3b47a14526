#pragma once

#include <cstdint>
#include <vector>

#include "contact.hpp"
#include "query/path_range.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// Whether both triangles lie in one plane that is square to an axis. A path that crosses the plane meets either, if at
/// all, at the same t.
template <typename Scalar>
[[nodiscard]] bool share_axis_plane(const Triangle<Scalar>& x, const Triangle<Scalar>& y);

/// A triangle that a path meets. Not set by itself, as a `Contact` is not.
template <typename Scalar>
struct Candidate {
  std::uint32_t id;
  Triangle<Scalar> triangle;
  Contact contact;
};

/// One path, asked against triangles that the kernel did not call misses: in double first, what that leaves undecided
/// with running error bounds, and what they leave undecided exactly.
template <typename Scalar>
class Narrowphase {
 public:
  Narrowphase(const Path<Scalar>& path, const QueryOptions<Scalar>& options, const PathRange<Scalar>& range,
              QueryStatistics& statistics)
      : path_(path), options_(options), range_(range), statistics_(statistics) {}

  /// Fills in the contact, unless there is none or the options leave it out.
  [[nodiscard]] bool find_contact(const Triangle<Scalar>& triangle, Contact& found) const;

  /// By exact t, then by id.
  [[nodiscard]] bool comes_before(const Candidate<Scalar>& x, const Candidate<Scalar>& y) const;

  /// Puts what was found in order, each triangle once, though it was found in every cell that lists it.
  void sort(std::vector<Candidate<Scalar>>& found) const;

  /// A contact as it is reported: t, u and v rounded once.
  [[nodiscard]] Hit<Scalar> hit(const Candidate<Scalar>& candidate) const;

 private:
  [[nodiscard]] bool admits(const Contact& contact) const;
  [[nodiscard]] bool find_exactly(const Triangle<Scalar>& triangle, Contact& found) const;
  [[nodiscard]] bool exactly_before(const Candidate<Scalar>& x, const Candidate<Scalar>& y) const;
  void round_exactly(const Candidate<Scalar>& candidate, Hit<Scalar>& hit) const;

  const Path<Scalar>& path_;
  const QueryOptions<Scalar>& options_;
  const PathRange<Scalar>& range_;
  QueryStatistics& statistics_;
};

}  // namespace surehit::detail
