// Model: values of variables by name; and what a term is under it.
#pragma once

#include "proof/smt/term.h"

#include <map>
#include <string>
#include <variant>

namespace feedhold::smt {

using Value = std::variant<bool, Number>;
using Model = std::map<std::string, Value, std::less<>>;

/// The exact value; absent when a variable is missing, a divisor is 0, or a function has no rational value that is
/// known. Connectives and conditions need only what decides them.
std::optional<Value> evaluate(const TermStore &store, TermId term, const Model &model);
/// Of a condition: its value is known, and it holds.
bool isTrue(const TermStore &store, TermId condition, const Model &model);

} // namespace feedhold::smt
