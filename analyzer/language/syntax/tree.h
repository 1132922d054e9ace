// SyntaxTree: the lossless tree of one file.  Every byte of the file belongs to one block or to one end-of-block.
#pragma once

#include "base/source/source_file.h"
#include "base/support/store.h"
#include "language/syntax/nodes.h"

#include <span>
#include <string>
#include <vector>

namespace feedhold {

enum class SyntaxIssueKind : std::uint8_t {
#define ISSUE(kind) kind,
#include "language/syntax/issues.def"
};

std::string_view nameOf(SyntaxIssueKind kind);

/// Something wrong in the text; issues.def says what the two spans are.
struct SyntaxIssue {
  SyntaxIssueKind kind;
  Span span;
  Span other = {};
};

class SyntaxTree {
public:
  Store<Block, BlockId> blocks; // the last one is an empty end mark, so that the next block always exists
  Store<Word, WordId> words;
  Store<Comment, CommentId> comments;
  Store<Statement, StatementId> statements;
  Store<Expression, ExpressionId> expressions;
  std::vector<ExpressionId> oWordArguments;
  std::vector<SyntaxIssue> issues; // in order of the text
  std::vector<Span> abbreviations; // control words, functions and operators in their short form
  std::vector<Span> skips;         // `/` and `/n`, at the head of a block or inside it
  std::vector<Span> lowerCase;     // runs of program text in lower case, at most one for each block

  /// Blocks without the end mark.
  std::size_t blockCount() const { return blocks.size() - 1; }
  std::span<const Word> wordsOf(BlockId block) const;
  std::span<const Comment> commentsOf(BlockId block) const;
  /// With those that are the action of an IF (`nested`); they stand before it, as children do.
  std::span<const Statement> statementsOf(BlockId block) const;
  std::span<const ExpressionId> argumentsOf(const OWord &oWord) const;
  WordId idOf(const Word &word) const;
  StatementId idOf(const Statement &statement) const;
  /// The block that holds a byte.
  BlockId blockAt(std::uint32_t offset) const;
  /// Memory of all stores, for the benchmark.
  std::size_t bytes() const;
};

/// The operands of an expression, left to right.
std::vector<ExpressionId> childrenOf(const SyntaxTree &tree, ExpressionId id);
/// Every expression below `root`, itself first, left to right.
std::vector<ExpressionId> subexpressions(const SyntaxTree &tree, ExpressionId root);
/// `root` without brackets and written `+` signs around it.
ExpressionId unwrapped(const SyntaxTree &tree, ExpressionId root);
/// The value of a literal, a signed literal or a bracketed literal.
std::optional<Decimal> literalValue(const SyntaxTree &tree, ExpressionId root);
/// The number of a `#101`; absent for computed and named ones.
std::optional<std::uint32_t> variableNumber(const SyntaxTree &tree, ExpressionId root);

/// A name as the control compares it: in small letters, without blanks.
std::string comparedName(std::string_view name);
/// The label of an o-word as the control compares it: a number without leading zeros, or a name without `<>`.  Empty
/// for a computed one.
std::string labelText(const OWord &oWord, const SourceFile &source);

/// The text of the file put together again from the nodes of the tree and the blanks between them.  A byte that is
/// neither in a node nor blank is left out, so that comparing with the source shows what the tree lost.
std::string print(const SyntaxTree &tree, const SourceFile &source);

/// The tree as indented text: what golden cases compare.
std::string dump(const SyntaxTree &tree, const SourceFile &source);

} // namespace feedhold
