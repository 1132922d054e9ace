// undocumented-argument: `(A=WIDTH, X=CENTER, Y=CENTER)` at the head of a macro that moves to X#4.
#include "base/support/text.h"
#include "rules/comments/argument_list.h"
#include "rules/flow/definitions.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace feedhold::rules::undocumented_argument {
namespace {

constexpr std::size_t kLeast = 3; // named arguments, to be a list of them

/// Some call of the run passes the argument.
bool isPassed(const FlowFacts &facts, std::uint32_t variable) {
  const auto callers = facts.programs.callGraph().callers({facts.file.file, facts.program});
  return std::ranges::any_of(callers, [&](const CallGraph::Caller &caller) {
    const Call &call = facts.programs.file(caller.file).model->calls[caller.call];
    return std::ranges::find(call.arguments, variable, &Argument::variable) != call.arguments.end();
  });
}

/// In a block that could not be read: it may have been meant to set the variable.
bool isInBrokenBlock(const FileContext &context, ProgramId program, std::uint32_t variable) {
  return std::ranges::any_of(context.model.variablesOf(program), [&](const VariableUse &use) {
    return use.number == variable && use.write && context.tree.blocks[use.block].has(Block::kBroken);
  });
}

/// Some condition asks for the argument itself: for vacant, or against a constant.  `[#[2000+#20] GT #1]` relies on it.
bool isAskedFor(const FlowFacts &facts, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto isIt = [&](ExpressionId side) { return variableNumber(tree, unwrapped(tree, side)) == variable; };
  const auto relies = [&](ExpressionId id) {
    const auto *relation = as<BinaryOperation>(tree, id);
    const bool isOrder = relation && isRelation(relation->op) && relation->op != OperatorKind::Equal &&
                         relation->op != OperatorKind::NotEqual;
    return isOrder && isIt(relation->right) && !isConstant(tree, relation->left) &&
           !variableNumber(tree, unwrapped(tree, relation->left));
  };
  std::size_t reliances = 0, tests = 0;
  for (const Read &read : readsOf(facts))
    tests += read.number == variable && (read.use == ReadUse::Equality || read.use == ReadUse::Ordering) ? 1 : 0;
  for (const BlockId block : blocksOf(facts.file, facts.program))
    reliances += static_cast<std::size_t>(std::ranges::count_if(expressionsOf(facts.file, block), relies));
  return tests > reliances || (tests == 0 && isTested(facts.file, facts.program, variable));
}

/// `(#1 BEGINNING Z <A>)`: a remark of its own, anywhere in the file.
bool hasRemark(const FileContext &context, std::uint32_t variable) {
  const std::string_view text = context.source.text();
  const std::string head = fmt::format("(#{}", variable);
  for (std::size_t at = text.find(head); at != std::string_view::npos; at = text.find(head, at + 1))
    if (const std::size_t end = at + head.size(); end < text.size() && !isDigit(text[end]))
      return true;
  return false;
}

/// Reads of arguments that the list does not name, as a call has passed them; the first of each variable.
std::vector<Read> otherReads(const FlowFacts &facts, const FileContext &context, const ArgumentList &list) {
  std::vector<Read> found;
  for (const Read &read : readsOf(facts)) {
    const bool isOther = read.number && read.use != ReadUse::Other && letterOfArgument(context.dialect, *read.number) &&
                         !list.variables.contains(*read.number) &&
                         std::ranges::find(found, read.number, &Read::number) == found.end();
    if (!isOther || isAskedFor(facts, *read.number) || isPassed(facts, *read.number) ||
        isInBrokenBlock(context, facts.program, *read.number) || hasRemark(context, *read.number))
      continue;
    const auto node = nodeOf(facts, read.block, read.expression);
    const auto known = node ? definitionsOf(facts, *read.number, *node) : std::nullopt;
    if (known && known->fromEntry && known->nodes.empty())
      found.push_back(read);
  }
  return found;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || !context.model.programs[facts.program].returns || isCalledAsSubprogram(facts) ||
      !context.dialect.behaviour.variablesMayBeVacant)
    return;
  const auto list = argumentListOf(context, facts.program);
  if (!list || list->variables.size() < kLeast)
    return;
  const std::vector<Read> others = otherReads(facts, context, *list);
  if (others.empty())
    return;
  const Read &read = others.front();
  Diagnostic diagnostic{.message = fmt::format("{} is read here, but the list of arguments does not name it",
                                               describeVariable(context.dialect, *read.number)),
                        .span = context.tree.expressions[read.expression].span,
                        .labels = {{list->comment, "the list"}},
                        .notes = {"who calls the macro by its remarks does not pass it: it is vacant here",
                                  "read the variable of an argument that is passed, or add this one to the list"}};
  for (std::size_t i = 1; i < others.size(); ++i)
    diagnostic.labels.push_back({context.tree.expressions[others[i].expression].span, "nor this one"});
  for (const Read &other : readsOf(facts))
    if (other.number == read.number && other.expression != read.expression)
      diagnostic.labels.push_back({context.tree.expressions[other.expression].span, "read here as well"});
  reporter.report(std::move(diagnostic));
}

} // namespace

extern const Rule undocumentedArgument;
const Rule undocumentedArgument{
    .info = {"undocumented-argument", Category::Flow, Severity::Warning,
             "Reports a macro that reads an argument which the list in its head does not name."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::undocumented_argument
