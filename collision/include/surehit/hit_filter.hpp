#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "surehit/callable.hpp"
#include "surehit/hit.hpp"

namespace surehit {

namespace detail {
template <typename Callable, typename Scalar>
concept HitPredicate = std::is_invocable_r_v < bool,
        std::remove_reference_t<Callable>
&, const Hit<Scalar>& > ;
template <typename Callable, typename Scalar>
concept BatchHitPredicate = std::is_invocable_r_v < bool,
        std::remove_reference_t<Callable>
&, std::size_t, const Hit<Scalar>& > ;
template <typename Callable, typename Filter, typename Scalar>
concept FiltersHits = OutlivesItsView<Callable> && !std::same_as<std::remove_cvref_t<Callable>, Filter> &&
                      (HitPredicate<Callable, Scalar> || BatchHitPredicate<Callable, Scalar>);
}  // namespace detail

/// Says which hits count: any callable `bool(const Hit<Scalar>& hit)`, or `bool(std::size_t path, const Hit<Scalar>&
/// hit)`, where `path` is the path's index in its batch, and 0 outside of batches.
///
/// A query may show it hits in any order, hits beyond the first one, and a hit more than once. What it says must
/// depend on its arguments alone. It must not throw: queries are noexcept.
///
/// A callable that has a name is referred to and must outlive the filter. A temporary one, such as a lambda, is copied
/// in; it must be trivially copyable and hold at most six pointers.
template <FloatOrDouble Scalar>
class HitFilter {
 public:
  template <detail::FiltersHits<HitFilter, Scalar> Callable>
  HitFilter(Callable&& callable) noexcept
      : callable_(std::forward<Callable>(callable)),
        call_(
            [](const detail::CallableView& target, [[maybe_unused]] std::size_t path, const Hit<Scalar>& hit) -> bool {
              if constexpr (detail::HitPredicate<Callable, Scalar>) {
                return target.get<Callable>()(hit);
              } else {
                return target.get<Callable>()(path, hit);
              }
            }) {}

  bool operator()(const Hit<Scalar>& hit) const { return (*this)(0, hit); }
  bool operator()(std::size_t path, const Hit<Scalar>& hit) const { return call_(callable_, path, hit); }

 private:
  detail::CallableView callable_;
  bool (*call_)(const detail::CallableView&, std::size_t, const Hit<Scalar>&);
};

using HitFilterf = HitFilter<float>;
using HitFilterd = HitFilter<double>;

}  // namespace surehit
