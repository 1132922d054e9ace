// What the contract of a program promises for its return, and for the calls that raise alarms.
#include "proof/prove/obligations.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::TermId;

namespace {

void append(Questions &all, Questions more) { std::move(more.begin(), more.end(), std::back_inserter(all)); }

std::optional<std::string> howItEnded(const RunResult &run) {
  switch (run.end) {
  case RunEnd::M02:
  case RunEnd::M30:
  case RunEnd::Returned:
  case RunEnd::EndOfFile: return "the program ends without an alarm";
  case RunEnd::UserAlarm: return fmt::format("stops with alarm {:.15g}", run.alarmNumber);
  case RunEnd::Alarm: return "the control stops the program";
  case RunEnd::Fuel:
  case RunEnd::Repeats:
  case RunEnd::NotModelled: return std::nullopt;
  }
  return std::nullopt;
}

/// Promised of runs that come to their end.
std::optional<std::string> brokenAtEnd(const RunResult &run, const GivenVariables &) {
  const auto end = howItEnded(run);
  if (!end || run.end == RunEnd::UserAlarm || run.end == RunEnd::Alarm)
    return std::nullopt;
  return *end + ", and what was promised does not hold";
}

Question promise(const ProofSubject &subject, ObligationKind kind, ClauseId clause) {
  return {.row = subject.obligation(kind, subject.textOf(clause)),
          .goals = {},
          .broken = brokenAtEnd,
          .isJudgedExactly = true};
}

TermId codesHold(const ExploredProgram &program, const std::vector<ModalCode> &codes, const SymbolicState &state) {
  smt::TermStore &store = program.start.store();
  const Dialect &dialect = program.subject.dialect();
  const ModalTable modes(dialect);
  TermId all = store.yes();
  for (const ModalCode &code : codes) {
    const Code *row = code.address == 'G' ? findGCode(dialect, code.tenths) : nullptr;
    const auto index = row ? modes.indexOf(*row) : std::nullopt;
    all = index ? store.logicalAnd(
                      all, store.equal(state.codes[row->group].index, program.start.reading().code(*index).index))
                : store.no();
  }
  return all;
}

/// What a program leaves behind besides codes: zero points, a tool length, mappings and modes that are not followed,
/// modal calls.  Words (F, S, T, D, H) and the spindle are not part of it (docs/contracts.md).
TermId settingsKept(const ExploredProgram &program, const SymbolicState &state) {
  smt::TermStore &store = program.start.store();
  const SymbolicState &entry = program.start.entry();
  const bool hasModalCall = state.modalCalls.size() != entry.modalCalls.size();
  TermId kept = hasModalCall ? store.no() : store.logicalNot(state.modalCallsUnknown.term);
  const auto keep = [&](const SymbolicValue &now, const SymbolicValue &before) {
    kept = store.logicalAnd(kept, store.equal(now.number, before.number));
  };
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    keep(state.shift[axis], entry.shift[axis]);
    keep(state.local[axis], entry.local[axis]);
  }
  keep(state.lengthOffset, entry.lengthOffset);
  return store.logicalAnd(kept, store.logicalNot(state.transformed.term));
}

TermId codesKept(const ExploredProgram &program, const SymbolicState &state) {
  smt::TermStore &store = program.start.store();
  const ModalTable modes(program.subject.dialect());
  TermId kept = store.yes();
  for (std::size_t group = 1; group < kModalGroups; ++group)
    if (!modes.group(group).codes.empty())
      kept = store.logicalAnd(kept, store.equal(state.codes[group].index, program.start.entry().codes[group].index));
  return kept;
}

TermId promisedAt(const ExploredProgram &program, const Ensure &ensure, const SymbolicState &state) {
  if (const auto *expression = std::get_if<ExpressionId>(&ensure.promise))
    return program.start.terms().condition(*expression, program.start.entry(), state);
  if (const auto *codes = std::get_if<std::vector<ModalCode>>(&ensure.promise))
    return codesHold(program, *codes, state);
  return program.start.store().logicalAnd(codesKept(program, state), settingsKept(program, state));
}

} // namespace

