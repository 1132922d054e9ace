// Operations on whole states: the arbitrary start, havoc, the union of two states.
#include "proof/symbolic/symbolic_interpretation.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::Number;
using smt::Sort;
using smt::TermId;

namespace {

template <typename Values, typename Make> void fillWith(Values &values, Make &&make) {
  for (auto &value : values)
    value = make();
}

bool isHavocked(const SymbolicState &state, std::uint32_t variable) {
  return std::any_of(state.havocked.begin(), state.havocked.end(),
                     [&](const auto &range) { return range.first <= variable && variable <= range.second; });
}

void shareHavocked(SymbolicState &to, const SymbolicState &from) {
  for (const auto &range : from.havocked)
    if (std::find(to.havocked.begin(), to.havocked.end(), range) == to.havocked.end())
      to.havocked.push_back(range);
}

} // namespace

SymbolicState symbolicEntry(SymbolicInterpretation &interpretation) {
  using Vacancy = SymbolicInterpretation::MayBeVacant;
  const auto nameOf = [](PartId id) {
    return id.part == Part::Position ? fmt::format("{} at the start", kAxisLetters[id.key])
                                     : fmt::format("{} in force", kModalWords[id.key]);
  };
  const auto value = [&](PartId id, SymbolicValue &input) {
    const bool isNumber = domainOf(id) == PartDomain::Number;
    if (domainOf(id) == PartDomain::Vacancy)
      input = interpretation.vacant();
    else if (id.part == Part::LocalVariable)
      input = interpretation.atEntry(id.key);
    else
      input = interpretation.named(nameOf(id), isNumber ? Vacancy::No : Vacancy::Yes);
  };
  const auto code = [&](PartId id, SymbolicCode &input) {
    const std::string name = id.part == Part::Spindle ? "spindle" : fmt::format("code of group {}", id.key);
    input = {interpretation.store().variable(name, Sort::Int)};
  };
  const auto truth = [&](PartId, Condition &input) { input = interpretation.unknownTruth(); };
  return entryParts<SymbolicInterpretation>(interpretation, Overloaded{value, code, truth},
                                            [&](PartId id, auto &part) { setAnything(interpretation, id, part); });
}

bool alignAll(SymbolicInterpretation &interpretation, SymbolicState &a, SymbolicState &b) {
  const bool haveSameCalls = align(interpretation, a, b);
  shareHavocked(a, b);
  shareHavocked(b, a);
  return haveSameCalls;
}

SymbolicValue SymbolicInterpretation::unwritten(const State &state, std::uint32_t variable) {
  if (!isHavocked(state, variable))
    return atEntry(variable);
  return isSystemVariable(*dialect_, variable) ? anyNumber() : anything();
}

SymbolicValue SymbolicInterpretation::volatileRead(std::uint32_t variable) {
  if (readings_ && !isContract_) {
    const std::vector<TermId> &script = (*readings_)[variable];
    const std::size_t taken = taken_[variable]++;
    return of(script.empty() ? store_.number(Number(0)) : script[std::min(taken, script.size() - 1)]);
  }
  const TermId number = fresh(fmt::format("read of #{}", variable), Sort::Real);
  if (!isContract_)
    inputReads_.push_back({place_, variable, number});
  return of(number);
}
SymbolicValue SymbolicInterpretation::toolLength(const State &, const Value &) { return anyNumber(); }

void SymbolicInterpretation::havocVariables(State &state, std::uint32_t first, std::uint32_t last) {
  state.havocked.emplace_back(first, last);
  std::erase_if(state.variables.entries(),
                [&](const auto &entry) { return first <= entry.first && entry.first <= last; });
}

void SymbolicInterpretation::join(State &state, Truth truth, const State &second) {
  if (truth.term == store_.no())
    return;
  State other = second;
  if (truth.term == store_.yes()) {
    state = std::move(other);
    return;
  }
  alignToJoin(*this, state, other);
  shareHavocked(state, other);
  forEachPart(Overloaded{[&](PartId, Value &mine, Value &theirs) { mine = select(truth, theirs, mine); },
                         [&](PartId, ModalCode &mine, ModalCode &theirs) { mine = selectCode(truth, theirs, mine); },
                         [&](PartId, Truth &mine, Truth &theirs) {
                           mine.term = store_.ite(truth.term, theirs.term, mine.term);
                         }},
              state, other);
}

// ---- variables whose number is not one constant ----

TermId SymbolicInterpretation::isVariable(const Value &index, std::uint32_t first, std::uint32_t last) {
  const TermId half = store_.number(Number(1) / Number(2));
  const TermId low = store_.subtract(store_.number(Number(static_cast<std::int64_t>(first))), half);
  const TermId high = store_.add(store_.number(Number(static_cast<std::int64_t>(last))), half);
  return store_.logicalAnd(store_.lessOrEqual(low, index.number), store_.less(index.number, high));
}

void SymbolicInterpretation::alarmsOfAnyOf(const Value &index, Use use, const Value &value, Span place) {
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
    possibleStops_.push_back({{stops}, std::nullopt, value, place});
}

SymbolicValue SymbolicInterpretation::readAnyOf(State &, const Value &index, Span place) {
  alarmsOfAnyOf(index, Use::Read, index, place);
  return anything();
}

bool SymbolicInterpretation::writeAnyOf(State &state, const Value &index, const Value &value, Span place) {
  alarmsOfAnyOf(index, Use::Write, value, place);
  bool mayMoveZero = false;
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
    havocVariables(state, row.first, row.last);
    const std::vector<VariableSpan> beside = cellsBeside(*dialect_, row.first, row.last);
    for (const VariableSpan &other : beside)
      havocVariables(state, other.first, other.last);
    mayMoveZero |= (row.role != VariableRole::Plain && row.role != VariableRole::Stored) || !beside.empty();
  }
  return mayMoveZero;
}

// ---- havoc ----

void SymbolicInterpretation::havoc(State &state, std::string_view reason, Span place) {
  unmodelled(reason, place);
  Move<Value> anywhere{.kind = MoveKind::Unmodelled, .start = state.position};
  havocParts(*this, state, {.polarGroup = polarGroup_, .modalCalls = !hasModalCalls(*dialect_)});
  anywhere.end = state.position;
  move(anywhere);
}

/// A macro that returns begins no modal call and ends none.
void SymbolicInterpretation::unlistedCode(State &state, const CodeName &code, Span place) {
  if (unlistedCodes_ == UnlistedCodes::DoAnything) {
    alarm(unknownTruth(), {AlarmKind::GCodeNotUsable, place});
    return havoc(state, kUnlistedCode, place);
  }
  returning_.push_back(textOf(code));
  if (unlistedCodes_ == UnlistedCodes::ChangeNothing)
    return;
  const Truth modalCalls = state.modalCallsUnknown;
  havoc(state, kUnlistedCode, place);
  state.modalCallsUnknown = modalCalls;
}

} // namespace feedhold::prove
