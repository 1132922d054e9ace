// See the header.
#include "findings/draft/conditions.h"

#include "base/support/text.h"
#include "meaning/semantics/variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace feedhold::draft {

namespace {

constexpr std::size_t kMostAlternatives = 12;
constexpr std::size_t kMostConditions = 8;

/// A relation, what holds where it does not, and the relation with its sides exchanged: `5 LT #1` is `#1 GT 5`.
struct RelationRow {
  OperatorKind relation;
  OperatorKind opposite;
  OperatorKind turned;
};
constexpr std::array<RelationRow, 6> kRelations = {
    {{OperatorKind::Equal, OperatorKind::NotEqual, OperatorKind::Equal},
     {OperatorKind::NotEqual, OperatorKind::Equal, OperatorKind::NotEqual},
     {OperatorKind::GreaterThan, OperatorKind::LessOrEqual, OperatorKind::LessThan},
     {OperatorKind::GreaterOrEqual, OperatorKind::LessThan, OperatorKind::LessOrEqual},
     {OperatorKind::LessThan, OperatorKind::GreaterOrEqual, OperatorKind::GreaterThan},
     {OperatorKind::LessOrEqual, OperatorKind::GreaterThan, OperatorKind::GreaterOrEqual}}};

/// Null: the operator compares nothing.
const RelationRow *rowOf(OperatorKind relation) {
  const auto found = std::ranges::find(kRelations, relation, &RelationRow::relation);
  return found == kRelations.end() ? nullptr : &*found;
}

bool isOperation(const Expression &expression) { return std::holds_alternative<BinaryOperation>(expression.node); }

/// What a clause can say of the moment of the call: no position, no input that changes by itself.
bool isSettled(const Dialect &dialect, std::uint32_t variable) {
  constexpr std::array kSettled = {VariableRole::Plain,      VariableRole::Stored,
                                   VariableRole::ModalCode,  VariableRole::ModalWord,
                                   VariableRole::WorkOffset, VariableRole::AdditionalWorkOffset};
  const VariableRange *row = findVariable(dialect, variable);
  return row && std::ranges::find(kSettled, row->role) != kSettled.end();
}

/// The variable that tells what the symbol stands for: `#4012` for the code of a modal group, `#4111` for a word.
std::optional<std::uint32_t> variableOfSymbol(const Dialect &dialect, std::uint32_t symbol) {
  if (symbol < kFirstNamedVariable)
    return symbol;
  for (const VariableRange &row : dialect.variables)
    for (std::uint32_t place = 1; place <= row.last - row.first + 1; ++place) {
      if (row.role != VariableRole::ModalCode && row.role != VariableRole::ModalWord)
        break;
      const auto letter = detail::letterOfModalWord(place);
      if ((row.role == VariableRole::ModalCode && symbol == kModalSymbols + place) ||
          (row.role == VariableRole::ModalWord && letter && symbol == kWordSymbols + indexOfModalWord(*letter)))
        return row.first + place - 1;
    }
  return std::nullopt;
}

} // namespace

std::string textOf(const Comparison &comparison) {
  return fmt::format("{} {} {}", comparison.left, spellingOf(comparison.relation), comparison.right);
}

Comparison opposite(Comparison comparison) {
  comparison.relation = rowOf(comparison.relation)->opposite;
  return comparison;
}

std::string textOf(const Alternatives &alternatives) {
  if (alternatives.size() == 1)
    return textOf(alternatives.front());
  std::string text;
  for (const Comparison &each : alternatives)
    text += fmt::format("{}[{}]", text.empty() ? "" : " OR ", textOf(each));
  return text;
}

