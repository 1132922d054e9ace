// VariableNames: the variables of a claim by name, for those who read texts about it.
#pragma once

#include "proof/check/problem.h"
#include "proof/smt/s_expression.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::check {

/// Why a text is none: thrown by the readers of texts, and caught where they begin.
struct Malformed {
  std::string reason;
};

class VariableNames {
public:
  VariableNames() = default;
  explicit VariableNames(const std::vector<ClaimVariable> &variables) {
    for (const ClaimVariable &variable : variables)
      add(variable.name);
  }
  void add(const std::string &name) {
    if (!indexes_.emplace(name, static_cast<std::uint32_t>(indexes_.size())).second)
      throw Malformed{"two variables named `" + name + "`"};
  }
  Polynomial operator[](const smt::SExpression &item) const {
    const auto found = item.isAtom() ? indexes_.find(item.atom) : indexes_.end();
    if (found == indexes_.end())
      throw Malformed{"an unknown variable `" + item.atom + "`"};
    return variable(found->second);
  }

private:
  std::map<std::string, std::uint32_t, std::less<>> indexes_;
};

/// The items of a list without the first few.
inline std::span<const smt::SExpression> rest(const smt::SExpression &item, std::size_t from = 1) {
  if (item.items.size() < from)
    throw Malformed{"a list is too short"};
  return std::span(item.items).subspan(from);
}

} // namespace feedhold::check
