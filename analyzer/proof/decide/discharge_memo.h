// Memoised proof searches: macros of a family, and the programs that call one macro, ask the same of their
// common parts.
#pragma once

#include "proof/decide/discharge_search.h"
#include "proof/smt/solver.h"

namespace feedhold::prove {

/// As searchCertificate.  The names of variables do not matter.
SearchResult searchOnce(const check::UnsatProblem &claim, std::uint64_t workLimit);
/// As smt::askZ3 and smt::askCvc5.
smt::Answer askZ3Once(const std::string &smtlib, smt::Arithmetic arithmetic, std::uint64_t resources);
smt::Answer askCvc5Once(const std::string &smtlib, std::uint64_t resources);

} // namespace feedhold::prove
