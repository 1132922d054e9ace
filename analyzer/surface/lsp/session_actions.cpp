// Code actions, formatting and commands.  Editors ask for actions at every movement of the cursor: they are made of
// what is known already.
#include "surface/lsp/session.h"

#include "base/source/path_text.h"
#include "surface/lsp/formatter.h"
#include "surface/sink/prove_shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::lsp {

namespace {

constexpr std::string_view kQuickFix = "quickfix";
constexpr std::string_view kRefactor = "refactor";
constexpr std::string_view kFixAll = "source.fixAll.feedhold";

Json textEdits(const std::vector<Edit> &edits, const Places &places) {
  Json rows = Json::array();
  for (const Edit &edit : edits)
    rows.push_back({{"range", places.range(edit.span)}, {"newText", edit.replacement}});
  return rows;
}

Json workspaceEdit(const OpenDocument &document, const std::vector<Edit> &edits, const Places &places) {
  return {{"changes", {{document.document.uri, textEdits(edits, places)}}}};
}

/// Kinds are trees: `source` asks for `source.fixAll.feedhold`, too.
bool isWanted(const Json &context, std::string_view kind) {
  const auto only = context.find("only");
  if (only == context.end() || only->is_null())
    return true;
  return std::any_of(only->begin(), only->end(), [&](const Json &each) {
    const auto wanted = each.get<std::string>();
    return kind == wanted || kind.starts_with(wanted + ".");
  });
}

std::vector<const PublishedDiagnostic *> diagnosticsAt(Span span, const OpenDocument &document) {
  std::vector<const PublishedDiagnostic *> found;
  for (const std::vector<PublishedDiagnostic> *some : {&document.proofs, &document.quick, &document.flow})
    for (const PublishedDiagnostic &published : *some)
      if (published.span.begin <= span.end && span.begin <= published.span.end)
        found.push_back(&published);
  return found;
}

bool hasSafeFix(const std::vector<PublishedDiagnostic> &diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(), [](const PublishedDiagnostic &published) {
    return std::any_of(published.fixes.begin(), published.fixes.end(),
                       [](const FixIt &fix) { return fix.safety == FixSafety::Safe; });
  });
}

std::string styleText(const Json &options) {
  constexpr std::size_t kWidest = 16;
  if (options.value("insertSpaces", true))
    return std::string(std::min(options.at("tabSize").get<std::size_t>(), kWidest), ' ');
  return "\t";
}

} // namespace

Json ClientSession::codeActions(const Json &params) {
  OpenDocument &document = documentOf(params);
  const Json context = params.at("context");
  const Places places(SourceFile::fromText({}, *document.document.text), workspace_.encoding);
  Json actions = Json::array();
  if (isWanted(context, kQuickFix))
    for (const PublishedDiagnostic *published : diagnosticsAt(places.span(params.at("range")), document))
      addActions(*published, document, places, actions);
  if (isWanted(context, kRefactor))
    addDraft(document, places.span(params.at("range")), actions);
  if (isWanted(context, kFixAll) && (hasSafeFix(document.quick) || hasSafeFix(document.flow)))
    if (const std::optional<Edit> edit = fixAll(document))
      actions.push_back(
          {{"title", "apply all safe fixes"}, {"kind", kFixAll}, {"edit", workspaceEdit(document, {*edit}, places)}});
  return actions;
}

void ClientSession::addActions(const PublishedDiagnostic &published, OpenDocument &document, const Places &places,
                               Json &actions) {
  const Json diagnostics = Json::array({diagnosticOf(published, places, document.document.uri, publishContext())});
  for (const FixIt &fix : published.fixes) {
    Json action = {{"title", fix.title},
                   {"kind", kQuickFix},
                   {"diagnostics", diagnostics},
                   {"edit", workspaceEdit(document, fix.edits, places)}};
    if (fix.safety == FixSafety::Safe)
      action["isPreferred"] = true;
    actions.push_back(std::move(action));
  }
  for (Json command : published.commands) {
    for (Json &argument : command["arguments"])
      argument["uri"] = document.document.uri;
    const Json title = command["title"];
    actions.push_back({{"title", title}, {"kind", kQuickFix}, {"diagnostics", diagnostics}, {"command", command}});
  }
  const auto programs = workspace_.programsOf(document);
  const RegisteredRule *rule = findRule(options_.known.rules, published.code);
  const bool isOfSuppression = rule && rule->rule->info.category == Category::Suppression;
  if (!programs || !published.subject.empty() || isOfSuppression)
    return; // a verdict is no matter of opinion, and what is wrong with a suppression cannot be suppressed
  const ProjectFile &file = programs->file(FileId(0));
  if (const std::optional<Edit> edit = commentAllowing(published, file))
    actions.push_back({{"title", fmt::format("allow `{}` here, with a reason", published.code)},
                       {"kind", kQuickFix},
                       {"diagnostics", diagnostics},
                       {"edit", workspaceEdit(document, {*edit}, places)}});
  const std::optional<SidecarClause> clause = clauseAllowing(published, file);
  if (clause && (!clause->isNew || createsFiles_))
    actions.push_back({{"title", fmt::format("allow `{}` for {} in {}, with a reason", published.code, clause->place,
                                             pathText(clause->file.filename()))},
                       {"kind", kQuickFix},
                       {"diagnostics", diagnostics},
                       {"edit", sidecarEdit(*clause)}});
}

