// What the words of a block belong to, before a rule takes them for coordinates or codes.
#pragma once

#include "findings/rule/rule.h"

namespace feedhold::rules {

/// The words of the block are arguments of a macro call (G65, G66, a code of the machine's tables).
bool passesArguments(const FileContext &context, BlockId block);

/// The block holds a code that gives its words a meaning of their own: a macro call, G10 data, or a code that is not in
/// the dialect (machine builders make calls of such codes).
bool meansOwnWords(const FileContext &context, BlockId block);
/// The same of one word.
bool meansOwnWords(const Word &word, const FileContext &context);

} // namespace feedhold::rules
