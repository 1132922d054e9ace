// Loads all files as one project, then runs the rules file by file.
#include "findings/session/analyse.h"

#include "base/source/path_text.h"
#include "base/support/parallel.h"
#include "base/support/text.h"
#include "base/support/turns.h"
#include "findings/project/project.h"
#include "findings/rule/run_rules.h"
#include "findings/rule/suppression.h"
#include "findings/session/analysis_keys.h"
#include "findings/session/file_analysis.h"
#include "findings/session/fingerprint.h"
#include "findings/session/other_language.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <memory>
#include <set>

namespace feedhold {

namespace {

Severity severityOf(const RawFinding &finding, const Profile &profile) {
  for (const SeveritySetting &setting : profile.severities)
    if (hasName(*finding.rule, setting.rule))
      return setting.severity;
  return finding.severity;
}

Finding toFinding(RawFinding finding, const Profile &profile) {
  const Severity severity = severityOf(finding, profile);
  return {finding.rule, severity, std::move(finding.diagnostic), {}};
}

Finding toFinding(SuppressedFinding suppressed, const FileContext &context, const Profile &profile) {
  Finding finding = toFinding(std::move(suppressed.finding), profile);
  finding.suppressed = true;
  finding.reason = std::move(suppressed.reason);
  if (suppressed.source != kProgramText)
    finding.allowedIn = context.contracts[context.file.index()]->source(suppressed.source).path();
  return finding;
}

bool comesBefore(const Finding &a, const Finding &b) {
  if (a.diagnostic.span != b.diagnostic.span)
    return a.diagnostic.span < b.diagnostic.span;
  return a.rule->name < b.rule->name;
}

/// A subprogram that several programs of the file run into is followed in each.
bool saysTheSame(const Finding &a, const Finding &b) {
  return a.rule == b.rule && a.severity == b.severity && a.diagnostic.span == b.diagnostic.span &&
         a.diagnostic.message == b.diagnostic.message && a.suppressed == b.suppressed;
}

std::vector<Finding> findingsOf(SuppressionResult raw, const FileContext &context, const Profile &profile) {
  std::vector<Finding> findings;
  findings.reserve(raw.kept.size() + raw.suppressed.size());
  for (RawFinding &finding : raw.kept)
    findings.push_back(toFinding(std::move(finding), profile));
  for (SuppressedFinding &finding : raw.suppressed)
    findings.push_back(toFinding(std::move(finding), context, profile));
  std::stable_sort(findings.begin(), findings.end(), comesBefore);
  findings.erase(std::unique(findings.begin(), findings.end(), saysTheSame), findings.end());
  Fingerprints fingerprints(context);
  for (Finding &finding : findings)
    finding.fingerprint = fingerprints.of(*finding.rule, finding.diagnostic.span);
  return findings;
}

/// A file beside the program, when there is something to say of its clauses or its suppressions.
std::optional<CheckedFile> checkSidecar(const WorkItem &item, const FileContext &program, ContractSourceId source,
                                        std::span<const SidecarFinding> ofSuppressions) {
  const FileContracts &contracts = *program.contracts[program.file.index()];
  const FileContext context{program.file,  contracts.source(source), program.dialect, program.tree,
                            program.model, program.callGraph,        nullptr,         program.contracts,
                            source};
  CheckedFile file = headOf(item);
  file.path = context.source.path();
  file.source = context.source;
  LineFingerprints fingerprints(context.source);
  std::vector<RawFinding> found = runContractRules(item.profile->rules, context);
  for (const SidecarFinding &each : ofSuppressions)
    if (each.source == source)
      found.push_back(each.finding);
  std::stable_sort(found.begin(), found.end(),
                   [](const RawFinding &a, const RawFinding &b) { return feedhold::comesBefore(a, b); });
  for (RawFinding &raw : found) {
    Finding finding = toFinding(std::move(raw), *item.profile);
    finding.fingerprint = fingerprints.of(*finding.rule, finding.diagnostic.span);
    file.findings.push_back(std::move(finding));
  }
  return file.findings.empty() ? std::nullopt : std::optional(std::move(file));
}

FileAnalysis analyseOne(const WorkItem &item, const FileContext &context, const RuleRegistry &rules) {
  FileAnalysis result;
  std::vector<RawFinding> found;
  if (auto doubt = doubtOf(item, context)) {
    found.push_back(std::move(*doubt)); // and nothing else, as of a file that is refused
  } else {
    found = runRules(item.profile->rules, context);
    doubtErrors(found, item, context);
  }
  SuppressionResult raw = applySuppressions(std::move(found), context, rules, item.profile->rules);
  const std::vector<SidecarFinding> ofSidecars = std::move(raw.ofSidecars);
  result.findings = findingsOf(std::move(raw), context, *item.profile);
  for (const Program &program : context.model.programs)
    result.programs.push_back({toString(program.name), program.header});
  const std::vector<SourceFile> &sources = context.contracts[context.file.index()]->sources;
  for (std::size_t i = 1; i < sources.size(); ++i)
    if (std::optional<CheckedFile> file = checkSidecar(item, context, ContractSourceId(i), ofSidecars))
      result.sidecars.push_back(std::move(*file));
  return result;
}

bool isOfUnused(const Finding &finding) { return finding.rule->name == kUnusedSuppressionRule; }

/// Two programs of one number in a folder share a file: what one of them uses is not unused.
std::vector<CheckedFile> joinSidecars(std::vector<FileAnalysis> analysed, const std::vector<CheckedFile> &programs) {
  std::map<std::string, std::size_t> readers;
  for (const CheckedFile &program : programs)
    for (const std::string &path : program.sidecars)
      readers[path] += program.isOnlyCalled ? 0U : 1U;
  std::map<std::pair<std::string, std::string>, std::size_t> unused; // by path and fingerprint
  for (const FileAnalysis &of : analysed)
    for (const CheckedFile &file : of.sidecars)
      for (const Finding &finding : file.findings)
        if (isOfUnused(finding))
          ++unused[{file.path, finding.fingerprint}];
  std::vector<CheckedFile> joined;
  std::set<std::string> seen;
  for (FileAnalysis &of : analysed)
    for (CheckedFile &file : of.sidecars) {
      std::erase_if(file.findings, [&](const Finding &finding) {
        return isOfUnused(finding) && unused.at({file.path, finding.fingerprint}) < readers[file.path];
      });
      if (!file.findings.empty() && seen.insert(file.path).second)
        joined.push_back(std::move(file));
    }
  return joined;
}

bool isOnlyCalled(const WorkItem &item, const AnalyseOptions &options) {
  return options.only != nullptr && !options.only->contains(item.shown);
}

/// One finding instead of a thousand: nothing else is said about a file in another language.
std::vector<Finding> refuse(const WorkItem &item) {
  Finding result = toFinding(refusalOf(item), *item.profile);
  result.fingerprint = fingerprintOfFile(*result.rule, pathText(item.path.filename()));
  return {std::move(result)};
}

bool anyAsksFlow(std::span<const WorkItem> items) {
  return std::any_of(items.begin(), items.end(), [](const WorkItem &item) {
    return item.foreign == nullptr && std::any_of(item.profile->rules.begin(), item.profile->rules.end(),
                                                  [](const Rule *rule) { return rule->hooks.asksFlow(); });
  });
}

/// What is known of all files, by item.
struct RunAnalysis {
  std::vector<FileAnalysis> files;
  std::vector<InferredSetting> inferred;
  std::vector<PathProblem> errors = {};
};

RunAnalysis analyseAll(std::span<const WorkItem> items, const KnownNames &known, const AnalyseOptions &options) {
  Project project = loadProject(items, {.graphs = anyAsksFlow(items) ? LoadGraphs::Yes : LoadGraphs::No,
                                        .infer = InferMachines::Yes,
                                        .jobs = options.jobs,
                                        .open = options.open});
  const std::vector<const FileContracts *> contracts = project.contracts();
  RunAnalysis analysis{std::vector<FileAnalysis>(items.size()), std::move(project.inferred)};
  std::atomic<std::size_t> done{0};
  const auto contextOf = [&](std::size_t i) {
    const ProjectFile &file = project.file(FileId(i));
    return FileContext{FileId(i),
                       items[i].source,
                       *file.dialect,
                       file.tree,
                       file.model,
                       project.callGraph,
                       project.set ? &*project.set : nullptr,
                       contracts};
  };
  parallelFor(items.size(), options.jobs, [&](std::size_t i) {
    giveTurn();
    FileAnalysis &result = analysis.files[i];
    const bool isOwn = !isOnlyCalled(items[i], options);
    if (isOwn && items[i].foreign != nullptr)
      result.findings = refuse(items[i]);
    else if (isOwn)
      result = analyseOne(items[i], contextOf(i), known.rules);
    for (std::size_t k = 1; k < contracts[i]->sources.size(); ++k)
      result.sidecarPaths.push_back(contracts[i]->sources[k].path());
    if (isOwn && options.progress)
      options.progress(++done, items.size());
  });
  return analysis;
}

/// Of a run that is joined from its parts.
RunAnalysis givenAnalysis(std::span<const WorkItem> items, const KnownNames &known, const AnalyseOptions &options) {
  const Answers &given = *options.answers.given;
  const AnalysisKeys keys(items);
  RunAnalysis analysis{std::vector<FileAnalysis>(items.size()), {}};
  std::vector<std::uint8_t> isKnown(items.size(), 1);
  parallelFor(items.size(), options.jobs, [&](std::size_t i) {
    if (isOnlyCalled(items[i], options))
      return;
    const std::string *record = given.find(keys.of(items[i]));
    std::optional<FileAnalysis> found =
        record == nullptr ? std::nullopt : readFileAnalysis(*record, items[i], {items, known.rules});
    isKnown[i] = found ? 1 : 0;
    if (found)
      analysis.files[i] = std::move(*found);
  });
  for (std::size_t i = 0; i < items.size(); ++i)
    if (isKnown[i] == 0)
      analysis.errors.push_back({items[i].shown, kNoAnswer});
  const std::string *record = given.find(keys.ofInferred());
  std::optional<std::vector<InferredSetting>> inferred =
      record == nullptr ? std::nullopt : readInferred(*record, known.dialects);
  if (inferred)
    analysis.inferred = std::move(*inferred);
  else if (analysis.errors.empty()) // else that is told already
    analysis.errors.push_back({"the settings of the machines", kNoAnswer});
  return analysis;
}

void keep(const RunAnalysis &analysis, std::span<const WorkItem> items, const AnalyseOptions &options) {
  const AnalysisKeys keys(items);
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!isOnlyCalled(items[i], options))
      options.answers.kept->add(keys.of(items[i]), writeFileAnalysis(analysis.files[i]));
  options.answers.kept->add(keys.ofInferred(), writeInferred(analysis.inferred));
}

AnalysedFiles joined(std::span<const WorkItem> items, RunAnalysis analysis, const AnalyseOptions &options) {
  std::vector<CheckedFile> files;
  files.reserve(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    FileAnalysis &of = analysis.files[i];
    CheckedFile &file = files.emplace_back(headOf(items[i]));
    file.findings = std::move(of.findings);
    file.programs = std::move(of.programs);
    file.foreign = items[i].foreign == nullptr ? std::string_view() : items[i].foreign->name;
    file.isOnlyCalled = isOnlyCalled(items[i], options);
    file.sidecars = std::move(of.sidecarPaths);
  }
  std::vector<CheckedFile> sidecars = joinSidecars(std::move(analysis.files), files);
  std::move(sidecars.begin(), sidecars.end(), std::back_inserter(files));
  return {std::move(files), std::move(analysis.inferred), std::move(analysis.errors)};
}

} // namespace

AnalysedFiles analyse(std::span<const WorkItem> items, const KnownNames &known, const AnalyseOptions &options) {
  if (options.answers.given != nullptr)
    return joined(items, givenAnalysis(items, known, options), options);
  RunAnalysis analysis = analyseAll(items, known, options);
  if (options.answers.kept != nullptr)
    keep(analysis, items, options);
  return joined(items, std::move(analysis), options);
}

} // namespace feedhold
