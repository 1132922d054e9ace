// match(variant, lambdas...): a case split that names every case; a new alternative breaks the build.
#pragma once

#include <utility>
#include <variant>

namespace feedhold {

template <typename... Cases> struct Overloaded : Cases... { using Cases::operator()...; };
template <typename... Cases> Overloaded(Cases...) -> Overloaded<Cases...>;

template <typename Variant, typename... Cases> decltype(auto) match(Variant &&variant, Cases &&...cases) {
  return std::visit(Overloaded{std::forward<Cases>(cases)...}, std::forward<Variant>(variant));
}

} // namespace feedhold
