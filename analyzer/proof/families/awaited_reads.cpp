#include "proof/families/awaited_reads.h"

#include "meaning/cfg/reached_programs.h"
#include "meaning/cfg/wto.h"

#include <algorithm>

namespace feedhold::prove {

namespace {

/// A program that may be called again before it returns passes a place more often than its own text says.
bool mayBeReentered(const ProofSubject &subject) {
  const ProgramRef own{subject.program.file, subject.program.program};
  ReachedPrograms reached;
  for (const Call &call : subject.file().model->callsOf(own.program))
    for (const ProgramRef &callee : subject.programs.callGraph().candidates(own.file, call))
      collectReached(subject.programs, callee, reached);
  const bool callsAny = std::ranges::any_of(subject.file().model->callsOf(own.program), [&](const Call &call) {
    return call.kind != CallKind::Local && call.callee.empty();
  });
  return callsAny || reached.orAny || reached.programs.contains(own);
}

/// The block names the variable once, and no computed one.
bool isReadOnce(const ProgramFile &file, BlockId block, std::uint32_t variable) {
  const auto uses = file.model->variablesIn(block, block.next());
  return std::ranges::count(uses, variable, &VariableUse::number) == 1 &&
         std::ranges::all_of(uses, [](const VariableUse &use) { return use.number.has_value(); });
}

Relation relationOf(OperatorKind op) { // operators.def has the relations in the same order
  return static_cast<Relation>(static_cast<int>(op) - static_cast<int>(OperatorKind::Equal));
}

/// As a program compares: EQ within the tolerance of the control.
smt::TermId isOther(SymbolicInterpretation &interpretation, const AwaitedInput &awaited, smt::TermId number) {
  const SymbolicValue value = interpretation.literal(awaited.value);
  const Condition isAwaited =
      interpretation.compare(relationOf(awaited.relation), {interpretation.store().no(), number}, value);
  return interpretation.store().logicalNot(isAwaited.term);
}

} // namespace

std::vector<AwaitedRead> awaitedReads(const ProofContext &context, const LoopInstance &loop) {
  std::vector<AwaitedRead> reads;
  const ProofSubject &subject = context.subject;
  if (!subject.contract() || subject.contract()->awaited.empty() || !loop.calls.empty() || mayBeReentered(subject))
    return reads;
  SymbolicInterpretation &interpretation = context.start.interpretation();
  const Wto wto(subject.file().cfg, *subject.file().model, subject.program.entry);
  const std::vector<AwaitedInput> &awaited = subject.contract()->awaited;
  for (const InputRead &read : interpretation.inputReads())
    for (std::size_t clause = 0; clause < awaited.size(); ++clause)
      if (read.variable == awaited[clause].variable && read.place && read.place->file == loop.head.file &&
          wto.headOf(read.place->node) == loop.head.node &&
          isReadOnce(subject.file(), subject.file().cfg.nodes[read.place->node].block, read.variable))
        reads.push_back({*read.place, clause, read.number, isOther(interpretation, awaited[clause], read.number)});
  return reads;
}

bool readsAwaited(const ProofContext &context) {
  const Contract *contract = context.subject.contract();
  return contract && std::ranges::any_of(context.start.interpretation().inputReads(), [&](const InputRead &read) {
           return std::ranges::find(contract->awaited, read.variable, &AwaitedInput::variable) !=
                  contract->awaited.end();
         });
}

} // namespace feedhold::prove
