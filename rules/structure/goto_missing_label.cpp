// goto-missing-label: `GOTO 10` in a program without `N10`.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules {
namespace {

bool inRange(const FileContext &context, std::uint32_t number) {
  return (number > 0 || context.dialect.grammar.sequenceZero) && number <= context.dialect.limits.lastSequenceNumber;
}

/// Behind the closing `%`: code-after-end-of-tape speaks of it.
bool standsBehindTape(const FileContext &context, std::uint32_t number) {
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i) {
    if (!context.tree.blocks[BlockId(i)].has(Block::kAfterEnd))
      continue;
    const Word *label = findWord(context.tree, BlockId(i), 'N');
    if (label && label->integer() == number)
      return true;
  }
  return false;
}

/// "the nearest sequence numbers are `N5` and `N8`"
std::string neighbours(const ProgramModel &model, ProgramId program, std::uint32_t number) {
  const auto labels = sortedSequenceNumbers(model, program);
  if (labels.empty())
    return "the program has no sequence numbers";
  const auto above = std::ranges::lower_bound(labels, number, {}, &SequenceNumber::number);
  if (above == labels.begin())
    return fmt::format("the lowest sequence number of the program is `N{}`", labels.front().number);
  const auto below = std::prev(above);
  if (above == labels.end())
    return fmt::format("the highest sequence number of the program is `N{}`", below->number);
  return fmt::format("the nearest sequence numbers are `N{}` and `N{}`", below->number, above->number);
}

Diagnostic missing(const Jump &jump, std::uint32_t number, const FileContext &context) {
  return {.message =
              fmt::format("{} has no target: there is no `N{}` in this program", context.quoted(jump.span), number),
          .span = jump.targetSpan,
          .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::SequenceNotFound)),
                    neighbours(context.model, jump.program, number)}};
}

/// `M99 P n` goes to the block N n of the program that called this one.
void checkReturn(const Jump &jump, std::uint32_t number, const FileContext &context, const Reporter &reporter) {
  for (const auto &[file, callId] : context.callGraph.callers({context.file, jump.program})) {
    const ProgramModel &model = context.callGraph.model(file);
    const Call &call = model.calls[callId];
    if (!model.find(call.caller, number).empty())
      continue;
    const Program &caller = model.programs[call.caller];
    const std::string name = isNamed(caller) ? fmt::format("`{}`", toString(caller.name)) : "the calling program";
    reporter.report(
        {.message = fmt::format("{} has no target: {} has no `N{}`", context.quoted(jump.span), name, number),
         .span = jump.targetSpan,
         .labels = {{call.span, "called here", file}},
         .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::SequenceNotFound)),
                   neighbours(model, call.caller, number)}});
    return;
  }
}

/// `M98 P.. Q n` starts the called program at its block N n.
void checkStart(const Jump &jump, std::uint32_t number, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.switches.sqc == Switch::Off)
    return;
  for (const Call &call : context.model.calls) {
    if (call.block != jump.block || call.kind != CallKind::Subprogram)
      continue;
    const auto callee = context.callGraph.callee(context.file, call);
    if (!callee)
      return;
    const ProgramModel &model = context.callGraph.model(callee->file);
    if (model.find(callee->program, number).empty())
      reporter.report({.message = fmt::format("{} has no target: `{}` has no `N{}`", context.quoted(jump.span),
                                              toString(call.callee), number),
                       .span = jump.targetSpan,
                       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::SequenceNotFound)),
                                 neighbours(model, callee->program, number)}});
    return;
  }
}

void check(const Jump &jump, const FileContext &context, const Reporter &reporter) {
  const auto number = labelNumber(jump);
  if (!number || !inRange(context, *number) || jump.target)
    return;
  switch (jump.kind) {
  case JumpKind::ReturnTo: checkReturn(jump, *number, context, reporter); return;
  case JumpKind::CallAt: checkStart(jump, *number, context, reporter); return;
  case JumpKind::Goto:
  case JumpKind::LocalCall:
  case JumpKind::ContourFrom:
  case JumpKind::ContourTo: break;
  }
  if (standsBehindTape(context, *number) || DeadBlocks(context, jump.program).contains(jump.block))
    return;
  reporter.report(missing(jump, *number, context));
}

} // namespace

extern const Rule gotoMissingLabel;
const Rule gotoMissingLabel{.info = {"goto-missing-label", Category::Structure, Severity::Error,
                                     "Reports a jump to a sequence number that does not exist."},
                            .hooks = {.jump = check}};

} // namespace feedhold::rules
