// Lowering of WHILE, DO and END.
#include "meaning/cfg/lowering.h"

#include <algorithm>

namespace feedhold {

void Lowering::whileStatement(StatementId id, const While &loop) {
  const std::optional<std::size_t> index = loopOfDo(id);
  if (!beginsLoop(index))
    return;
  const NodeId test = emitTest(loop.condition);
  loopNodes_[*index].head = test;
  loopNodes_[*index].test = test;
  enter(*index);
}

void Lowering::doStatement(StatementId id) {
  const std::optional<std::size_t> index = loopOfDo(id);
  if (!beginsLoop(index))
    return;
  loopNodes_[*index].head = end();
  enter(*index);
  if (end() == *loopNodes_[*index].head)
    emit(Pass{});
}

/// Else the node of the DO is made here, and nothing is repeated.
bool Lowering::beginsLoop(std::optional<std::size_t> loop) {
  if (loop && usableNumber(model_.loops[*loop].number, dialect_) && model_.loops[*loop].endBlock)
    return true;
  if (loop)
    loopNodes_[*loop].head = end();
  if (!loop || !model_.loops[*loop].number)
    emit(Havoc{"a DO whose number could not be read"});
  else if (!usableNumber(model_.loops[*loop].number, dialect_))
    stop(AlarmKind::LoopNumber);
  else
    stop(AlarmKind::MissingEnd);
  return false;
}

void Lowering::enter(std::size_t loop) {
  if (loopNodes_[loop].isEntered)
    emit(EnterLoop{static_cast<std::uint8_t>(*model_.loops[loop].number)});
}

void Lowering::endStatement(StatementId id) {
  const std::optional<std::size_t> index = loopOfEnd(id);
  if (!index) {
    const std::span<const LoneEnd> lone = model_.loneEndsIn(block_, block_.next());
    const auto found =
        std::find_if(lone.begin(), lone.end(), [&](const LoneEnd &each) { return each.statement == id; });
    if (found == lone.end() || !found->number)
      emit(Havoc{"an END whose number could not be read"});
    else
      stop(usableNumber(found->number, dialect_) ? AlarmKind::MissingDo : AlarmKind::LoopNumber);
    return;
  }
  const LoopNodes &nodes = loopNodes_[*index];
  const std::optional<std::uint8_t> number = usableNumber(model_.loops[*index].number, dialect_);
  if (!number || !nodes.head) {
    stop(AlarmKind::LoopNumber);
    return;
  }
  const NodeId back = nodes.isEntered ? emit(RequireLoop{*number}) : emit(Pass{});
  setNext(back, *nodes.head);
  if (nodes.test)
    setNext(*nodes.test, end());
}

std::optional<std::size_t> Lowering::loopOfDo(StatementId id) const {
  for (const Loop &loop : model_.loopsIn(block_, block_.next()))
    if (loop.doStatement == id)
      return static_cast<std::size_t>(&loop - model_.loops.data());
  return std::nullopt;
}

std::optional<std::size_t> Lowering::loopOfEnd(StatementId id) const {
  const auto at = std::lower_bound(loopEnds_.begin(), loopEnds_.end(), std::pair(id, std::size_t{0}));
  return at != loopEnds_.end() && at->first == id ? std::optional(at->second) : std::nullopt;
}

/// The ends of the loops of a program, and which of its loops may be entered past their DO because it can be left out.
void Lowering::sortEnds(ProgramId id) {
  loopEnds_.clear();
  for (const Loop &loop : model_.loopsOf(id)) {
    const auto index = static_cast<std::size_t>(&loop - model_.loops.data());
    if (loop.endStatement)
      loopEnds_.push_back({*loop.endStatement, index});
    constexpr std::uint16_t kSkipped = Block::kSkip | Block::kSkipInside;
    const bool repeats = usableNumber(loop.number, dialect_) && loop.endBlock;
    if (repeats && (tree_.blocks[loop.doBlock].flags & kSkipped) != 0)
      loopNodes_[index].isEntered = true;
  }
  std::sort(loopEnds_.begin(), loopEnds_.end());
}

/// `/WHILE [..] DO1`: when the block is skipped, the loop is entered past its DO.
void Lowering::leaveOutDo(std::optional<NodeId> skip) {
  const NodeId lastOfDo(end().index() - 1);
  if (!skip || cfg_.nodes[lastOfDo].next != end())
    return;
  for (const Loop &loop : model_.loopsIn(block_, block_.next())) {
    const LoopNodes &nodes = loopNodes_[static_cast<std::size_t>(&loop - model_.loops.data())];
    if (!nodes.isEntered || !nodes.head)
      continue;
    const NodeId gate = emit(JumpIntoLoop{static_cast<std::uint8_t>(*loop.number)});
    setNext(lastOfDo, gate.next());
    std::get<BlockSkip>(cfg_.nodes[*skip].instruction).skipped = gate;
    return;
  }
}

} // namespace feedhold
