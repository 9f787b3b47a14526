#pragma once

#include <concepts>
#include <type_traits>

#include "surehit/callable_address.hpp"
#include "surehit/hit.hpp"

namespace surehit {

/// A reference to any callable `bool(const Hit<Scalar>&)` that says whether a hit counts. It owns nothing: the callable
/// must outlive the query, which a lambda written in the call does.
///
/// A query may show it hits in any order, hits beyond the first, and the same hit more than once; what it says must
/// depend on the hit alone. It must not throw: queries are noexcept.
template <typename Scalar>
class HitFilter {
 public:
  template <typename Callable>
  requires(!std::same_as<std::remove_cvref_t<Callable>, HitFilter> &&
           std::is_invocable_r_v<bool, Callable&, const Hit<Scalar>&>) HitFilter(Callable&& callable)
  noexcept
      : callable_(detail::callable_address(callable)), call_([](void* target, const Hit<Scalar>& hit) -> bool {
          return (*reinterpret_cast<std::remove_reference_t<Callable>*>(target))(hit);
        }) {}

  bool operator()(const Hit<Scalar>& hit) const { return call_(callable_, hit); }

 private:
  void* callable_;
  bool (*call_)(void*, const Hit<Scalar>&);
};

using HitFilterf = HitFilter<float>;
using HitFilterd = HitFilter<double>;

}  // namespace surehit
