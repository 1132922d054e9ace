// certificate.json: what was proved of which bytes, under which settings.
#include "base/support/sha256.h"
#include "base/support/text.h"
#include "language/dialect/g_code_system.h"
#include "surface/evidence/reading_json.h"
#include "surface/report/report_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace feedhold::certificate {

namespace {

namespace fs = std::filesystem;
using prove::Obligation;
using prove::Verdict;

Json countsToJson(const VerdictCounts &counts) {
  Json row = Json::object();
  for (const Verdict::Kind verdict : {Verdict::Proved, Verdict::Refuted, Verdict::Unknown, Verdict::Unreachable})
    row[std::string(prove::nameOf(verdict))] = counts.of(verdict);
  return row;
}

/// `POCKET FROM THE MIDDLE`: the comment behind the name of a program.
std::string titleOf(const ProjectFile &file, ProgramId program) {
  const std::uint32_t header = file.source.lineOf(file.model.programs[program].header.begin);
  for (const Comment &comment : file.tree.comments)
    if (file.source.lineOf(comment.span.begin) == header) {
      std::string text = file.source.utf8(comment.span);
      std::erase_if(text, [](char c) { return c == '(' || c == ')'; });
      return std::string(trimmed(text));
    }
  return {};
}

class Document {
public:
  Document(const ReportInput &input, const Bundle &evidence,
           const std::vector<std::vector<std::vector<ShownRun>>> &runs)
      : input_(input), runs_(runs) {
    const std::string &text = evidence.at(std::string(kBundleIndex));
    indexSha_ = sha256(text);
    const Json index = Json::parse(text);
    for (const Json &file : index.at("files"))
      evidence_[file.at("path")] = file.at("obligations");
  }

  Json write() {
    Json files = Json::array();
    std::vector<std::pair<std::string, std::size_t>> order;
    for (std::size_t i = 0; i < input_.proofs.files.size(); ++i)
      order.emplace_back(relative(input_.proofs.files[i].file().path), i);
    std::sort(order.begin(), order.end());
    for (const auto &[path, index] : order)
      files.push_back(fileToJson(path, index));
    Json solvers = input_.solvers;
    return {{"version", 2},
            {"feedhold", input_.version},
            {"solvers", std::move(solvers)},
            {"selfCheck", selfCheckToJson()},
            {"date", input_.options.date ? Json(*input_.options.date) : Json()},
            {"options", optionsToJson()},
            {"counts", countsToJson(counts_)},
            {"status", nameOf(releaseStatusOf(input_.proofs))},
            {"assumptions", assumptions()},
            {"sources", sourcesToJson()},
            {"files", std::move(files)},
            {"skipped", skippedToJson()},
            {"evidence", {{"file", std::string(kEvidenceFolder) + std::string(kBundleIndex)}, {"sha256", indexSha_}}}};
  }

private:
  std::string relative(const fs::path &path) const { return pathFrom(input_.folder, path); }

  Json optionsToJson() const {
    Json options = readingToJson(input_.options.reading, input_.folder);
    options["paths"] = Json::array();
    for (const fs::path &path : input_.options.paths)
      options["paths"].push_back(relative(path));
    return options;
  }
  Json selfCheckToJson() const {
    Json rows = Json::array();
    for (const SelfCheckStep &step : input_.selfCheck)
      rows.push_back({{"name", step.name}, {"result", step.result()}, {"message", step.message()}});
    return rows;
  }
  Json skippedToJson() const {
    Json rows = Json::array();
    for (const SkippedFile &skipped : input_.proofs.skipped)
      rows.push_back({{"path", relative(skipped.path)}, {"reason", skipped.reason}});
    return rows;
  }

  // ---- what was read ----

