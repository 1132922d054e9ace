#include "surface/lsp/remarks.h"

#include "base/support/check.h"
#include "surface/sink/prove_shown.h"
#include "surface/sink/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace feedhold::lsp {

namespace {

using prove::Obligation;
using prove::Verdict;

constexpr std::string_view kUnreachableRule = "unreachable-block";

/// The number that the protocol has for it.
int numberOf(Severity severity) {
  switch (severity) {
  case Severity::Error: return 1;
  case Severity::Warning: return 2;
  case Severity::Info: return 3;
  }
  FEEDHOLD_UNREACHABLE("a severity");
}

class Findings {
public:
  Findings(std::size_t file, const CheckResult &result, const RemarkContext &context)
      : own_(file), result_(result), context_(context) {}

  Remark remarkOf(const Finding &finding) const {
    const Diagnostic &diagnostic = finding.diagnostic;
    Remark remark{.span = diagnostic.span,
                  .severity = finding.severity,
                  .code = std::string(finding.rule->name),
                  .subject = {},
                  .message = messageWithNotes(diagnostic)};
    addPlaces(remark, diagnostic.labels);
    addPlaces(remark, diagnostic.way);
    remark.fixes = diagnostic.fixes;
    return remark;
  }

private:
  void addPlaces(Remark &remark, const std::vector<Label> &labels) const {
    for (const Label &label : labels)
      if (const std::size_t there = label.file ? label.file->index() : own_; there == own_) {
        remark.related.push_back({.uri = {}, .span = label.span, .message = label.text});
      } else {
        const CheckedFile &file = result_.files[there];
        remark.related.push_back({.uri = context_.uriOf(file.path),
                                  .range = Places(file.source, context_.encoding).range(label.span),
                                  .message = label.text});
      }
  }

  std::size_t own_;
  const CheckResult &result_;
  const RemarkContext &context_;
};

/// What a proof left open, as a remark on the document or on the call in it that leads there.
class OpenObligations {
public:
  OpenObligations(const ProvedFile &file, const ProofsResult &result, const RemarkContext &context)
      : file_(file), report_{.result = result}, context_(context) {}

  Remark remarkOf(const Obligation &obligation, const ProvedProgram &program) const {
    const Dialect &dialect = file_.project->dialect();
    Remark remark{.span = obligation.span,
                  .severity = obligation.verdict == Verdict::Refuted ? Severity::Error : Severity::Warning,
                  .code = std::string(nameOf(obligation.kind)),
                  .subject = obligation.id,
                  .message = messageOf(obligation, dialect)};
    if (!obligation.verdict.reason().empty())
      remark.message += fmt::format("\n{}", obligation.verdict.reason());
    if (obligation.verdict.witness())
      addWitness(remark, obligation, program);
    if (obligation.verdict.guard())
      addGuard(remark, *obligation.verdict.guard(), obligation.place.file);
    if (obligation.place.file != FileId(0))
      moveToOwnText(remark, obligation, program);
    return remark;
  }

private:
  void addWitness(Remark &remark, const Obligation &obligation, const ProvedProgram &program) const {
    const prove::Witness &witness = *obligation.verdict.witness();
    const TypedWitness call = typed(witness, file_, program, report_);
    const std::string happened = happenedIn(witness, obligation, file_.project->dialect());
    remark.message += fmt::format("\n{}: {}", textOf(call), happened);
    if (witness.gouge) {
      const BlockId block = file_.project->set->node(witness.gouge->place).block;
      const FileId there = witness.gouge->place.file;
      addPlace(remark, there, file_.project->file(there).tree.blocks[block].span(), happened);
    }
    remark.commands.push_back({{"title", "run the witness: " + textOf(call)},
                               {"command", "feedhold.runWitness"},
                               {"arguments", Json::array({{{"obligation", obligation.id}}})}});
  }

  static void addGuard(Remark &remark, const prove::Guard &guard, FileId file) {
    remark.message += "\n" + remedyOf(guard);
    if (guard.fix && file == FileId(0)) {
      FixIt fix = *guard.fix;
      fix.title = "insert the missing guard: " + fix.title;
      remark.fixes.push_back(std::move(fix));
    }
  }