namespace {

/// The first one, `#3 EQ 1`, holds only where the second one does, `#3 NE 6`.
bool isWithin(const Comparison &first, const Comparison &second) {
  if (first.relation != OperatorKind::Equal || !first.constant || first.left != second.left)
    return false;
  if (second.isVacancy)
    return second.relation == OperatorKind::NotEqual;
  if (!second.constant)
    return false;
  const auto order = *first.constant <=> *second.constant;
  return (second.relation == OperatorKind::NotEqual && order != 0) ||
         (second.relation == OperatorKind::GreaterThan && order > 0) ||
         (second.relation == OperatorKind::GreaterOrEqual && order >= 0) ||
         (second.relation == OperatorKind::LessThan && order < 0) ||
         (second.relation == OperatorKind::LessOrEqual && order <= 0);
}

} // namespace

std::optional<std::vector<Alternatives>> either(const std::vector<Alternatives> &a,
                                                const std::vector<Alternatives> &b) {
  std::vector<Alternatives> all;
  for (const Alternatives &left : a)
    for (const Alternatives &right : b) {
      Alternatives both = left;
      std::ranges::copy_if(right, std::back_inserter(both),
                           [&](const Comparison &each) { return std::ranges::find(left, each) == left.end(); });
      std::erase_if(both, [&, known = both](const Comparison &each) {
        return std::ranges::any_of(known, [&](const Comparison &other) { return isWithin(each, other); });
      });
      all.push_back(std::move(both));
    }
  const bool isShort = all.size() <= kMostConditions && std::ranges::all_of(all, [](const Alternatives &each) {
                         return each.size() <= kMostAlternatives;
                       });
  return isShort ? std::optional(all) : std::nullopt;
}

bool isInput(const Dialect &dialect, std::uint32_t variable) {
  const VariableRange *row = findVariable(dialect, variable);
  return row && (row->kind == VariableKind::Local || row->kind == VariableKind::Common ||
                 row->kind == VariableKind::Retentive);
}

bool comesBack(const FlowFacts &facts) {
  if (!facts.file.model->programs[facts.program].returns || !facts.isComplete())
    return facts.file.model->programs[facts.program].returns;
  std::set<NodeId> reached;
  std::vector<NodeId> open = {facts.entry()};
  while (!open.empty()) {
    const NodeId node = open.back();
    open.pop_back();
    if (reached.insert(node).second)
      forEachSuccessor(facts.file.cfg, *facts.file.model, node, ProgramUse::Called,
                       [&](NodeId next) { open.push_back(next); });
  }
  return std::ranges::any_of(
      facts.exits(), [&](const ExitFact &exit) { return exit.end == PathEnd::Returns && reached.contains(exit.node); });
}

const Assignment *onlyAssignment(const FlowFacts &facts, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  const Assignment *found = nullptr;
  for (const VariableUse &use : facts.file.model->variablesOf(facts.program)) {
    if (!use.write || use.number.value_or(variable) != variable)
      continue;
    if (found || !use.number)
      return nullptr;
    for (const Statement &statement : tree.statementsOf(use.block))
      if (const auto *assignment = std::get_if<Assignment>(&statement.node);
          assignment && variableNumber(tree, assignment->target) == variable)
        found = assignment;
    if (!found)
      return nullptr;
  }
  return found;
}

std::optional<std::vector<Alternatives>> EntryValues::conditionsOf(ExpressionId condition, bool holds) const {
  const SyntaxTree &tree = *facts_.file.tree;
  const auto *operation = std::get_if<BinaryOperation>(&tree.expressions[unwrapped(tree, condition)].node);
  if (!operation)
    return std::nullopt;
  if (operation->op == OperatorKind::And || operation->op == OperatorKind::Or)
    return joined(*operation, holds);
  auto comparison = comparisonOf(*operation);
  if (!comparison)
    return std::nullopt;
  return std::vector<Alternatives>{{holds ? *comparison : opposite(*comparison)}};
}

std::optional<std::vector<Alternatives>> EntryValues::joined(const BinaryOperation &operation, bool holds) const {
  const auto left = conditionsOf(operation.left, holds);
  const auto right = conditionsOf(operation.right, holds);
  if (!left || !right)
    return std::nullopt;
  if ((operation.op == OperatorKind::Or) == holds)
    return either(*left, *right);
  std::vector<Alternatives> all = *left;
  all.insert(all.end(), right->begin(), right->end());
  return all;
}

