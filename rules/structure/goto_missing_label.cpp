// goto-missing-label: `GOTO 10` in a program without `N10`.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::goto_missing_label {
namespace {

bool inRange(const FileContext &context, std::uint32_t number) {
  return (number > 0 || context.dialect.grammar.sequenceZero) && number <= context.dialect.limits.lastSequenceNumber;
}

/// "the nearest sequence numbers are `N5` and `N8`"
std::string neighbours(const ProgramModel &model, ProgramId program, std::uint32_t number) {
  const auto inProgram = [&](std::uint32_t index) {
    return model.programs[program].contains(model.sequenceNumbers[index].block);
  };
  const auto at = model.firstAtOrBehind(number, BlockId(0));
  const auto next = std::find_if(at, model.byNumber.end(), inProgram);
  const auto previous = std::find_if(std::make_reverse_iterator(at), model.byNumber.rend(), inProgram);
  const bool hasNext = next != model.byNumber.end();
  const bool hasPrevious = previous != model.byNumber.rend();
  if (!hasPrevious && !hasNext)
    return "the program has no sequence numbers";
  if (!hasPrevious)
    return fmt::format("the lowest sequence number there is `N{}`", model.sequenceNumbers[*next].number);
  if (!hasNext)
    return fmt::format("the highest sequence number there is `N{}`", model.sequenceNumbers[*previous].number);
  return fmt::format("the nearest sequence numbers there are `N{}` and `N{}`", model.sequenceNumbers[*previous].number,
                     model.sequenceNumbers[*next].number);
}

/// `L1002` on a line of its own, which was to be `N1002`.
const Word *labelMeant(ProgramId program, std::uint32_t number, const FileContext &context) {
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    const auto words = context.tree.wordsOf(block);
    if (words.size() == 1 && words.front().address() == 'L' && words.front().integer() == number &&
        context.tree.statementsOf(block).empty())
      return &words.front();
  }
  return nullptr;
}

Diagnostic missing(const Jump &jump, std::uint32_t number, const FileContext &context) {
  return {.message = fmt::format("{} has no target: this program has no `N{}`", context.quoted(jump.span), number),
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
  for (const Call &call : context.model.callsIn(jump.block, jump.block.next())) {
    if (call.kind != CallKind::Subprogram)
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

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  std::optional<DeadBlocks> dead; // only needed when a target is missing
  for (const Jump &jump : context.model.jumpsOf(program)) {
    const auto number = targetNumber(jump);
    if (!number || !inRange(context, *number))
      continue;
    if (jump.kind == JumpKind::ReturnTo && context.dialect.behaviour.returnTargetIsLocal) {
      if (context.model.find(jump.program, *number).empty())
        reporter.report(missing(jump, *number, context));
    } else if (jump.kind == JumpKind::ReturnTo) {
      checkReturn(jump, *number, context, reporter);
    } else if (jump.kind == JumpKind::CallAt) {
      checkStart(jump, *number, context, reporter);
    } else if (!jump.target && !isMotionCodeWithLetter(context, jump.block, jump.span)) {
      if (!dead)
        dead.emplace(context, program);
      if (const Word *label = labelMeant(program, *number, context)) {
        Diagnostic diagnostic = missing(jump, *number, context);
        diagnostic.labels = {{label->span(), "was this to be the label?"}};
        diagnostic.notes.back() = fmt::format("jumps look for N: write `N{}`", *number);
        reporter.report(std::move(diagnostic));
        continue; // what is not reached is so for want of these labels
      }
      // code-after-end-of-tape speaks of jumps to blocks behind the closing `%`.
      if (!context.model.isBehindEnd(*number) && !dead->contains(jump.block))
        reporter.report(missing(jump, *number, context));
    }
  }
}

} // namespace

extern const Rule gotoMissingLabel;
const Rule gotoMissingLabel{.info = {"goto-missing-label", Category::Structure, Severity::Error,
                                     "Reports a jump to a sequence number that does not exist."},
                            .hooks = {.program = check}};

} // namespace feedhold::rules::goto_missing_label
