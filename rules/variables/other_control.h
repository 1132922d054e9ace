// Whether a program seems to be for another control than the one that it is checked for: it uses variables and G codes
// that this one does not have.
#pragma once

#include "findings/rule/rule.h"

#include <map>
#include <string>

namespace feedhold::rules {

/// So many variables that do not exist are more than slips.
inline constexpr std::size_t kForeignVariables = 4;

/// Variables and G codes that the control does not have, each where it stands first.
using MissingVariables = std::map<std::uint32_t, Span>;
using MissingCodes = std::map<std::string, Span>;
MissingVariables missingVariablesOf(const FileContext &context);
MissingCodes missingCodesOf(const FileContext &context);

bool isOfOtherControl(const MissingVariables &variables, const MissingCodes &codes);
/// The same, or the variables alone, or the codes alone, are too many for slips.
bool seemsForOtherControl(const FileContext &context);

} // namespace feedhold::rules
