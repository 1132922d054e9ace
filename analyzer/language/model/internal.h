// The steps of resolve(), each one function of the tree and what the earlier steps found.
#pragma once

#include "language/model/model.h"

namespace feedhold {

struct ResolveContext {
  const SourceFile &source;
  const SyntaxTree &tree;
  const Dialect &dialect;
};

/// The word that names a program: an O word, or a `<NAME>`, at the head of a block; null for other blocks.  A lone `:`
/// at the end of a block is a mistyped `;`.
const Word *headerOf(const ResolveContext &context, BlockId block);
/// Pairs the o-words; OWordUse::program is filled in by findPrograms.
void findOWords(const ResolveContext &context, ProgramModel &model);
void findPrograms(const ResolveContext &context, ProgramModel &model);
void findSequenceNumbers(const ResolveContext &context, ProgramModel &model);
void findLoops(const ResolveContext &context, ProgramModel &model);
void findCalls(const ResolveContext &context, ProgramModel &model);
/// Fills in Call::span and Call::isLast.
void placeCalls(const ResolveContext &context, ProgramModel &model);
void findJumps(const ResolveContext &context, ProgramModel &model);
void findVariableUses(const ResolveContext &context, ProgramModel &model);

/// Sorts each word of a macro call into argument assignment I or II as the control does: word by word, so that the
/// later word wins when two set one variable.
std::vector<Argument> assignArguments(const ResolveContext &context, BlockId block, const Call &call);

} // namespace feedhold