  struct Source {
    std::string sha256;
    std::size_t bytes = 0;
    std::set<std::string> roles;
  };
  void addSource(const fs::path &path, std::string_view text, const std::string &role) {
    Source &source = sources_[relative(path)];
    if (source.roles.empty())
      source = {sha256(text), text.size(), {}};
    source.roles.insert(role);
  }
  Json sourcesToJson() const {
    Json rows = Json::array();
    for (const auto &[path, source] : sources_)
      rows.push_back({{"path", path}, {"sha256", source.sha256}, {"bytes", source.bytes}, {"roles", source.roles}});
    return rows;
  }
  void addSources(const ProvedFile &file) {
    std::set<std::size_t> called;
    for (std::size_t i = 0; i < file.project->files.size(); ++i)
      for (const Call &call : file.project->files[i]->model.calls)
        if (const auto callee = file.project->set->callGraph().callee(FileId(i), call))
          called.insert(callee->file.index());
    for (std::size_t i = 0; i < file.project->files.size(); ++i) {
      const ProjectFile &loaded = *file.project->files[i];
      addSource(loaded.path, loaded.source.text(), i == 0 ? "program" : called.contains(i) ? "called" : "same-folder");
      for (std::size_t contract = 1; contract < loaded.contracts.sources.size(); ++contract) {
        const SourceFile &source = loaded.contracts.sources[contract];
        addSource(source.path(), source.text(), "contract");
      }
    }
    if (const auto config = input_.configOf(file.file().path))
      if (const Result<SourceFile> text = SourceFile::open(*config))
        addSource(*config, text.value().text(), "configuration");
  }

  // ---- a file ----

  const CheckedFile *findingsOf(const ProvedFile &file) const {
    const auto &files = input_.findings.files;
    const auto found = std::find_if(files.begin(), files.end(),
                                    [&](const CheckedFile &each) { return each.path == file.file().shown; });
    return found == files.end() ? nullptr : &*found;
  }
  Json fileToJson(const std::string &path, std::size_t index) {
    const ProvedFile &file = input_.proofs.files[index];
    addSources(file);
    Json programs = Json::array();
    for (std::size_t i = 0; i < file.programs.size(); ++i)
      programs.push_back(programToJson(path, file, file.programs[i], runs_[index][i]));
    const auto config = input_.configOf(file.file().path);
    const CheckedFile *checked = findingsOf(file);
    Json reasons = Json::array();
    if (checked != nullptr)
      for (const std::string_view reason : checked->reasons)
        reasons.push_back(reason);
    return {{"path", path},
            {"dialect", file.project->dialect().id},
            {"control", fmt::format("{} ({})", file.project->dialect().title, file.project->dialect().controls)},
            {"chosenBy", checked ? Json(feedhold::nameOf(checked->choice)) : Json()},
            {"reasons", std::move(reasons)},
            {"config", config ? Json(relative(*config)) : Json()},
            {"switches", switchesOf(file.project->dialect(), checked)},
            {"programs", std::move(programs)},
            {"findings", checked ? findingsToJson(*checked) : Json::array()}};
  }
  /// `dpi=2`: 0 is off, 1 on, 2 not known.
  Json switchesOf(const Dialect &dialect, const CheckedFile *checked) const {
    const Dialect *plain = findDialect(input_.dialects, dialect.id);
    std::istringstream now(feedhold::textOf(dialect.switches));
    std::istringstream before(plain ? feedhold::textOf(plain->switches) : std::string());
    std::set<std::string> plainWords;
    for (std::string word; before >> word;)
      plainWords.insert(word);
    Json rows = Json::array();
    for (std::string word; now >> word;) {
      const std::size_t equals = word.find('=');
      const std::string value = word.substr(equals + 1);
      const std::string shown = value == "0" ? "off" : value == "1" ? "on" : value == "2" ? "unknown" : value;
      const std::string name = word.substr(0, equals);
      const ControlOptions &asked = input_.options.reading.control;
      const bool isAsked =
          (name == "increment-system" && asked.incrementSystem) || (name == "g-code-system" && asked.gCodeSystem);
      const bool isGuessed =
          name == "g-code-system" && checked != nullptr &&
          std::ranges::find(checked->reasons, marksOf(dialect.switches.gCodeSystem)) != checked->reasons.end();
      rows.push_back({{"name", name},
                      {"value", shown},
                      {"chosenBy", isAsked                     ? "option"
                                   : isGuessed                 ? "guess"
                                   : plainWords.contains(word) ? "dialect"
                                                               : "config"}});
    }
    return rows;
  }
  static Json findingsToJson(const CheckedFile &checked) {
    Json rows = Json::array();
    for (const Finding &finding : checked.findings) {
      const Position at = checked.source.position(finding.diagnostic.span.begin);
      rows.push_back({{"rule", finding.rule->name},
                      {"severity", nameOf(finding.severity)},
                      {"line", at.line},
                      {"message", finding.diagnostic.message},
                      {"notes", finding.diagnostic.notes},
                      {"suppressed", finding.suppressed},
                      {"reason", finding.reason.empty() ? Json() : Json(finding.reason)}});
    }
    return rows;
  }

