// Header call: the letters that the remarks at the head of a macro show in its call, `(G65 P9012 H_ T_)`.
#pragma once

#include "findings/rule/rule.h"

#include <set>

namespace feedhold::rules {

struct HeaderCall {
  std::set<char> letters;
  Span comment;
};

/// Of a call with the number of the program itself, in a remark before its first block that does something.
std::optional<HeaderCall> headerCallOf(const FileContext &context, ProgramId program);

} // namespace feedhold::rules
