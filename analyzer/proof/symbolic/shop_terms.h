// Terms written as a machinist writes expressions: `FUP[ABS[#21/#22]]`.
#pragma once

#include "proof/smt/term.h"

#include <map>
#include <optional>
#include <string>

namespace feedhold::prove {

/// What terms are called: `#10`.
using TermNames = std::map<smt::TermId, std::string>;

/// Absent when something in the term has no name, or no macro function says it.
std::optional<std::string> shopText(smt::TermStore &store, smt::TermId term, const TermNames &names);

} // namespace feedhold::prove
