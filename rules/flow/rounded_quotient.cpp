// rounded-quotient: `FUP[#21/#22]`, where 0.6/0.2 is 2.9999999.
#include "rules/flow/formula.h"

#include <fmt/format.h>
#include <set>
#include <unordered_set>

namespace feedhold::rules::rounded_quotient {
namespace {

/// The division or product whose result is cut to a whole number: as it is, as a size, or with a whole number added.
const BinaryOperation *cutIn(const SyntaxTree &tree, ExpressionId argument) {
  if (const auto *call = asInside<FunctionCall>(tree, argument); call && call->function == FunctionKind::Abs)
    return call->arguments().empty() ? nullptr : cutIn(tree, call->arguments().front());
  const auto *operation = asInside<BinaryOperation>(tree, argument);
  if (!operation)
    return nullptr;
  if (operation->op == OperatorKind::Divide || operation->op == OperatorKind::Multiply)
    return operation;
  const auto added = literalValue(tree, operation->right);
  const bool isSum = operation->op == OperatorKind::Add || operation->op == OperatorKind::Subtract;
  return isSum && added && added->isInteger() ? cutIn(tree, operation->left) : nullptr;
}

bool isWhole(const FlowFacts &facts, ExpressionId id) {
  const AbstractValue *value = facts.valueOf(id);
  return value && value->isNumber() && value->number().isWhole();
}

struct Cut {
  ExpressionId id;
  FunctionKind function;
  ExpressionId argument;
  NodeId node;
};

struct Shown {
  RoundedNumber argument;
  RoundedNumber whole;
  std::string given;
};

/// Values with which the result differs from the one on paper.
std::optional<Shown> findShown(Formulas &formulas, const Cut &cut, FormulaId argument) {
  const Dialect &dialect = *formulas.facts().file.dialect;
  const auto inputs = formulas.inputsOf(argument);
  const auto guards = formulas.guardsOf(cut.node);
  std::optional<Shown> shown;
  const auto setting = findSetting(formulas, inputs, [&](FormulaSetting &tried) {
    const auto value = formulas.value(argument, tried);
    const auto whole = value ? wholePart(*value, cut.function, dialect) : std::nullopt;
    if (!whole || whole->exact.toDouble() == whole->computed || !formulas.pass(guards, tried))
      return false;
    shown = Shown{*value, *whole, {}};
    return true;
  });
  if (setting)
    shown->given = describeSetting(formulas, inputs, *setting);
  return setting ? shown : std::nullopt;
}

std::string messageFor(const Shown &shown, const std::string &cut, const std::string &argument) {
  return fmt::format("{}{}rounding makes {} {}, not {}: {}", shown.given, shown.given.empty() ? "" : ", ", cut,
                     shown.whole.computed, exactText(shown.whole.exact), describeRounding(argument, shown.argument));
}

FixIt allowance(const Cut &cut, const FileContext &context) {
  const std::string_view text = cut.function == FunctionKind::Fix ? "+.0005" : "-.0005";
  const std::uint32_t end = context.tree.expressions[cut.argument].span.end;
  return {.title = fmt::format("insert `{}`", text), .edits = {{{end, end}, std::string(text)}}};
}

/// Where a whole number that is off by one selects something else, and is not one pass more or less: an operand of EQ
/// or NE, or the index of a variable or a part of it.
struct Selectors {
  std::unordered_set<std::size_t> expressions; // by index
  std::set<Decimal> variables;                 // by number
};

void addSelector(const SyntaxTree &tree, ExpressionId id, Selectors &selectors) {
  const ExpressionId inner = unwrapped(tree, id);
  selectors.expressions.insert(inner.index());
  if (const auto *variable = as<NumberedVariable>(tree, inner))
    selectors.variables.insert(variable->number);
}

void addSelectorsOf(const SyntaxTree &tree, ExpressionId user, Selectors &selectors) {
  const auto addOperands = [&](const BinaryOperation &operation) {
    addSelector(tree, operation.left, selectors);
    addSelector(tree, operation.right, selectors);
  };
  if (const auto *operation = as<BinaryOperation>(tree, user);
      operation && (operation->op == OperatorKind::Equal || operation->op == OperatorKind::NotEqual))
    addOperands(*operation);
  if (const auto *variable = as<IndirectVariable>(tree, user)) {
    addSelector(tree, variable->index, selectors);
    if (const auto *offset = asInside<BinaryOperation>(tree, variable->index))
      addOperands(*offset);
  }
}

Selectors selectorsIn(const FlowFacts &facts) {
  Selectors selectors;
  std::optional<BlockId> last;
  for (const VariableUse &use : facts.file.model->variablesOf(facts.program)) {
    if (last == use.block)
      continue;
    last = use.block;
    for (const ExpressionId id : expressionsOf(facts.file, use.block))
      addSelectorsOf(*facts.file.tree, id, selectors);
  }
  return selectors;
}

/// The variable to which the block assigns the whole number.
std::optional<Decimal> variableOf(const SyntaxTree &tree, BlockId block, ExpressionId cut) {
  for (const Statement &statement : tree.statementsOf(block)) {
    const auto *assignment = std::get_if<Assignment>(&statement.node);
    const auto *target = assignment && unwrapped(tree, assignment->value) == cut
                             ? as<NumberedVariable>(tree, assignment->target)
                             : nullptr;
    if (target)
      return target->number;
  }
  return std::nullopt;
}

/// The whole number, or the variable that it is assigned to, selects something.
bool selects(const Cut &cut, const FlowFacts &facts, const FileContext &context) {
  const Selectors &selectors = facts.derived<Selectors>([&] { return selectorsIn(facts); });
  const auto variable = variableOf(context.tree, facts.file.cfg.nodes[cut.node].block, cut.id);
  return selectors.expressions.contains(cut.id.index()) || (variable && selectors.variables.contains(*variable));
}

void checkCut(const Cut &cut, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const BinaryOperation &operation = *cutIn(context.tree, cut.argument);
  Formulas formulas(facts);
  const auto argument = formulas.of(cut.argument, cut.node);
  const auto shown = argument ? findShown(formulas, cut, *argument) : std::nullopt;
  const bool isUnknown =
      !argument && operation.op == OperatorKind::Divide && !isWhole(facts, operation.right) && facts.valueOf(cut.id);
  if (!shown && !(isUnknown && selects(cut, facts, context)))
    return;
  const Span span = context.tree.expressions[cut.id].span;
  const std::string text = context.quoted(span);
  const Span inner = context.tree.expressions[cut.argument].span;
  reporter.report(
      {.message = shown ? messageFor(*shown, text, context.quoted(inner))
                        : fmt::format("{} may be off by one when the quotient should be a whole number", text),
       .span = span,
       .notes =
           {"the control computes in binary: 0.6/0.2 may come out just above or below 3, and FIX or FUP is then off "
            "by one",
            "add or subtract a small amount inside the brackets, or use ROUND"},
       .fixes = {allowance(cut, context)}},
      shown && shown->given.empty() ? Severity::Warning : Severity::Info);
}

void checkBlock(BlockId block, const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const ExpressionId id : expressionsOf(facts.file, block)) {
    const auto *call = as<FunctionCall>(context.tree, id);
    if (!call || (call->function != FunctionKind::Fix && call->function != FunctionKind::Fup) ||
        call->arguments().empty() || !cutIn(context.tree, call->arguments().front()))
      continue;
    if (const auto node = nodeOf(facts, block, id))
      checkCut({id, call->function, call->arguments().front(), *node}, facts, context, reporter);
  }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::optional<BlockId> last;
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    if (last == use.block)
      continue;
    last = use.block;
    checkBlock(use.block, facts, context, reporter);
  }
}

} // namespace

extern const Rule roundedQuotient;
const Rule roundedQuotient{.info = {"rounded-quotient", Category::Flow, Severity::Info,
                                    "Reports `FIX` or `FUP` of a quotient or product that may not be exact."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules::rounded_quotient
