// default-behind-use: `#107=#110/#17`, then `IF[#17EQ#0]THEN#17=0.5`.
#include "rules/flow/definitions.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::default_behind_use {
namespace {

struct Default {
  NodeId test;
  Span span;
  std::uint32_t argument;
};

/// `IF[#17EQ#0]THEN#17=0.5` of an argument.
std::optional<Default> defaultAt(const FlowFacts &facts, const FileContext &context, NodeId node) {
  const auto *test = std::get_if<Test>(&facts.node(node).instruction);
  const Statement *statement = firstStatement(context.tree, facts.node(node).block);
  const auto *branch = statement ? std::get_if<If>(&statement->node) : nullptr;
  if (!test || !test->condition || !facts.isReached(node) || !branch || branch->condition != test->condition ||
      branch->action != IfAction::Statement)
    return std::nullopt;
  const auto *relation = asInside<BinaryOperation>(context.tree, *test->condition);
  const auto *assignment = std::get_if<Assignment>(&context.tree.statements[*branch->statement].node);
  if (!relation || relation->op != OperatorKind::Equal || !isVacant(context, relation->right) || !assignment)
    return std::nullopt;
  const auto argument = variableOf(facts, unwrapped(context.tree, relation->left));
  if (!argument || !isParameter(facts, *argument) || variableOf(facts, assignment->target) != argument ||
      isVacant(context, assignment->value))
    return std::nullopt;
  return Default{node, statement->span, *argument};
}

bool isDemanding(ReadUse use) { return use == ReadUse::Computed || use == ReadUse::Word; }

/// No condition that leads to the place, and none of its block, has asked for the argument.
bool isAsked(const FlowFacts &facts, NodeId use, std::uint32_t argument) {
  const auto asks = [&](NodeId node) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (!test || !test->condition)
      return false;
    const auto reads = readsIn(facts.file, *test->condition, facts.node(node).block);
    return std::ranges::any_of(reads, [&](const Read &read) { return read.number == argument; });
  };
  return asks(use) ||
         std::ranges::any_of(testsBefore(facts, use), [&](const PassedTest &passed) { return asks(passed.node); });
}

std::optional<Read> useBefore(const FlowFacts &facts, const Default &late) {
  for (const Read &read : readsOf(facts)) {
    if (read.number != late.argument || !isDemanding(read.use) || read.block >= facts.node(late.test).block)
      continue;
    const auto node = nodeOf(facts, read.block, read.expression);
    if (!node || !isPassedAlways(facts, *node, late.test) || isAsked(facts, *node, late.argument))
      continue;
    const auto known = definitionsOf(facts, late.argument, *node);
    const auto later = definitionsOf(facts, late.argument, late.test);
    if (known && known->fromEntry && known->nodes.empty() && later == known)
      return read;
  }
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || isMainProgram(facts))
    return;
  std::set<std::uint32_t> done;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto late = defaultAt(facts, context, node);
    const auto use = late && !done.contains(late->argument) ? useBefore(facts, *late) : std::nullopt;
    if (!use)
      continue;
    done.insert(late->argument);
    const Span span = context.tree.expressions[use->expression].span;
    reporter.report(
        {.message =
             fmt::format("{} is used before its default is set", describeVariable(context.dialect, late->argument)),
         .span = span,
         .labels = {{late->span, "the default comes here"}},
         .notes = {use->use == ReadUse::Word ? "when it is not passed, the control ignores this word"
                                             : "when it is not passed, the control computes with 0 here",
                   "move the default before this block"}},
        use->use == ReadUse::Word ? Severity::Info : Severity::Warning); // a word may be left out on purpose
  }
}

} // namespace

extern const Rule defaultBehindUse;
const Rule defaultBehindUse{.info = {"default-behind-use", Category::Flow, Severity::Warning,
                                     "Reports an argument that is used before the block that gives it a default."},
                            .hooks = {.flow = check}};

} // namespace feedhold::rules::default_behind_use
