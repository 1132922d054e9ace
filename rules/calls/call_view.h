// How rules look at calls: their words, the program they name.
#pragma once

#include "findings/rule/rule.h"

#include <string>

namespace feedhold::rules {

/// A call that is written with the code of its kind and the number of a program: G65, G66, G66.1, M98, M198.
bool namesProgram(CallKind kind);
bool isMacroCall(CallKind kind);

const Word &wordOf(const FileContext &context, WordId id);
/// The call of the program `caller` that reaches `callee` first in the text; null when there is none.
const Call *callTo(const FileContext &context, ProgramId caller, ProgramRef callee);

} // namespace feedhold::rules
