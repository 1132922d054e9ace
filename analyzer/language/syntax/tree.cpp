// Walking the tree.
#include "language/syntax/tree.h"

#include "base/support/check.h"
#include "base/support/match.h"
#include "base/support/text.h"

#include <algorithm>

namespace feedhold {

std::string_view nameOf(SyntaxIssueKind kind) {
  static constexpr std::string_view kNames[] = {
#define ISSUE(kind) #kind,
#include "language/syntax/issues.def"
  };
  return kNames[static_cast<std::size_t>(kind)];
}

std::optional<std::uint16_t> Word::tenths() const {
  if (form_ != WordForm::Number || payload_ < 0)
    return std::nullopt;
  std::int64_t mantissa = payload_;
  std::uint8_t scale = scale_;
  for (; scale > 1 && mantissa % 10 == 0; --scale)
    mantissa /= 10;
  if (scale > 1 || mantissa > 60000)
    return std::nullopt;
  const std::int64_t value = scale == 1 ? mantissa : mantissa * 10;
  return value > 60000 ? std::nullopt : std::optional(static_cast<std::uint16_t>(value));
}

std::optional<std::uint32_t> Word::integer() const {
  if (form_ != WordForm::Number)
    return std::nullopt;
  const std::optional<std::int64_t> value = scale_ == 0 ? std::optional(payload_) : number().asInteger();
  if (!value || *value < 0 || *value > 0xffffffffLL)
    return std::nullopt;
  return static_cast<std::uint32_t>(*value);
}

std::span<const Word> SyntaxTree::wordsOf(BlockId block) const {
  return words.slice(blocks[block].firstWord, blocks[block.next()].firstWord);
}

std::span<const Comment> SyntaxTree::commentsOf(BlockId block) const {
  return comments.slice(blocks[block].firstComment, blocks[block.next()].firstComment);
}

std::span<const Statement> SyntaxTree::statementsOf(BlockId block) const {
  return statements.slice(blocks[block].firstStatement, blocks[block.next()].firstStatement);
}

std::span<const ExpressionId> SyntaxTree::argumentsOf(const OWord &oWord) const {
  return std::span(oWordArguments).subspan(oWord.firstArgument, oWord.argumentCount);
}

WordId SyntaxTree::idOf(const Word &word) const { return WordId(static_cast<std::size_t>(&word - &*words.begin())); }

StatementId SyntaxTree::idOf(const Statement &statement) const {
  return StatementId(static_cast<std::size_t>(&statement - &*statements.begin()));
}

BlockId SyntaxTree::blockAt(std::uint32_t offset) const {
  const auto behind = std::upper_bound(blocks.begin(), blocks.end() - 1, offset,
                                       [](std::uint32_t at, const Block &block) { return at < block.begin; });
  const auto index = static_cast<std::size_t>(behind - blocks.begin());
  return BlockId(index == 0 ? 0 : index - 1);
}

std::size_t SyntaxTree::bytes() const {
  return blocks.size() * sizeof(Block) + words.size() * sizeof(Word) + comments.size() * sizeof(Comment) +
         statements.size() * sizeof(Statement) + expressions.size() * sizeof(Expression) +
         oWordArguments.size() * sizeof(ExpressionId) + issues.size() * sizeof(SyntaxIssue) +
         (skips.size() + lowerCase.size() + abbreviations.size()) * sizeof(Span);
}

namespace {

/// Behind what `to` has; no list of their own, as expressions are gone through in every pass over a program.
void appendChildren(const SyntaxTree &tree, ExpressionId id, std::vector<ExpressionId> &to) {
  match(
      tree.expressions[id].node, [](const NumberLiteral &) {}, [](const NumberedVariable &) {},
      [](const NamedVariable &) {}, [](const BrokenExpression &) {},
      [&](const IndirectVariable &node) { to.push_back(node.index); },
      [&](const Negation &node) { to.push_back(node.operand); },
      [&](const Identity &node) { to.push_back(node.operand); },
      [&](const Bracketed &node) { to.push_back(node.inner); },
      [&](const BinaryOperation &node) {
        to.push_back(node.left);
        to.push_back(node.right);
      },
      [&](const FunctionCall &node) { to.insert(to.end(), node.arguments().begin(), node.arguments().end()); });
}

} // namespace

std::vector<ExpressionId> childrenOf(const SyntaxTree &tree, ExpressionId id) {
  std::vector<ExpressionId> children;
  appendChildren(tree, id, children);
  return children;
}

std::vector<ExpressionId> subexpressions(const SyntaxTree &tree, ExpressionId root) {
  std::vector<ExpressionId> found;
  std::vector<ExpressionId> open = {root};
  while (!open.empty()) {
    const ExpressionId id = open.back();
    open.pop_back();
    found.push_back(id);
    const auto first = static_cast<std::ptrdiff_t>(open.size());
    appendChildren(tree, id, open);
    std::reverse(open.begin() + first, open.end()); // the leftmost is taken next
  }
  return found;
}

ExpressionId unwrapped(const SyntaxTree &tree, ExpressionId root) {
  while (true) {
    const auto &node = tree.expressions[root].node;
    if (const auto *bracket = std::get_if<Bracketed>(&node))
      root = bracket->inner;
    else if (const auto *plus = std::get_if<Identity>(&node))
      root = plus->operand;
    else
      return root;
  }
}

std::optional<Decimal> literalValue(const SyntaxTree &tree, ExpressionId root) {
  bool negative = false;
  root = unwrapped(tree, root);
  while (const auto *negation = std::get_if<Negation>(&tree.expressions[root].node)) {
    negative = !negative;
    root = unwrapped(tree, negation->operand);
  }
  const auto *literal = std::get_if<NumberLiteral>(&tree.expressions[root].node);
  if (!literal)
    return std::nullopt;
  return negative ? literal->value.negated() : literal->value;
}

std::optional<std::uint32_t> variableNumber(const SyntaxTree &tree, ExpressionId root) {
  const auto *variable = std::get_if<NumberedVariable>(&tree.expressions[root].node);
  if (!variable)
    return std::nullopt;
  const std::optional<std::int64_t> number = variable->number.asInteger();
  if (!number || *number < 0 || *number > 0xffffffffLL)
    return std::nullopt;
  return static_cast<std::uint32_t>(*number);
}

std::string comparedName(std::string_view name) {
  std::string compared;
  for (const char c : name)
    if (static_cast<unsigned char>(c) > ' ')
      compared += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return compared;
}

std::string labelText(const OWord &oWord, const SourceFile &source) {
  if (oWord.computed)
    return {};
  const std::string label = comparedName(source.text(oWord.label));
  if (label.starts_with('<'))
    return label.substr(1, label.size() - 2);
  const std::size_t first = label.find_first_not_of('0');
  return first == std::string::npos ? "0" : label.substr(first);
}

} // namespace feedhold
