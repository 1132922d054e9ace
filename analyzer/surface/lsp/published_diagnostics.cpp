#include "surface/lsp/published_diagnostics.h"

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
  Findings(std::size_t file, const CheckResult &result, const PublishContext &context)
      : own_(file), result_(result), context_(context) {}

  PublishedDiagnostic publishedOf(const Finding &finding) const {
    const Diagnostic &diagnostic = finding.diagnostic;
    PublishedDiagnostic published{.span = diagnostic.span,
                                  .severity = finding.severity,
                                  .code = std::string(finding.rule->name),
                                  .subject = {},
                                  .message = messageWithNotes(diagnostic)};
    addPlaces(published, diagnostic.labels);
    addPlaces(published, diagnostic.flow);
    published.fixes = diagnostic.fixes;
    return published;
  }

private:
  void addPlaces(PublishedDiagnostic &published, const std::vector<Label> &labels) const {
    for (const Label &label : labels)
      if (const std::size_t there = label.file ? label.file->index() : own_; there == own_) {
        published.related.push_back({.uri = {}, .span = label.span, .message = label.text});
      } else {
        const CheckedFile &file = result_.files[there];
        published.related.push_back({.uri = context_.uriOf(file.path),
                                     .range = Places(file.source, context_.encoding).range(label.span),
                                     .message = label.text});
      }
  }

  std::size_t own_;
  const CheckResult &result_;
  const PublishContext &context_;
};

/// What a proof left open, reported on the document or on the call in it that leads there.
class OpenObligations {
public:
  OpenObligations(const ProvedFile &file, const ProofsResult &result, const PublishContext &context)
      : file_(file), report_{.result = result}, context_(context) {}

  PublishedDiagnostic publishedOf(const Obligation &obligation, const ProvedProgram &program) const {
    const Dialect &dialect = file_.project->dialect();
    PublishedDiagnostic published{.span = obligation.span,
                                  .severity =
                                      obligation.verdict == Verdict::Refuted ? Severity::Error : Severity::Warning,
                                  .code = std::string(nameOf(obligation.kind)),
                                  .subject = obligation.id,
                                  .message = messageOf(obligation, dialect)};
    if (!obligation.verdict.reason().empty())
      published.message += fmt::format("\n{}", obligation.verdict.reason());
    if (obligation.verdict.witness())
      addWitness(published, obligation, program);
    if (obligation.verdict.guard())
      addGuard(published, *obligation.verdict.guard(), obligation.place.file);
    if (obligation.place.file != FileId(0))
      moveToOwnText(published, obligation, program);
    return published;
  }

private:
  void addWitness(PublishedDiagnostic &published, const Obligation &obligation, const ProvedProgram &program) const {
    const prove::Witness &witness = *obligation.verdict.witness();
    const TypedWitness call = typed(witness, file_, program, report_);
    const std::string happened = happenedIn(witness, obligation, file_.project->dialect());
    published.message += fmt::format("\n{}: {}", textOf(call), happened);
    if (witness.gouge) {
      const BlockId block = file_.project->set->node(witness.gouge->place).block;
      const FileId there = witness.gouge->place.file;
      addPlace(published, there, file_.project->file(there).tree.blocks[block].span(), happened);
    }
    published.commands.push_back({{"title", "run the witness: " + textOf(call)},
                                  {"command", "feedhold.runWitness"},
                                  {"arguments", Json::array({{{"obligation", obligation.id}}})}});
  }

  static void addGuard(PublishedDiagnostic &published, const prove::Guard &guard, FileId file) {
    published.message += "\n" + remedyOf(guard);
    if (guard.fix && file == FileId(0)) {
      FixIt fix = *guard.fix;
      fix.title = "insert the missing guard: " + fix.title;
      published.fixes.push_back(std::move(fix));
    }
  }

  void addPlace(PublishedDiagnostic &published, FileId there, Span span, std::string message) const {
    const ProjectFile &file = file_.project->file(there);
    RelatedPlace place{.uri = {}, .span = span, .message = std::move(message)};
    if (there != FileId(0)) {
      place.uri = context_.uriOf(file.path);
      place.range = Places(file.source, context_.encoding).range(span);
    }
    published.related.push_back(std::move(place));
  }

  /// The place is in a program that is called: the diagnostic stands at the head of the one that was proved.
  void moveToOwnText(PublishedDiagnostic &published, const Obligation &obligation, const ProvedProgram &program) const {
    addPlace(published, obligation.place.file, obligation.span, "here");
    const ProjectFile &own = file_.file();
    published.span = own.model.programs[program.program].header;
  }

  const ProvedFile &file_;
  ProveReport report_;
  const PublishContext &context_;
};

} // namespace

std::vector<PublishedDiagnostic> diagnosticsOfCheck(std::size_t file, const CheckResult &result,
                                                    const PublishContext &context) {
  const Findings findings(file, result, context);
  std::vector<PublishedDiagnostic> diagnostics;
  for (const Finding &finding : result.files[file].findings)
    if (!finding.suppressed)
      diagnostics.push_back(findings.publishedOf(finding));
  return diagnostics;
}

std::vector<PublishedDiagnostic> diagnosticsOfProofs(const ProvedFile &file, const ProofsResult &result,
                                                     const PublishContext &context) {
  const OpenObligations open(file, result, context);
  std::vector<PublishedDiagnostic> diagnostics;
  for (const ProvedProgram &program : file.programs)
    for (const Obligation &obligation : program.proof.obligations)
      if (!prove::holds(obligation.verdict))
        diagnostics.push_back(open.publishedOf(obligation, program));
  return diagnostics;
}

std::optional<PublishedDiagnostic> moved(const PublishedDiagnostic &published, const TextChange &change) {
  const std::optional<Span> span = moved(published.span, change);
  if (!span)
    return std::nullopt;
  PublishedDiagnostic result = published;
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

SplitDiagnostics split(std::vector<PublishedDiagnostic> diagnostics, const std::vector<PublishedDiagnostic> &others) {
  using Key = std::tuple<Span, std::string_view, std::string_view>;
  const auto keyOf = [](const PublishedDiagnostic &published) {
    return Key{published.span, published.code, published.message};
  };
  std::set<Key> keys;
  for (const PublishedDiagnostic &other : others)
    keys.insert(keyOf(other));
  SplitDiagnostics result;
  for (PublishedDiagnostic &published : diagnostics)
    (keys.contains(keyOf(published)) ? result.known : result.fresh).push_back(std::move(published));
  return result;
}

Json diagnosticOf(const PublishedDiagnostic &published, const Places &places, const std::string &uri,
                  const PublishContext &context) {
  Json diagnostic = {{"range", places.range(published.span)},
                     {"severity", numberOf(published.severity)},
                     {"code", published.code},
                     {"source", "feedhold"},
                     {"message", published.message}};
  if (const std::string page = context.pageOf(published.code); !page.empty())
    diagnostic["codeDescription"] = {{"href", page}};
  if (published.code == kUnreachableRule)
    diagnostic["tags"] = Json::array({1}); // Unnecessary
  for (const RelatedPlace &place : published.related)
    diagnostic["relatedInformation"].push_back(
        {{"location",
          {{"uri", place.uri.empty() ? uri : place.uri},
           {"range", place.uri.empty() ? places.range(place.span) : place.range}}},
         {"message", place.message}});
  if (!published.subject.empty())
    diagnostic["data"] = {{"obligation", published.subject}};
  return diagnostic;
}

} // namespace feedhold::lsp
