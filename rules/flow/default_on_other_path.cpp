// default-on-other-path: `IF[#9EQ#0]THEN#9=90.` in one part of a macro, and `F#9` in another without it.
#include "rules/comments/remarks_of_block.h"
#include "rules/flow/definitions.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace feedhold::rules::default_on_other_path {
namespace {

struct Default {
  NodeId test;
  Span span;
};
using Defaults = std::map<std::uint32_t, std::vector<Default>>; // by argument, in order of the text

/// `IF[#9EQ#0]THEN#9=90.`
Defaults defaultsOf(const FlowFacts &facts, const FileContext &context) {
  Defaults found;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    const Statement *statement = firstStatement(context.tree, facts.node(node).block);
    const auto *branch = statement ? std::get_if<If>(&statement->node) : nullptr;
    if (!test || !test->condition || !facts.isReached(node) || !branch || branch->action != IfAction::Statement ||
        branch->condition != test->condition)
      continue;
    const auto *relation = asInside<BinaryOperation>(context.tree, *test->condition);
    const auto *assignment = std::get_if<Assignment>(&context.tree.statements[*branch->statement].node);
    if (!relation || relation->op != OperatorKind::Equal || !isVacant(context, relation->right) || !assignment)
      continue;
    const auto argument = variableOf(facts, unwrapped(context.tree, relation->left));
    if (argument && isParameter(facts, *argument) && variableOf(facts, assignment->target) == argument &&
        !isVacant(context, assignment->value))
      found[*argument].push_back({node, statement->span});
  }
  return found;
}

bool isAskedBefore(const FlowFacts &facts, NodeId use, std::uint32_t argument) {
  return std::ranges::any_of(testsBefore(facts, use), [&](const PassedTest &passed) {
    const auto *test = std::get_if<Test>(&facts.node(passed.node).instruction);
    const auto reads = test && test->condition ? readsIn(facts.file, *test->condition, facts.node(passed.node).block)
                                               : std::vector<Read>{};
    return std::ranges::any_of(reads, [&](const Read &read) { return read.number == argument; });
  });
}

/// The argument is as it was passed there, and no condition before has asked for it.  A default that only comes behind
/// is another rule's.
bool isUnasked(const FlowFacts &facts, NodeId node, std::uint32_t argument, const std::vector<Default> &defaults) {
  const auto known = definitionsOf(facts, argument, node);
  return known && known->fromEntry && known->nodes.empty() && !isAskedBefore(facts, node, argument) &&
         std::ranges::none_of(defaults, [&](const Default &its) { return isPassedAlways(facts, node, its.test); });
}

/// `(IF[#9EQ#0]THEN#9=.1)` in this part of the program: the default was taken out on purpose.
bool isCommentedOut(const FlowFacts &facts, const FileContext &context, NodeId node, std::uint32_t argument) {
  const std::string test = fmt::format("#{}EQ#0", argument);
  for (BlockId block = facts.node(node).block; block > context.model.programs[facts.program].first;) {
    block = BlockId(static_cast<std::uint32_t>(block.index() - 1));
    if (findCode(context.tree, block, context.dialect, CodeRole::Return))
      return false;
    std::string remarks = remarksOf(context, block);
    std::erase_if(remarks, isBlank);
    if (remarks.find(test) != std::string::npos)
      return true;
  }
  return false;
}

void tell(std::uint32_t argument, Span span, Span other, std::string consequence, const FileContext &context,
          const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("{} has no default on this path", describeVariable(context.dialect, argument)),
       .span = span,
       .labels = {{other, "another path gives it one"}},
       .notes = {fmt::format("when it is not passed, {}", consequence),
                 "move the default to the head of the program"}});
}

/// `F#9`: with a vacant variable the word is left out, and the feed of before stays.
void checkWord(const Word &word, BlockId block, const Defaults &defaults, const FlowFacts &facts,
               const FileContext &context, const Reporter &reporter) {
  const auto argument = word.address() == 'F' && word.form() == WordForm::Expression && !word.has(Word::kArgument)
                            ? variableOf(facts, word.expression())
                            : std::nullopt;
  const auto its = argument ? defaults.find(*argument) : defaults.end();
  const auto node = its != defaults.end() ? nodeOf(facts, block, word.expression()) : std::nullopt;
  if (node && isUnasked(facts, *node, *argument, its->second) && !isCommentedOut(facts, context, *node, *argument))
    tell(*argument, word.span(), its->second.front().span,
         "the control ignores the word, and the feed of the program before stays in force", context, reporter);
}

/// `#3/#17`, `#3/ABS[#103]` behind `#103=#17`.
void checkDivision(const AlarmFact &alarm, const Defaults &defaults, const FlowFacts &facts, const FileContext &context,
                   const Reporter &reporter) {
  auto divisor = expressionAt(facts, facts.node(alarm.node).block, alarm.place);
  if (const auto *call = divisor ? asInside<FunctionCall>(context.tree, *divisor) : nullptr;
      call && call->function == FunctionKind::Abs && call->arguments().size() == 1)
    divisor = call->arguments().front();
  auto variable = divisor ? variableOf(facts, unwrapped(context.tree, *divisor)) : std::nullopt;
  NodeId node = alarm.node;
  const auto copied = variable && !defaults.contains(*variable) ? definitionsOf(facts, *variable, node) : std::nullopt;
  if (copied && !copied->fromEntry && copied->nodes.size() == 1) {
    node = copied->nodes.front();
    const auto assignment = assignmentTo(facts, node, *variable);
    variable = assignment ? variableOf(facts, unwrapped(context.tree, assignment->value)) : std::nullopt;
  }
  const auto its = variable ? defaults.find(*variable) : defaults.end();
  if (its != defaults.end() && isUnasked(facts, node, *variable, its->second))
    tell(*variable, alarm.place, its->second.front().span,
         fmt::format("the control {} here", stopsWith(context.dialect, AlarmKind::DivideByZero)), context, reporter);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || isMainProgram(facts))
    return;
  const auto defaults = defaultsOf(facts, context);
  if (defaults.empty())
    return;
  for (const BlockId block : blocksOf(facts.file, facts.program))
    for (const Word &word : context.tree.wordsOf(block))
      checkWord(word, block, defaults, facts, context, reporter);
  for (const AlarmFact &alarm : facts.alarms())
    if (alarm.kind == AlarmKind::DivideByZero && !alarm.always)
      checkDivision(alarm, defaults, facts, context, reporter);
}

} // namespace

extern const Rule defaultOnOtherPath;
const Rule defaultOnOtherPath{
    .info = {"default-on-other-path", Category::Flow, Severity::Warning,
             "Reports a feed from, or a division by, an argument without a default, when another "
             "part of the program has one for it."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::default_on_other_path