  // ---- a program ----

  Json programToJson(const std::string &path, const ProvedFile &file, const ProvedProgram &program,
                     const std::vector<ShownRun> &runs) {
    VerdictCounts counts;
    counts.add(program.proof);
    counts_.add(program.proof);
    const ProjectFile &loaded = file.file();
    Json obligations = Json::array();
    for (const Obligation &obligation : program.proof.obligations)
      obligations.push_back(obligationToJson(obligation, path, file, program));
    return {{"name", programName(file, program)},
            {"title", titleOf(loaded, program.program)},
            {"line", loaded.source.lineOf(loaded.model.programs[program.program].header.begin)},
            {"counts", countsToJson(counts)},
            {"status", nameOf(releaseStatusOf(file, program))},
            {"summary", sentenceOf(file, program)},
            {"clauses", clausesOf(loaded, program.program)},
            {"calls", callsOf(file, program.program)},
            {"incomplete", program.proof.incomplete ? Json(*program.proof.incomplete) : Json()},
            {"unmodelled", unmodelledOf(file, program)},
            {"obligations", std::move(obligations)},
            {"runs", runsToJson(path, runs)}};
  }
  Json clausesOf(const ProjectFile &file, ProgramId program) const {
    Json rows = Json::array();
    for (const Clause &clause : file.contracts.clauses)
      if (clause.program == program) {
        const SourceFile &source = file.contracts.source(clause.source);
        rows.push_back({{"text", clause.text},
                        {"path", relative(clause.source == kProgramText ? file.path : fs::path(source.path()))},
                        {"line", source.lineOf(clause.span.begin)}});
      }
    return rows;
  }
  /// Of this program and of all that it leads to, each program once.
  Json callsOf(const ProvedFile &file, ProgramId program) const {
    Json rows = Json::array();
    std::vector<ProgramRef> open = {{FileId(0), program}};
    std::set<ProgramRef> seen(open.begin(), open.end());
    for (std::size_t i = 0; i < open.size(); ++i) {
      const ProgramRef caller = open[i];
      const ProjectFile &from = file.project->file(caller.file);
      for (const Call &call : from.model.callsOf(caller.program)) {
        const auto callee = file.project->set->callGraph().callee(caller.file, call);
        const std::string name = toString(call.callee);
        rows.push_back({{"from", nameIn(from, caller.program)},
                        {"fromPath", relative(from.path)},
                        {"line", from.source.lineOf(call.span.begin)},
                        {"to", callee         ? nameIn(file.project->file(callee->file), callee->program)
                               : name.empty() ? "a program that is computed"
                                              : name},
                        {"path", callee ? Json(relative(file.project->file(callee->file).path)) : Json()}});
        if (callee && seen.insert(*callee).second)
          open.push_back(*callee);
      }
    }
    return rows;
  }
  static std::string nameIn(const ProjectFile &file, ProgramId program) {
    const std::string name = toString(file.model.programs[program].name);
    return name.empty() ? "a program without a number" : name;
  }
  Json unmodelledOf(const ProvedFile &file, const ProvedProgram &program) const {
    Json rows = Json::array();
    for (const prove::Unmodelled &each : program.proof.unmodelled) {
      const ProjectFile &where = file.project->file(each.place.file);
      rows.push_back(
          {{"reason", each.reason}, {"path", relative(where.path)}, {"line", where.source.lineOf(each.span.begin)}});
    }
    return rows;
  }
  Json runsToJson(const std::string &path, const std::vector<ShownRun> &runs) {
    Json rows = Json::array();
    for (const ShownRun &run : runs)
      rows.push_back({{"witnessOf", run.witnessOf.empty() ? Json() : Json(run.witnessOf)},
                      {"call", run.call},
                      {"plot", fmt::format("feedhold plot {}{}", quotedWord(path), run.options + replayOptions())},
                      {"notes", run.notes},
                      {"picture", {{"file", pictureName(++pictures_)}, {"sha256", sha256(run.svg)}}}});
    return rows;
  }

public:
  static std::string pictureName(std::size_t number) { return fmt::format("pictures/{:04}.svg", number); }

private:
  /// What a replay has to be told, from the folder of the report.
  std::string replayOptions() const {
    BundleReading reading = input_.options.reading;
    if (reading.config)
      reading.config = relative(*reading.config);
    return readingOptions(reading);
  }
  static Json alarmToJson(const std::optional<RaisedAlarm> &alarm) {
    if (!alarm)
      return nullptr;
    return {{"number", alarm->number ? Json(*alarm->number) : Json()}, {"message", alarm->message}};
  }
  /// The files of its first part, and how many parts there are; the index of the evidence names the files one by one,
  /// with their hashes.
  static Json evidenceToJson(const Json &parts) {
    if (parts.empty())
      return nullptr;
    std::size_t queries = 0;
    for (const Json &part : parts)
      queries += part.contains("smtlib") ? 1 : 0;
    Json first = Json::array();
    for (const char *part : {"smtlib", "claim", "certificate"})
      if (parts.front().contains(part))
        first.push_back(std::string(kEvidenceFolder) + parts.front().at(part).at("file").get<std::string>());
    return {{"first", std::move(first)}, {"certificates", parts.size() - queries}, {"queries", queries}};
  }
  /// What the index of the evidence says of it, and what else there is to know.
  Json obligationToJson(const Obligation &obligation, const std::string &path, const ProvedFile &file,
                        const ProvedProgram &program) {
    Json row;
    for (const Json &each : evidence_.at(pathFrom(input_.folder / kEvidenceFolder, file.file().path)))
      if (each.at("id") == obligation.id)
        row = each;
    const Dialect &dialect = file.project->dialect();
    row.erase("program");
    row["evidence"] = evidenceToJson(row.at("evidence"));
    row["method"] = obligation.verdict.method().empty() ? Json() : Json(obligation.verdict.method());
    row["effort"] = obligation.effort;
    row["margin"] = obligation.verdict.margin() ? Json(*obligation.verdict.margin()) : Json();
    row["path"] = relative(file.project->file(obligation.place.file).path);
    row["line"] = file.project->file(obligation.place.file).source.lineOf(obligation.span.begin);
    row["message"] = holds(obligation.verdict) ? Json() : Json(messageOf(obligation, dialect));
    row["alarm"] = alarmToJson(raisedAlarm(obligation, file));
    row["guard"] = obligation.verdict.guard() ? Json(obligation.verdict.guard()->clause) : Json();
    if (!obligation.verdict.witness())
      return row;
    const TypedWitness call = typed(*obligation.verdict.witness(), file, program, {.result = input_.proofs});
    const std::string options = quotedWord(path) + optionsBehindFile(call, file) + replayOptions();
    Json &witness = row["witness"];
    witness["call"] = feedhold::textOf(call);
    witness["happened"] = happenedIn(*obligation.verdict.witness(), obligation, dialect);
    witness["run"] = "feedhold run " + options;
    witness["plot"] = "feedhold plot " + options;
    return row;
  }

  const ReportInput &input_;
  const std::vector<std::vector<std::vector<ShownRun>>> &runs_;
  std::map<std::string, Json> evidence_; // obligations by the path from the evidence
  std::map<std::string, Source> sources_;
  VerdictCounts counts_;
  std::size_t pictures_ = 0;
  std::string indexSha_;
};

} // namespace

std::string textOf(const Json &document) { return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json documentOf(const ReportInput &input, const Bundle &evidence,
                const std::vector<std::vector<std::vector<ShownRun>>> &runs) {
  return Document(input, evidence, runs).write();
}

} // namespace feedhold::certificate
