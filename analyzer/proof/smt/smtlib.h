// Terms as SMT-LIB 2 text, and the part of SMT-LIB 2 that we write, read back.
#pragma once

#include "base/support/result.h"
#include "proof/smt/term.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::smt {

enum class Arithmetic : std::uint8_t { Linear, Nonlinear };
/// Nonlinear: a product of unknowns or a quotient by one occurs.
Arithmetic arithmeticOf(const TermStore &store, std::span<const TermId> formulas);

/// `set-logic`, declarations, definitions of what occurs more than once (so that the size is linear), one `assert` for
/// each formula, `check-sat`.  Functions other than floor are uninterpreted, named `feedhold.sin` and so on.
std::string writeSmtLib(const TermStore &store, std::span<const TermId> formulas);

/// The asserted formulas.  Reads declare-const, declare-fun without arguments, define-fun, assert, let, ite, the
/// connectives, linear and nonlinear arithmetic, to_real, to_int, and our own functions.  No quantifiers.
Result<std::vector<TermId>> readSmtLib(TermStore &store, std::string_view text);

} // namespace feedhold::smt
