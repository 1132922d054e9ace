// Verdicts as SARIF 2.1.0: what is refuted is an error, what is unknown a warning, what holds without any margin a
// note; each kind of obligation is a rule.  What else is proved is left out: services show every result as something to
// do.
#include "proof/obligation/obligation_kinds.h"
#include "surface/sink/prove_shown.h"
#include "surface/sink/sarif_parts.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

using prove::Obligation;
using prove::ObligationKind;
using prove::Verdict;
using sarif::Json;

std::string_view summaryOf(ObligationKind kind) {
  switch (kind) {
  case ObligationKind::LoopEnds: return "every loop ends";
  case ObligationKind::ProgramEnds: return "every run of the program ends";
  case ObligationKind::AlarmUnreachable: return "no call raises the alarm of this `#3000`";
  case ObligationKind::Compensation: return "the control does not stop in a cutter compensation";
  case ObligationKind::NoControlAlarm: return "the control does not stop the program with an alarm of its own";
  case ObligationKind::AlarmIff: return "the alarm is raised for the calls that the contract states";
  case ObligationKind::Ensures: return "the promise of the contract holds at the return";
  case ObligationKind::Assigns: return "only the listed common variables are written";
  case ObligationKind::ModalPreserved: return "the modal state at the return is the same as at the entry";
  case ObligationKind::Guarded: return "calls outside the contract raise an alarm before an axis moves";
  case ObligationKind::CallMeetsContract: return "a call satisfies the contract of the program that it calls";
  case ObligationKind::ContractSatisfiable: return "at least one call satisfies the contract";
  case ObligationKind::KeepIn: return "cutting moves keep the tool inside the region";
  case ObligationKind::KeepOut: return "no move brings the tool into the region";
  case ObligationKind::Clearance: return "rapid moves stay above the clearance height";
  case ObligationKind::Travel: return "no move leaves the travel limits";
  case ObligationKind::Limit: return "feed and spindle speed stay within their limits while cutting";
  }
  FEEDHOLD_UNREACHABLE("the switch names every kind");
}

/// Something for a person to look at.
bool isOpen(const Obligation &obligation) {
  return obligation.verdict == Verdict::Refuted || obligation.verdict == Verdict::Unknown ||
         obligation.verdict.exactOnly();
}

std::string_view levelOf(const Obligation &obligation) {
  if (obligation.verdict.exactOnly())
    return "note";
  return obligation.verdict == Verdict::Refuted ? "error" : "warning";
}

std::string textFor(const Obligation &obligation, const ProvedFile &file, const ProvedProgram &program,
                    const ProveReport &report) {
  if (obligation.verdict.exactOnly())
    return claimOf(obligation, file.project->dialect()) + "\n" + std::string(kExactOnly);
  std::string text = messageOf(obligation, file.project->dialect());
  if (!obligation.verdict.reason().empty())
    text += fmt::format("\n{}", obligation.verdict.reason());
  if (obligation.verdict.witness()) {
    const TypedWitness witness = typed(*obligation.verdict.witness(), file, program, report);
    text += "\n" + textOf(witness) + ": " +
            happenedIn(*obligation.verdict.witness(), obligation, file.project->dialect()) +
            "\nreplay it: " + witness.run();
  }
  if (obligation.verdict.guard())
    text += "\n" + remedyOf(*obligation.verdict.guard());
  return text;
}

Json resultFor(const Obligation &obligation, const ProvedFile &file, const ProvedProgram &program,
               const ProveReport &report) {
  const ProjectFile &there = file.project->file(obligation.place.file);
  Json location = {
      {"physicalLocation", sarif::physicalLocation(there.shown, there.source, obligation.span, report.root)},
      {"logicalLocations", Json::array({Json{{"fullyQualifiedName", obligation.id}}})}};
  Json row = {{"ruleId", nameOf(obligation.kind)},
              {"ruleIndex", static_cast<std::size_t>(obligation.kind)},
              {"kind", "fail"},
              {"level", levelOf(obligation)},
              {"message", {{"text", textFor(obligation, file, program, report)}}},
              {"locations", Json::array({std::move(location)})},
              {"partialFingerprints", {{"primaryLocationLineHash", obligation.id + ":1"}}},
              {"properties", Json{{"verdict", nameOf(obligation.verdict)}, {"arithmetic", report.arithmetic}}}};
  if (obligation.verdict.guard() && obligation.verdict.guard()->fix)
    row["fixes"] =
        Json::array({sarif::fixToJson(*obligation.verdict.guard()->fix, there.shown, there.source, report.root)});
  return row;
}

Json driver(const ProveReport &report) {
  Json row = {{"name", "Feedhold"}, {"semanticVersion", report.version}, {"rules", Json::array()}};
  for (const ObligationKind kind : prove::kObligationKinds)
    row["rules"].push_back({{"id", nameOf(kind)}, {"shortDescription", {{"text", summaryOf(kind)}}}});
  return row;
}

} // namespace

std::string writeProveSarif(const ProveReport &report) {
  Json results = Json::array();
  for (const ProvedFile &file : report.result.files)
    for (const ProvedProgram &program : file.programs)
      for (const Obligation &obligation : program.proof.obligations)
        if (isOpen(obligation))
          results.push_back(resultFor(obligation, file, program, report));
  return sarif::documentText({driver(report), nullptr, std::move(results)},
                             {report.result.errors, report.result.skipped, report.exitCode}, report.root);
}

} // namespace feedhold
