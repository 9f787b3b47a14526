#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "surehit/attributes.hpp"
#include "surehit/callable.hpp"
#include "surehit/hit.hpp"

namespace surehit {

namespace detail {
/// A callable that takes a hit.
template <typename Callable, typename Answer>
concept HitPredicate = requires(std::remove_reference_t<Callable>& callable, const Answer& hit) {
  { callable(hit) } -> std::convertible_to<bool>;
};
/// A callable that takes the index of a path and a hit.
template <typename Callable, typename Answer>
concept BatchHitPredicate = requires(std::remove_reference_t<Callable>& callable, std::size_t path, const Answer& hit) {
  { callable(path, hit) } -> std::convertible_to<bool>;
};
/// A callable of either kind that does not dangle in a `HitFilter`.
template <typename Callable, typename Filter, typename Answer>
concept FiltersHits = OutlivesItsView<Callable> && !std::same_as<std::remove_cvref_t<Callable>, Filter> &&
                      (HitPredicate<Callable, Answer> || BatchHitPredicate<Callable, Answer>);
/// One that has a name, to which a `HitFilter` refers.
template <typename Callable, typename Filter, typename Answer>
concept NamedHitFilter = FiltersHits<Callable, Filter, Answer> && std::is_lvalue_reference_v<Callable>;
/// A temporary one, which a `HitFilter` copies.
template <typename Callable, typename Filter, typename Answer>
concept TemporaryHitFilter = FiltersHits<Callable, Filter, Answer> && !std::is_lvalue_reference_v<Callable>;
}  // namespace detail

/// Decides which hits count. It is made of any callable `bool(const Hit<Scalar>& hit)`, or `bool(std::size_t path,
/// const Hit<Scalar>& hit)`. `path` is the index of the path in its batch, or 0 for a single query. The result is true
/// if the hit counts. The hit is as it is reported, with rounded t, u and v.
///
/// A query may ask about hits in any order, about hits after the first one, and about a hit more than once. The answer
/// must depend on the arguments alone. The callable must not throw, because queries are noexcept. With an executor,
/// several threads may call it at the same time.
///
/// The filter refers to a callable that has a name, and this callable must outlive it. It copies a temporary one, such
/// as a lambda. This one must be trivially copyable, and at most as large as six pointers. A filter allocates nothing.
///
/// `Answer` is the type of the hits. It is `SceneHit<Scalar>` for a scene. For moving shapes it is `ShapeHit<Scalar>`,
/// and `SceneShapeHit<Scalar>` in a scene.
template <FloatOrDouble Scalar, typename Answer = Hit<Scalar>>
class HitFilter {
 public:
  /// Refers to a callable that has a name. One that fits both forms gets the hit alone.
  template <detail::NamedHitFilter<HitFilter, Answer> Callable>
  HitFilter(Callable&& callable SUREHIT_LIFETIMEBOUND) noexcept : callable_(callable), call_(call<Callable>) {}
  /// Copies a temporary callable. A large one, or one that is not trivially copyable, does not compile.
  template <detail::TemporaryHitFilter<HitFilter, Answer> Callable>
  HitFilter(Callable&& callable) noexcept : callable_(std::forward<Callable>(callable)), call_(call<Callable>) {}

  /// Returns true if a hit of a single query counts.
  bool operator()(const Answer& hit) const { return (*this)(0, hit); }
  /// Returns true if a hit of this path of a batch counts.
  bool operator()(std::size_t path, const Answer& hit) const { return call_(callable_, path, hit); }

 private:
  template <typename Callable>
  static bool call(const detail::CallableView& target, [[maybe_unused]] std::size_t path, const Answer& hit) {
    if constexpr (detail::HitPredicate<Callable, Answer>) {
      return target.get<Callable>()(hit);
    } else {
      return target.get<Callable>()(path, hit);
    }
  }

  detail::CallableView callable_;
  bool (*call_)(const detail::CallableView&, std::size_t, const Answer&);  ///< Calls the callable by its type.
};

using HitFilterf = HitFilter<float>;   ///< A filter of hits in float.
using HitFilterd = HitFilter<double>;  ///< A filter of hits in double.

}  // namespace surehit
