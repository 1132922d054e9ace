// Verdicts for programs; their shape is docs/schemas/prove.schema.json.
#include "surface/sink/json_parts.h"
#include "surface/sink/prove_shown.h"

#include <cmath>

namespace feedhold {

namespace {

using json::Json;
using prove::Obligation;

Json orNull(std::string_view text) { return text.empty() ? Json() : Json(text); }

/// A coordinate to the micrometre of a micrometre: what the geometry rounds is no part of it.
double asShown(double value) { return std::round(value * 1e6) / 1e6 + 0.0; }

class FileJson {
public:
  FileJson(const ProveReport &report, const ProvedFile &file) : report_(report), file_(file) {}

  Json write() {
    Json programs = Json::array();
    Json obligations = Json::array();
    for (const ProvedProgram &program : file_.programs) {
      programs.push_back(programToJson(program));
      for (const Obligation &obligation : program.proof.obligations)
        obligations.push_back(obligationToJson(obligation, program));
    }
    return {{"path", file_.file().shown},
            {"dialect", file_.project->dialect().id},
            {"programs", std::move(programs)},
            {"obligations", std::move(obligations)}};
  }

private:
  std::string nameOf(const ProvedProgram &program) const {
    return toString(file_.file().model.programs[program.program].name);
  }
  Json programToJson(const ProvedProgram &program) const {
    Json unmodelled = Json::array();
    for (const prove::Unmodelled &each : program.proof.unmodelled) {
      const ProjectFile &file = file_.project->file(each.place.file);
      const Position at = file.source.position(each.span.begin);
      unmodelled.push_back({{"reason", each.reason}, {"path", file.shown}, {"line", at.line}, {"column", at.column}});
    }
    return {{"name", nameOf(program)},
            {"incomplete", program.proof.incomplete ? Json(*program.proof.incomplete) : Json()},
            {"unmodelled", std::move(unmodelled)}};
  }
  Json obligationToJson(const Obligation &obligation, const ProvedProgram &program) const {
    const prove::Verdict &verdict = obligation.verdict;
    const Position at = file_.project->file(obligation.place.file).source.position(obligation.span.begin);
    return {{"id", obligation.id},
            {"program", nameOf(program)},
            {"kind", prove::nameOf(obligation.kind)},
            {"line", at.line},
            {"column", at.column},
            {"claim", claimOf(obligation, file_.project->dialect())},
            {"verdict", prove::nameOf(verdict)},
            {"grade", verdict.grade() ? Json(prove::nameOf(*verdict.grade())) : Json()},
            {"method", orNull(verdict.method())},
            {"reason", orNull(verdict.reason())},
            {"exactOnly", verdict.exactOnly()},
            {"ifReturning", obligation.returning},
            {"ifPromising", obligation.promising},
            {"ifUnchanged", obligation.unchanged},
            {"ifPassesAtMost", obligation.takesFewPasses ? Json(prove::kMostPasses) : Json()},
            {"ifOffsetOfTool", obligation.offsetIsOfTool},
            {"bound", orNull(verdict.bound())},
            {"margin", verdict.margin() ? Json(*verdict.margin()) : Json()},
            {"tolerance", obligation.tolerance ? Json(*obligation.tolerance) : Json()},
            {"witness", verdict.witness() ? witnessToJson(obligation, program) : Json()},
            {"guard", verdict.guard() ? guardToJson(obligation) : Json()},
            {"effort", obligation.effort}};
  }
  Json guardToJson(const Obligation &obligation) const {
    const auto &[conditions, clause, fix, exactOnly] = *obligation.verdict.guard();
    const SourceFile &source = file_.project->file(obligation.place.file).source;
    return {{"conditions", conditions},
            {"clause", clause},
            {"exactOnly", exactOnly},
            {"fix", fix ? json::fixToJson(*fix, source) : Json()}};
  }
  Json witnessToJson(const Obligation &obligation, const ProvedProgram &program) const {
    const prove::Witness &witness = *obligation.verdict.witness();
    const TypedWitness call = typed(witness, file_, program, report_);
    Json variables = Json::object();
    for (const auto &[name, value] : call.variables)
      variables[name] = value;
    Json readings = Json::object();
    for (const auto &[name, script] : call.readings)
      readings[name] = script;
    return {{"call", call.call ? Json(*call.call) : Json()},
            {"variables", std::move(variables)},
            {"inputs", std::move(readings)},
            {"start", json::startToJson(call.modal, call.place, call.settings)},
            {"run", call.run()},
            {"end", feedhold::nameOf(witness.end)},
            {"happened", happenedIn(witness, obligation, file_.project->dialect())},
            {"ifReturning", witness.returning},
            {"gouge", witness.gouge ? gougeToJson(*witness.gouge) : Json()}};
  }
  Json gougeToJson(const prove::GougeAt &gouge) const {
    const ProjectFile &file = file_.project->file(gouge.place.file);
    const BlockId block = file_.project->set->node(gouge.place).block;
    const auto &[x, y, z] = gouge.at;
    return {{"path", file.shown}, {"line", file.source.lineOf(file.tree.blocks[block].span().begin)},
            {"x", asShown(x)},    {"y", asShown(y)},
            {"z", asShown(z)},    {"depth", gouge.depth}};
  }

  const ProveReport &report_;
  const ProvedFile &file_;
};

} // namespace

std::string writeProveJson(const ProveReport &report) {
  Json document = {{"version", 3},
                   {"arithmetic", report.arithmetic},
                   {"files", Json::array()},
                   {"skipped", Json::array()},
                   {"errors", Json::array()}};
  for (const ProvedFile &file : report.result.files)
    document["files"].push_back(FileJson(report, file).write());
  for (const SkippedFile &skipped : report.result.skipped)
    document["skipped"].push_back({{"path", skipped.path}, {"reason", skipped.reason}});
  for (const PathProblem &problem : report.result.errors)
    document["errors"].push_back({{"path", problem.path}, {"message", problem.message}});
  // A path may hold bytes that are no UTF-8; they become U+FFFD.
  return json::documentText(document);
}

} // namespace feedhold
