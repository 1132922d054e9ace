// S-expressions: the form of SMT-LIB, of claims and of certificates.
#pragma once

#include "base/support/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace feedhold::smt {

/// An atom, or a list of them.
struct SExpression {
  enum class Kind : std::uint8_t { Atom, List };
  Kind kind = Kind::List;
  std::string atom; ///< without the bars of `|a name|`
  std::vector<SExpression> items;

  bool isAtom() const { return kind == Kind::Atom; }
  bool isAtom(std::string_view text) const { return isAtom() && atom == text; }
  /// A list whose first item is this atom.
  bool isCall(std::string_view head) const { return !items.empty() && items.front().isAtom(head); }
};

/// All expressions of a text; `;` begins a comment.  Lists nest 1000 deep at most.
Result<std::vector<SExpression>> readSExpressions(std::string_view text);

/// The name itself, or within bars where it is no simple symbol.  Bars and backslashes in a name become underscores.
std::string quotedSymbol(std::string_view name);

} // namespace feedhold::smt
