// unset-common-variable: `X#110`, and no program of the run sets `#110`.
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::unset_common_variable {
namespace {

// A T word that calls a program leaves its number in `#149`, other codes theirs in the three before it.
constexpr std::uint32_t kFirstOfCodeCalls = 146;
constexpr std::uint32_t kLastOfCodeCalls = 149;

std::optional<VariableKind> commonKind(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  const bool isCommon = range && (range->kind == VariableKind::Common || range->kind == VariableKind::Retentive);
  const bool byCodeCall = variable >= kFirstOfCodeCalls && variable <= kLastOfCodeCalls;
  return isCommon && !byCodeCall ? std::optional(range->kind) : std::nullopt;
}

/// Something that the program calls, or an assignment to a computed number, may set any common variable.
bool setsUnseen(const FlowFacts &facts, const FileContext &context) {
  const auto calls = context.model.callsOf(facts.program);
  return std::ranges::any_of(calls,
                             [&](const Call &call) {
                               return call.kind != CallKind::ModalCancel &&
                                      (!context.callGraph.callee(context.file, call) ||
                                       context.callGraph.reachesEncrypted(context.file, call));
                             }) ||
         std::ranges::any_of(context.model.variablesOf(facts.program),
                             [](const VariableUse &use) { return use.write && !use.number; });
}

/// The call comes before the block, or around to it in a loop.
bool isBefore(const Call &call, BlockId block, ProgramId program, const FileContext &context) {
  if (call.block <= block)
    return true;
  const auto loops = context.model.loopsOf(program);
  const auto jumps = context.model.jumpsOf(program);
  return std::ranges::any_of(loops,
                             [&](const Loop &loop) {
                               return loop.doBlock <= block && (!loop.endBlock || call.block < *loop.endBlock);
                             }) ||
         std::ranges::any_of(jumps, [&](const Jump &jump) {
           return !jump.target || (*jump.target <= block && call.block <= jump.block);
         });
}

/// As setsUnseen, on the way from the head of the program to the block.
bool setsUnseenBefore(const FlowFacts &facts, const FileContext &context, BlockId block) {
  const auto calls = context.model.callsOf(facts.program);
  return std::ranges::any_of(calls,
                             [&](const Call &call) {
                               return call.kind != CallKind::ModalCancel &&
                                      isBefore(call, block, facts.program, context) &&
                                      (!context.callGraph.callee(context.file, call) ||
                                       context.callGraph.reachesEncrypted(context.file, call));
                             }) ||
         std::ranges::any_of(context.model.variablesOf(facts.program),
                             [](const VariableUse &use) { return use.write && !use.number; });
}

/// `#110-1.5` is no statement: it may have been meant to set the variable.
bool isMeantAsAssignment(const FileContext &context, const VariableUse &use) {
  const auto statements = context.tree.statementsOf(use.block);
  return context.tree.blocks[use.block].has(Block::kBroken) ||
         std::ranges::any_of(statements, [](const Statement &statement) {
           return std::holds_alternative<LoneExpression>(statement.node);
         });
}

bool isSet(const FlowFacts &facts, const FileContext &context, std::uint32_t variable) {
  return isPromised(facts, context, variable) || facts.programs.isWrittenInCalled(variable) ||
         std::ranges::any_of(context.model.variablesOf(facts.program), [&](const VariableUse &use) {
           return use.number == variable && (use.write || isMeantAsAssignment(context, use));
         });
}

/// What goes missing when an argument is vacant.
std::string effectOn(const Read &read, const FileContext &context) {
  for (const Call &call : context.model.callsIn(read.block, read.block.next()))
    for (const Argument &argument : call.arguments) {
      const Word &word = context.tree.words[argument.word];
      if (word.form() == WordForm::Expression && word.span().contains(context.tree.expressions[read.expression].span))
        return fmt::format("if it is vacant the call does not pass {}, and `#{}` of the macro is vacant too",
                           word.address(), argument.variable);
    }
  return read.use == ReadUse::Word ? "if it is vacant the control ignores this word"
                                   : "it has whatever value an earlier program or the operator left there";
}

/// Some file of the run sets the variable, or one whose number is computed.
bool isSetInRun(const FlowFacts &facts, std::uint32_t variable) {
  return facts.programs.unnumberedUses().writes + facts.programs.usesOf(variable).writes != 0;
}

/// A program that the operator starts, or one that a program of the run calls.
bool isStartKnown(const FlowFacts &facts) {
  const ProgramFile &file = facts.file;
  return facts.programs.callGraph().isCalled({file.file, facts.program}) ||
         (!file.model->programs[facts.program].within && !file.model->programs[facts.program].returns);
}

/// Numbered parameters of LinuxCNC are 0 until something sets them, and the next program finds them as they are.
void checkParameters(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  constexpr std::uint32_t kLastParameter = 5000;
  if (!isStartKnown(facts) || setsUnseen(facts, context))
    return;
  std::vector<std::uint32_t> done;
  for (const Read &read : readsOf(facts)) {
    if (!read.number || *read.number > kLastParameter || !commonKind(context, *read.number) ||
        std::ranges::find(done, *read.number) != done.end())
      continue;
    done.push_back(*read.number);
    if (isPromised(facts, context, *read.number) || isSetInRun(facts, *read.number) || !reachedNode(facts, read.block))
      continue;
    const Span span = context.tree.expressions[read.expression].span;
    reporter.report({.message = fmt::format("{} is used here, but no checked program sets it", context.quoted(span)),
                     .span = span,
                     .notes = {"it is 0, or what an earlier program or the parameter file left there",
                               "set it before its first use, or correct the parameter number"}},
                    isTested(facts.file, facts.program, *read.number) ? Severity::Info : Severity::Warning);
  }
}

/// Of the conditions that end a loop: a common variable that nothing sets but its own steps in the loop.
std::optional<Read> bareCounter(const LoopFlow &loop, const FlowFacts &facts, const FileContext &context) {
  for (const LoopExit &exit : loop.exits)
    for (const Read &read : readsIn(facts.file, exit.condition, facts.node(exit.test).block)) {
      if (read.use != ReadUse::Ordering || !read.number || commonKind(context, *read.number) != VariableKind::Common ||
          isPromised(facts, context, *read.number))
        continue;
      const auto writes = writesTo(facts, loop, *read.number);
      const auto all = std::ranges::count_if(
          context.model.variables, [&](const VariableUse &use) { return use.write && use.number == read.number; });
      const bool onlySteps = writes && !writes->empty() && std::ranges::all_of(*writes, [&](const LoopWrite &write) {
                               return stepOf(facts, write.assignment, *read.number).has_value();
                             });
      if (onlySteps && all == static_cast<std::ptrdiff_t>(writes->size()) &&
          !facts.programs.isWrittenInCalled(*read.number))
        return read;
    }
  return std::nullopt;
}

/// `WHILE[#100LE5]DO1`, `#100=#100+1`: where the first run has left the counter, the second does not enter the loop.
void checkCounters(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || setsUnseen(facts, context))
    return;
  std::vector<std::uint32_t> done;
  for (const LoopFlow &loop : loopsOf(facts)) {
    const auto read = bareCounter(loop, facts, context);
    if (!read || std::ranges::find(done, *read->number) != done.end())
      continue;
    done.push_back(*read->number);
    const Span span = context.tree.expressions[read->expression].span;
    const LoopWrite step = writesTo(facts, loop, *read->number)->front();
    reporter.report({.message = fmt::format("{} counts this loop, but nothing sets it before", context.quoted(span)),
                     .span = span,
                     .labels = {{context.tree.blocks[facts.node(step.node).block].span(), "counted here"}},
                     .notes = {"the next run of the program finds it where this one has left it, and does not repeat "
                               "the loop",
                               "set it before the loop"}});
  }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.oWords) {
    checkParameters(facts, context, reporter);
    return;
  }
  if (!isMainProgram(facts))
    return;
  checkCounters(facts, context, reporter);
  std::vector<std::uint32_t> done;
  for (const Read &read : readsOf(facts)) {
    const auto kind = read.number ? commonKind(context, *read.number) : std::nullopt;
    if (!kind || std::ranges::find(done, *read.number) != done.end())
      continue;
    done.push_back(*read.number);
    const bool isPassed = read.use == ReadUse::Argument;
    const bool unseen = setsUnseenBefore(facts, context, read.block);
    if (isSet(facts, context, *read.number) || (unseen && !isPassed) ||
        isTestedForVacancy(facts.file, facts.program, *read.number) || !reachedNode(facts, read.block))
      continue;
    const bool mustBeSet =
        *kind == VariableKind::Common && !unseen && !isTested(facts.file, facts.program, *read.number);
    const Span span = context.tree.expressions[read.expression].span;
    reporter.report(
        {.message = fmt::format("{} is {} here, but no checked program sets it", context.quoted(span),
                                isPassed ? "passed" : "used"),
         .span = span,
         .notes = {effectOn(read, context), "set it at the head of the program, or correct the variable number"}},
        mustBeSet ? Severity::Warning : Severity::Info);
  }
}

} // namespace

extern const Rule unsetCommonVariable;
const Rule unsetCommonVariable{
    .info = {"unset-common-variable", Category::Flow, Severity::Warning,
             "Reports a common variable that a main program uses but no checked program sets."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::unset_common_variable
