// Stops: no run reaches `#3000=` or an alarm of the control, unless the contract declares the alarm.
#include "proof/families/called_compensation.h"
#include "proof/families/families.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::TermId;

namespace {

/// Those that the contract foresees: for which calls they come, and whether for others too, its clauses say, which are
/// claims of their own (alarmQuestions).
std::vector<std::uint32_t> foreseenAlarms(const Contract *contract) {
  std::vector<std::uint32_t> numbers;
  if (contract != nullptr)
    for (const AlarmPromise &promise : contract->alarms)
      numbers.push_back(promise.number);
  return numbers;
}

/// What a run that breaks the claim on this place does.
auto stopAt(const StopSite &stop, const std::vector<std::uint32_t> &foreseen) {
  return [place = stop.place, span = stop.span, alarm = stop.alarm,
          foreseen](const RunResult &run, const GivenVariables &) -> std::optional<std::string> {
    const bool here = run.place == place && run.alarmSpan == span;
    const bool isForeseen = std::any_of(foreseen.begin(), foreseen.end(), [&](std::uint32_t number) {
      return static_cast<double>(number) == run.alarmNumber;
    });
    if (!alarm && here && run.end == RunEnd::UserAlarm && !isForeseen)
      return fmt::format("stops with alarm {:.15g}", run.alarmNumber);
    if (alarm == AlarmKind::CutterCompensation)
      return stopInCompensation(run, place);
    if (alarm && here && run.end == RunEnd::Alarm && run.alarm == *alarm)
      return "the control stops here";
    return std::nullopt;
  };
}

ObligationKind kindOf(const StopSite &stop) {
  if (!stop.alarm)
    return ObligationKind::AlarmUnreachable;
  return stop.alarm == AlarmKind::CutterCompensation ? ObligationKind::Compensation : ObligationKind::NoControlAlarm;
}

std::string stopClaim(const StopSite &stop, const std::vector<std::uint32_t> &foreseen) {
  if (stop.alarm == AlarmKind::CutterCompensation)
    return "the control never stops in the cutter compensation that begins here";
  if (stop.alarm)
    return fmt::format("no {} here", meaningOf(*stop.alarm));
  if (foreseen.empty())
    return "this alarm is never raised";
  return "this block raises only alarms that the contract declares";
}

TermId isOneOf(SymbolicInterpretation &interpretation, const SymbolicValue &value,
               const std::vector<std::uint32_t> &numbers) {
  smt::TermStore &store = interpretation.store();
  std::vector<TermId> any;
  for (const std::uint32_t number : numbers)
    any.push_back(store.equal(value.number, interpretation.number(number).number));
  return store.logicalAnd(store.logicalNot(value.vacant), store.logicalOr(any));
}

/// The node that assigns: the same as where a path meets it, so that it is the same claim.
NodeId writeOf(const ProgramFile &file, const VariableUse &use) {
  NodeId node = file.cfg.nodeOf(use.block);
  for (NodeId at = node; at.index() < file.cfg.nodes.size() && file.cfg.nodes[at].block == use.block; at = at.next())
    if (const auto *assign = std::get_if<Assign>(&file.cfg.nodes[at].instruction))
      for (std::uint32_t i = 0; i < assign->count; ++i) {
        const Statement &statement = file.tree->statements[StatementId(assign->first.index() + i)];
        if (const auto *assignment = std::get_if<Assignment>(&statement.node);
            assignment && assignment->target == use.expression)
          node = at;
      }
  return node;
}

} // namespace

Questions stopQuestions(const ExploredProgram &program) {
  const auto &[subject, start, found] = program;
  smt::TermStore &store = start.store();
  const std::vector<std::uint32_t> foreseen = foreseenAlarms(subject.contract());
  std::optional<bool> isOfCaller;
  const bool isCovered = isCoveredByCallers(subject, {subject.program.file, subject.program.program});
  Questions questions;
  if (subject.contract() && subject.wants(ObligationKind::Compensation))
    questions = calledCompensations(program);
  for (const StopSite &stop : found.stopSites) {
    const ObligationKind kind = kindOf(stop);
    if (!subject.isOwn(stop.place) || !subject.wants(kind))
      continue;
    if (kind == ObligationKind::Compensation && !isOfCaller)
      isOfCaller = beginsNoCompensation(subject);
    if (kind == ObligationKind::Compensation && (*isOfCaller || isCovered))
      continue;
    Question question{.row = subject.obligation(kind, stop.place, stop.span, stopClaim(stop, foreseen)),
                      .goals = {},
                      .broken = stopAt(stop, foreseen)};
    question.row.alarm = stop.alarm;
    if (kind == ObligationKind::Compensation && askCompensation(found, stop.place, question)) {
      questions.push_back(std::move(question));
      continue;
    }
    for (const StopInstance &instance : stop.instances) {
      const TermId isForeseen = stop.alarm ? store.no() : isOneOf(start.interpretation(), instance.number, foreseen);
      question.goals.push_back({&instance.conditions, store.implies(instance.stops, isForeseen)});
    }
    questions.push_back(std::move(question));
  }
  return questions;
}

Questions unmetAlarms(const ExploredProgram &program) {
  const auto &[subject, start, found] = program;
  Questions questions;
  if (!subject.wants(ObligationKind::AlarmUnreachable))
    return questions;
  const auto isMet = [&subject = subject, &found = found](BlockId block, Span span) {
    return std::any_of(found.stopSites.begin(), found.stopSites.end(), [&](const StopSite &stop) {
      return !stop.alarm && stop.place.file == subject.program.file && stop.span == span &&
             subject.programs.node(stop.place).block == block;
    });
  };
  for (const VariableUse &use : subject.file().model->variablesOf(subject.program.program)) {
    const VariableRange *row = use.write && use.number ? findVariable(subject.dialect(), *use.number) : nullptr;
    const Span span = subject.file().tree->expressions[use.expression].span;
    if (!row || row->role != VariableRole::Alarm || isMet(use.block, span))
      continue;
    const StopSite stop{
        .place = {subject.program.file, writeOf(subject.file(), use)}, .span = span, .alarm = {}, .instances = {}};
    questions.push_back({.row = subject.obligation(ObligationKind::AlarmUnreachable, stop.place, stop.span,
                                                   stopClaim(stop, foreseenAlarms(subject.contract()))),
                         .goals = {},
                         .broken = stopAt(stop, foreseenAlarms(subject.contract()))});
  }
  return questions;
}

} // namespace feedhold::prove
