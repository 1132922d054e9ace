// dump: the tree as indented text, one node a line, for golden cases and for people who wonder what was read.
#include "base/support/match.h"
#include "base/support/text.h"
#include "language/syntax/tree.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

class Dumper {
public:
  Dumper(const SyntaxTree &tree, const SourceFile &source) : tree_(tree), source_(source) {}

  std::string run() {
    for (std::size_t i = 0; i < tree_.blockCount(); ++i)
      block(BlockId(i));
    for (const SyntaxIssue &issue : tree_.issues)
      line(0, fmt::format("issue {} {}", nameOf(issue.kind), place(issue.span)));
    return std::move(out_);
  }

private:
  void line(int depth, std::string_view text) {
    out_.append(static_cast<std::size_t>(depth) * 2, ' ').append(text).append("\n");
  }
  std::string text(Span span) const { return source_.utf8(span); }
  std::string place(Span span) const {
    const Position at = source_.position(span.begin);
    return fmt::format("{}:{} `{}`", at.line, at.column, text(span));
  }

  void block(BlockId id) {
    const Block &block = tree_.blocks[id];
    const std::pair<Block::Flag, std::string_view> flags[] = {
        {Block::kPercent, "percent"}, {Block::kLeader, "leader"},       {Block::kAfterEnd, "after-end"},
        {Block::kBroken, "broken"},   {Block::kData, "data"},           {Block::kSkipInside, "skip-inside"},
        {Block::kFolder, "folder"},   {Block::kEncrypted, "encrypted"}, {Block::kCommentTail, "comment-tail"},
    };
    std::string head = fmt::format("block {}", source_.lineOf(block.begin));
    if (block.has(Block::kSkip))
      head += fmt::format(" skip {}", block.skipLevel);
    for (const auto &[flag, name] : flags)
      if (block.has(flag))
        head += fmt::format(" {}", name);
    line(0, head);
    for (const Word &each : tree_.wordsOf(id))
      word(each);
    for (const Statement &each : tree_.statementsOf(id))
      if (!each.nested)
        statement(each, 1);
    for (const Comment &each : tree_.commentsOf(id))
      line(1, fmt::format("{} `{}`", each.closed ? "comment" : "unclosed-comment", text(each.span)));
  }

  void word(const Word &word) {
    const std::string flags =
        fmt::format("{}{}{}", word.has(Word::kComma) ? " comma" : "", word.has(Word::kAfterThen) ? " conditional" : "",
                    word.has(Word::kAfterSkip) ? " after-skip" : "");
    switch (word.form()) {
    case WordForm::Number:
      line(1, fmt::format("word {} {}{}{}", word.address(), word.number().toString(),
                          word.has(Word::kPoint) ? " point" : "", flags));
      return;
    case WordForm::Expression:
      line(1, fmt::format("word {}{}", word.address(), flags));
      expression(word.expression(), 2);
      return;
    case WordForm::Name: line(1, fmt::format("name `{}`", text(word.span()))); return;
    case WordForm::Missing: line(1, fmt::format("word {} missing{}", word.address(), flags)); return;
    case WordForm::Broken: line(1, fmt::format("word {} broken `{}`", word.address(), text(word.span()))); return;
    }
  }

  void optional(const std::optional<ExpressionId> &id, int depth) {
    if (id)
      expression(*id, depth);
    else
      line(depth, "missing");
  }

  void statement(const Statement &statement, int depth) {
    match(
        statement.node,
        [&](const Assignment &node) {
          line(depth, "assignment");
          expression(node.target, depth + 1);
          expression(node.value, depth + 1);
        },
        [&](const LoneExpression &node) {
          line(depth, "lone-expression");
          expression(node.expression, depth + 1);
        },
        [&](const Goto &node) {
          line(depth, "goto");
          optional(node.target, depth + 1);
        },
        [&](const If &node) { ifStatement(node, depth); }, [&](const Else &) { line(depth, "else"); },
        [&](const ElseIf &node) {
          line(depth, "elseif");
          optional(node.condition, depth + 1);
        },
        [&](const EndIf &) { line(depth, "endif"); },
        [&](const While &node) {
          line(depth, "while");
          optional(node.condition, depth + 1);
          optional(node.number, depth + 1);
        },
        [&](const Do &node) {
          line(depth, "do");
          optional(node.number, depth + 1);
        },
        [&](const End &node) {
          line(depth, "end");
          optional(node.number, depth + 1);
        },
        [&](const NameVariables &node) {
          line(depth, fmt::format("setvn `{}`", text(node.names)));
          optional(node.first, depth + 1);
        },
        [&](const ConditionalWords &node) {
          line(depth, "conditional-words");
          expression(node.condition, depth + 1);
        },
        [&](const Print &node) {
          line(depth, fmt::format("{} `{}`", spellingOf(node.keyword), text(node.format)));
          for (std::size_t i = node.firstVariable.index(); i < node.lastVariable.index(); ++i)
            if (std::holds_alternative<NumberedVariable>(tree_.expressions[ExpressionId(i)].node))
              expression(ExpressionId(i), depth + 1);
        },
        [&](const OWord &node) {
          line(depth, fmt::format("o-word {} {}", text(node.label), toLower(spellingOf(node.kind))));
          if (node.computed)
            expression(*node.computed, depth + 1);
          for (const ExpressionId argument : tree_.argumentsOf(node))
            expression(argument, depth + 1);
        },
        [&](const BrokenStatement &) { line(depth, fmt::format("broken `{}`", text(statement.span))); });
  }

  void ifStatement(const If &node, int depth) {
    constexpr std::string_view kActions[] = {"jump", "statement", "words", "lines", "nothing"};
    line(depth, fmt::format("if {}{}", kActions[static_cast<std::size_t>(node.action)], node.hasThen ? " then" : ""));
    optional(node.condition, depth + 1);
    if (node.statement)
      statement(tree_.statements[*node.statement], depth + 1);
  }

  void expression(ExpressionId id, int depth) {
    const Expression &shown = tree_.expressions[id];
    match(
        shown.node, [&](const NumberLiteral &node) { line(depth, fmt::format("number {}", node.value.toString())); },
        [&](const NumberedVariable &node) { line(depth, fmt::format("variable #{}", node.number.toString())); },
        [&](const IndirectVariable &node) {
          line(depth, "indirect-variable");
          expression(node.index, depth + 1);
        },
        [&](const NamedVariable &node) { line(depth, fmt::format("named-variable {}", text(node.name))); },
        [&](const Negation &node) {
          line(depth, "negation");
          expression(node.operand, depth + 1);
        },
        [&](const Identity &node) {
          line(depth, "plus-sign");
          expression(node.operand, depth + 1);
        },
        [&](const Bracketed &node) {
          line(depth, "bracketed");
          expression(node.inner, depth + 1);
        },
        [&](const BinaryOperation &node) {
          line(depth, fmt::format("operation {}", spellingOf(node.op)));
          expression(node.left, depth + 1);
          expression(node.right, depth + 1);
        },
        [&](const FunctionCall &node) {
          line(depth, fmt::format("function {}{}", spellingOf(node.function), node.slash ? " slash" : ""));
          for (const ExpressionId argument : node.arguments())
            expression(argument, depth + 1);
        },
        [&](const BrokenExpression &) { line(depth, fmt::format("broken `{}`", text(shown.span))); });
  }

  const SyntaxTree &tree_;
  const SourceFile &source_;
  std::string out_;
};

} // namespace

std::string dump(const SyntaxTree &tree, const SourceFile &source) { return Dumper(tree, source).run(); }

} // namespace feedhold
