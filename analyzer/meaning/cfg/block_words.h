// BlockWords: which words of a block are executed as NC words, and which belong to a call, a return or an end.
#pragma once

#include "language/model/model.h"
#include "meaning/cfg/cfg.h"

namespace feedhold {

class BlockWords {
public:
  BlockWords(const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect, BlockId block);

  /// A word of some ExecuteWords.  Not: N, O and `<NAME>`; calls with their arguments; M99 with its P and L; M02, M30.
  bool isExecuted(const Word &word) const;
  bool belongsTo(const Word &word, WordChoice which) const;

  std::span<const Call> calls() const { return calls_; }
  /// M99, M02 or M30; the first one of the block.
  const Word *ending() const { return ending_; }
  bool endingReturns() const { return returns_; }

private:
  bool isOwnTo(const Call &call, const Word &word) const;

  const SyntaxTree &tree_;
  const Dialect &dialect_;
  std::span<const Call> calls_;
  const Word *ending_ = nullptr;
  bool returns_ = false;
  bool data_;
};

/// Calls visit(word) for each word of a block that the instruction executes.
template <typename Visit>
void forEachExecutedWord(const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect, BlockId block,
                         const ExecuteWords &execute, Visit &&visit) {
  if (execute.isWholeBlock) { // nearly every block of a tool path
    for (const Word &word : tree.wordsOf(block))
      visit(word);
    return;
  }
  const BlockWords split(tree, model, dialect, block);
  for (const Word &word : tree.wordsOf(block))
    if (split.belongsTo(word, execute.which))
      visit(word);
}

/// G65, G66, G66.1, or a code that passes arguments: all words behind the code are the call's.
bool takesArguments(const Call &call, const SyntaxTree &tree, const Dialect &dialect);

} // namespace feedhold
