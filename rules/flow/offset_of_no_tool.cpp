// offset-of-no-tool: `#[2000+#4120]=#5063`, and nothing asks whether a tool is active.
#include "rules/flow/system_variables.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::offset_of_no_tool {
namespace {

constexpr std::uint32_t kModalTool = 4120;

bool isModalTool(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = findVariable(context.dialect, variable);
  return variable == kModalTool && range && range->role == VariableRole::ModalWord;
}

/// Nothing but `#100=#4120` sets the variable.
bool copiesTool(const FlowFacts &facts, const FileContext &context, std::uint32_t variable) {
  bool copies = false;
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    if (!use.write || use.number != variable)
      continue;
    const auto statements = context.tree.statementsOf(use.block);
    const auto *assignment = statements.size() == 1 ? std::get_if<Assignment>(&statements.front().node) : nullptr;
    const auto source =
        assignment ? variableNumber(context.tree, unwrapped(context.tree, assignment->value)) : std::nullopt;
    if (!source || !isModalTool(context, *source))
      return false;
    copies = true;
  }
  return copies;
}

/// `#[2000+#4120]`, `#[11000+#1]`: a term of the index that holds the number of the active tool.
std::optional<std::uint32_t> toolIn(const FlowFacts &facts, const FileContext &context, ExpressionId target) {
  const auto *indirect = asInside<IndirectVariable>(context.tree, target);
  const auto *sum = indirect ? asInside<BinaryOperation>(context.tree, indirect->index) : nullptr;
  if (!sum || sum->op != OperatorKind::Add)
    return std::nullopt;
  for (const auto &[base, term] : {std::pair{sum->left, sum->right}, {sum->right, sum->left}}) {
    const auto first = literalValue(context.tree, base);
    const auto variable = variableNumber(context.tree, unwrapped(context.tree, term));
    if (first && variable && first->asInteger().value_or(1) % 100 == 0 &&
        (isModalTool(context, *variable) || copiesTool(facts, context, *variable)))
      return variable;
  }
  return std::nullopt;
}

/// The program itself, or a program that it calls, may load a tool.
bool selectsTool(const FlowFacts &facts, const FileContext &context) {
  const auto blocks = blocksOf(facts.file, facts.program);
  return std::ranges::any_of(blocks, [&](BlockId block) {
    return std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) { return word.address() == 'T'; });
  });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    if (!use.write || use.number || !reachedNode(facts, use.block))
      continue;
    const auto tool = toolIn(facts, context, use.expression);
    const auto table = tool ? tableNumber(context, use.expression) : std::nullopt;
    if (!table || !isToolOffset(context, *table) || isTested(facts.file, facts.program, *tool) ||
        isTested(facts.file, facts.program, kModalTool) || selectsTool(facts, context))
      continue;
    const Span span = context.tree.expressions[use.expression].span;
    reporter.report({.message = fmt::format("{} is no tool offset while T0 is active: nothing checks `#{}`",
                                            context.quoted(span), *tool),
                     .span = span,
                     .flow = {},
                     .notes = {fmt::format("`#{}` is 0 with no tool in the spindle: the control stops, or writes to "
                                           "another variable",
                                           kModalTool),
                               fmt::format("check `IF[#{} LT 1]` before this block", *tool)}});
    return;
  }
}

} // namespace

extern const Rule offsetOfNoTool;
const Rule offsetOfNoTool{
    .info = {"offset-of-no-tool", Category::Flow, Severity::Warning,
             "Reports a write to the offset of the active tool without a check that a tool is active."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::offset_of_no_tool
