#include "inference/absint/kept_state.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace feedhold {

namespace {

/// Beyond that many differences a state becomes a base itself.
constexpr std::size_t kMostDifferences = 32;

/// All values but the variables, which may be others from one state to the next.
template <typename State, typename Visit> void forEachCell(State &state, Visit &&visit) {
  const auto &entries = state.variables.entries();
  const void *begin = entries.data();
  const void *end = entries.data() + entries.size();
  const std::less<const void *> isBefore;
  forEachValue(state, [&](auto &value) {
    if (isBefore(&value, begin) || !isBefore(&value, end))
      visit(value);
  });
}

bool haveSameCells(const AbstractState &a, const AbstractState &b) {
  return a.counters.size() == b.counters.size() &&
         std::equal(a.modalCalls.begin(), a.modalCalls.end(), b.modalCalls.begin(), b.modalCalls.end(),
                    [](const auto &x, const auto &y) { return x.file == y.file && x.call == y.call; });
}

} // namespace

KeptState::Rest KeptState::restOf(const AbstractState &state) {
  return {state.forgotten, state.codes, state.transformed, state.spindle, state.modalCallsUnknown, state.enteredLoops};
}

AbstractState KeptState::state() const {
  AbstractState state = *base_;
  auto cell = cells_.begin();
  std::uint32_t index = 0;
  forEachCell(state, [&](AbstractValue &value) {
    if (cell != cells_.end() && cell->index == index)
      value = (cell++)->value;
    ++index;
  });
  for (const std::uint32_t variable : erased_)
    state.variables.erase(variable);
  for (const auto &[variable, value] : variables_)
    state.variables.set(variable, value);
  state.forgotten = rest_->forgotten;
  state.codes = rest_->codes;
  state.transformed = rest_->transformed;
  state.spindle = rest_->spindle;
  state.modalCallsUnknown = rest_->modalCallsUnknown;
  state.enteredLoops = rest_->enteredLoops;
  return state;
}

KeptState StateKeeper::keep(const AbstractState &state) {
  std::optional<KeptState> kept = base_ ? differing(state) : std::nullopt;
  if (!kept) {
    base_ = std::make_shared<const AbstractState>(state);
    kept.emplace();
    kept->base_ = base_;
    forEachValue(state, [&](const AbstractValue &) { ++kept->ownValues_; });
  }
  KeptState::Rest rest = KeptState::restOf(state);
  if (!rest_ || *rest_ != rest)
    rest_ = std::make_shared<const KeptState::Rest>(std::move(rest));
  kept->rest_ = rest_;
  return std::move(*kept);
}

/// From the base; absent when there is too much of it.
std::optional<KeptState> StateKeeper::differing(const AbstractState &state) const {
  if (!haveSameCells(*base_, state))
    return std::nullopt;
  std::vector<const AbstractValue *> old;
  forEachCell(*base_, [&](const AbstractValue &value) { old.push_back(&value); });
  KeptState kept;
  kept.base_ = base_;
  std::uint32_t index = 0;
  forEachCell(state, [&](const AbstractValue &value) {
    if (*old[index] != value && kept.cells_.size() <= kMostDifferences)
      kept.cells_.push_back({index, value});
    ++index;
  });
  auto before = base_->variables.entries().begin();
  const auto end = base_->variables.entries().end();
  for (const auto &entry : state.variables.entries()) {
    for (; before != end && before->first < entry.first; ++before)
      kept.erased_.push_back(before->first);
    const bool isKnown = before != end && before->first == entry.first;
    if (!isKnown || before->second != entry.second)
      kept.variables_.push_back(entry);
    if (isKnown)
      ++before;
  }
  for (; before != end; ++before)
    kept.erased_.push_back(before->first);
  if (kept.cells_.size() + kept.variables_.size() + kept.erased_.size() > kMostDifferences)
    return std::nullopt;
  return kept;
}

} // namespace feedhold
