// `M98 P2 L#528`: how often a subprogram is repeated, where that is computed.
#pragma once

#include "language/model/model.h"
#include "language/syntax/tree.h"

#include <optional>

namespace feedhold {

/// L of a call that shares the variables of its caller.  The graph counts such calls down, like a `repeat`: each of
/// them enters and leaves the program once, which for shared variables is the same as entering it repeatedly.
inline std::optional<ExpressionId> computedRepeats(const SyntaxTree &tree, const Call &call) {
  std::optional<ExpressionId> times;
  if (call.repeats || (call.kind != CallKind::Subprogram && call.kind != CallKind::Local))
    return times;
  const Span code = tree.words[call.code].span();
  for (const Word &word : tree.wordsOf(call.block))
    if (word.address() == 'L' && word.form() == WordForm::Expression && word.span().begin > code.begin)
      times = word.expression();
  return times;
}

} // namespace feedhold
