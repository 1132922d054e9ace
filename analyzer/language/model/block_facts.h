// What the codes of one block mean together: the roles of its G and M words, and how control leaves it.
#pragma once

#include "base/source/source_file.h"
#include "language/dialect/dialect.h"
#include "language/syntax/tree.h"

#include <optional>

namespace feedhold {

/// The first word of the block whose code has the role.
const Word *findCode(const SyntaxTree &tree, BlockId block, const Dialect &dialect, CodeRole role);
/// Likewise, by what it does: one of `actions`.
const Word *findAction(const SyntaxTree &tree, BlockId block, const Dialect &dialect,
                       std::initializer_list<CodeAction> actions);
/// A cycle of a lathe that returns to where it started.
const Word *findTurningCycle(const SyntaxTree &tree, BlockId block, const Dialect &dialect);
/// The first word of an address; comma words do not count.
const Word *findWord(const SyntaxTree &tree, BlockId block, char address);
/// The dialect's row for a G or M word with a literal number; none for an argument of a call.
const Code *codeOf(const Word &word, const Dialect &dialect);

/// The words of the block are arguments of a macro call (G65, G66, a code of the machine's tables).
bool passesArguments(const SyntaxTree &tree, BlockId block, const Dialect &dialect);
/// The word gives the others of its block a meaning of their own: a macro call, G10 data, or a code that is not in the
/// dialect (machine builders make calls of such codes).
bool meansOwnWords(const Word &word, const Dialect &dialect);
bool meansOwnWords(const SyntaxTree &tree, BlockId block, const Dialect &dialect);

/// How the control goes on after a block that is not skipped.
enum class FlowAfter : std::uint8_t { Next, MayJump, Jumps, Ends };
/// Ends: M02, M30, M99, `#3000=`, `o100 endsub`.  Jumps: an unconditional GOTO, `break`, `continue`, `return`.
FlowAfter flowAfter(const SyntaxTree &tree, BlockId block, const Dialect &dialect);

/// `(abort, no probe)` as the last `(..)` of a block without an o-word: LinuxCNC stops there, before it executes the
/// words and statements of the block (tried on the interpreter).
bool abortsProgram(const SourceFile &source, const SyntaxTree &tree, BlockId block, const Dialect &dialect);

/// `GO1X25.`: the digit of a motion code with the letter O.  The control reads `GOTO 1`, and stops at the words behind
/// it.  Absent: the statement is none.
std::optional<unsigned> motionCodeWithLetter(const SyntaxTree &tree, BlockId block, const Statement &statement,
                                             const Dialect &dialect);

/// The text of the block, its comments apart, has a letter other than N with a number, a variable or an expression
/// behind it: of a block that could not be read, whether it may have been meant to hold a code or a coordinate.
bool mayNameWord(const SourceFile &source, const SyntaxTree &tree, BlockId block);

/// The block only ends or separates: no word, no statement (it may hold comments).
bool isEmpty(const SyntaxTree &tree, BlockId block);

} // namespace feedhold
