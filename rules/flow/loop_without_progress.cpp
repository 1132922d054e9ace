// loop-without-progress: what the conditions of a loop ask about never changes in it.
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::loop_without_progress {
namespace {

/// A common variable that is vacant when the machine is switched on, and that no program of the run sets.
bool isUnsetCommon(const FlowFacts &facts, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(*facts.file.dialect, variable);
  const auto isUnseen = [&](const Call &call) { return !facts.programs.callGraph().callee(facts.file.file, call); };
  return range && range->kind == VariableKind::Common && isMainProgram(facts) && !isWrittenInAny(facts, variable) &&
         !isTested(facts.file, facts.program, variable) &&
         std::ranges::none_of(facts.file.model->callsOf(facts.program), isUnseen);
}

/// `#5=#5-#104` where `#104` is 0: the block changes nothing.
bool isStepOfZero(const FlowFacts &facts, const LoopWrite &write, std::uint32_t variable) {
  const auto step = stepOf(facts, write.assignment, variable);
  const AbstractValue *size = step ? facts.valueOf(step->size) : nullptr;
  if (!size)
    return false;
  const auto name = variableOf(facts, step->size);
  if (name && isUnsetCommon(facts, *name))
    return true;
  if (size->isVacant())
    return name && !isNeverSet(facts, *name); // else another rule's
  return size->isNumber() && size->number().interval().lo == 0 && size->number().interval().hi == 0;
}

/// By its number or its name.
std::optional<std::uint32_t> numberOf(const FlowFacts &facts, const Read &read) {
  return read.number ? read.number : variableOf(facts, read.expression);
}

/// The first block of the loop that counts a variable of the condition, by 0.
std::optional<LoopWrite> stepOfZero(const LoopExit &exit, const LoopFlow &loop, const FlowFacts &facts) {
  for (const Read &read : readsIn(facts.file, exit.condition, facts.node(exit.test).block))
    if (const auto number = numberOf(facts, read)) {
      const auto writes = writesTo(facts, loop, *number);
      if (writes && !writes->empty())
        return writes->front();
    }
  return std::nullopt;
}

/// Of this program alone.
bool isOwn(const FlowFacts &facts, std::uint32_t variable) {
  return isLocal(facts.file, variable) || facts.programs.isLocalName(variable);
}

/// The condition can have another outcome in a later pass, or that cannot be told.
bool mayChange(const LoopExit &exit, const LoopFlow &loop, const FlowFacts &facts) {
  const auto reads = readsIn(facts.file, exit.condition, facts.node(exit.test).block);
  if (reads.empty())
    return true; // of constants alone: written so on purpose, or another rule's
  return std::ranges::any_of(reads, [&](const Read &read) {
    const auto number = numberOf(facts, read);
    if (!number || (*number != kVacantVariable && !isPlain(facts.file, *number) && !isOwn(facts, *number)))
      return true;
    const auto writes = writesTo(facts, loop, *number);
    return !writes ||
           !std::ranges::all_of(*writes, [&](const LoopWrite &write) { return isStepOfZero(facts, write, *number); });
  });
}

bool moves(const LoopFlow &loop, const FlowFacts &facts) {
  return std::ranges::any_of(loop.nodes, [&](NodeId node) {
    const auto words = facts.file.tree->wordsOf(facts.node(node).block);
    const bool isDwell =
        findCode(*facts.file.tree, facts.node(node).block, *facts.file.dialect, CodeRole::Dwell) != nullptr;
    return !isDwell && std::ranges::any_of(words, [](const Word &word) {
      return word.address() == 'X' || word.address() == 'Y' || word.address() == 'Z';
    });
  });
}

/// Nothing but local variables and constants.
bool readsLocals(const LoopExit &exit, const FlowFacts &facts) {
  const auto reads = readsIn(facts.file, exit.condition, facts.node(exit.test).block);
  return std::ranges::all_of(reads, [&](const Read &read) {
    const auto number = numberOf(facts, read);
    return number && (*number == kVacantVariable || isOwn(facts, *number));
  });
}

/// Called programs do not reach the local variables of this one.
bool mayChangeUnseen(const LoopFlow &loop, const FlowFacts &facts) {
  return loop.changesUnseen && !(loop.keepsLocals && std::ranges::all_of(loop.exits, [&](const LoopExit &exit) {
                                   return readsLocals(exit, facts);
                                 }));
}

/// A loop that stands still until common variables change may wait for a robot or a computer that writes them.
bool mayWait(const LoopFlow &loop, const FlowFacts &facts) {
  return !moves(loop, facts) &&
         std::ranges::none_of(loop.exits, [&](const LoopExit &exit) { return readsLocals(exit, facts); });
}

/// The loop is left by this test whenever it is reached: there is no second pass.
bool alwaysLeaves(const LoopExit &exit, const FlowFacts &facts) {
  return facts.truthOf(exit.test) == truthOf(exit.leavesWhenTrue);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::vector<NodeId> done;
  for (const LoopFlow &loop : loopsOf(facts)) {
    if (!loop.exitsAreKnown || loop.exits.empty() || mayChangeUnseen(loop, facts) ||
        std::ranges::any_of(loop.exits, [&](const LoopExit &exit) {
          return mayChange(exit, loop, facts) || alwaysLeaves(exit, facts);
        }))
      continue;
    const LoopExit &exit = loop.exits.front();
    if (mayWait(loop, facts))
      continue;
    if (std::ranges::find(done, exit.test) != done.end())
      continue;
    done.push_back(exit.test);
    const Span span = context.tree.expressions[exit.condition].span;
    const Span head = context.tree.blocks[facts.node(loop.head).block].span();
    Diagnostic diagnostic{
        .message = loop.exits.size() > 1 ? "nothing in this loop changes the variables that its exit conditions read"
                                         : fmt::format("{} once {} {}", endlessnessOf(loop), context.quoted(span),
                                                       exit.leavesWhenTrue ? "is false" : "is true"),
        .span = span,
        .flow = pathFromEntry(facts, exit.test),
        .notes = {loop.mayStop ? "nothing in the loop changes a variable of the condition"
                               : "nothing in the loop changes a variable of the condition; only reset stops it"}};
    if (const auto zero = stepOfZero(exit, loop, facts)) {
      diagnostic.labels.push_back({context.tree.blocks[facts.node(zero->node).block].span(), "the step is 0 here"});
      diagnostic.notes = {"the step is 0, so no variable of the condition changes", "check the step before the loop"};
    }
    if (!head.contains(span))
      diagnostic.labels.push_back({head, "the loop begins here"});
    reporter.report(std::move(diagnostic));
  }
}

} // namespace

extern const Rule loopWithoutProgress;
const Rule loopWithoutProgress{.info = {"loop-without-progress", Category::Flow, Severity::Warning,
                                        "Reports a loop in which no variable of its conditions changes."},
                               .hooks = {.flow = check}};

} // namespace feedhold::rules::loop_without_progress
