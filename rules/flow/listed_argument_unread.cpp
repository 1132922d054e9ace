// listed-argument-unread: `(A=LENGTH, B=WIDTH, C=FEED)` at the head of a macro in which #2 does not occur.
#include "rules/comments/argument_list.h"
#include "rules/flow/definitions.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace feedhold::rules::listed_argument_unread {
namespace {

constexpr std::size_t kLeast = 3; // named arguments, to be a list of them

bool isNamed(const FlowFacts &facts, std::uint32_t variable) {
  return std::ranges::any_of(facts.file.model->variablesOf(facts.program),
                             [&](const VariableUse &use) { return use.number == variable; });
}

/// Something else than the text of the program may read its local variables, or its text is not all there.
bool isOpen(const FlowFacts &facts, const FileContext &context) {
  const auto shares = [](const Call &call) { return call.kind != CallKind::Macro && call.kind != CallKind::Local; };
  const bool isBroken = std::ranges::any_of(blocksOf(facts.file, facts.program), [&](BlockId block) {
    return context.tree.blocks[block].has(Block::kBroken);
  });
  return isTooLarge(facts) || isBroken || isCalledAsSubprogram(facts) ||
         std::ranges::any_of(facts.file.model->callsOf(facts.program), shares) ||
         std::ranges::any_of(facts.file.model->variablesOf(facts.program),
                             [&](const VariableUse &use) { return mayReadLocal(facts.file, use); });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!context.model.programs[facts.program].returns || isOpen(facts, context))
    return;
  const auto list = argumentListOf(context, facts.program);
  if (!list || list->variables.size() < kLeast)
    return;
  std::vector<std::uint32_t> unread;
  for (const std::uint32_t variable : list->variables)
    if (!isNamed(facts, variable))
      unread.push_back(variable);
  if (unread.size() != 1) // several: the remarks are of another macro, or of a plan
    return;
  reporter.report(
      {.message = fmt::format("no block reads {}, which the list of arguments names",
                              describeVariable(context.dialect, unread.front())),
       .span = list->comment,
       .notes = {"what a call passes for it has no effect", "read it where it was meant, or take it out of the list"}});
}

} // namespace

extern const Rule listedArgumentUnread;
const Rule listedArgumentUnread{
    .info = {"listed-argument-unread", Category::Flow, Severity::Warning,
             "Reports an argument that the list at the head of a macro names and none of its blocks reads."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::listed_argument_unread