Questions promiseQuestions(const ExploredProgram &program) {
  Questions all = callQuestions(program);
  if (!program.subject.contract())
    return all;
  append(all, ensureQuestions(program));
  append(all, assignQuestions(program));
  append(all, alarmQuestions(program));
  append(all, limitQuestions(program));
  return all;
}

Questions ensureQuestions(const ExploredProgram &program) {
  const auto &[subject, start, found] = program;
  Questions questions;
  for (const Ensure &ensure : subject.contract()->ensures) {
    const ObligationKind kind = std::holds_alternative<ModalPreserved>(ensure.promise) ? ObligationKind::ModalPreserved
                                                                                       : ObligationKind::Ensures;
    if (!subject.wants(kind))
      continue;
    Question question = promise(subject, kind, ensure.clause);
    for (const PathExit &exit : found.exits)
      question.goals.push_back({&exit.conditions, promisedAt(program, ensure, exit.state)});
    questions.push_back(std::move(question));
  }
  return questions;
}

Questions assignQuestions(const ExploredProgram &program) {
  const auto &[subject, start, found] = program;
  const Contract &contract = *subject.contract();
  if (contract.assigns.empty() || !subject.wants(ObligationKind::Assigns))
    return {};
  const auto allowed = [&](std::uint32_t variable) {
    for (const Assigns &assigns : contract.assigns)
      for (const Assigns::Variables &range : assigns.variables)
        if (range.first <= variable && variable <= range.last)
          return true;
    return false;
  };
  smt::TermStore &store = start.store();
  Question question = promise(subject, ObligationKind::Assigns, contract.assigns.front().clause);
  for (const PathExit &exit : found.exits) {
    TermId kept = store.yes();
    for (const auto &[variable, value] : exit.state.variables.entries()) {
      const VariableRange *row = variable < kFirstNamedVariable ? findVariable(subject.dialect(), variable) : nullptr;
      if (!row || row->kind == VariableKind::System || row->kind == VariableKind::Local || allowed(variable))
        continue;
      const SymbolicValue before = start.reading().atEntry(variable);
      kept = store.logicalAnd(
          kept, store.logicalAnd(store.equal(value.vacant, before.vacant), store.equal(value.number, before.number)));
    }
    if (!exit.state.forgotten.empty())
      question.open = "a variable whose number is not known is written";
    question.goals.push_back({&exit.conditions, kept});
  }
  return {std::move(question)};
}

/// IF: a call for which the condition holds ends with this alarm and no other way.  IFF: no other call raises it.
Questions alarmQuestions(const ExploredProgram &program) {
  const auto &[subject, start, found] = program;
  Questions questions;
  if (!subject.wants(ObligationKind::AlarmIff))
    return questions;
  smt::TermStore &store = start.store();
  for (const AlarmPromise &alarm : subject.contract()->alarms) {
    const TermId condition = start.terms().condition(alarm.condition, start.entry(), start.entry());
    const TermId number = start.reading().number(alarm.number).number;
    const bool isIff = alarm.claim == AlarmClaim::IfAndOnlyIf;
    Question question = promise(subject, ObligationKind::AlarmIff, alarm.clause);
    question.row.id = fmt::format("{}.alarm-iff.{}", subject.name(), alarm.number);
    question.broken = [](const RunResult &run, const GivenVariables &) { return howItEnded(run); };
    for (const PathExit &exit : found.exits)
      question.goals.push_back({&exit.conditions, store.logicalNot(condition)});
    for (const Check &check : found.checks)
      for (const CheckInstance &instance : check.instances) {
        const TermId isThis = check.alarm ? store.no() : store.equal(instance.number.number, number);
        question.goals.push_back({&instance.conditions, store.implies(condition, isThis), instance.stops});
        if (isIff)
          question.goals.push_back({&instance.conditions, store.implies(isThis, condition), instance.stops});
      }
    for (const UnfollowedCall &call : found.unfollowedCalls) // which may end with any alarm
      question.goals.push_back({&call.conditions, isIff ? store.no() : store.logicalNot(condition)});
    questions.push_back(std::move(question));
  }
  return questions;
}

} // namespace feedhold::prove
