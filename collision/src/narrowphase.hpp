#pragma once

#include <cstdint>
#include <vector>

#include "contact.hpp"
#include "filter/bounded_contact.hpp"
#include "path_range.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// Returns true if both triangles lie in one plane that is perpendicular to an axis. If a path crosses this plane and
/// meets both triangles, it meets them at the same t.
template <typename Scalar>
[[nodiscard]] bool share_axis_plane(const Triangle<Scalar>& x, const Triangle<Scalar>& y);

/// Rounds t, u and v of a hit. Returns false if their bounds do not decide all of them.
template <typename Scalar>
[[nodiscard]] bool try_round(const BoundedContact& bounded, Hit<Scalar>& hit);

/// Returns true if the options on contacts admit a contact: the culling, and the contacts to ignore. `Options` are
/// those of a collider or of a scene.
template <typename Options>
[[nodiscard]] bool admits(const Options& options, const Contact& contact) {
  if (options.culling == Culling::back && contact.side != Side::front) return false;
  if (options.culling == Culling::front && contact.side != Side::back) return false;
  if (options.ignore_start_contact && contact.at_start) return false;
  if (options.ignore_end_contact && contact.at_end) return false;
  return true;
}

/// A triangle that a path may meet. `Candidate` without `{}` leaves all members unset, as `Contact` does.
template <typename Scalar>
struct Candidate {
  std::uint32_t id;           ///< The id of the triangle.
  Triangle<Scalar> triangle;  ///< The corners of the triangle.
  Contact contact;            ///< The contact. It is set if the path meets the triangle.
};

/// What is known of a path and a triangle before the narrowphase.
enum class Closeness : std::uint8_t {
  unknown,  ///< Nothing is known.
  close,    ///< The kernel in double has not decided the pair, with its bounds for a list.
};

/// Decides one path against triangles that may be hit. The kernel has not called them misses. It begins with the
/// second stage, which works in double. A path that ends at a corner needs no more than a sign, and one in the plane of
/// a wall no more than two coordinates. Running error bounds decide what it leaves undecided. Exact integers decide the
/// rest.
template <typename Scalar>
class Narrowphase {
 public:
  Narrowphase(const Path<Scalar>& path, const QueryOptions<Scalar>& options, const PathRange<Scalar>& range,
              QueryStatistics& statistics)
      : path_(path), options_(options), range_(range), statistics_(statistics) {}

  /// Returns true, with the contact in `found`, if the path meets the triangle and the options on contacts admit it.
  /// Otherwise `found` has no meaning. A close pair skips `double_contact`. Masks, filters and the ignored triangle are
  /// for the caller.
  [[nodiscard]] bool find_contact(const Triangle<Scalar>& triangle, Contact& found,
                                  Closeness closeness = Closeness::unknown) const;

  /// Returns true if x comes before y: by the exact t, then by the id.
  [[nodiscard]] bool comes_before(const Candidate<Scalar>& x, const Candidate<Scalar>& y) const;

  /// Sorts the candidates by `comes_before`, and keeps each triangle once. Each cell that lists a triangle may find it.
  void sort(std::vector<Candidate<Scalar>>& found) const;

  /// Returns the contact as it is reported. Each of t, u and v is the exact value, rounded once.
  [[nodiscard]] Hit<Scalar> hit(const Candidate<Scalar>& candidate) const;

 private:
  /// Does the same with stages 3 and 4. It does not look at the options on contacts.
  [[nodiscard]] bool find_exactly(const Triangle<Scalar>& triangle, Contact& found) const;
  /// Does the same as `comes_before`, exactly.
  [[nodiscard]] bool exactly_before(const Candidate<Scalar>& x, const Candidate<Scalar>& y) const;
  /// Rounds t, u and v with stages 3 and 4.
  void round_exactly(const Candidate<Scalar>& candidate, Hit<Scalar>& hit) const;

  const Path<Scalar>& path_;
  const QueryOptions<Scalar>& options_;
  const PathRange<Scalar>& range_;
  QueryStatistics& statistics_;
};

}  // namespace surehit::detail
