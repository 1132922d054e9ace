#include "surface/lsp/formatter.h"

#include "base/diag/edits.h"
#include "base/support/match.h"
#include "base/support/text.h"
#include "language/lex/lexer.h"

#include <algorithm>

namespace feedhold::lsp {

namespace {

/// What a block does to the blocks around it.
struct Step {
  int before = 0; // to its own indent
  int behind = 0; // to that of the blocks that follow
};

/// `WHILE .. DO`, `END` and the like in one block add up.
class Nesting {
public:
  Nesting(const SourceFile &source, const SyntaxTree &tree) : source_(source), tree_(tree) {}

  Step of(BlockId block) {
    Step step;
    for (const Statement &statement : tree_.statementsOf(block)) {
      const Step own = of(statement);
      step.before += step.behind == 0 ? own.before : 0; // what the same block opened does not shift it
      step.behind += own.behind;
    }
    return step;
  }

private:
  static constexpr Step kOpens{.before = 0, .behind = 1};
  static constexpr Step kBetween{.before = -1, .behind = 0};
  static constexpr Step kCloses{.before = -1, .behind = -1};

  Step of(const Statement &statement) {
    return match(
        statement.node, [](const While &) { return kOpens; }, [](const Do &) { return kOpens; },
        [](const End &) { return kCloses; },
        [](const If &branch) { return branch.action == IfAction::Lines ? kOpens : Step{}; },
        [](const Else &) { return kBetween; }, [](const ElseIf &) { return kBetween; },
        [](const EndIf &) { return kCloses; }, [&](const OWord &word) { return of(word); },
        [](const auto &) { return Step{}; });
  }

  Step of(const OWord &word) {
    switch (word.kind) {
    case OWordKind::Sub:
    case OWordKind::If:
    case OWordKind::Repeat: return kOpens;
    case OWordKind::Do: loops_.push_back(labelText(word, source_)); return kOpens;
    case OWordKind::While: return whileOf(word);
    case OWordKind::Else:
    case OWordKind::ElseIf: return kBetween;
    case OWordKind::EndSub:
    case OWordKind::EndIf:
    case OWordKind::EndWhile:
    case OWordKind::EndRepeat: return kCloses;
    case OWordKind::Call:
    case OWordKind::Return:
    case OWordKind::Break:
    case OWordKind::Continue: return {};
    }
    FEEDHOLD_UNREACHABLE("a kind of o-word");
  }

  /// Of `o1 do` it is the end.
  Step whileOf(const OWord &word) {
    if (loops_.empty() || loops_.back() != labelText(word, source_))
      return kOpens;
    loops_.pop_back();
    return kCloses;
  }

  const SourceFile &source_;
  const SyntaxTree &tree_;
  std::vector<std::string> loops_; // labels of `do`
};

bool isBlanks(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\t'; });
}

class Formatter {
public:
  Formatter(const SourceFile &source, const SyntaxTree &tree, const Dialect &dialect, const FormatStyle &style)
      : source_(source), tree_(tree), tokens_(lex(source, dialect)), style_(style) {}

  std::vector<Edit> run() {
    Nesting nesting(source_, tree_);
    int depth = 0;
    for (BlockId block(0); block.index() < tree_.blockCount(); block = block.next()) {
      const Step step = nesting.of(block);
      if (isProgramHead(block))
        depth = 0;
      if (mayChange(block))
        formatBlock(block, std::max(0, depth + step.before));
      depth = std::max(0, depth + step.behind);
    }
    return std::move(edits_);
  }

private:
  bool isProgramHead(BlockId block) const {
    const auto words = tree_.wordsOf(block);
    return tree_.blocks[block].has(Block::kPercent) || (!words.empty() && words.front().address() == 'O');
  }

  bool mayChange(BlockId id) const {
    constexpr std::array kUntouched = {Block::kLeader, Block::kAfterEnd, Block::kBroken, Block::kCommentTail,
                                       Block::kData};
    const Block &block = tree_.blocks[id];
    const auto statements = tree_.statementsOf(id);
    return std::none_of(kUntouched.begin(), kUntouched.end(), [&](Block::Flag flag) { return block.has(flag); }) &&
           std::none_of(statements.begin(), statements.end(), [](const Statement &statement) {
             return std::holds_alternative<Print>(statement.node) ||
                    std::holds_alternative<NameVariables>(statement.node);
           });
  }

  void formatBlock(BlockId id, int depth) {
    const Block &block = tree_.blocks[id];
    const std::uint32_t line = source_.lineOf(block.begin);
    const Span whole = source_.lineSpan(line);
    std::uint32_t at = whole.begin; // where the blanks before the next token begin
    bool isFirst = true;
    while (next_ < tokens_.size() && tokens_[next_].begin < block.begin)
      at = std::max(at, tokens_[next_++].end);
    isFirst = at == whole.begin;
    for (; next_ < tokens_.size() && tokens_[next_].begin < block.end; ++next_) {
      const Token &token = tokens_[next_];
      if (isFirst)
        put({at, token.begin}, indentOf(id, depth));
      else if (token.kind != TokenKind::Comment && token.begin > at) // comments may stand in a column
        put({at, token.begin}, " ");
      isFirst = false;
      at = token.end;
    }
    if (at < whole.end && isBlanks(source_.text({at, whole.end})))
      put({at, whole.end}, "");
  }

  /// `%`, `O` and `/` stand at the head of the line.
  std::string indentOf(BlockId block, int depth) const {
    std::string indent;
    if (!isProgramHead(block) && !tree_.blocks[block].has(Block::kSkip))
      for (int i = 0; i < depth; ++i)
        indent += style_.indent;
    return indent;
  }

  void put(Span span, const std::string &blanks) {
    const std::string_view text = source_.text(span);
    if (text != blanks && isBlanks(text))
      edits_.push_back({span, blanks});
  }

  const SourceFile &source_;
  const SyntaxTree &tree_;
  const TokenBuffer tokens_;
  const FormatStyle &style_;
  std::size_t next_ = 0;
  std::vector<Edit> edits_;
};

bool sameTokens(const SourceFile &before, const SourceFile &after, const Dialect &dialect) {
  const TokenBuffer left = lex(before, dialect), right = lex(after, dialect);
  return std::equal(left.begin(), left.end(), right.begin(), right.end(), [&](const Token &a, const Token &b) {
    return a.kind == b.kind && before.text(a.span()) == after.text(b.span());
  });
}

} // namespace

std::vector<Edit> format(const SourceFile &source, const SyntaxTree &tree, const Dialect &dialect,
                         const FormatStyle &style) {
  std::vector<Edit> edits = Formatter(source, tree, dialect, style).run();
  const FixIt all{.safety = FixSafety::Safe, .title = {}, .edits = edits};
  const std::string text = applyFixes(source.text(), std::span(&all, 1)).text;
  if (!sameTokens(source, SourceFile::fromText(source.path(), text), dialect))
    return {};
  return edits;
}

} // namespace feedhold::lsp