  void addPlace(Remark &remark, FileId there, Span span, std::string message) const {
    const ProjectFile &file = file_.project->file(there);
    RelatedPlace place{.uri = {}, .span = span, .message = std::move(message)};
    if (there != FileId(0)) {
      place.uri = context_.uriOf(file.path);
      place.range = Places(file.source, context_.encoding).range(span);
    }
    remark.related.push_back(std::move(place));
  }

  /// The place is in a program that is called: the remark stands at the head of the one that was proved.
  void moveToOwnText(Remark &remark, const Obligation &obligation, const ProvedProgram &program) const {
    addPlace(remark, obligation.place.file, obligation.span, "here");
    const ProjectFile &own = file_.file();
    remark.span = own.model.programs[program.program].header;
  }

  const ProvedFile &file_;
  ProveReport report_;
  const RemarkContext &context_;
};

} // namespace

std::vector<Remark> remarksOn(std::size_t file, const CheckResult &result, const RemarkContext &context) {
  const Findings findings(file, result, context);
  std::vector<Remark> remarks;
  for (const Finding &finding : result.files[file].findings)
    if (!finding.suppressed)
      remarks.push_back(findings.remarkOf(finding));
  return remarks;
}

std::vector<Remark> remarksOnProofs(const ProvedFile &file, const ProofsResult &result, const RemarkContext &context) {
  const OpenObligations open(file, result, context);
  std::vector<Remark> remarks;
  for (const ProvedProgram &program : file.programs)
    for (const Obligation &obligation : program.proof.obligations)
      if (!prove::holds(obligation.verdict))
        remarks.push_back(open.remarkOf(obligation, program));
  return remarks;
}

std::optional<Remark> moved(const Remark &remark, const TextChange &change) {
  const std::optional<Span> span = moved(remark.span, change);
  if (!span)
    return std::nullopt;
  Remark result = remark;
  result.span = *span;
  std::erase_if(result.related, [&](RelatedPlace &place) {
    const std::optional<Span> there = moved(place.span, change);
    place.span = there.value_or(place.span);
    return place.uri.empty() && !there;
  });
  std::erase_if(result.fixes, [&](FixIt &fix) {
    return std::any_of(fix.edits.begin(), fix.edits.end(), [&](Edit &edit) {
      const std::optional<Span> there = moved(edit.span, change);
      edit.span = there.value_or(edit.span);
      return !there;
    });
  });
  return result;
}

SplitRemarks split(std::vector<Remark> remarks, const std::vector<Remark> &others) {
  using Key = std::tuple<Span, std::string_view, std::string_view>;
  const auto keyOf = [](const Remark &remark) { return Key{remark.span, remark.code, remark.message}; };
  std::set<Key> keys;
  for (const Remark &other : others)
    keys.insert(keyOf(other));
  SplitRemarks result;
  for (Remark &remark : remarks)
    (keys.contains(keyOf(remark)) ? result.known : result.fresh).push_back(std::move(remark));
  return result;
}

Json diagnosticOf(const Remark &remark, const Places &places, const std::string &uri, const RemarkContext &context) {
  Json diagnostic = {{"range", places.range(remark.span)},
                     {"severity", numberOf(remark.severity)},
                     {"code", remark.code},
                     {"source", "feedhold"},
                     {"message", remark.message}};
  if (const std::string page = context.pageOf(remark.code); !page.empty())
    diagnostic["codeDescription"] = {{"href", page}};
  if (remark.code == kUnreachableRule)
    diagnostic["tags"] = Json::array({1}); // Unnecessary
  for (const RelatedPlace &place : remark.related)
    diagnostic["relatedInformation"].push_back(
        {{"location",
          {{"uri", place.uri.empty() ? uri : place.uri},
           {"range", place.uri.empty() ? places.range(place.span) : place.range}}},
         {"message", place.message}});
  if (!remark.subject.empty())
    diagnostic["data"] = {{"obligation", remark.subject}};
  return diagnostic;
}

} // namespace feedhold::lsp
