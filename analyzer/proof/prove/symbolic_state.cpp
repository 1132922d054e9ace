// The reading's operations on whole states: what is there at the start, what becomes unknown, two states in one.
#include "proof/prove/symbolic_reading.h"

#include <fmt/format.h>

namespace feedhold::prove {

using smt::Number;
using smt::Sort;
using smt::TermId;

namespace {

void noMapping(SymbolicReading &reading, SymbolicState &state) {
  state.transform.scale.fill(reading.number(1));
  state.transform.scaleCentre.fill(reading.number(0));
  state.transform.mirrorAt.fill(reading.vacant());
  state.transform.angle = reading.number(0);
  state.transform.centre.fill(reading.number(0));
  state.transform.other = reading.vacant();
  state.transformed = reading.truth(false);
}

template <typename Values, typename Make> void fillWith(Values &values, Make &&make) {
  for (auto &value : values)
    value = make();
}

bool isForgotten(const SymbolicState &state, std::uint32_t variable) {
  return std::any_of(state.forgotten.begin(), state.forgotten.end(),
                     [&](const auto &range) { return range.first <= variable && variable <= range.second; });
}

bool sameCalls(const SymbolicState &a, const SymbolicState &b) {
  return std::equal(a.modalCalls.begin(), a.modalCalls.end(), b.modalCalls.begin(), b.modalCalls.end(),
                    [](const auto &x, const auto &y) { return x.file == y.file && x.call == y.call; });
}

/// A loop that is not listed counts as entered.
void completeLoops(const SymbolicReading &reading, SymbolicState &to, const SymbolicState &from) {
  for (const auto &[number, entered] : from.enteredLoops)
    if (std::none_of(to.enteredLoops.begin(), to.enteredLoops.end(),
                     [n = number](const auto &loop) { return loop.first == n; }))
      to.enteredLoops.emplace_back(number, reading.truth(true));
  std::sort(to.enteredLoops.begin(), to.enteredLoops.end(),
            [](const auto &x, const auto &y) { return x.first < y.first; });
}

} // namespace

SymbolicState symbolicEntry(SymbolicReading &reading) {
  using Vacancy = SymbolicReading::MayBeVacant;
  SymbolicState state;
  for (std::uint32_t local = 0; local <= kLocalVariables; ++local)
    state.locals[local] = local == 0 ? reading.vacant() : reading.atEntry(local);
  for (std::size_t group = 0; group < kModalGroups; ++group)
    state.codes[group] = {reading.store().variable(fmt::format("code of group {}", group), Sort::Int)};
  for (const Axis axis : kAllAxes)
    state.at(axis) = reading.named(fmt::format("{} at the start", letterOf(axis)), Vacancy::No);
  for (std::size_t i = 0; i < kModalWords.size(); ++i)
    state.words[i] = reading.named(fmt::format("{} in force", kModalWords[i]), Vacancy::Yes);
  for (auto *numbers : {&state.shift, &state.local})
    fillWith(*numbers, [&] { return reading.anyNumber(); });
  state.lengthOffset = reading.anyNumber();
  for (auto *level :
       {&state.cycle.bottom, &state.cycle.retract, &state.cycle.initial, &state.cycle.peck, &state.cycle.dwell})
    *level = reading.anything();
  noMapping(reading, state);
  state.spindle = {reading.store().variable("spindle", Sort::Int)};
  state.modalCallsUnknown = reading.truth(false);
  return state;
}

bool align(SymbolicReading &reading, SymbolicState &a, SymbolicState &b) {
  const auto complete = [&](SymbolicState &to, const SymbolicState &from) {
    for (const auto &[number, value] : from.variables.entries())
      if (!to.variables.find(number))
        to.variables.set(number, reading.unwritten(to, number));
    completeLoops(reading, to, from);
  };
  complete(a, b);
  complete(b, a);
  const std::size_t counters = std::max(a.counters.size(), b.counters.size());
  a.counters.resize(counters, reading.number(0));
  b.counters.resize(counters, reading.number(0));
  for (auto [to, from] : {std::pair{&a, &b}, std::pair{&b, &a}})
    for (const auto &range : from->forgotten)
      if (std::find(to->forgotten.begin(), to->forgotten.end(), range) == to->forgotten.end())
        to->forgotten.push_back(range);
  return sameCalls(a, b);
}

SymbolicValue SymbolicReading::unwritten(const State &state, std::uint32_t variable) {
  if (!isForgotten(state, variable))
    return atEntry(variable);
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(*dialect_, variable);
  return range && range->kind == VariableKind::System ? anyNumber() : anything();
}

SymbolicValue SymbolicReading::volatileRead(std::uint32_t variable) {
  return of(fresh(fmt::format("read of #{}", variable), Sort::Real));
}
SymbolicValue SymbolicReading::toolLength(const State &, const Value &) { return anyNumber(); }

void SymbolicReading::forgetVariables(State &state, std::uint32_t first, std::uint32_t last) {
  state.forgotten.emplace_back(first, last);
  std::erase_if(state.variables.entries(),
                [&](const auto &entry) { return first <= entry.first && entry.first <= last; });
}

void SymbolicReading::join(State &state, Truth truth, const State &second) {
  if (truth.term == store_.no())
    return;
  State other = second;
  if (truth.term == store_.yes()) {
    state = std::move(other);
    return;
  }
  if (!align(*this, state, other)) {
    state.modalCalls.clear();
    other.modalCalls.clear();
    state.modalCallsUnknown = other.modalCallsUnknown = unknownTruth();
  }
  std::vector<TermId> parts;
  forEachPart(other, [&](TermId &part) { parts.push_back(part); });
  auto part = parts.begin();
  forEachPart(state, [&](TermId &mine) {
    mine = store_.ite(truth.term, *part, mine);
    ++part;
  });
}

// ---- variables whose number is not one constant ----

TermId SymbolicReading::isVariable(const Value &index, std::uint32_t first, std::uint32_t last) {
  const TermId half = store_.number(Number(1) / Number(2));
  const TermId low = store_.subtract(store_.number(Number(static_cast<std::int64_t>(first))), half);
  const TermId high = store_.add(store_.number(Number(static_cast<std::int64_t>(last))), half);
  return store_.logicalAnd(store_.lessOrEqual(low, index.number), store_.lessOrEqual(index.number, high));
}

void SymbolicReading::alarmsOfAnyOf(const Value &index, Use use, const Value &value, Span place) {
  std::vector<TermId> rows;
  std::vector<TermId> guarded;
  TermId stops = store_.no();
  for (const VariableRange &row : dialect_->variables) {
    rows.push_back(isVariable(index, row.first, row.last));
    if (row.access == (use == Use::Read ? VariableAccess::WriteOnly : VariableAccess::ReadOnly))
      guarded.push_back(rows.back());
    if (use == Use::Write && row.role == VariableRole::Alarm)
      stops = store_.logicalOr(stops, rows.back());
  }
  alarm({store_.logicalNot(store_.logicalOr(rows))}, {AlarmKind::VariableNotAvailable, place});
  alarm({store_.logicalOr(guarded)}, {use == Use::Read ? AlarmKind::ReadProtected : AlarmKind::WriteProtected, place});
  if (mayBe({stops}) && !stopped_)
    checks_.push_back({{stops}, std::nullopt, value, place});
}

SymbolicValue SymbolicReading::readAnyOf(State &, const Value &index, Span place) {
  alarmsOfAnyOf(index, Use::Read, index, place);
  return anything();
}

void SymbolicReading::writeAnyOf(State &state, const Value &index, const Value &value, Span place) {
  alarmsOfAnyOf(index, Use::Write, value, place);
  for (const VariableRange &row : dialect_->variables) {
    if (row.access == VariableAccess::ReadOnly)
      continue;
    if (path_ && path_->proves(store_.logicalNot(isVariable(index, row.first, row.last))))
      continue;
    if (row.kind == VariableKind::Local) {
      fillWith(state.locals, [&] { return anything(); });
      state.locals[0] = vacant();
      continue;
    }
    forgetVariables(state, row.first, row.last);
    if (row.role != VariableRole::Plain && row.role != VariableRole::Stored)
      fillWith(state.position, [&] { return anyNumber(); });
  }
}

// ---- what is not followed ----

void SymbolicReading::anyMapping(State &state) {
  for (auto *numbers : {&state.transform.scale, &state.transform.scaleCentre})
    fillWith(*numbers, [&] { return anyNumber(); });
  fillWith(state.transform.mirrorAt, [&] { return anything(); });
  fillWith(state.transform.centre, [&] { return anyNumber(); });
  state.transform.angle = anyNumber();
  state.transform.other = anything();
  state.transformed = unknownTruth();
}

void SymbolicReading::havoc(State &state, std::string_view reason, Span place) {
  notModelled(reason, place);
  Move<Value> anywhere{.kind = MoveKind::Unfollowed, .start = state.position};
  forgetVariables(state, 0, 0xffffffff);
  for (auto *values : {&state.locals})
    fillWith(*values, [&] { return anything(); });
  state.locals[0] = vacant();
  fillWith(state.words, [&] { return anything(); });
  for (auto *numbers : {&state.position, &state.shift, &state.local})
    fillWith(*numbers, [&] { return anyNumber(); });
  state.lengthOffset = anyNumber();
  const bool mapped = state.transformed.term != store_.no();
  if (mapped)
    anyMapping(state);
  fillWith(state.counters, [&] { return anyNumber(); });
  for (std::size_t group = 0; group < kModalGroups; ++group)
    if (mapped || group != polarGroup_)
      state.codes[group] = unknownCode();
  state.spindle = unknownCode();
  state.modalCallsUnknown = unknownTruth();
  for (auto &loop : state.enteredLoops)
    loop.second = unknownTruth();
  for (auto *level :
       {&state.cycle.bottom, &state.cycle.retract, &state.cycle.initial, &state.cycle.peck, &state.cycle.dwell})
    *level = anything();
  for (auto &call : state.modalCalls)
    fillWith(call.locals, [&] { return anything(); });
  anywhere.end = state.position;
  move(anywhere);
}

} // namespace feedhold::prove