std::optional<Comparison> EntryValues::comparisonOf(const BinaryOperation &operation) const {
  const SyntaxTree &tree = *facts_.file.tree;
  const RelationRow *row = rowOf(operation.op);
  if (!row)
    return std::nullopt;
  ExpressionId left = unwrapped(tree, operation.left);
  ExpressionId right = unwrapped(tree, operation.right);
  const bool isTurned = !variableNumber(tree, left) && variableNumber(tree, right).value_or(kVacantVariable) != 0;
  if (isTurned)
    std::swap(left, right);
  const auto leftText = textOverEntry(left);
  const auto rightText = textOverEntry(right);
  if (!leftText || !rightText)
    return std::nullopt;
  Comparison comparison{*leftText, isTurned ? row->turned : operation.op, *rightText};
  comparison.constant = literalValue(tree, right);
  comparison.isVacancy = variableNumber(tree, right) == kVacantVariable;
  const bool tellsVacancy = row->relation == OperatorKind::Equal || row->relation == OperatorKind::NotEqual;
  if (comparison.isVacancy && !tellsVacancy) { // a vacant variable counts as 0
    comparison.isVacancy = false;
    comparison.constant = Decimal();
  }
  if (comparison.constant)
    comparison.right = comparison.constant->toString();
  if (variableNumber(tree, left))
    comparison.variable = onEntry(left);
  for (const ExpressionId side : {left, right})
    for (const ExpressionId each : subexpressions(tree, side))
      if (variableNumber(tree, each).value_or(kVacantVariable) != kVacantVariable)
        comparison.reads.push_back(*onEntry(each));
  std::ranges::sort(comparison.reads);
  return comparison.reads.empty() ? std::nullopt : std::optional(comparison);
}

bool EntryValues::isDefaulted(std::uint32_t variable) const {
  return std::ranges::find(defaults_, variable) != defaults_.end() && onlyAssignment(facts_, variable);
}

std::optional<std::uint32_t> EntryValues::onEntry(ExpressionId expression) const {
  const Dialect &dialect = *facts_.file.dialect;
  const auto variable = variableNumber(*facts_.file.tree, expression);
  const AbstractValue *value = facts_.valueOf(expression);
  if (!variable || *variable == kVacantVariable || !value)
    return std::nullopt;
  const auto &origin = value->origin();
  if (origin && origin->offset.isZero() && isEntrySymbol(origin->symbol)) {
    const auto source = variableOfSymbol(dialect, origin->symbol);
    return source && isSettled(dialect, *source) ? source : std::nullopt;
  }
  return isDefaulted(*variable) ? variable : std::nullopt;
}

std::optional<std::string> EntryValues::textOverEntry(ExpressionId expression) const {
  const SyntaxTree &tree = *facts_.file.tree;
  std::vector<std::pair<Span, std::string>> names;
  for (const ExpressionId each : subexpressions(tree, expression)) {
    const auto &node = tree.expressions[each].node;
    if (std::holds_alternative<IndirectVariable>(node) || std::holds_alternative<NamedVariable>(node) ||
        std::holds_alternative<BrokenExpression>(node))
      return std::nullopt;
    if (!std::holds_alternative<NumberedVariable>(node))
      continue;
    const auto number = variableNumber(tree, each);
    const auto entry = number == kVacantVariable ? number : onEntry(each);
    if (!entry)
      return std::nullopt;
    names.emplace_back(tree.expressions[each].span, fmt::format("#{}", *entry));
  }
  const Span span = tree.expressions[expression].span;
  std::string text;
  std::uint32_t at = span.begin;
  for (const auto &[place, name] : names) {
    text += toUpper(facts_.file.source->text({at, place.begin})) + name;
    at = place.end;
  }
  text += toUpper(facts_.file.source->text({at, span.end}));
  std::erase_if(text, isBlank);
  return isOperation(tree.expressions[expression]) ? "[" + text + "]" : text;
}

} // namespace feedhold::draft
