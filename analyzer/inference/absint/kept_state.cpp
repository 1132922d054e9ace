#include "inference/absint/kept_state.h"

#include <algorithm>
#include <optional>

namespace feedhold {

namespace {

/// Beyond that many differences a state becomes a base itself.
constexpr std::size_t kMostDifferences = 32;

/// All parts but the variables, which may be others from one state to the next.
template <typename Visit, typename... States> void forEachCell(Visit &&visit, States &...states) {
  forEachPart<Part::Variable>(visit, states...);
}

} // namespace

KeptState::Rest KeptState::restOf(const AbstractState &state) {
  Rest rest{state.havocked, {}, {}};
  forEachCell(Overloaded{[](PartId, const AbstractValue &) {},
                         [&](PartId id, const CodeSet &code) { rest.codes.emplace_back(id, code); },
                         [&](PartId, const Truth &truth) { rest.truths.push_back(truth); }},
              state);
  return rest;
}

CodeSet KeptState::code(std::uint8_t group) const {
  for (const auto &[id, code] : rest_->codes)
    if (id == PartId{Part::Code, group})
      return code;
  FEEDHOLD_UNREACHABLE("a state has a code of each group");
}

AbstractState KeptState::state() const {
  AbstractState state = *base_;
  auto cell = cells_.begin();
  std::uint32_t index = 0;
  auto code = rest_->codes.begin();
  auto truth = rest_->truths.begin();
  forEachCell(Overloaded{[&](PartId, AbstractValue &value) {
                           if (cell != cells_.end() && cell->index == index)
                             value = (cell++)->value;
                           ++index;
                         },
                         [&](PartId, CodeSet &mine) { mine = (code++)->second; },
                         [&](PartId, Truth &mine) { mine = *truth++; }},
              state);
  for (const std::uint32_t variable : erased_)
    state.variables.erase(variable);
  for (const auto &[variable, value] : variables_)
    state.variables.set(variable, value);
  state.havocked = rest_->havocked;
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
  if (!haveSameLists(*base_, state))
    return std::nullopt;
  KeptState kept;
  kept.base_ = base_;
  std::uint32_t index = 0;
  forEachCell(Overloaded{[&](PartId, const AbstractValue &old, const AbstractValue &value) {
                           if (old != value && kept.cells_.size() <= kMostDifferences)
                             kept.cells_.push_back({index, value});
                           ++index;
                         },
                         [](PartId, const auto &, const auto &) {}},
              *base_, state);
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
