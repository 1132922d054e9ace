// What a step writes of the variables that other programs can see.
#include "proof/explore/explorer.h"

#include "proof/symbolic/path_memory.h"

namespace feedhold::prove {

using smt::TermId;

std::optional<Explorer::StepWrites> Explorer::beginWrites(const Path &path) const {
  const bool isAsked = options_.keepWrites && purpose_ == Purpose::Record;
  return isAsked ? std::optional(StepWrites{path.state}) : std::nullopt;
}

/// By what the state holds before and behind the step, so that no way to write is left out (an assignment, G10); and by
/// what the step says to have written where nothing is kept of it (outputs).
void Explorer::takeWrites(const Path &path, const StepWrites &step) {
  const SymbolicState &before = step.before;
  const auto record = [&](std::optional<std::uint32_t> variable, TermId isKept) {
    if (isKept != store_.yes())
      result_.writes.push_back({path.at, path.conditions, isKept, variable});
  };
  takeRegionWrites(path, before);
  for (const auto &[variable, now] : path.state.variables.entries()) {
    if (isPathMemory(variable))
      continue;
    const SymbolicValue *held = before.variables.find(variable);
    const SymbolicValue old = held ? *held : interpretation_.unwritten(before, variable);
    record(variable, store_.logicalAnd(store_.equal(now.vacant, old.vacant), store_.equal(now.number, old.number)));
  }
  for (const std::uint32_t variable : step.unkept)
    record(variable, store_.no());
}

/// An index that chooses among a span writes one of its variables; any other change may be one of anything.
void Explorer::takeRegionWrites(const Path &path, const SymbolicState &before) {
  constexpr std::uint32_t kMostNamed = 200; // variables of a span
  const auto changes = interpretation_.changesBetween(before, path.state);
  const auto isNamed = [](const RegionChange *change) {
    return change->write && change->span.last - change->span.first < kMostNamed;
  };
  if (!changes || !std::ranges::all_of(*changes, isNamed)) {
    result_.writes.push_back({path.at, path.conditions, store_.no(), std::nullopt});
    return;
  }
  for (const RegionChange *change : *changes)
    for (std::uint32_t variable = change->span.first; variable <= change->span.last; ++variable)
      result_.writes.push_back({path.at, path.conditions,
                                store_.logicalNot(interpretation_.isCell(change->write->index, variable)), variable});
}

} // namespace feedhold::prove