Json ClientSession::sidecarEdit(const SidecarClause &clause) const {
  const std::string uri = workspace_.uriOf(clause.file);
  const Json edits = textEdits({clause.edit}, Places(clause.before, workspace_.encoding));
  if (!clause.isNew)
    return {{"changes", {{uri, edits}}}};
  return {{"documentChanges",
           {{{"kind", "create"}, {"uri", uri}, {"options", {{"ignoreIfExists", true}}}},
            {{"textDocument", {{"uri", uri}, {"version", nullptr}}}, {"edits", edits}}}}};
}

/// What `check --fix` would make of the text; absent when it is the same.
std::optional<Edit> ClientSession::fixAll(OpenDocument &document) {
  if (!document.fixed || document.fixed->stamp != document.stamp) {
    // With its folder: what seems unused in a program alone may be of use to those that it calls.
    const FlowScope scope = workspace_.scopeOf(document);
    const FixResult result = fix(scope.whole ? *scope.whole : scope.alone, FixKind::Safe, options_.known);
    const std::string name = Workspace::nameIn(document, scope.alone);
    document.fixed = FixedText{document.stamp, *document.document.text};
    for (const FixedFile &file : result.files)
      if (file.path == name)
        document.fixed->text = file.after;
  }
  const std::string &after = document.fixed->text;
  const TextChange change = difference(*document.document.text, after);
  if (change.removed == 0 && change.added == 0)
    return std::nullopt;
  return Edit{{change.at, change.at + change.removed}, after.substr(change.at, change.added)};
}

Json ClientSession::formatting(const Json &params) {
  OpenDocument &document = documentOf(params);
  const FormatStyle style{styleText(params.at("options"))};
  const auto programs = workspace_.programsOf(document);
  if (!programs)
    return nullptr;
  const ProjectFile &file = programs->file(FileId(0));
  std::vector<Edit> edits = format(file.source, file.tree, programs->dialect(), style);
  const Places places(file.source, workspace_.encoding);
  if (params.contains("range")) {
    const Span asked = places.span(params.at("range"));
    const Span lines{file.source.lineSpan(file.source.lineOf(asked.begin)).begin,
                     file.source.lineSpan(file.source.lineOf(asked.end)).end};
    std::erase_if(edits, [&](const Edit &edit) { return !lines.contains(edit.span); });
  }
  return textEdits(edits, places);
}

Json ClientSession::execute(const Json &params) {
  const auto command = params.at("command").get<std::string>();
  const auto arguments = params.find("arguments");
  constexpr std::array kCommands = {"feedhold.draft", "feedhold.prove", "feedhold.runWitness"};
  if (std::find(kCommands.begin(), kCommands.end(), command) == kCommands.end())
    throw RequestError(ErrorCode::InvalidParams, fmt::format("unknown command `{}`", command));
  if (arguments == params.end() || !arguments->is_array() || arguments->empty())
    throw RequestError(ErrorCode::InvalidParams,
                       fmt::format("`{}` needs the URI of a document, as a string or as {{\"uri\": ..}}", command));
  const Json &argument = arguments->front();
  const Json target = {{"textDocument", {{"uri", argument.is_string() ? argument : argument.at("uri")}}}};
  OpenDocument &document = documentOf(target);
  if (command == "feedhold.prove") {
    document.verdicts.reset();
    startProofs(document);
    return nullptr;
  }
  if (command == "feedhold.draft") {
    startDraft(document, argument.is_string() ? std::string() : argument.value("program", std::string()));
    return nullptr;
  }
  return runWitness(document, argument.at("obligation").get<std::string>());
}

/// The prover has run it already; a person reads what it came to, and how to see it again.
Json ClientSession::runWitness(const OpenDocument &document, const std::string &id) {
  if (document.verdicts && document.proved)
    for (const ProvedFile &file : document.proved->files)
      for (const ProvedProgram &program : file.programs)
        for (const prove::Obligation &obligation : program.proof.obligations)
          if (obligation.id == id && obligation.verdict.witness()) {
            const ProveReport report{.result = *document.proved};
            const TypedWitness witness = typed(*obligation.verdict.witness(), file, program, report);
            const std::string happened = happenedIn(*obligation.verdict.witness(), obligation, file.project->dialect());
            show(Severity::Info, fmt::format("{}: {}\n{}", textOf(witness), happened, witness.run()));
            return {{"call", textOf(witness)}, {"happened", happened}, {"run", witness.run()}};
          }
  throw RequestError(ErrorCode::RequestFailed,
                     fmt::format("{} has no witness for the current text; run the proof again", id));
}

} // namespace feedhold::lsp
