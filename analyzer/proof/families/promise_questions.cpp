// What the contract of a program promises for its return, and for the calls that raise alarms.
#include "language/contract/assigned_cells.h"
#include "language/contract/reserved.h"
#include "proof/families/families.h"
#include "proof/families/modal_state.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

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
  case RunEnd::Alarm: return "the control stops the program with an alarm of its own";
  case RunEnd::Fuel:
  case RunEnd::Repeats:
  case RunEnd::Unmodelled: return std::nullopt;
  }
  return std::nullopt;
}

/// Promised of runs that come to their end.
std::optional<std::string> brokenAtEnd(const RunResult &run, const GivenVariables &) {
  const auto end = howItEnded(run);
  if (!end || run.end == RunEnd::UserAlarm || run.end == RunEnd::Alarm)
    return std::nullopt;
  return *end + ", and the promise does not hold";
}

/// `POS[X]` in the promise: a run that does not know where it is shows nothing of it.
bool namesPosition(const SyntaxTree &tree, ExpressionId expression) {
  const auto number = reservedNumber(tree, expression);
  const auto reserved = number ? reservedVariable(*number) : std::nullopt;
  return (reserved && std::holds_alternative<PositionOf>(*reserved)) ||
         std::ranges::any_of(childrenOf(tree, expression),
                             [&](ExpressionId child) { return namesPosition(tree, child); });
}

/// Broken as soon as the write happens, however the run ends.
std::optional<std::string> brokenByWrite(const RunResult &run) {
  if (run.end == RunEnd::Fuel || run.end == RunEnd::Unmodelled)
    return std::nullopt;
  return "the run changes a variable that the clause does not list";
}

/// A write of it outlasts the program, or is seen outside of it.
bool isSeenByOthers(const ProofSubject &subject, std::uint32_t variable) {
  if (variable >= kFirstNamedVariable)
    return subject.programs.isGlobalName(variable);
  const VariableRange *row = findVariable(subject.dialect(), variable);
  return row && row->kind != VariableKind::Local;
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
    all = index ? store.logicalAnd(all, store.equal(state.codes[row->group].index,
                                                    program.start.interpretation().code(*index).index))
                : store.no();
  }
  return all;
}

TermId promisedAt(const ExploredProgram &program, const Ensure &ensure, const SymbolicState &state) {
  if (const auto *expression = std::get_if<ExpressionId>(&ensure.promise))
    return program.start.terms().promise(*program.subject.contract(), *expression, program.start.entry(), state);
  if (const auto *codes = std::get_if<std::vector<ModalCode>>(&ensure.promise))
    return codesHold(program, *codes, state);
  return modalStateKept(program, std::get<ModalPreserved>(ensure.promise), state);
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
    question.promise = &ensure;
    if (const auto *expression = std::get_if<ExpressionId>(&ensure.promise);
        expression && namesPosition(subject.contracts->tree, *expression))
      question.broken = [](const RunResult &run, const GivenVariables &given) {
        return run.isLost ? std::nullopt : brokenAtEnd(run, given);
      };
    for (const PathExit &exit : found.exits)
      question.goals.push_back({&exit.conditions, promisedAt(program, ensure, exit.state)});
    if (const auto *kept = std::get_if<ModalPreserved>(&ensure.promise)) {
      question.whyOpen = whyNotKept(program, *kept);
      if (modeNotTold(program))
        question.open = question.whyOpen;
    }
    questions.push_back(std::move(question));
  }
  return questions;
}

Questions assignQuestions(const ExploredProgram &program) {
  const auto &[subject, start, found] = program;
  const Contract &contract = *subject.contract();
  if (contract.assigns.empty() || !subject.wants(ObligationKind::Assigns))
    return {};
  const std::set<std::uint32_t> allowed = assignedCells(subject.dialect(), contract.assigns);
  Question question = promise(subject, ObligationKind::Assigns, contract.assigns.front().clause);
  question.broken = [](const RunResult &run, const GivenVariables &) { return brokenByWrite(run); };
  for (const WriteInstance &write : found.writes) {
    if (!write.variable)
      question.open = fmt::format("{} writes a variable whose number is unknown", subject.lineOf(write.place));
    else if (isSeenByOthers(subject, *write.variable) && !allowed.contains(*write.variable))
      question.goals.push_back(
          {.conditions = &write.conditions,
           .goal = write.isKept,
           .missedBy = fmt::format("{} changes `{}`, which the clause does not list", subject.lineOf(write.place),
                                   subject.programs.nameOfVariable(*write.variable))});
  }
  const auto any = std::ranges::find(found.unmodelledCalls, false, &UnmodelledCall::tellsWrites);
  if (any != found.unmodelledCalls.end())
    question.open = fmt::format("{}; it may write any variable", any->why);
  if (question.goals.empty() && !found.incomplete) // there is nothing to break it
    question.goals.push_back({&start.demands(), start.store().yes()});
  return {std::move(question)};
}

/// IF: a call for which the condition holds ends with this alarm and not otherwise.  IFF: no other call raises it.
Questions alarmQuestions(const ExploredProgram &program) {
  const auto &[subject, start, found] = program;
  Questions questions;
  if (!subject.wants(ObligationKind::AlarmIff))
    return questions;
  smt::TermStore &store = start.store();
  for (const AlarmPromise &alarm : subject.contract()->alarms) {
    const TermId condition = start.terms().condition(alarm.condition, start.entry(), start.entry());
    const TermId number = start.interpretation().number(alarm.number).number;
    const bool isIff = alarm.claim == AlarmClaim::IfAndOnlyIf;
    Question question = promise(subject, ObligationKind::AlarmIff, alarm.clause);
    question.row.id = fmt::format("{}.alarm-iff.{}", subject.name(), alarm.number);
    question.broken = [](const RunResult &run, const GivenVariables &) { return howItEnded(run); };
    for (const PathExit &exit : found.exits)
      question.goals.push_back({&exit.conditions, store.logicalNot(condition)});
    for (const StopSite &stop : found.stopSites)
      for (const StopInstance &instance : stop.instances) {
        const TermId isThis = stop.alarm ? store.no() : store.equal(instance.number.number, number);
        question.goals.push_back({&instance.conditions, store.implies(condition, isThis), instance.stops});
        if (isIff)
          question.goals.push_back({&instance.conditions, store.implies(isThis, condition), instance.stops});
      }
    for (const UnmodelledCall &call : found.unmodelledCalls)
      if (call.returning.empty()) // it may end with any alarm
        question.goals.push_back({&call.conditions, isIff ? store.no() : store.logicalNot(condition)});
    questions.push_back(std::move(question));
  }
  return questions;
}

} // namespace feedhold::prove
