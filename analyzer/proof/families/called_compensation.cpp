#include "proof/families/called_compensation.h"

#include "meaning/cfg/reached_programs.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

namespace {

/// A code with which compensation begins.
bool isSide(const ProgramFile &file, const Word &word) {
  const auto tenths = word.address() == 'G' ? word.tenths() : std::nullopt;
  const Code *code = tenths ? findGCode(*file.dialect, *tenths) : nullptr;
  return code != nullptr && beginsCompensation(code->action);
}
/// The text has such a code, or a computed G code, which may be one.
bool namesSide(const ProgramFile &file) {
  return std::ranges::any_of(file.tree->words, [&](const Word &word) {
    return isSide(file, word) || (word.address() == 'G' && !word.tenths());
  });
}

bool hasContract(const ProofSubject &subject, ProgramRef program) {
  if (program == ProgramRef{subject.program.file, subject.program.program})
    return subject.contract() != nullptr;
  return subject.contractsOf({program.file, NodeId(0), program.program}) != nullptr;
}

bool isCovered(const ProofSubject &subject, ProgramRef program, std::set<ProgramRef> open) {
  if (hasContract(subject, program) || !open.insert(program).second)
    return false;
  const auto callers = subject.programs.callGraph().callers(program);
  return !callers.empty() && std::ranges::all_of(callers, [&](const CallGraph::Caller &caller) {
    const ProgramRef by{caller.file, subject.programs.file(caller.file).model->calls[caller.call].caller};
    return hasContract(subject, by) || isCovered(subject, by, open);
  });
}

/// Programs without a contract, by way of such programs alone: others answer for themselves.
std::vector<ProgramRef> reachedBy(const ProofSubject &subject, const Call &call) {
  std::vector<ProgramRef> open = subject.programs.callGraph().candidates(subject.program.file, call);
  std::vector<ProgramRef> reached;
  while (!open.empty()) {
    const ProgramRef next = open.back();
    open.pop_back();
    if (hasContract(subject, next) || std::ranges::count(reached, next) != 0)
      continue;
    reached.push_back(next);
    for (const Call &inner : subject.programs.file(next.file).model->callsOf(next.program)) {
      const auto callees = subject.programs.callGraph().candidates(next.file, inner);
      open.insert(open.end(), callees.begin(), callees.end());
    }
  }
  std::ranges::sort(reached);
  return reached;
}

/// Where compensation begins in the program.
std::vector<Place> beginningsIn(const ExploredProgram &explored, ProgramRef program) {
  const ProgramFile &file = explored.subject.programs.file(program.file);
  const auto blockOf = [&](Place place) { return explored.subject.programs.node(place).block; };
  std::vector<Place> places;
  for (const StopSite &stop : explored.found.stopSites)
    if (stop.alarm == AlarmKind::CutterCompensation && stop.place.file == program.file &&
        file.model->programOf(blockOf(stop.place)) == program.program)
      places.push_back(stop.place);
  const Program &own = file.model->programs[program.program];
  for (BlockId block = own.first; block < own.last; block = block.next()) { // no path may have come to it
    const bool isKnown = std::ranges::any_of(places, [&](Place place) { return blockOf(place) == block; });
    if (!isKnown &&
        std::ranges::any_of(file.tree->wordsOf(block), [&](const Word &word) { return isSide(file, word); }))
      places.push_back({program.file, file.cfg.nodeOf(block)});
  }
  return places;
}

Question askOf(const ExploredProgram &explored, const Call &call, Place began) {
  const auto &[subject, start, found] = explored;
  const ProgramFile &callee = subject.programs.file(began.file);
  const BlockId block = subject.programs.node(began).block;
  const Place place{subject.program.file, subject.file().cfg.nodeOf(call.block)};
  Question question{
      .row = subject.obligation(ObligationKind::Compensation, place, subject.spanOf(place),
                                "the control never stops in the cutter compensation that begins in " +
                                    subject.lineOf(began)),
      .goals = {},
      .broken = [began](const RunResult &run, const GivenVariables &) { return stopInCompensation(run, began); }};
  question.row.alarm = AlarmKind::CutterCompensation;
  question.row.id += fmt::format(".{}.L{}", toString(callee.model->programs[callee.model->programOf(block)].name),
                                 callee.source->lineOf(callee.tree->blocks[block].span().begin));
  if (askCompensation(found, began, question))
    return question;
  for (const StopSite &stop : found.stopSites)
    if (stop.alarm == AlarmKind::CutterCompensation && stop.place == began)
      for (const StopInstance &instance : stop.instances)
        question.goals.push_back({&instance.conditions, start.store().logicalNot(instance.stops)});
  return question;
}

} // namespace

bool beginsNoCompensation(const ProofSubject &subject) {
  ReachedPrograms reached;
  collectReached(subject.programs, {subject.program.file, subject.program.program}, reached);
  return !reached.orAny && std::ranges::none_of(reached.programs, [&](const ProgramRef &program) {
    return namesSide(subject.programs.file(program.file));
  });
}

bool isCoveredByCallers(const ProofSubject &subject, ProgramRef program) { return isCovered(subject, program, {}); }

Questions calledCompensations(const ExploredProgram &explored) {
  const ProofSubject &subject = explored.subject;
  std::set<Place> asked;
  Questions questions;
  for (const Call &call : subject.file().model->callsOf(subject.program.program))
    for (const ProgramRef program : reachedBy(subject, call))
      for (const Place began : beginningsIn(explored, program))
        if (asked.insert(began).second)
          questions.push_back(askOf(explored, call, began));
  return questions;
}

bool askCompensation(const Exploration &found, Place began, Question &question) {
  for (const CutterClaim &claim : found.cutterClaims)
    if (claim.began == began) {
      question.goals.push_back({&claim.conditions, claim.goal});
      if (question.whyOpen.empty() && !claim.why.empty())
        question.whyOpen = "the path of the tool's centre is not followed: " + claim.why;
    }
  if (question.goals.empty())
    question.whyOpen = "the path of the tool's centre under G41 and G42 is not followed; state the offset of D with "
                       "`@OFFSET`, or the tool with `@TOOL`; `feedhold run` follows it for given arguments";
  return !question.goals.empty();
}

std::optional<std::string> stopInCompensation(const RunResult &run, Place began) {
  if (run.end != RunEnd::Alarm || run.compensation != began)
    return std::nullopt;
  return fmt::format("stops: {}{}", meaningOf(run.alarm),
                     run.offsetIsAssumed ? "; the offset of D is taken to be the radius of `@TOOL`" : "");
}

} // namespace feedhold::prove
