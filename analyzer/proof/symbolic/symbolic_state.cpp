// Operations on whole states: the arbitrary start, havoc, the union of two states.
#include "language/model/unread_blocks.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::Number;
using smt::Sort;
using smt::TermId;

namespace {

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

SymbolicValue SymbolicInterpretation::volatileRead(std::uint32_t variable) { return readOf(variable, Sort::Real); }

SymbolicValue SymbolicInterpretation::signalRead(std::uint32_t variable, double least, double most) {
  const Value read = readOf(variable, Sort::Int);
  if (!readings_ || isContract_)
    facts_.push_back(store_.logicalAnd(store_.lessOrEqual(store_.number(Number::fromDouble(least)), read.number),
                                       store_.lessOrEqual(read.number, store_.number(Number::fromDouble(most)))));
  return read;
}

SymbolicValue SymbolicInterpretation::readOf(std::uint32_t variable, Sort sort) {
  if (readings_ && !isContract_) {
    const std::vector<TermId> &script = (*readings_)[variable];
    const std::size_t taken = taken_[variable]++;
    return of(script.empty() ? store_.number(Number(0)) : script[std::min(taken, script.size() - 1)]);
  }
  const TermId number = fresh(fmt::format("read of #{}", variable), sort);
  if (!isContract_)
    inputReads_.push_back({place_, variable, number});
  return of(number);
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

// ---- havoc ----

void SymbolicInterpretation::havoc(State &state, std::string_view reason, Span place) {
  unmodelled(reason, place);
  Move<Value> anywhere{.kind = MoveKind::Unmodelled, .start = state.position};
  const bool hasNone = state.modalCalls.empty() && state.modalCallsUnknown.term == store_.no();
  const bool keepsModalCalls = !hasModalCalls(*dialect_) || (hasNone && reason == kUnreadWithoutCall);
  havocParts(*this, state, {.polarGroup = polarGroup_, .modalCalls = keepsModalCalls});
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
