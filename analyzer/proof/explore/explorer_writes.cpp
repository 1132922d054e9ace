// What a step writes of the variables that other programs can see.
#include "proof/explore/explorer.h"

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
  if (path.state.havocked != before.havocked)
    record(std::nullopt, store_.no());
  for (const auto &[variable, now] : path.state.variables.entries()) {
    const SymbolicValue *held = before.variables.find(variable);
    const SymbolicValue old = held ? *held : interpretation_.unwritten(before, variable);
    record(variable, store_.logicalAnd(store_.equal(now.vacant, old.vacant), store_.equal(now.number, old.number)));
  }
  for (const std::uint32_t variable : step.unkept)
    record(variable, store_.no());
}

} // namespace feedhold::prove
