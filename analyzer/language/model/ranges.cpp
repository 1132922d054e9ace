// What lies in a range of blocks.  The lists of the model are in order of the text, so that each part of the text is a
// range of them.
#include "language/model/model.h"

#include <algorithm>

namespace feedhold {

namespace {

template <typename T>
std::span<const T> between(std::span<const T> all, BlockId T::*place, BlockId firstBlock, BlockId lastBlock) {
  const auto before = [&](const T &each, BlockId block) { return each.*place < block; };
  const auto first = std::lower_bound(all.begin(), all.end(), firstBlock, before);
  return {first, std::lower_bound(first, all.end(), lastBlock, before)};
}

} // namespace

std::span<const SequenceNumber> ProgramModel::sequenceNumbersIn(BlockId first, BlockId last) const {
  return between<SequenceNumber>(sequenceNumbers, &SequenceNumber::block, first, last);
}

std::span<const Jump> ProgramModel::jumpsIn(BlockId first, BlockId last) const {
  return between<Jump>(jumps, &Jump::block, first, last);
}

std::span<const Loop> ProgramModel::loopsIn(BlockId first, BlockId last) const {
  return between<Loop>(loops, &Loop::doBlock, first, last);
}

std::span<const LoneEnd> ProgramModel::loneEndsIn(BlockId first, BlockId last) const {
  return between<LoneEnd>(loneEnds, &LoneEnd::block, first, last);
}

std::span<const OWordUse> ProgramModel::oWordsIn(BlockId first, BlockId last) const {
  return between<OWordUse>(oWords.slice(OWordId(0), OWordId(oWords.size())), &OWordUse::block, first, last);
}

std::span<const Call> ProgramModel::callsIn(BlockId first, BlockId last) const {
  return between<Call>(calls.slice(CallId(0), CallId(calls.size())), &Call::block, first, last);
}

std::span<const VariableUse> ProgramModel::variablesIn(BlockId first, BlockId last) const {
  return between<VariableUse>(variables, &VariableUse::block, first, last);
}

std::span<const SequenceNumber> ProgramModel::sequenceNumbersOf(ProgramId program) const {
  return sequenceNumbersIn(programs[program].first, programs[program].last);
}

std::span<const Jump> ProgramModel::jumpsOf(ProgramId program) const {
  return jumpsIn(programs[program].first, programs[program].last);
}

std::set<BlockId> ProgramModel::jumpTargetsOf(ProgramId program) const {
  std::set<BlockId> targets;
  for (const Jump &jump : jumpsOf(program))
    if (jump.target)
      targets.insert(*jump.target);
  return targets;
}

std::span<const Loop> ProgramModel::loopsOf(ProgramId program) const {
  return loopsIn(programs[program].first, programs[program].last);
}

std::span<const LoneEnd> ProgramModel::loneEndsOf(ProgramId program) const {
  return loneEndsIn(programs[program].first, programs[program].last);
}

std::span<const Call> ProgramModel::callsOf(ProgramId program) const {
  return callsIn(programs[program].first, programs[program].last);
}

std::span<const VariableUse> ProgramModel::variablesOf(ProgramId program) const {
  return variablesIn(programs[program].first, programs[program].last);
}

} // namespace feedhold
